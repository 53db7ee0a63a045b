"""A partner that is missing, elsewhere or different, and command lines that cannot work."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from lcm_network import BINARIES, Process, controller, plant, run  # noqa: E402
from waiting import LIMIT_S  # noqa: E402


class WrongPartner(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_missing_partner_is_one_message_and_status_1(self):
        with controller(self.folder, "--partner-timeout", 4) as control:
            self.assertEqual(control.status(), 1)
            self.assertEqual(control.text.count("no sensor frames at udpm://239.255.76.67:7667"), 1)
            self.assertIn("start amb-plant with the same --rig, --port and --pace", control.text)
        with plant(self.folder, "--partner-timeout", 4) as rig:
            self.assertEqual(rig.status(), 1)
            self.assertEqual(rig.text.count("no controller answers at udpm://239.255.76.67:7668"), 1)
            self.assertIn("start amb-controller", rig.text)

    def status_and_message(self, program, *words):
        done = subprocess.run([str(BINARIES / program), *words], capture_output=True, text=True,
                              timeout=LIMIT_S, check=False)
        return done.returncode, done.stderr

    # The loopback interface is no virtual CAN bus: for what may be a rig, like any chip's.
    def test_lockstep_is_refused_where_a_real_rig_may_be(self):
        words = ["--rig", "flexible_rotor", "--controller", "flexible_rotor", "--port", "can:lo"]
        for pace in ([], ["--pace", "lockstep"]):
            status, message = self.status_and_message("amb-controller", *words, *pace)
            self.assertEqual(status, 2, message)
            self.assertIn("allowed: --pace realtime", message)
        status, message = self.status_and_message("amb-controller", *words, "--pace", "realtime")
        self.assertNotIn("lockstep", message)
        self.assertNotEqual(status, 2, message)  # one bus for both directions is too slow

    def test_a_simulated_rig_stays_off_a_bus_where_a_real_one_may_be(self):
        words = ["--rig", "flexible_rotor", "--port", "can:lo"]
        status, message = self.status_and_message("amb-rig", *words)
        self.assertEqual(status, 2, message)
        self.assertIn("--on-a-real-bus", message)
        status, message = self.status_and_message("amb-rig", *words, "--on-a-real-bus")
        self.assertNotEqual(status, 2, message)

    def test_another_port_is_another_network(self):
        elsewhere = "lcm:udpm://239.255.76.67:8667?ttl=0"
        with plant(self.folder, "--partner-timeout", 3) as rig, \
                controller(self.folder, "--port", elsewhere, "--partner-timeout", 3) as control:
            self.assertEqual(control.status(), 1)
            self.assertEqual(rig.status(), 1)
            self.assertIn("udpm://239.255.76.67:8667", control.text)

    def test_another_group_on_the_same_port_is_another_network(self):
        elsewhere = "lcm:udpm://239.255.76.68:7667?ttl=0"
        with plant(self.folder, "--partner-timeout", 3) as rig, \
                controller(self.folder, "--port", elsewhere, "--partner-timeout", 3) as control:
            self.assertEqual(control.status(), 1)
            self.assertEqual(rig.status(), 1)

    def test_machine_without_loopback_is_told_the_remedy(self):
        for program in (["amb-plant", "--rig", "flexible_rotor"],
                        ["amb-controller", "--rig", "flexible_rotor", "--controller",
                         "flexible_rotor", "--trip-folder", str(self.folder)]):
            done = subprocess.run(["unshare", "-n", str(BINARIES / program[0]), *program[1:]],
                                  capture_output=True, text=True, timeout=LIMIT_S, check=False)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn("ip link set lo up", done.stderr)

    def test_signal_ends_a_program_that_has_no_partner(self):
        for start in (controller, plant):
            with start(self.folder) as lonely:
                lonely.says("udpm://")
                lonely.terminate()
                self.assertEqual(lonely.status(), 0, lonely.text)

    def test_command_line_and_files_have_their_statuses(self):
        def status(name, *arguments):
            with Process(self.folder, name, *arguments) as process:
                return process.status(), process.text
        self.assertEqual(status("amb-plant")[0], 2)
        self.assertEqual(status("amb-controller", "--rig", "flexible_rotor")[0], 2)
        self.assertEqual(status("amb-plant", "--rig", "flexible_rotor", "--pace", "slow")[0], 2)
        rig = ["--rig", "flexible_rotor"]
        for program in (["amb-plant", *rig], ["amb-controller", *rig, "--controller", "flexible_rotor"]):
            for time in ("nan", "1e300"):  # no times: as nanoseconds they would be over at once
                code, text = status(*program, "--partner-timeout", time)
                self.assertEqual(code, 2, text)
                self.assertIn(f"'{time}' is no time", text)
        code, text = status("amb-plant", "--rig", "flexible_rotor", "--port", "lcm:udpm://10.0.0.1:1")
        self.assertEqual(code, 2)
        self.assertIn("not a multicast address", text)
        self.assertEqual(status("amb-plant", "--rig", "/no/such/rig.yaml")[0], 3)
        self.assertEqual(status("amb-plant", "--help")[0], 0)


if __name__ == "__main__":
    run()

"""What comes from outside at 3000 rpm, at the real-time pace, in virtual time, one by one.

The machine's processor is idle but for us, so what is asserted in periods is what the programs do.
The rig and its controller accelerate faster than the shipped ones, to keep the runs short.
"""

import math
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

SOURCE = Path(os.environ["LEVITAS_SOURCE"])
sys.path.insert(0, str(SOURCE / "tests/support"))
from lcm_network import Process  # noqa: E402
from rotor_fate import SPEED_RPM, Fate, records, rpm  # noqa: E402

PERIOD_S = 1e-4
RPM_PER_S = 20_000
CLEARANCE_M = 190e-6  # of the shipped rig
RIG_WATCHDOG = 1000  # periods, amb-plant
CAN_WATCHDOG = 20  # periods, amb-rig
WITHIN_S = 5  # of virtual time
SCENARIO = f"""kind: scenario
name: spin
steps:
  - {{do: lift, until: levitating, timeout_s: 5, hold_s: 0.05}}
  - {{do: spin, speed_rpm: {SPEED_RPM}, acceleration_rpm_per_s: {RPM_PER_S}, until: speed_reached, timeout_s: 5, hold_s: 60}}
"""


class Turning(unittest.TestCase):
    """A rotor at full speed, and what a record must say of its end."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "spin.yaml").write_text(SCENARIO, encoding="utf-8")
        self.rig_file = self.faster("rigs/flexible_rotor", "max_acceleration_rpm_per_s")
        self.controller_file = self.faster("controllers/flexible_rotor_commissioned",
                                           "trip_deceleration_rpm_per_s")
        self.session = self.folder / "session.lcmlog"

    def faster(self, name, key):
        text = (SOURCE / f"config/{name}.yaml").read_text(encoding="utf-8")
        changed = re.sub(rf"{key}: \d+", f"{key}: {RPM_PER_S}", text)
        self.assertNotEqual(text, changed)
        path = self.folder / f"{Path(name).name}.yaml"
        path.write_text(changed, encoding="utf-8")
        return path

    def start(self, port="lcm", rig="amb-plant", stderr=None, record=None):
        common = ["--rig", self.rig_file, "--port", port, "--pace", "realtime"]
        self.rig = Process(self.folder, rig, *common)
        self.addCleanup(self.rig.kill)
        words = ["--controller", self.controller_file, "--scenario", self.folder / "spin.yaml",
                 "--record", record or self.session, "--trip-folder", self.folder]
        control = Process(self.folder, "amb-controller", *common, *words, output=stderr)
        self.addCleanup(control.kill)
        return control

    def turning(self):
        """Lift 0.95 s, run up 0.15 s after the rig has energised its magnets; and half a second."""
        self.rig.says("amplifiers on")
        time.sleep(1.1 + SPEED_RPM / RPM_PER_S)

    def landed(self, control, status=0):
        self.assertEqual(control.status(), status, control.text)
        fate = Fate(self.session)
        print(f"{self.id().rsplit('.', 1)[1]}: {fate}", flush=True)
        self.assertTrue(fate.landed, f"{fate}\n{control.text}")
        self.rig.says("amplifiers off, as commanded")
        return records(self.session)

    def no_deadline_missed(self, all_records):
        self.assertEqual(sum(record.missed_deadlines for record in all_records), 0)


class Outside(Turning):
    def test_a_lost_connection(self):
        control = self.start()
        self.turning()
        for _ in range(3):
            control.child.send_signal(signal.SIGHUP)
        self.no_deadline_missed(self.landed(control))

    def test_ctrl_z_and_signals_of_others(self):
        control = self.start()
        self.turning()
        for number in (signal.SIGTSTP, signal.SIGTTOU, signal.SIGUSR1, signal.SIGALRM, signal.SIGXFSZ):
            control.child.send_signal(number)
        time.sleep(0.05)
        control.terminate()
        self.no_deadline_missed(self.landed(control))

    def test_a_log_that_nobody_takes(self):
        here, there = os.pipe()
        os.set_blocking(there, False)
        try:
            while True:
                os.write(there, b"x" * 4096)
        except BlockingIOError:
            os.set_blocking(there, True)
        control = self.start(stderr=there)
        self.turning()
        control.terminate()
        self.no_deadline_missed(self.landed(control))
        os.close(here)
        os.close(there)

    def test_a_log_on_a_full_disk(self):
        with open("/dev/full", "wb") as full:
            control = self.start(stderr=full)
        self.turning()
        control.terminate()
        self.no_deadline_missed(self.landed(control))

    def test_a_full_disk(self):
        small = self.folder / "small"
        small.mkdir()
        subprocess.run(["mount", "-t", "tmpfs", "-o", "size=3m", "none", small], check=True)
        self.addCleanup(subprocess.run, ["umount", "-l", small], check=False)
        control = self.start(record=small / "session.lcmlog")
        self.turning()
        control.terminate()
        self.assertEqual(control.status(), 0, control.text)
        self.assertIn("recording stopped: No space left on device", control.text)
        self.assertIn("landing -> off", control.text)
        self.rig.says("amplifiers off, as commanded")
        self.assertRegex(control.text, r"\b0 skipped")

    def test_a_stop_of_5_ms_is_a_trip_that_catches_the_rotor_again_and_brakes_it(self):
        control = self.start()
        self.turning()
        control.child.send_signal(signal.SIGSTOP)
        time.sleep(5e-3)
        control.child.send_signal(signal.SIGCONT)
        time.sleep(0.2)
        control.terminate()
        all_records = self.landed(control, status=4)
        missed = [record.missed_deadlines for record in all_records if record.missed_deadlines]
        # The periods of 5 ms, but for the one at each end.
        self.assertGreaterEqual(sum(missed), 48)
        trip = next(record for record in all_records if record.fault)
        print(f"  {sum(missed)} periods missed, fault {trip.fault}", flush=True)
        # The rig holds the last currents meanwhile, so the rotor touches; then it is held again.
        braking = [max(math.hypot(r.position_m[i], r.position_m[i + 1]) for i in (0, 2))
                   for r in all_records if r.cycle > trip.cycle and abs(rpm(r)) > 0.1 * SPEED_RPM]
        print(f"  largest radius {max(braking) * 1e6:.0f} um, in the second half of the braking "
              f"{max(braking[len(braking) // 2:]) * 1e6:.0f} um", flush=True)
        self.assertLess(max(braking[len(braking) // 2:]), 0.5 * CLEARANCE_M)

    def test_a_killed_controller_is_left_to_the_watchdog_of_the_rig(self):
        control = self.start()
        self.turning()
        control.kill()
        self.rig.says(f"amplifiers off: no valid current for {RIG_WATCHDOG} periods", WITHIN_S)


class OutsideOverCan(Turning):
    """The rig's watchdog on currents is the one of a real rig."""

    @classmethod
    def setUpClass(cls):
        subprocess.run("ip link add dev vcan0 type vcan; ip link set vcan0 mtu 72 up", shell=True,
                       check=True)

    def start(self, port="can:vcan0", rig="amb-rig", stderr=None, record=None):
        return super().start(port, rig, stderr, record)

    def test_a_stop_of_5_ms_ends_in_the_release_by_the_watchdog_of_the_rig(self):
        control = self.start()
        self.turning()
        control.child.send_signal(signal.SIGSTOP)
        time.sleep(5e-3)
        control.child.send_signal(signal.SIGCONT)
        self.rig.says(f"amplifiers off: no valid current for {CAN_WATCHDOG} periods", WITHIN_S)
        control.says("TRIP")
        control.terminate()
        self.assertEqual(control.status(), 4, control.text)

    def test_a_killed_controller_is_left_to_the_watchdog_of_the_rig(self):
        control = self.start()
        self.turning()
        control.kill()
        self.rig.says(f"amplifiers off: no valid current for {CAN_WATCHDOG} periods", WITHIN_S)


if __name__ == "__main__":
    unittest.main(verbosity=2)

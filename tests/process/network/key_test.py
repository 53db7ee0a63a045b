"""Two machines that reach each other (ttl 1): the key decides who may speak."""

import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from far_page import FarPage  # noqa: E402
from forged import STOP, command, everything  # noqa: E402
from lcm_network import COMMAND, SKIPPED, Process, controller, plant, run  # noqa: E402
from seal import Sealer, new_key  # noqa: E402
from two_machines import OtherMachine, possible  # noqa: E402

PORT = "lcm:udpm://239.255.76.67:7667?ttl=1"


class Key(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.key, self.other_key = (new_key(self.folder / name) for name in ("lab.key", "other.key"))
        self.other = OtherMachine()
        self.addCleanup(self.other.close)

    def pair(self, *arguments):
        options = ("--port", PORT, "--key", "lab.key")
        return plant(self.folder, *options), controller(self.folder, *options, *arguments)

    def test_the_key_moves_the_rig_and_no_key_another_key_and_records_do_not(self):
        rig, control = self.pair()
        with rig, control:
            control.says("rig found")
            control.says("whoever has the key lab.key, on any machine")
            self.other.send(everything())
            stranger = Sealer(self.other_key)
            self.other.send([(port, stranger.seal(data, port)) for port, data in everything()])
            control.says("messages without a key are refused")
            said = control.says("messages with another key, or changed on the way are refused")
            self.assertNotIn("command lift", said)

            recorder = self.other.listen(self.folder, COMMAND)
            with recorder, FarPage(self.other, self.folder, "--port", PORT, "--key", "lab.key") as page:
                self.assertEqual(page.command("lift"), "accepted")
                control.says("-> levitating")
                lift = self.recorded(recorder)
            self.other.send([(COMMAND, lift)])
            control.says("messages repeated, or recorded before are refused")
            control.terminate()
            self.assertEqual(control.status(), 0, control.text)
            self.assertEqual(rig.status(), 0, rig.text)
        self.assertEqual(control.text.count("command lift"), 1)
        self.assertNotIn("TRIP", control.text)

        # What was recorded of that run is worth nothing in the next one, but for a stop, which
        # needs no more than the seal: of another key it is none.
        rig, control = self.pair()
        with rig, control:
            control.says("rig found")
            port, stop = command(STOP)
            self.other.send([(COMMAND, lift), (COMMAND, stranger.seal(stop, port))])
            control.says("messages recorded before, or given without a challenge are refused")
            said = control.says("messages with another key, or changed on the way are refused")
            self.assertNotIn("TRIP", said)
            self.other.send([(COMMAND, Sealer(self.key).seal(stop, port, challenge=0))], 1)
            self.assertNotIn("command lift", control.says("TRIP"))

    def recorded(self, recorder):
        """A command as it was on the wire, with its seal."""
        heard = recorder.says(re.compile(rf"[0-9a-f]*{b'LEVITAS_COMMAND'.hex()}00[0-9a-f]*\n"))
        return bytes.fromhex(heard.splitlines()[-1])

    def test_other_machines_are_let_in_only_with_a_key(self):
        for name, arguments in (("amb-plant", []), ("amb-controller",
                                                    ["--controller", "flexible_rotor"])):
            with Process(self.folder, name, "--rig", "flexible_rotor", "--port", PORT,
                         *arguments) as process:
                self.assertEqual(process.status(), 2, process.text)
                self.assertIn("--key FILE", process.text)

    def test_a_key_that_others_may_read_is_a_bad_file(self):
        (self.folder / "lab.key").chmod(0o644)
        rig, control = self.pair()
        with rig, control:
            for process in (rig, control):
                self.assertEqual(process.status(), 3, process.text)
                self.assertIn("chmod 600 lab.key", process.text)

    def test_without_commands_nobody_commands(self):
        with plant(self.folder) as rig, controller(self.folder, "--no-commands") as control:
            control.says("who may command: nobody over the network (--no-commands)")
            control.says("rig found")
            used = subprocess.run(["ss", "-Hlun"], capture_output=True, text=True, check=True).stdout
            self.assertNotIn(f":{COMMAND} ", used)
            control.terminate()
            self.assertEqual(control.status(), 0, control.text)
            self.assertEqual(rig.status(), 0, rig.text)

    def test_a_pair_with_a_key_on_its_own_machine_works_as_one_without(self):
        with plant(self.folder, "--key", "lab.key") as rig, controller(
                self.folder, "--key", "lab.key", "--scenario", "levitate") as control:
            self.assertEqual(control.status(), 0, control.text)
            self.assertEqual(rig.status(), 0, rig.text)
        self.assertNotIn("refused", control.text)


if __name__ == "__main__":
    if not possible():
        print("not run: no pair of joined network namespaces here")
        sys.exit(SKIPPED)
    run()

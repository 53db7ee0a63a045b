"""Two rigs, or two controllers, on one port: one pair works, the second one is refused and named."""

import json
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from forged import LIFT, command, goodbye, sensor_frame  # noqa: E402
from lcm_network import CURRENT, SENSOR, COMMAND, Bus, controller, plant, run  # noqa: E402


class TwoRigs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def bus(self, port):
        bus = Bus(port)
        self.addCleanup(bus.close)
        return bus

    def test_a_second_rig_is_named_and_does_not_disturb_the_first(self):
        with plant(self.folder, "--stay") as first, controller(
                self.folder, "--scenario", "levitate", "--json", "c.json") as control:
            control.says("-> levitating")
            with plant(self.folder, "--stay", "--seed", 2):
                self.assertEqual(control.status(), 0, control.text)
            first.terminate()
            self.assertEqual(first.status(), 0, first.text)
        self.assertEqual(control.text.count("frames of a second rig at 127.0.0.1:"), 1, control.text)
        self.assertNotIn("TRIP", control.text)
        facts = json.loads((self.folder / "c.json").read_text())
        self.assertGreater(facts["frames_refused"], 0)
        self.assertIn("of a second rig were refused", facts["transport"])

    def test_a_second_controller_is_named_and_the_rotor_stays_with_the_first(self):
        with plant(self.folder) as rig, controller(self.folder) as first:
            first.says("rig found")
            self.bus(COMMAND).send(command(LIFT)[1])
            first.says("-> levitating")
            with controller(self.folder, "--partner-timeout", 3):
                rig.says("currents of a second controller at 127.0.0.1:")
            first.terminate()
            self.assertEqual(first.status(), 0, first.text)
            self.assertEqual(rig.status(), 0, rig.text)
        self.assertNotIn("TRIP", first.text)

    def test_one_frame_and_one_goodbye_of_a_stranger_change_nothing(self):
        with plant(self.folder) as rig, controller(self.folder) as control:
            control.says("rig found")
            sensors, currents = self.bus(SENSOR), self.bus(CURRENT)
            for _ in range(20):
                sensors.send(sensor_frame()[1])
                currents.send(goodbye()[1])
            self.bus(COMMAND).send(command(LIFT)[1])
            control.says("-> levitating")
            control.terminate()
            self.assertEqual(control.status(), 0, control.text)
            self.assertEqual(rig.status(), 0, rig.text)
        self.assertNotIn("TRIP", control.text)
        self.assertIn("-> levitating", control.text)


if __name__ == "__main__":
    run()

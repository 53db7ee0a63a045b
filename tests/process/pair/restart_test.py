"""One process of the pair dies, is stopped or is commanded; the other goes on in a defined way."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from lcm_network import COMMAND, TELEMETRY, Bus, controller, plant, run  # noqa: E402

LIFT, SPIN, STOP, RESET = 1, 2, 5, 6
OFF, LEVITATING, SPINNING, TRIPPED = 0, 3, 4, 7


class Restart(unittest.TestCase):
    def setUp(self):
        from levitas_msg.controller_state_t import controller_state_t
        from levitas_msg.operator_command_t import operator_command_t
        self.state_type, self.command_type = controller_state_t, operator_command_t
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.commands, self.states = Bus(COMMAND), Bus(TELEMETRY)
        self.addCleanup(self.commands.close)
        self.addCleanup(self.states.close)
        self.sequence = 0

    def command(self, number, speed=0.0, acceleration=0.0):
        self.sequence += 1
        message = self.command_type()
        message.sequence, message.command = self.sequence, number
        message.speed_rad_per_s, message.acceleration_rad_per_s2 = speed, acceleration
        self.commands.publish("LEVITAS_COMMAND", message)

    def wait_for(self, mode, process, speed=0.0):
        for channel, payload in self.states.messages():
            if channel != "LEVITAS_STATE":
                continue
            state = self.state_type.decode(payload)
            if state.mode == mode and state.speed_rad_per_s >= speed:
                return
        self.fail(f"mode {mode} was not reached:\n{process.said_so_far}")

    def ask_until(self, command, mode, process):
        """Asks again while it is refused: what stands has to be seen standing for a while first."""
        for number, (channel, payload) in enumerate(self.states.messages()):
            if channel == "LEVITAS_STATE" and self.state_type.decode(payload).mode == mode:
                return
            if number % 50 == 0:
                self.command(command)
        self.fail(f"mode {mode} was not reached:\n{process.said_so_far}")

    def lifted(self, control):
        control.says("rig found")
        self.command(LIFT)
        self.wait_for(LEVITATING, control)

    def test_killed_rig_trips_the_controller_which_levitates_again_after_a_reset(self):
        with controller(self.folder) as control:
            with plant(self.folder) as rig:
                self.lifted(control)
                rig.kill()
            with plant(self.folder):
                control.says("TRIP")
                control.says("rig")
                self.wait_for(TRIPPED, control)
                self.ask_until(RESET, OFF, control)
                self.command(LIFT)
                self.wait_for(LEVITATING, control)
                control.terminate()
                self.assertEqual(control.status(), 4, control.text)
            self.assertIn("rig_restarted", control.text)
            self.assertTrue(list(self.folder.glob("trip-*rig_restarted*")))

    def test_killed_controller_is_replaced_by_a_new_one(self):
        with plant(self.folder) as rig:
            with controller(self.folder) as first:
                self.lifted(first)
                first.kill()
            with controller(self.folder, "--scenario", "levitate") as second:
                self.assertEqual(second.status(), 0, second.text)
                self.assertEqual(rig.status(), 0, rig.text)

    def test_termination_lands_the_rotor(self):
        with plant(self.folder) as rig, controller(self.folder) as control:
            self.lifted(control)
            control.terminate()
            self.assertEqual(control.status(), 0, control.text)
            self.assertEqual(rig.status(), 0, rig.text)
        self.assertIn("levitating -> landing", control.text)
        self.assertIn("landing -> off", control.text)

    def test_termination_brakes_a_spinning_rotor_before_it_lands(self):
        with plant(self.folder), controller(self.folder) as control:
            self.lifted(control)
            self.command(SPIN, speed=100.0, acceleration=50.0)
            # Well above standstill: a rotor that has hardly begun to turn is landed at once.
            self.wait_for(SPINNING, control, speed=50.0)
            control.terminate()
            self.assertEqual(control.status(), 0, control.text)
        self.assertIn("command spin to 0 rpm", control.text)
        self.assertIn("landing -> off", control.text)

    def test_emergency_stop_over_the_network_is_a_trip_with_status_4(self):
        with plant(self.folder) as rig, controller(self.folder) as control:
            self.lifted(control)
            self.command(STOP)
            self.wait_for(TRIPPED, control)
            control.terminate()
            self.assertEqual(control.status(), 4, control.text)
            self.assertEqual(rig.status(), 0, rig.text)
        self.assertIn("emergency_stop", control.text)

    def test_rig_that_stays_serves_one_controller_after_the_other(self):
        with plant(self.folder, "--stay") as rig:
            for _ in range(2):
                with controller(self.folder, "--scenario", "levitate") as control:
                    self.assertEqual(control.status(), 0, control.text)
            rig.terminate()
            self.assertEqual(rig.status(), 0, rig.text)

    def test_rig_that_dies_for_good_ends_the_controller_with_status_1(self):
        with controller(self.folder, "--partner-timeout", 3) as control:
            with plant(self.folder) as rig:
                self.lifted(control)
                rig.kill()
            self.assertEqual(control.status(), 1, control.text)
        self.assertIn("no rig for 3 s", control.text)


if __name__ == "__main__":
    run()

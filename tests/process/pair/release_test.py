"""After the magnets have let go of a turning rotor, as a disconnected sensor makes them: the brake."""

import signal
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from lcm_network import CURRENT, TELEMETRY, Bus, controller, plant, run  # noqa: E402
from rotor_fate import SPEED_RPM, SPIN, STANDSTILL_RPM, records, rpm  # noqa: E402
from waiting import pause  # noqa: E402

STAND = "kind: scenario\nname: stand\nsteps:\n" \
    "  - {do: lift, until: levitating, timeout_s: 5, hold_s: 600}\n"
# At full speed from 2.7 s on: 1.1 s to lift, 1.5 s to run up.
SENSOR_GONE = "rig_events:\n  - {at_s: 3, what: sensor_invalid, channel: de_x, duration_s: 0.1}\n"
LEVITATING, SPINNING, RELEASED = 3, 4, 7


class Release(unittest.TestCase):
    def setUp(self):
        from levitas_msg import controller_state_t, current_frame_t
        self.state_type, self.current_type = controller_state_t, current_frame_t
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.session = self.folder / "session.lcmlog"
        (self.folder / "spin.yaml").write_text(SPIN % 600, encoding="utf-8")
        (self.folder / "gone.yaml").write_text(SPIN % 600 + SENSOR_GONE, encoding="utf-8")
        (self.folder / "stand.yaml").write_text(STAND, encoding="utf-8")
        self.states = Bus(TELEMETRY)
        self.addCleanup(self.states.close)

    def start(self, scenario, *more):
        self.rig = plant(self.folder, "--scenario", self.folder / scenario)
        self.addCleanup(self.rig.kill)
        control = controller(self.folder, "--scenario", self.folder / scenario, "--record",
                             self.session, *more)
        self.addCleanup(control.kill)
        return control

    def reached(self, mode, control, speed_rpm):
        for channel, payload in self.states.messages():
            if channel == "LEVITAS_STATE":
                state = self.state_type.decode(payload)
                if state.mode == mode and rpm(state) > speed_rpm:
                    return
        self.fail(f"mode {mode} was not reached:\n{control.said_so_far}")

    def assert_braked_until_it_stands(self):
        after = []
        for record in records(self.session):
            if after or (record.fault and not record.amplifiers_enabled):
                after.append(record)
        self.assertGreater(rpm(after[0]), 0.98 * SPEED_RPM)  # let go of at full speed
        self.assertFalse(any(record.amplifiers_enabled for record in after))
        turning = [record for record in after if abs(rpm(record)) > STANDSTILL_RPM]
        self.assertTrue(all(record.drive_enabled for record in turning))
        self.assertTrue(all(record.speed_set_point_rad_per_s == 0 for record in turning))
        self.assertLessEqual(abs(rpm(after[-1])), STANDSTILL_RPM)

    def test_the_controller_of_a_scenario_stays_and_brakes_until_the_rotor_stands(self):
        control = self.start("gone.yaml")
        self.assertEqual(control.status(), 4, control.text)
        self.assertIn("sensor_not_finite", control.text)
        self.assert_braked_until_it_stands()

    def test_a_signal_during_the_run_down_changes_nothing_of_it(self):
        control = self.start("gone.yaml")
        self.reached(RELEASED, control, 0.5 * SPEED_RPM)
        control.terminate()
        self.assertEqual(control.status(), 4, control.text)
        self.assert_braked_until_it_stands()

    def goodbye(self, scenario, mode, speed_rpm):
        """What a controller that is to end at once leaves the rig with, the rotor in this state."""
        control = self.start(scenario)
        self.reached(mode, control, speed_rpm)
        self.rig.send_signal(signal.SIGSTOP)  # in lockstep time stands still, and hardly any
        currents = Bus(CURRENT)  # current is sent: none is lost here
        self.addCleanup(currents.close)
        control.terminate()
        pause(0.6, "this or longer does not count as one request")
        control.terminate()
        for channel, payload in currents.messages():
            if channel == "LEVITAS_GOODBYE":
                control.status()
                return self.current_type.decode(payload)
        return self.fail(control.said_so_far)

    def test_who_ends_at_once_leaves_a_turning_rotor_under_the_brake(self):
        last = self.goodbye("spin.yaml", SPINNING, 0.99 * SPEED_RPM)
        self.assertFalse(last.amplifiers_enabled)
        self.assertTrue(last.drive_enabled)
        self.assertEqual(last.speed_set_point_rad_per_s, 0)
        self.assertGreater(last.acceleration_limit_rad_per_s2, 0)

    def test_who_ends_at_once_leaves_a_standing_rotor_without_drive(self):
        last = self.goodbye("stand.yaml", LEVITATING, -1.0)
        self.assertFalse(last.amplifiers_enabled)
        self.assertFalse(last.drive_enabled)


if __name__ == "__main__":
    run()

"""The programs at their real-time pace, unmodified, in virtual time: deadlines, time-outs, stops.

Everything is asserted in periods of 100 us: no machine is too slow for it.
"""

import os
import signal
import sys
import tempfile
import time
import unittest
from pathlib import Path

SOURCE = Path(os.environ["LEVITAS_SOURCE"])
sys.path.insert(0, str(SOURCE / "tests/support"))
from gpio_sim import ENABLE, FAULT, HEARTBEAT, STOP, Chip  # noqa: E402
from lcm_network import Process, log_events  # noqa: E402
from levitas_msg import cycle_record_t  # noqa: E402

PERIOD_NS = 100_000
FRAME_MISSING, DEADLINE_MISSED, EMERGENCY_STOP, AMPLIFIER_FAULT = 5, 6, 9, 11
CURRENTS_LATE = 17  # of common/enums.hpp: the rig held its currents meanwhile
TRIPPED = 7
MISSING_LIMIT, DEADLINE_LIMIT = 10, 50  # of flexible_rotor_commissioned.yaml
SCENARIO = """kind: scenario
name: short
steps:
  - {do: lift, until: levitating, timeout_s: 5, hold_s: %s}
  - {do: land, until: off, timeout_s: 5}
"""


class RealTime(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.chip = Chip()
        self.addCleanup(self.chip.close)
        self.rig = self.chip.rig(SOURCE, folder.name)

    def start(self, hold_s, name="session"):
        """Rig and controller under a scenario that holds the rotor for `hold_s`."""
        scenario = self.folder / "scenario.yaml"
        scenario.write_text(SCENARIO % hold_s)
        plant = Process(self.folder, "amb-plant", "--rig", self.rig, "--pace", "realtime",
                        "--seed", 3)
        self.addCleanup(plant.kill)
        control = Process(self.folder, "amb-controller", "--rig", self.rig, "--controller",
                          "flexible_rotor_commissioned", "--scenario", scenario, "--pace",
                          "realtime", "--seed", 3, "--record", self.folder / name,
                          "--trip-folder", self.folder)
        self.addCleanup(control.kill)
        return plant, control

    def records(self, name="session"):
        return [cycle_record_t.decode(data) for channel, data in log_events(self.folder / name)
                if channel == "LEVITAS_CYCLE"]

    def tripped(self, control, records):
        """The first record with a fault, once the controller has ended with status 4."""
        self.assertEqual(control.status(), 4, control.text)
        records[:] = self.records()
        return next(record for record in records if record.fault != 0)

    def test_a_whole_run_misses_no_deadline(self):
        plant, control = self.start(0.05)
        self.assertEqual(control.status(), 0, control.text)
        self.assertEqual(plant.status(), 0, plant.text)
        records = self.records()
        # Lift of 0.9 s and landing of 0.5 s at the least.
        self.assertGreater(len(records), 14_000)
        self.assertEqual(sum(record.missed_deadlines for record in records), 0)

    def test_a_pressed_emergency_stop_stops_within_two_cycles(self):
        _, control = self.start(3)
        control.says("-> levitating")
        self.assertTrue(self.chip.level(ENABLE))
        time.sleep(0.05 + 0.3 * PERIOD_NS * 1e-9)
        pressed_ns = time.monotonic_ns()
        self.chip.pull(STOP, False)
        records = []
        trip = self.tripped(control, records)
        self.assertEqual(trip.fault, EMERGENCY_STOP)
        cycles = sum(1 for record in records
                     if record.sample_time_ns > pressed_ns - PERIOD_NS and record.cycle <= trip.cycle)
        print("cycles from the stop to the trip:", cycles)
        self.assertLessEqual(trip.sample_time_ns, pressed_ns + 2 * PERIOD_NS)
        self.assertLessEqual(cycles, 2)
        # A levitated stop: the amplifiers stay on until the rotor lies, and then go off.
        self.assertEqual(trip.mode, TRIPPED)
        self.assertFalse(self.chip.level(ENABLE))

    def test_an_amplifiers_fault_line_releases_the_rotor_and_drops_the_enable_line(self):
        _, control = self.start(3)
        control.says("-> levitating")
        pressed_ns = time.monotonic_ns()
        self.chip.pull(FAULT, False)
        time.sleep(3 * PERIOD_NS * 1e-9)
        self.assertFalse(self.chip.level(ENABLE))
        trip = self.tripped(control, [])
        self.assertEqual(trip.fault, AMPLIFIER_FAULT)
        self.assertLessEqual(trip.sample_time_ns, pressed_ns + 2 * PERIOD_NS)

    def test_a_killed_controller_drops_the_enable_line_and_its_heartbeat(self):
        plant, control = self.start(3)
        control.says("-> levitating")
        self.assertTrue(self.chip.level(ENABLE))
        killed_ns = time.monotonic_ns()
        control.child.send_signal(signal.SIGKILL)
        while self.chip.level(ENABLE) and time.monotonic_ns() - killed_ns < 1e9:
            time.sleep(20e-6)
        took_ns = time.monotonic_ns() - killed_ns
        print("periods from SIGKILL to the enable line low:", took_ns / PERIOD_NS)
        self.assertFalse(self.chip.level(ENABLE))
        self.assertLessEqual(took_ns, 2 * PERIOD_NS)
        levels = set()
        for _ in range(100):
            levels.add(self.chip.level(HEARTBEAT))
            time.sleep(PERIOD_NS * 1e-9)
        self.assertEqual(len(levels), 1)
        control.says("controller is gone: enable line made inactive")
        del plant

    def test_a_silent_rig_trips_in_the_cycle_that_the_limit_names(self):
        plant, control = self.start(3)
        control.says("-> levitating")
        plant.child.send_signal(signal.SIGSTOP)
        records = []
        try:
            trip = self.tripped(control, records)
        finally:
            plant.child.send_signal(signal.SIGCONT)
        self.assertEqual(trip.fault, FRAME_MISSING)
        at = records.index(trip)
        missing = [not record.frame_present for record in records[at - MISSING_LIMIT:at + 1]]
        # The last frame before, then as many cycles without one as the limit allows.
        self.assertEqual(missing, [False] + [True] * MISSING_LIMIT)

    def test_a_controller_that_is_stopped_for_longer_than_the_limit_trips_when_it_goes_on(self):
        _, control = self.start(3)
        control.says("-> levitating")
        control.child.send_signal(signal.SIGSTOP)
        time.sleep((DEADLINE_LIMIT + 5) * PERIOD_NS * 1e-9)
        control.child.send_signal(signal.SIGCONT)
        records = []
        trip = self.tripped(control, records)
        self.assertIn(trip.fault, (DEADLINE_MISSED, FRAME_MISSING, CURRENTS_LATE))
        # Stopped between two cycles it wakes to a frame that counts the currents it did not send,
        # and learns of the missed deadlines in the cycle after.
        stopped = next(record for record in records if record.missed_deadlines > 0)
        self.assertGreaterEqual(stopped.missed_deadlines, DEADLINE_LIMIT)
        self.assertLessEqual(abs(trip.cycle - stopped.cycle), 1)


if __name__ == "__main__":
    unittest.main(verbosity=2)

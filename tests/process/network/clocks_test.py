"""Two machines whose clocks of the day disagree, or are set during a run: a stop acts and is answered."""

import os
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from far_page import Clock, FarPage  # noqa: E402
from lcm_network import SKIPPED, Process, plant, run  # noqa: E402
from seal import new_key  # noqa: E402
from two_machines import OtherMachine, possible  # noqa: E402
from waiting import until  # noqa: E402

NETWORK = ("--port", "lcm:udpm://239.255.76.67:7667?ttl=1", "--key", "lab.key")
HOUR, DAY = 3600, 86_400


class Clocks(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        new_key(self.folder / "lab.key")
        self.other = OtherMachine()
        self.addCleanup(self.other.close)
        self.clock = Clock(self.folder / "controller.clock")
        self.page_clock = Clock(self.folder / "page.clock")

    def controller(self):
        return Process(self.folder, "amb-controller", "--rig", "flexible_rotor", "--controller",
                       "flexible_rotor", "--trip-folder", self.folder, *NETWORK,
                       env={**os.environ, **self.clock.environment})

    def page(self):
        return FarPage(self.other, self.folder, *NETWORK, clock=self.page_clock)

    def stops_and_is_reset(self, page):
        self.assertEqual(page.command("emergency_stop"), "accepted")
        until(lambda: self.is_reset(page), "a reset that is accepted")

    def is_reset(self, page):
        """Refused is one that meets a cycle without a frame, on a busy machine: no matter of clocks."""
        outcome = page.command("reset")
        self.assertIn(outcome, ("accepted", "refused"))
        return outcome == "accepted"

    def test_set_during_a_run_keep_no_stop_and_no_other_command_from_acting(self):
        with plant(self.folder, *NETWORK) as rig, self.controller() as control, self.page() as page:
            control.says("rig found")
            for ahead_s in (3, HOUR, -HOUR, DAY):
                self.clock.set(ahead_s)
                self.stops_and_is_reset(page)
            self.clock.set(0)
            self.stops_and_is_reset(page)
            for ahead_s in (3, -3, HOUR, -HOUR, 0):  # and back: what the page sent was ahead
                self.page_clock.set(ahead_s)
                self.stops_and_is_reset(page)
            control.terminate()
            control.status()
            self.assertEqual(rig.status(), 0)
        self.assertNotIn("frame_missing", control.text)

    def test_that_differ_from_the_start_delay_no_stop_and_are_put_right_at_once(self):
        self.clock.set(HOUR)  # a machine without a battery for its clock, with the rig on it
        environment = {**os.environ, **self.clock.environment}
        with plant(self.folder, *NETWORK, env=environment), self.controller() as control:
            control.says("rig found")
            with self.page() as page:
                self.stops_and_is_reset(page)
            self.clock.set(0)
            with self.page() as page:
                self.stops_and_is_reset(page)
            control.terminate()
            control.status()

    def test_of_a_page_that_are_behind_by_a_day_delay_no_stop(self):
        self.page_clock.set(-DAY)
        with plant(self.folder, *NETWORK), self.controller() as control, self.page() as page:
            control.says("rig found")
            self.stops_and_is_reset(page)
            control.terminate()
            control.status()


if __name__ == "__main__":
    if not possible():
        print("not run: no pair of joined network namespaces here")
        sys.exit(SKIPPED)
    run()

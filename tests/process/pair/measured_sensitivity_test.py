"""The verdict measures |S| where the run held test signals, and warns when the files say otherwise.

Controller and rig are two processes with rig files of their own: where the rig's file holds an effect
that the controller's does not know, the loop that runs is not the one that is computed.
"""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from lcm_network import BINARIES, Process, run  # noqa: E402

RIG = BINARIES.parents[2] / "config/rigs/flexible_rotor.yaml"
# Every magnet has 1.25 times the negative stiffness of the file: the computed peak knows nothing of it.
SOFT = "effects:\n  - id: displacement_stiffness\n    channels: [de_x, de_y, nde_x, nde_y]\n    ratio: 1.25\n"
# Sines up to 600 Hz: the law answers the edges of a binary signal in its reading with all its current.
READING = ("signal: multisine, point: measured_position, amplitude_um: 8, from_hz: 2, to_hz: 600, "
           "repeat_s: 0.8")
AXES = ("de_x", "de_y", "nde_x", "nde_y")


def scenario(signals, signal="amplitude_a: 0.15, order: 12, divisor: 2"):
    steps = ["  - {do: lift, until: levitating, timeout_s: 5, hold_s: 1}"]
    for axis in signals:
        steps += ["  - do: nothing", "    hold_s: 3.3", "    orbit_limit_um: 100", "    excitation:",
                  f"      - {{channel: {axis}, {signal}}}",
                  "  - {do: nothing, hold_s: 0.3}"]
    steps += ["  - {do: land, until: \"off\", timeout_s: 5}"]
    return "kind: scenario\nname: measure\nsteps:\n" + "\n".join(steps) + "\n"


class MeasuredSensitivity(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def verdict(self, signals, effects="", **signal):
        """What `amb report` says of the record, with nothing but the record."""
        (self.folder / "rig.yaml").write_text(RIG.read_text(encoding="utf-8") + effects,
                                              encoding="utf-8")
        (self.folder / "scenario.yaml").write_text(scenario(signals, **signal), encoding="utf-8")
        with Process(self.folder, "amb-plant", "--rig", "rig.yaml") as rig, \
                Process(self.folder, "amb-controller", "--rig", "flexible_rotor", "--controller",
                        "flexible_rotor_commissioned", "--scenario", "scenario.yaml", "--record",
                        "s.lcm", "--overwrite", "--trip-folder", ".") as control:
            self.assertEqual(control.status(), 0, control.text)
            self.assertEqual(rig.status(), 0, rig.text)
        done = subprocess.run([BINARIES / "amb", "report", "s.lcm", "--out", "s.html", "--json",
                               "s.json"], cwd=self.folder, capture_output=True, text=True,
                              check=True)
        return json.loads((self.folder / "s.json").read_text())["judgement"], done.stdout

    def measured(self, verdict):
        return {axis["axis"]: axis for speed in verdict["sensitivity"]
                if speed["source"] == "measured" for axis in speed["axes"]}

    def test_agrees_where_the_rig_is_what_its_file_says(self):
        verdict, _ = self.verdict(AXES)
        axes = self.measured(verdict)
        self.assertEqual(set(axes), set(AXES))
        for axis in axes.values():
            self.assertIsNotNone(axis["zone"], axis)
            # Three deviations, and 0.1 for the largest of several hundred noisy lines.
            self.assertLess(abs(axis["peak"] - axis["computed_peak"]), 3 * axis["sigma"] + 0.1, axis)
        self.assertEqual((verdict["warnings"], verdict["sensitivity_not_measured"]), ([], ""))

    def test_warns_where_the_rig_is_not_what_its_file_says(self):
        verdict, _ = self.verdict(AXES, SOFT)
        self.assertTrue(any("the rig file or the controller file is probably not what runs" in warning
                            for warning in verdict["warnings"]), verdict["sensitivity"])
        apart = [a for a in self.measured(verdict).values() if a["more_than_20_percent_apart"]]
        self.assertEqual(len(apart), len(verdict["warnings"]))

    def test_says_what_a_campaign_lacks_and_judges_the_computed_peak(self):
        verdict, _ = self.verdict(AXES[:1])
        self.assertIn("de_y", verdict["sensitivity_not_measured"])
        self.assertEqual({s["source"] for s in verdict["sensitivity"]}, {"computed"})

    def test_agrees_where_the_signals_are_added_to_the_reading(self):
        verdict, _ = self.verdict(AXES, signal=READING)
        axes = self.measured(verdict)
        self.assertEqual(set(axes), set(AXES))
        for axis in axes.values():
            self.assertIsNotNone(axis["zone"], axis)
            # Three deviations, and 0.1 for what the largest of the fitted lines still adds.
            self.assertLess(abs(axis["peak"] - axis["computed_peak"]), 3 * axis["sigma"] + 0.1, axis)
            self.assertGreater(axis["largest_line"], axis["peak"] - 3 * axis["sigma"], axis)
        self.assertEqual((verdict["warnings"], verdict["sensitivity_not_measured"]), ([], ""))

    def test_warns_of_another_rig_where_the_signals_are_added_to_the_reading(self):
        verdict, _ = self.verdict(AXES, SOFT, signal=READING)
        apart = [a for a in self.measured(verdict).values() if a["more_than_20_percent_apart"]]
        self.assertGreater(len(apart), 0, verdict["sensitivity"])
        self.assertEqual(len(apart), len(verdict["warnings"]))

    def test_is_not_asked_for_without_a_test_signal(self):
        verdict, _ = self.verdict(())
        self.assertEqual(verdict["sensitivity_not_measured"], "no test signal")


if __name__ == "__main__":
    run()

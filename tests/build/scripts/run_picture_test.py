"""scripts/run_picture.py on runs whose picture is known: a circle at constant speed."""

import math
import os
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

SOURCE = Path(os.environ["LEVITAS_SOURCE"])
SVG = "{http://www.w3.org/2000/svg}"
RADIUS_UM = 20.0
PERIOD_S = 1e-3


def run_csv(rpm, rows=4000, with_speed=True):
    """A rotor that circles at RADIUS_UM about the centre with `rpm`."""
    columns = ["time_s", "rotor_angle_rad"] + (["speed_rpm"] if with_speed else [])
    columns += [f"position_{end}_{axis}_m" for end in ("de", "nde") for axis in "xy"]
    lines = [",".join(columns)]
    for row in range(rows):
        angle = rpm * math.pi / 30 * row * PERIOD_S
        values = [row * PERIOD_S, angle % (2 * math.pi)] + ([rpm] if with_speed else [])
        x, y = RADIUS_UM * 1e-6 * math.cos(angle), RADIUS_UM * 1e-6 * math.sin(angle)
        lines.append(",".join(repr(value) for value in [*values, x, y, x, y]))
    return "\n".join(lines) + "\n"


class RunPicture(unittest.TestCase):
    def draw(self, text):
        with tempfile.TemporaryDirectory() as folder:
            data, picture = Path(folder) / "run.csv", Path(folder) / "run.svg"
            data.write_text(text)
            done = subprocess.run([sys.executable, "-B", SOURCE / "scripts/run_picture.py", data,
                                   picture], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            return ElementTree.fromstring(picture.read_text(encoding="utf-8"))

    def paths(self, root):
        return [[tuple(map(float, pair.split(","))) for pair in re.split("[ML]", path.get("d"))[1:]]
                for path in root.iter(SVG + "path")]

    def words(self, root):
        return " ".join(text.text for text in root.iter(SVG + "text"))

    def test_has_clearance_two_envelopes_speed_objective_and_two_orbits(self):
        root = self.draw(run_csv(600))
        self.assertEqual(root.get("viewBox"), "0 0 960 500")
        self.assertEqual(len(self.paths(root)), 7)
        for label in ("touchdown bearing", "Speed (rpm)", "time (s)", "drive end",
                      "non-drive end", "Orbits at 600 rpm"):
            self.assertIn(label, self.words(root))

    def test_the_orbit_is_a_circle_of_its_radius_to_scale_about_the_middle_of_its_plot(self):
        orbit = self.paths(self.draw(run_csv(600)))[-1]
        self.assertEqual(len(orbit), 500)  # five turns of 100 samples
        pixels_per_um = 280 / 100  # +-50 um on 280 pixels
        for x, y in orbit:
            # 0.1 pixel: coordinates are written with one digit.
            self.assertAlmostEqual(math.hypot(x - 780, y - 216), RADIUS_UM * pixels_per_um, delta=0.1)

    def test_the_envelope_of_a_circle_is_a_straight_line_at_its_radius(self):
        for envelope in self.paths(self.draw(run_csv(600)))[1:3]:
            self.assertLessEqual(len(envelope), 520)  # 420 columns, rounded to whole samples
            for _, y in envelope:
                self.assertAlmostEqual(y, 76 + 190 * (1 - RADIUS_UM / 200), delta=0.1)

    def test_nothing_is_drawn_outside_the_picture(self):
        for rpm in (600, 6000):
            for points in self.paths(self.draw(run_csv(rpm))):
                for x, y in points:
                    self.assertTrue(0 <= x <= 960 and 0 <= y <= 500, (rpm, x, y))

    def test_without_a_speed_column_the_speed_is_the_slope_of_the_wrapped_angle(self):
        self.assertIn("Orbits at 600 rpm", self.words(self.draw(run_csv(600, with_speed=False))))

    def test_a_rotor_that_never_turned_is_drawn_for_40_ms(self):
        root = self.draw(run_csv(0))
        self.assertEqual(len(self.paths(root)[-1]), 40)
        self.assertIn("Orbits at 0 rpm", self.words(root))

    def test_a_rotor_that_turns_backwards_is_drawn_at_its_speed(self):
        root = self.draw(run_csv(-600))
        self.assertEqual(len(self.paths(root)[-1]), 500)
        self.assertIn("Orbits at 600 rpm", self.words(root))

    def test_anything_but_two_names_is_a_usage_error(self):
        for words in ([], ["one"], ["one", "two", "three"]):
            done = subprocess.run([sys.executable, "-B", SOURCE / "scripts/run_picture.py", *words],
                                  capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 2)
            self.assertIn("scripts/run_picture.py run.csv", done.stderr)


if __name__ == "__main__":
    unittest.main()

"""The example that plots a recorded session: what it prints and draws is what was recorded."""

import csv
import math
import os
import re
import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
import own_program  # noqa: E402

SCRIPT = own_program.SOURCE / "examples/session_in_python/plot_session.py"
AMB = own_program.BUILD / "bin/amb"
RECORD_MAKER = own_program.BUILD / "tests/process/commands/record_maker"
SVG = "{http://www.w3.org/2000/svg}"


class SessionInPython(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        own_program.must(RECORD_MAKER, "r.csv", "unbalance", "1500", "2000", "7", cwd=cls.folder)
        own_program.must(AMB, "import", "r.csv", "--rig", "flexible_rotor", "--out", "s", cwd=cls.folder)

    def plot(self, *words, python=("-S",), amb=AMB):
        """Without site-packages, -S: as where matplotlib is not installed."""
        return own_program.run(sys.executable, "-B", *python, SCRIPT, *words, cwd=self.folder,
                               env={**os.environ, "LEVITAS_AMB": str(amb)})

    def largest_um(self, end):
        """Of every tenth row, as the example takes them."""
        with (self.folder / "r.csv").open(newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))[::10]
        return 1e6 * max(math.hypot(*(float(row[f"position_{end}_{axis}_m"]) for axis in "xy")) for row in rows)

    def test_prints_the_largest_orbit_of_each_bearing(self):
        done = self.plot("s", "run.svg")
        self.assertEqual(done.returncode, 0, done.stderr)
        for end in ("de", "nde"):
            self.assertIn(f"{end}: largest orbit {self.largest_um(end):.1f} um", done.stdout)

    def test_draws_every_row_of_every_bearing_inside_its_axes(self):
        done = self.plot("s", "drawn.svg")
        self.assertEqual(done.returncode, 0, done.stderr)
        root = xml.parse(self.folder / "drawn.svg").getroot()
        lines = root.findall(f"{SVG}polyline")
        self.assertEqual(len(lines), 4)  # two bearings, over time and as orbits
        for drawn in lines:
            points = [tuple(map(float, point.split(","))) for point in drawn.get("points").split()]
            self.assertEqual(len(points), 200)  # 2000 cycles, every tenth
            for x, y in points:
                self.assertTrue(60 <= x <= 920 and 40 <= y <= 400, (x, y))
        # An orbit of unbalance at 1500 rpm goes round: the points lie in all quarters of its axes.
        across = [tuple(map(float, point.split(","))) for point in lines[1].get("points").split()]
        self.assertEqual({(x > 740, y > 220) for x, y in across}, {(a, b) for a in (0, 1) for b in (0, 1)})

    def test_says_what_is_missing(self):
        other = self.plot("s", "run.png")
        self.assertNotEqual(other.returncode, 0)
        self.assertIn("name it run.svg", other.stderr)
        none = self.plot("nothing", "run.svg")
        self.assertNotEqual(none.returncode, 0)
        self.assertIn("nothing: cannot be read as a session", none.stderr)

    def test_draws_with_matplotlib_where_it_is_installed(self):
        python = next((name for name in (sys.executable, "/usr/bin/python3")
                       if own_program.run(name, "-c", "import matplotlib").returncode == 0), None)
        if python is None:
            self.skipTest("no matplotlib here (python3-matplotlib)")
        done = own_program.run(python, "-B", SCRIPT, "s", "run.png", cwd=self.folder,
                               env={**os.environ, "LEVITAS_AMB": str(AMB)})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.folder / "run.png").read_bytes()[:4], b"\x89PNG")


class Docstring(unittest.TestCase):
    def test_without_two_names_it_says_how_it_is_used(self):
        done = own_program.run(sys.executable, "-B", "-S", SCRIPT)
        self.assertNotEqual(done.returncode, 0)
        self.assertTrue(re.search(r"plot_session\.py run\.lcm run\.svg", done.stderr))


if __name__ == "__main__":
    unittest.main()

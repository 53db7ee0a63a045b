"""scripts/notch_picture.py on figures whose picture is known: decay falls, orbit rises."""

import json
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


def figures(scale):
    return {"speeds": [{"speed_rpm": rpm, "slowest_decay": scale / rpm, "orbit_m": 1e-8 * rpm,
                        "orbit_alone_m": 1e-5} for rpm in range(1000, 6001, 500)]}


class NotchPicture(unittest.TestCase):
    def run_script(self, *words):
        return subprocess.run([sys.executable, "-B", SOURCE / "scripts/notch_picture.py", *words],
                              capture_output=True, text=True, check=False)

    def test_has_two_decays_two_orbits_and_the_rigs_limits(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = Path(folder)
            for name, scale in (("current", 100.0), ("vibration", 1000.0)):
                (folder / name).write_text(json.dumps(figures(scale)))
            done = self.run_script(folder / "current", folder / "vibration", folder / "out.svg")
            self.assertEqual(done.returncode, 0, done.stderr)
            root = ElementTree.fromstring((folder / "out.svg").read_text(encoding="utf-8"))
        curves = [[float(pair.split(",")[1]) for pair in re.split("[ML]", path.get("d"))[1:]]
                  for path in root.iter(SVG + "path")]
        self.assertEqual(len(curves), 4)
        slow, fast, alone, quiet = curves  # y of a picture points down
        self.assertTrue(all(a > b for a, b in zip(slow, fast)), "a tenth of the decay lies lower")
        self.assertGreater(slow[-1], slow[0])
        self.assertEqual(len(set(alone)), 1)
        self.assertLess(quiet[-1], quiet[0])
        self.assertEqual(quiet[0], alone[0])  # 10 um both
        words = " ".join(text.text for text in root.iter(SVG + "text"))
        for word in ("objective 36 um", "clearance 190 um", "target vibration", "law alone"):
            self.assertIn(word, words)

    def test_without_its_files_it_says_how_it_is_called(self):
        done = self.run_script()
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("scripts/notch_picture.py current.json", done.stderr)


if __name__ == "__main__":
    unittest.main()

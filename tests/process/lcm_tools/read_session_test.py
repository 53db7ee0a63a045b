"""The example that reads a session with LCM's Python package finds what is in it.

Not run (status 77) where the package is neither here nor to be had, as in python_lcm_test.py.
"""

import csv
import math
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from lcm_network import BINARIES, BUILD  # noqa: E402
from python_lcm_test import provide_package  # noqa: E402
from waiting import LIMIT_S  # noqa: E402

SCRIPT = Path(__file__).resolve().parents[3] / "scripts/read_session.py"
RECORD_MAKER = BUILD / "tests/process/commands/record_maker"


class ReadSession(unittest.TestCase):
    def test_finds_the_largest_distances_of_the_record(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        data = Path(folder.name) / "r.csv"
        subprocess.run([RECORD_MAKER, data, "unbalance", "1500", "2000", "7"], check=True, timeout=LIMIT_S)
        subprocess.run([BINARIES / "amb", "import", "r.csv", "--rig", "flexible_rotor", "--out", "s"],
                       cwd=folder.name, check=True, timeout=LIMIT_S, capture_output=True)
        done = subprocess.run([PYTHON, "-B", SCRIPT, "s"], cwd=folder.name, text=True, check=False,
                              capture_output=True, timeout=LIMIT_S,
                              env={**os.environ, "PYTHONPATH": str(BUILD / "lcmtypes/python")})
        self.assertEqual(done.returncode, 0, done.stderr)
        with data.open(newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        for end in ("de", "nde"):
            largest_um = 1e6 * max(math.hypot(*(float(row[f"position_{end}_{axis}_m"]) for axis in "xy"))
                                   for row in rows)
            self.assertIn(f"{end}_x: {largest_um:.2f} um", done.stdout)


if __name__ == "__main__":
    PYTHON = provide_package()
    unittest.main()

"""Runs amb as a user does and looks at all it leaves: status, both streams, files, JSON."""

import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from waiting import LIMIT_S  # noqa: E402

BINARIES = Path(os.environ["LEVITAS_BINARIES"])
SOURCE = Path(os.environ["LEVITAS_SOURCE"])
RECORD_MAKER = Path(os.environ["LEVITAS_BUILD"]) / "tests/process/commands/record_maker"
SHIPPED_RIG = SOURCE / "config/rigs/flexible_rotor.yaml"
SHIPPED_CONTROLLER = SOURCE / "config/controllers/flexible_rotor.yaml"
REFERENCE = SOURCE / "tests/data/reference"
FOREIGN_RECORD = SOURCE / "tests/data/records/standing_2s.csv.xz"

DONE, OTHER, USAGE, BAD_INPUT = 0, 1, 2, 3

# A number in a JSON file is a quantity whose key ends in its unit, a count, or a pure ratio.
UNITS = ("_m", "_hz", "_rpm", "_s", "_a", "_n", "_kg", "_rad", "_n_per_a", "_n_per_m",
         "_1_per_s", "_rad_per_s", "_byte", "_ns", "_percent", "_kg_m2", "_db")
COUNTS = {"samples", "drop_outs", "missing_samples", "rows", "cycles_without_frame", "pieces",
          "gaps", "settling_samples", "not_levitated_samples", "order", "cycles", "compared",
          "first_compared_cycle", "mode_differs", "missing_cycles", "fault_cycle",
          "corrupt_bytes", "corrupt_records", "corrupt_blocks", "seed", "substeps", "compared_with_substeps",
          "orders", "turns", "skipped_periods", "missing_frames", "held_currents", "missing_records", "count", "times",
          "failures", "repeats", "baseline"}
RATIOS = {"ratio", "share", "sigmas", "rise_deviations", "points_gain", "damping_ratio", "largest_pole_modulus", "forward_share",
          "torsion_share", "sensitivity_peak", "gain_margin_up", "gain_margin_down", "largest_singular_value",
          "multiple_of_noise", "expected_multiple", "lag_one_correlation",
          "dominant_density_ratio", "saturated_share", "clearance_share", "share_of_peak", "peak",
          "sigma", "computed_peak", "condition", "shown_share", "copper_share", "unexplained_share",
          "relative_deflection", "sensitivity_real", "sensitivity_imaginary",
          "fm4", "fm4_deviation", "coverage", "lines", "once_ratio"}


def amb(folder, *arguments, environment=None):
    return subprocess.run([str(BINARIES / "amb"), *map(str, arguments)], cwd=folder, text=True,
                          capture_output=True, timeout=LIMIT_S, check=False, env=environment)


def make_record(path, rotor="healthy", speed_rpm=0, rows=10_000, seed=20261121):
    subprocess.run([RECORD_MAKER, path, rotor, str(speed_rpm), str(rows), str(seed)], check=True,
                   timeout=LIMIT_S)
    return path


def numbers(text):
    """The numbers of a printed line, without those that are part of a name."""
    return [float(word) for word in re.findall(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w])",
                                               text)]


def reference_rows(name):
    """Rows of a reference file as numbers, without its line of names."""
    lines = (REFERENCE / name).read_text().splitlines()
    return [[float(field) for field in line.split(",")] for line in lines[1:]]


def edited(path, *changes):
    """Text of a shipped file with every (old, new) replaced; each old one must be there."""
    text = path.read_text()
    for old, new in changes:
        if old not in text:
            raise AssertionError(f"{path} holds no '{old}'")
        text = text.replace(old, new)
    return text


def scaled_controller(factor):
    """The shipped law with Kp, Ki and Kd of both bearings times `factor`."""
    gains = {"kp_a_per_m": ("4514.47", "9613.112418"), "ki_a_per_m_s": ("24128.6", "51379.44084"),
             "kd_a_s_per_m": ("13.0414", "27.77035716")}
    return edited(SHIPPED_CONTROLLER, *((f"{key}: {value}", f"{key}: {float(value) * factor!r}")
                                        for key, values in gains.items() for value in values))


def keys_without_unit(value, key=""):
    """Keys of a JSON document that hold numbers and do not say of what."""
    if isinstance(value, dict):
        return [bad for name, inner in value.items() for bad in keys_without_unit(inner, name)]
    if isinstance(value, list):
        return [bad for inner in value for bad in keys_without_unit(inner, key)]
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return []
    return [] if key.endswith(UNITS) or key in COUNTS | RATIOS else [key]


class CommandTest(unittest.TestCase):
    """A test in a folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return name

    def compute(self, *arguments, warns=""):
        """(what was printed, its JSON) of a command that must succeed without a complaint, or with
        the one warning that has these words."""
        out = self.folder / "out.json"
        done = amb(self.folder, *arguments, "--json", out)
        self.assertEqual(done.returncode, DONE, done.stdout + done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1 if warns else 0, done.stderr)
        self.assertIn(warns, done.stderr)
        document = json.loads(out.read_text())
        self.assertEqual(keys_without_unit(document), [])
        return done.stdout, document

    def refuse(self, status, words, *arguments):
        """The one message of a command that must fail, and that nothing new lies in the folder."""
        before = self.files()
        done = amb(self.folder, *arguments)
        told = (arguments, done.stdout, done.stderr)
        self.assertEqual(done.returncode, status, told)
        self.assertIn(words, done.stderr, told)
        if status != USAGE:  # those of the option parser name no program
            self.assertEqual(done.stderr.count("amb: "), 1, told)
        for noise in ("terminate called", "what():", "Assertion", "filesystem error"):
            self.assertNotIn(noise, done.stderr, told)
        self.assertEqual(self.files(), before, told)
        return done.stderr

    def files(self):
        """Everything below the test's folder, and files left beside it by a name made from it."""
        inside = {str(path) for path in self.folder.rglob("*")}
        return inside | {str(path) for path in self.folder.parent.glob(self.folder.name + ".*")}

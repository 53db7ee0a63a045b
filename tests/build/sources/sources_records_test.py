"""Figures of records and identified models, on signals of which they are known in closed form."""

import cmath
import math
import os
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(os.environ["LEVITAS_SOURCE"]) / "scripts"))
import sources_records as records  # noqa: E402

HZ, RATE = 25, 1000  # of the rotor, of the rows


def position(turns):
    """Off centre, 3 um forward, 1 um backward at half the speed, 2 um at 20 times the speed."""
    turn = 2j * math.pi * turns
    return (1e-5 + 3e-6 * cmath.exp(turn) + 1e-6 * cmath.exp(-0.5 * turn) +
            2e-6 * cmath.exp(20 * turn))


class OfARecord(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name) / "rows.csv"
        lines = ["rotor_angle_rad,speed_rpm,position_g_x_m,position_g_y_m,one,other"]
        for row in range(2030):  # not a whole number of turns
            at = position(HZ * row / RATE)
            bit = row // 10
            one = 1 if 10 <= row < 2000 and bit % 2 else 0
            other = 1 if 10 <= row < 2000 and bit % 4 > 1 else 0
            lines.append(f"{HZ * row / RATE % 1 * math.tau},{60 * HZ},{at.real},{at.imag},{one},{other}")
        lines.append("0,0,1,1,0,0")  # far away, at another speed
        self.path.write_text("\n".join(lines))

    def test_lines_are_found_by_order_and_sense(self):
        for order, amplitude in ((1, 3e-6), (-0.5, 1e-6), (20, 2e-6), (-1, 0), (3, 0)):
            self.assertAlmostEqual(records.line(self.path, "g", 60 * HZ, order), amplitude, delta=1e-12)

    def test_vibration_is_that_about_the_mean_and_adds_up_over_bearings(self):
        one = math.sqrt(9 + 1 + 4) * 1e-6
        # The last, broken turn counts here: 30 of 2030 rows.
        self.assertAlmostEqual(records.vibration(self.path, ["g"], 60 * HZ), one, delta=0.02 * one)
        both = records.vibration(self.path, ["g", "g"], 60 * HZ)
        self.assertAlmostEqual(both, math.sqrt(2) * records.vibration(self.path, ["g"], 60 * HZ))

    def test_what_is_excited_reaches_from_the_first_to_the_last_row_that_is_not_zero(self):
        self.assertEqual(records.rows_excited(self.path, "one"), 1990)
        self.assertEqual(records.largest(self.path, "position_g_x_m"), 1.0)

    def test_correlation_is_one_for_a_shifted_copy_and_that_of_the_overlap_otherwise(self):
        alone = records.largest_correlation(self.path, ["one", "one"], 10, 0)
        self.assertAlmostEqual(alone, 1.0)
        # Every second bit against two of four: half of the bits of each meet.
        self.assertAlmostEqual(records.largest_correlation(self.path, ["one", "other"], 10, 0), 0.5,
                               delta=0.02)


class OfAnIdentifiedModel(unittest.TestCase):
    PERIOD = 5e-5
    # A pair of zeros on the circle at 500 Hz, poles at 0.9 on the real axis.
    TERMS = [{"term": "u2(k)", "coefficient": 0.5}, {"term": "u2(k-2)", "coefficient": 0.5},
             {"term": "u2(k-1)", "coefficient": -math.cos(math.tau * 500 * PERIOD)},
             {"term": "y1(k-1)", "coefficient": 0.9}, {"term": "u1(k)", "coefficient": 7.0}]

    def test_coefficients_stand_by_lag_whatever_the_order_of_the_terms(self):
        self.assertEqual(records.polynomial(self.TERMS, "y1"), [0.0, 0.9])
        self.assertEqual(records.polynomial(self.TERMS, "u2")[::2], [0.5, 0.5])

    def test_least_gain_is_at_the_zeros(self):
        self.assertEqual(records.least_gain_hz(self.TERMS, "u2", self.PERIOD, 300, 900), 500.0)


if __name__ == "__main__":
    unittest.main()

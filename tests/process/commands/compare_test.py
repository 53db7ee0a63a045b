"""amb compare: synchronous amplitudes of records side by side, as text, JSON and a page.

The records come from the nonlinear plant with written seeds, at a constant speed.
"""

import cmath
import re
import unittest
import urllib.parse
import xml.etree.ElementTree as xml

from command import BAD_INPUT, DONE, USAGE, CommandTest, amb, make_record

ROWS = 8_000
SPEED_RPM = 3000
CHANNELS = ["de_x", "de_y", "nde_x", "nde_y"]
RIG = ("--rig", "flexible_rotor")


def without_test_signal(path):
    """The same record, whose test currents nobody has written down: they are noise then."""
    rows = [line.split(",") for line in path.read_text().splitlines()]
    kept = [i for i, name in enumerate(rows[0]) if not name.startswith("excitation_")]
    path.write_text("".join(",".join(row[i] for i in kept) + "\n" for row in rows))


class Compare(CommandTest):
    def setUp(self):
        super().setUp()
        for rotor, speed in (("healthy", SPEED_RPM), ("unbalance", SPEED_RPM), ("standing", 0)):
            kind = "healthy" if rotor == "standing" else rotor
            without_test_signal(make_record(self.folder / f"{rotor}.csv", kind, speed, ROWS))

    def imported(self, name):
        done = amb(self.folder, "import", f"{name}.csv", *RIG, "--out", f"{name}.lcm")
        self.assertEqual(done.returncode, DONE, done.stderr)
        return f"{name}.lcm"

    @staticmethod
    def at(result, record, speed_rpm):
        return next(speed for speed in result["records"][record]["speeds"]
                    if abs(speed["speed_rpm"] - speed_rpm) < 0.01 * speed_rpm + 0.5)

    def test_more_unbalance_turns_more_at_once_the_speed_alone(self):
        printed, result = self.compute("compare", "healthy.csv", "unbalance.csv", *RIG, "--orders",
                                       "1,7")
        self.assertIn("Control current, amplitude [A]", printed)
        self.assertEqual(result["channels"], CHANNELS)
        healthy, unbalanced = (self.at(result, i, SPEED_RPM) for i in (0, 1))
        self.assertEqual({healthy["found"], unbalanced["found"]}, {"held"})
        for one, other in zip(healthy["axes"], unbalanced["axes"]):
            self.assertGreater(other["position_m"][0], 1.1 * one["position_m"][0])
            self.assertGreater(other["control_current_a"][0], 1.1 * one["control_current_a"][0])
            self.assertLess(other["position_m"][1], 0.1 * other["position_m"][0])  # noise alone

    def test_the_amplitude_is_that_of_the_recorded_positions(self):
        """2 / N |sum x e^(-j angle)| over whole turns, of 200 rows each."""
        _, result = self.compute("compare", "unbalance.csv", *RIG)
        axis = self.at(result, 0, SPEED_RPM)["axes"][0]
        rows = [line.split(",") for line in
                (self.folder / "unbalance.csv").read_text().splitlines()]
        column = next(i for i, name in enumerate(rows[0]) if name.startswith("position_de_x"))
        scale = {"m": 1, "mm": 1e-3, "um": 1e-6}[rows[0][column].rsplit("_", 1)[1]]
        angle = rows[0].index("rotor_angle_rad")
        taken = rows[-7000:]
        turning = sum(scale * float(row[column]) * cmath.exp(-1j * float(row[angle]))
                      for row in taken)
        # Other turns of a record with noise: 35 of them here, the last 39 there.
        self.assertAlmostEqual(axis["position_m"][0] / (2 * abs(turning) / len(taken)), 1,
                               delta=0.03)

    def test_a_standing_rotor_has_a_mean_and_no_order(self):
        printed, result = self.compute("compare", "standing.csv", *RIG)
        standing = self.at(result, 0, 0)
        self.assertEqual([axis["position_m"] for axis in standing["axes"]], [[]] * 4)
        self.assertTrue(all(abs(axis["control_current_mean_a"]) > 0.05
                            for axis in standing["axes"]))  # each carries its share of the weight
        self.assertIn("mean", printed)

    def test_a_record_under_a_test_signal_holds_no_speed(self):
        make_record(self.folder / "shaken.csv", "healthy", SPEED_RPM, ROWS)
        self.refuse(BAD_INPUT, "without a test signal", "compare", "shaken.csv", *RIG)

    def test_a_session_names_its_rig_itself_and_other_files_do_not(self):
        session = self.imported("healthy")
        _, of_session = self.compute("compare", session)
        _, of_csv = self.compute("compare", "healthy.csv", *RIG)
        self.assertEqual(of_session["records"][0]["speeds"], of_csv["records"][0]["speeds"])
        self.refuse(USAGE, "name it, --rig", "compare", "healthy.csv")

    def test_says_where_a_record_has_not_the_speed(self):
        printed, result = self.compute("compare", "healthy.csv", "standing.csv", *RIG, "--speeds",
                                       f"0,{SPEED_RPM}")
        self.assertEqual(self.at(result, 0, 0)["found"], "absent")
        self.assertEqual(self.at(result, 1, SPEED_RPM)["found"], "absent")
        self.assertEqual(printed.count("not in it"), 4)  # in each of the two tables

    def test_the_page_needs_nothing_beside_it_and_shows_orbits_and_circle(self):
        self.compute("compare", "healthy.csv", "unbalance.csv", *RIG, "--page", "c.html",
                     "--circle-um", "36")
        page = (self.folder / "c.html").read_text(encoding="utf-8")
        pictures = re.findall(r'src="data:image/svg\+xml,([^"]*)"', page)
        for picture in pictures:
            self.assertTrue(xml.fromstring(urllib.parse.unquote(picture)).tag.endswith("svg"))
        names = re.findall(r'<figure id="([^"]*)"', page)
        self.assertEqual(names[:2], ["orbits_de", "orbits_nde"])
        self.assertEqual(len(names), len(pictures))
        self.assertIn("c00000", urllib.parse.unquote(pictures[0]))
        self.assertIn("the circle of 36 µm", page)
        self.assertNotIn("<script", page)
        self.compute("compare", "healthy.csv", *RIG, "--page", "without.html")
        page = (self.folder / "without.html").read_text(encoding="utf-8")
        self.assertNotIn("the circle of", page)

    def test_refuses_records_of_other_rigs_and_other_channels(self):
        (self.folder / "one.csv").write_text("time_s,position_mass_x_m,control_current_mass_x_a\n" +
                                             "".join(f"{n * 1e-4:.4f},0,0\n" for n in range(3000)))
        done = amb(self.folder, "import", "one.csv", "--rig", "one_axis", "--out", "one.lcm")
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.refuse(BAD_INPUT, "nothing to set side by side", "compare", self.imported("healthy"),
                    "one.lcm")
        self.refuse(USAGE, "--circle-um", "compare", "healthy.csv", *RIG, "--circle-um", "36")


if __name__ == "__main__":
    unittest.main()

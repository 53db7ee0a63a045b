"""A probe's table becomes numbers, points, a rig file, and what a nonlinear identification knows."""

import json
import re
import random
import unittest

from command import BAD_INPUT, DONE, USAGE, CommandTest, amb

HEADER = "displacement_um,reading_um\n"
A3_1_PER_UM2 = 1e-5  # 1e7 1/m^2


def table(header=HEADER):
    """There and back over +-100 um; 0.2 um of hysteresis, 0.5 um of offset."""
    steps = list(range(-10, 11)) + list(range(9, -11, -1))
    ways = [0.1] * 21 + [-0.1] * 20
    rows = (f"{10 * n},{0.5 + 10 * n + A3_1_PER_UM2 * (10 * n) ** 3 + way:.9g}"
            for n, way in zip(steps, ways))
    return header + "\n".join(rows) + "\n"


class IdentifyCharacteristic(CommandTest):
    def characteristic(self, *arguments):
        return amb(self.folder, "identify", "characteristic", *arguments)

    def test_prints_the_curve_and_writes_it_into_the_rig(self):
        self.write("probe.csv", table())
        done = self.characteristic("probe.csv", "--json", "c.json")
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.assertIn("- {displacement_um: 0.0000, reading_um: 0.0000}", done.stdout)
        found = json.loads((self.folder / "c.json").read_text())
        self.assertAlmostEqual(found["gain"], 1.0, delta=1e-6)
        self.assertAlmostEqual(found["a3_1_per_m2"], 1e7, delta=10.0)
        self.assertAlmostEqual(found["offset_m"], 0.5e-6, delta=1e-10)
        self.assertAlmostEqual(found["hysteresis_m"], 0.2e-6, delta=1e-10)
        # 1e7 x^3 is 1 um off at 46.4 um.
        self.assertAlmostEqual(found["straight_to_m"], 46.4e-6, delta=0.1e-6)
        done = self.characteristic("probe.csv", "--rig", "turbomolecular_pump", "--channel", "lx",
                                   "--out", "measured.yaml")
        self.assertEqual(done.returncode, DONE, done.stderr)
        rig = (self.folder / "measured.yaml").read_text()
        self.assertEqual(rig.count("characteristic:\n"), 1)
        places = [float(um) for um in re.findall(r"displacement_um: (\S+)", rig)]
        self.assertAlmostEqual(max(places), 100.0, delta=1e-9)
        modes = amb(self.folder, "modes", "--rig", "measured.yaml")
        self.assertEqual(modes.returncode, DONE, modes.stderr)

    def test_what_is_no_table_or_no_channel_is_refused(self):
        self.write("probe.csv", table())
        self.write("bare.csv", table("displacement,reading\n"))
        for status, words, arguments in (
                (BAD_INPUT, "bare.csv: line 1: column 'displacement' has no unit", ("bare.csv",)),
                (USAGE, "--rig, --channel and --out belong together", ("probe.csv", "--out", "r.yaml")),
                (USAGE, "--channel vx: rig turbomolecular_pump has ux, uy, lx, ly",
                 ("probe.csv", "--rig", "turbomolecular_pump", "--channel", "vx", "--out", "r.yaml"))):
            done = self.characteristic(*arguments)
            self.assertEqual((done.returncode, words in done.stderr), (status, True), done.stderr)
            self.assertFalse((self.folder / "r.yaml").exists())

    def test_what_is_wrong_is_said_before_anything_is_printed(self):
        self.write("probe.csv", table())
        for rig, channel in (("absent.yaml", "ux"), ("turbomolecular_pump", "vx")):
            done = self.characteristic("probe.csv", "--rig", rig, "--channel", channel, "--out", "r.yaml")
            self.assertEqual((done.returncode != DONE, done.stdout), (True, ""))

    def test_a_probe_that_no_cubic_describes_is_told_and_warned_of(self):
        """A step of 5 um at 20 um, there and back twice."""
        steps = 2 * (list(range(-25, 26)) + list(range(24, -25, -1)))
        self.write("step.csv", HEADER + "".join(f"{2 * n},{2 * n + 5 * (n > 10)}\n" for n in steps))
        done = self.characteristic("step.csv", "--json", "c.json")
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.assertIn("NO CUBIC", done.stdout)
        found = json.loads((self.folder / "c.json").read_text())
        self.assertEqual(found["cubic_suffices"], False)
        for point in found["points"]:
            x = point["displacement_m"]
            self.assertAlmostEqual(point["reading_m"], x + 5e-6 * (x > 21e-6), delta=2e-8)
        self.write("run.csv", "u,y\n" + "".join(f"{n % 7},{1e-6 * (n % 5)}\n" for n in range(400)))
        done = amb(self.folder, "identify", "hammerstein-wiener", "run.csv", "--input", "u", "--output", "y",
                   "--rate-hz", "1000", "--order", "2", "--degree", "1", "--sensor-table", "step.csv")
        self.assertIn("warning: step.csv: no cubic describes this probe", done.stderr)

    def test_a_table_of_one_sweep_is_not_judged(self):
        self.write("once.csv", HEADER + "".join(f"{2 * n},{2 * n + 5 * (n > 10)}\n" for n in range(-25, 26)))
        done = self.characteristic("once.csv", "--json", "c.json")
        self.assertIn("not judged, for nothing was measured twice", done.stdout)
        self.assertIsNone(json.loads((self.folder / "c.json").read_text())["cubic_suffices"])

    def test_tells_the_identification_what_the_numbers_tell_it(self):
        """A lag of first order behind a curved probe; the curve is known, or it is not."""
        draw, state, rows = random.Random(7), 0.0, ["u,y"]
        for _ in range(2000):
            u = draw.randint(-9, 9)
            rows.append(f"{u},{1e-6 * (state + A3_1_PER_UM2 * state ** 3):.12g}")
            state = 0.95 * state + u
        self.write("run.csv", "\n".join(rows) + "\n")
        self.write("probe.csv", table())
        fits = []
        for known in (("--sensor-table", "probe.csv"), ("--sensor-a3", "1e7"), ()):
            done = amb(self.folder, "identify", "hammerstein-wiener", "run.csv", "--input", "u", "--output",
                       "y", "--rate-hz", "1000", "--order", "2", "--degree", "1", *known, "--json", "h.json")
            self.assertEqual(done.returncode, DONE, done.stderr)
            judged = json.loads((self.folder / "h.json").read_text())["judged"]
            fits.append(judged[-1]["free_run"]["fit_percent"][0])
        self.assertAlmostEqual(fits[0], fits[1], delta=0.01)
        self.assertGreater(fits[0], fits[2] + 0.01)
        done = amb(self.folder, "identify", "hammerstein-wiener", "run.csv", "--input", "u", "--output", "y",
                   "--rate-hz", "1000", "--sensor-table", "probe.csv,probe.csv")
        self.assertEqual(done.returncode, USAGE)
        self.assertIn("2 files for 1 outputs", done.stderr)


if __name__ == "__main__":
    unittest.main()

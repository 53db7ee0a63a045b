"""amb simulate on records of known rotors: silent where model and rotor agree, loud where not.

The records come from the nonlinear plant with written seeds; nothing recorded elsewhere is needed.
"""

import math
import os
import unittest
from pathlib import Path
from tempfile import TemporaryDirectory

from command import (BAD_INPUT, DONE, FOREIGN_RECORD, SHIPPED_RIG, CommandTest, amb, edited,
                     make_record, scaled_controller)

CHANNELS = ["de_x", "de_y", "nde_x", "nde_y"]
SPEED_RPM = 3000
ROWS = 15_000


def power(channel):
    return channel["rms_m"]**2


class Simulate(CommandTest):
    @classmethod
    def setUpClass(cls):
        cls.shared = TemporaryDirectory()
        cls.sessions = {}
        for name, rotor, speed in (("healthy", "healthy", SPEED_RPM), ("standing", "healthy", 0),
                                   ("unbalance", "unbalance", SPEED_RPM),
                                   ("weak_magnet", "weak_magnet", 0)):
            csv = make_record(Path(cls.shared.name) / f"{name}.csv", rotor, speed, ROWS)
            session = csv.with_suffix(".lcmlog")
            done = amb(cls.shared.name, "import", csv, "--rig", "flexible_rotor", "--out", session)
            assert done.returncode == DONE, done.stderr
            cls.sessions[name] = session

    @classmethod
    def tearDownClass(cls):
        cls.shared.cleanup()

    def simulate(self, name, *options, warns=""):
        return self.compute("simulate", self.sessions[name], *options, warns=warns)

    def test_right_model_departs_nowhere(self):
        for name in ("healthy", "standing"):
            printed, result = self.simulate(name)
            self.assertEqual(result["departures"], [], name)
            self.assertIn("The model departs nowhere", printed)
            self.assertEqual([c["channel"] for c in result["channels"]], CHANNELS)
            for channel in result["channels"]:
                # Nothing predicts better than the reading's own noise; 2 % for 1 s of it.
                self.assertGreater(channel["multiple_of_noise"], 0.98)
                self.assertLess(channel["multiple_of_noise"], 1.02 * channel["expected_multiple"])
                # White: neighbours are uncorrelated within 5/sqrt(10 000).
                self.assertLess(abs(channel["lag_one_correlation"]), 0.05)

    def test_noise_of_the_sensor_is_that_of_the_rig_file(self):
        """1 um rms and the rounding to 14 bits over 800 um: q/sqrt(12)."""
        _, result = self.simulate("healthy")
        wanted = math.hypot(1e-6, 800e-6 / 2**14 / math.sqrt(12))
        for channel in result["channels"]:
            self.assertAlmostEqual(channel["sensor_noise_m"], wanted, delta=1e-4 * wanted)
            self.assertAlmostEqual(channel["multiple_of_noise"], channel["rms_m"] / wanted,
                                   delta=1e-3)

    def test_tripled_unbalance_shows_once_per_turn_in_every_channel(self):
        printed, result = self.simulate("unbalance")
        for channel in result["channels"]:
            orders = {order["order"]: order for order in channel["orders"]}
            self.assertGreater(orders[1]["share"], 0.9, channel["channel"])
            self.assertLess(orders[2]["share"], 0.02)
            self.assertAlmostEqual(channel["dominant_frequency_hz"], SPEED_RPM / 60,
                                   delta=result["line_spacing_hz"])
        first = result["departures"][0]
        self.assertEqual(first["place"], "1x of rotation")
        # The same rig turned without the extra weight has none of it.
        _, healthy = self.simulate("healthy")
        for wrong, right in zip(result["channels"], healthy["channels"]):
            self.assertGreater(wrong["orders"][0]["amplitude_m"],
                               10 * right["orders"][0]["amplitude_m"])
        self.assertIn("1x of rotation", printed.split("departs most")[1].splitlines()[1])

    def test_weak_magnet_shows_in_the_channels_of_its_bearing(self):
        _, weak = self.simulate("weak_magnet")
        _, right = self.simulate("standing")
        excess = {a["channel"]: power(a) - power(b)
                  for a, b in zip(weak["channels"], right["channels"])}
        at_magnet = min(excess["nde_x"], excess["nde_y"])
        self.assertGreater(at_magnet, 0.0)
        self.assertGreater(at_magnet, 2.0 * max(abs(excess["de_x"]), abs(excess["de_y"])), excess)
        for channel in weak["channels"]:
            self.assertEqual(channel["orders"], [])  # it stands
        self.assertTrue(weak["departures"])
        self.assertTrue(weak["departures"][0]["channel"].startswith("nde"), weak["departures"][0])

    def test_model_with_the_tripled_unbalance_explains_it(self):
        changes = [(f"moment_g_mm: {n},", f"moment_g_mm: {3 * n},") for n in (5, 18)]
        rig = self.write("heavy.yaml", edited(SHIPPED_RIG, *changes))
        _, result = self.simulate("unbalance", "--rig", rig, warns="the session's own rig")
        self.assertEqual(result["departures"], [])

    def test_model_with_the_weak_magnet_explains_it(self):
        text = SHIPPED_RIG.read_text()
        before, after = text.split("  - name: nde")
        rig = self.write("weak.yaml",
                         before + "  - name: nde" + after.replace("ki_n_per_a: 40",
                                                                  "ki_n_per_a: 28"))
        _, result = self.simulate("weak_magnet", "--rig", rig, warns="the session's own rig")
        self.assertEqual(result["departures"], [])

    def test_rig_of_the_session_is_the_model_unless_another_is_named(self):
        rig = self.write("heavy.yaml", edited(
            SHIPPED_RIG, ("name: flexible_rotor", "name: heavy"), ("gap_mm: 0.381", "gap_mm: 0.4")))
        done = amb(self.folder, "import", FOREIGN_RECORD, "--rig", rig, "--out", "own.lcmlog")
        self.assertEqual(done.returncode, DONE, done.stderr)
        printed, _ = self.compute("simulate", "own.lcmlog")
        self.assertIn("own.lcmlog against rig heavy", printed)
        printed, _ = self.compute("simulate", "own.lcmlog", "--rig", "flexible_rotor",
                                  warns="was recorded with rig heavy, --rig names flexible_rotor")
        self.assertIn("own.lcmlog against rig flexible_rotor", printed)

    def test_shares_of_one_channel_do_not_exceed_the_whole(self):
        _, result = self.simulate("unbalance")
        for channel in result["channels"]:
            shares = [band["share"] for band in channel["bands"]]
            # 1 %: bands a little below the expected noise take from the whole, not from a share.
            self.assertTrue(all(0.0 <= share <= 1.01 for share in shares), shares)
            self.assertLessEqual(sum(shares), 1.01)
            edges = [(band["low_hz"], band["high_hz"]) for band in channel["bands"]]
            self.assertEqual([high for _, high in edges[:-1]], [low for low, _ in edges[1:]])
            self.assertEqual(edges[-1][1], 5000.0)  # half the sampling rate

    def test_accounts_for_every_row(self):
        _, result = self.simulate("healthy")
        rows = round(result["compared_s"] / 1e-4) + result["settling_samples"]
        self.assertEqual(rows + result["not_levitated_samples"], ROWS)
        self.assertEqual((result["pieces"], result["gaps"]), (1, 0))

    def test_what_is_printed_is_what_the_json_holds(self):
        printed, result = self.simulate("unbalance")
        lines = printed.splitlines()
        self.assertIn(f"{result['compared_s']:.3f} s compared", lines[0])
        self.assertIn(f"mean speed {SPEED_RPM} rpm", lines[0])
        table = lines.index(next(line for line in lines if line.startswith("channel")))
        for line, channel in zip(lines[table + 1:], result["channels"]):
            name, rms_um, multiple, expected = line.split()[:4]
            self.assertEqual(name, channel["channel"])
            self.assertAlmostEqual(float(rms_um), channel["rms_m"] * 1e6, delta=0.00051)
            self.assertAlmostEqual(float(multiple), channel["multiple_of_noise"], delta=0.0051)
            self.assertAlmostEqual(float(expected), channel["expected_multiple"], delta=0.0051)
        listed = printed.split("departs most")[1].splitlines()[1:]
        self.assertEqual(len(listed), min(8, len(result["departures"])))
        for line, departure in zip(listed, result["departures"]):
            self.assertTrue(line.strip().startswith(departure["channel"]), line)
            self.assertIn(departure["place"], line)
            self.assertIn(f"{departure['ratio']:.1f} x expected", line)

    def test_departures_limits_the_list_not_the_file(self):
        printed, result = self.simulate("unbalance", "--departures", "1")
        self.assertEqual(len(printed.split("departs most")[1].splitlines()), 2)
        self.assertGreater(len(result["departures"]), 1)
        ratios = [departure["ratio"] for departure in result["departures"]]
        self.assertGreater(min(ratios), 1.0)

    def test_spectrum_file_holds_the_power_of_the_innovations(self):
        """Parseval: the density summed over its lines is the mean square, within the windows."""
        _, result = self.simulate("healthy", "--csv", "spectrum.csv", "--svg", "spectrum.svg")
        names, *lines = (self.folder / "spectrum.csv").read_text().splitlines()
        self.assertEqual(names.split(","),
                         ["frequency_hz", *(f"density_{c}_m2_per_hz" for c in CHANNELS)])
        rows = [[float(cell) for cell in line.split(",")] for line in lines]
        self.assertAlmostEqual(rows[-1][0], 5000.0, delta=1e-6)
        for i, channel in enumerate(result["channels"]):
            total = sum(row[1 + i] for row in rows) * result["line_spacing_hz"]
            # 5 %: the first and last half segment count less than the rest.
            self.assertAlmostEqual(total, power(channel), delta=0.05 * power(channel))
        picture = (self.folder / "spectrum.svg").read_text()
        self.assertEqual(picture.count("<polyline"), len(CHANNELS))
        self.assertTrue(picture.endswith("</svg>\n"))

    def test_larger_force_noise_follows_the_sensors_more_closely(self):
        """A tripled unbalance leaves less behind in an observer that trusts its model less."""
        rms = []
        for options in ((), ("--force-noise-percent", "5")):
            _, result = self.simulate("unbalance", *options)
            rms.append(result["channels"][0]["orders"][0]["amplitude_m"])
        self.assertLess(rms[1], 0.5 * rms[0])

    def test_needs_no_reference_records(self):
        """Whatever the environment says of measured data: rig and session are all it reads."""
        _, usual = self.simulate("healthy")
        environment = {name: value for name, value in os.environ.items()
                       if not name.startswith("AMB_")}
        environment["AMB_MEASURED"] = str(self.folder / "nowhere")
        done = amb(self.folder, "simulate", self.sessions["healthy"], "--json", "bare.json",
                   environment=environment)
        self.assertEqual(done.returncode, DONE, done.stderr)
        _, again = self.simulate("healthy")
        self.assertEqual(usual, again)
        self.assertEqual((self.folder / "bare.json").read_text(),
                         (self.folder / "out.json").read_text())

    def test_record_of_another_simulator_is_no_stranger(self):
        """Its numbers are a little off the rig file's; 20 % is far from a fault, far from nothing."""
        done = amb(self.folder, "import", FOREIGN_RECORD, "--rig", "flexible_rotor", "--out",
                   "foreign.lcmlog")
        self.assertEqual(done.returncode, DONE, done.stderr)
        _, result = self.compute("simulate", "foreign.lcmlog")
        for channel in result["channels"]:
            self.assertAlmostEqual(channel["multiple_of_noise"], channel["expected_multiple"],
                                   delta=0.2 * channel["expected_multiple"])

    def test_session_of_another_rig_is_refused(self):
        for change, words in ((("period_us: 100", "period_us: 50"), "sampled every 100 us"),
                              (("name: de\n", "name: upper\n"), "has upper_x, upper_y")):
            rig = self.write("other.yaml", edited(SHIPPED_RIG, change))
            told = self.refuse(BAD_INPUT, words, "simulate", self.sessions["healthy"], "--rig",
                               rig, "--json", "x.json", "--csv", "x.csv")
            self.assertIn("use the rig file it was recorded with", told)

    def test_record_too_short_for_a_spectrum_is_refused(self):
        csv = make_record(self.folder / "short.csv", rows=300)
        session = self.folder / "short.lcmlog"
        done = amb(self.folder, "import", csv, "--rig", "flexible_rotor", "--out", session)
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.refuse(BAD_INPUT, "longer record", "simulate", session, "--json", "x.json")

    def test_a_free_run_stays_near_the_record_with_the_right_law_only(self):
        """Model and law by themselves, moved by nothing but the test signal of the record."""
        session = self.sessions["standing"]
        _, right = self.compute("simulate", session, "--free-run", "--controller", "flexible_rotor")
        self.write("stiff.yaml", scaled_controller(1.5))
        _, wrong = self.compute("simulate", session, "--free-run", "--controller", "stiff.yaml")
        for one, other in zip(right["free_run"]["fit_percent"], wrong["free_run"]["fit_percent"]):
            self.assertGreater(one, other + 5)
        segments = right["free_run"]["segments"]
        self.assertEqual([segment["excited"] for segment in segments], [CHANNELS])

    def test_a_free_run_leaves_its_responses_and_a_picture(self):
        self.compute("simulate", self.sessions["healthy"], "--free-run", "--controller",
                     "flexible_rotor", "--csv", "f.csv", "--svg", "f.svg")
        names, *rows = (self.folder / "f.csv").read_text().splitlines()
        self.assertEqual(names, "time_s,speed_rpm," + ",".join(
            f"measured_{channel}_m,model_{channel}_m" for channel in CHANNELS))
        self.assertGreater(len(rows), 0.9 * ROWS)
        self.assertIn("model, free run", (self.folder / "f.svg").read_text())

    def test_a_free_run_needs_a_law_and_a_test_signal(self):
        session = self.sessions["standing"]
        self.refuse(BAD_INPUT, "give the law with --controller", "simulate", session, "--free-run")
        rows = [line.split(",") for line in
                session.with_name("standing.csv").read_text().splitlines()]
        kept = [i for i, name in enumerate(rows[0]) if not name.startswith("excitation_")]
        self.write("still.csv", "".join(",".join(row[i] for i in kept) + "\n" for row in rows))
        self.refuse(BAD_INPUT, "no test signal", "simulate", "still.csv", "--free-run",
                    "--controller", "flexible_rotor")


if __name__ == "__main__":
    unittest.main()

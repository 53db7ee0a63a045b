"""amb replay on imported records: what another controller would have commanded.

(Replay of recorded runs bit by bit is tested with the processes that record them.)
"""

import json
import math
import unittest

from command import (BAD_INPUT, DONE, SHIPPED_CONTROLLER, CommandTest, amb, edited, make_record,
                     scaled_controller)

ROWS = 4_000
LIMIT_A = 1.0  # bias of the rig: |ic| may not exceed it


class Replay(CommandTest):
    def setUp(self):
        super().setUp()
        make_record(self.folder / "r.csv", "unbalance", 3000, ROWS)
        done = amb(self.folder, "import", "r.csv", "--rig", "flexible_rotor", "--out", "s.lcmlog")
        self.assertEqual(done.returncode, DONE, done.stderr)

    def rows(self, name):
        names, *lines = (self.folder / name).read_text().splitlines()
        return [dict(zip(names.split(","), map(float, line.split(",")))) for line in lines]

    def compare(self, controller):
        return self.compute("replay", "s.lcmlog", "--controller", controller, "--csv", "both.csv")

    def test_imported_record_has_no_controller_to_repeat(self):
        told = self.refuse(BAD_INPUT, "holds no controller", "replay", "s.lcmlog", "--json", "x")
        self.assertIn("--controller FILE", told)

    def test_recorded_currents_are_those_of_the_record(self):
        self.compare("flexible_rotor")
        data = {round(row["time_s"] * 1e4): row for row in self.rows("r.csv")}
        both = self.rows("both.csv")
        self.assertGreater(len(both), ROWS / 2)
        for row in both:
            original = data[round(row["time_s"] * 1e4)]
            for channel in ("de_x", "de_y", "nde_x", "nde_y"):
                self.assertEqual(row[f"recorded_{channel}_a"],
                                 original[f"control_current_{channel}_a"])
                self.assertLessEqual(abs(row[f"other_{channel}_a"]), LIMIT_A)

    def test_json_is_the_statistics_of_the_cycles_in_the_csv(self):
        _, report = self.compare("flexible_rotor_commissioned")
        both = self.rows("both.csv")
        self.assertEqual(report["compared"], len(both))
        self.assertEqual(report["cycles"], ROWS)
        for channel in report["channels"]:
            name = channel["channel"]
            recorded = [row[f"recorded_{name}_a"] for row in both]
            difference = [row[f"other_{name}_a"] - row[f"recorded_{name}_a"] for row in both]
            n = len(both)
            # 1e-9: sums of some thousand numbers of 53 bits.
            self.assertAlmostEqual(channel["recorded_rms_a"],
                                   math.sqrt(sum(x * x for x in recorded) / n), delta=1e-9)
            self.assertAlmostEqual(channel["difference_rms_a"],
                                   math.sqrt(sum(x * x for x in difference) / n), delta=1e-9)
            self.assertAlmostEqual(channel["difference_mean_a"], sum(difference) / n, delta=1e-9)
            self.assertAlmostEqual(abs(channel["difference_max_a"]), max(map(abs, difference)),
                                   delta=1e-12)

    def test_law_that_flew_the_rotor_would_have_done_nearly_the_same(self):
        """Its integrators start empty: a constant differs, what changes from cycle to cycle does not."""
        _, own = self.compare("flexible_rotor")
        rms = {}
        for name, gain in (("own", 1.0), ("double", 2.0)):
            self.write("c.yaml", scaled_controller(gain))
            _, report = self.compare("c.yaml")
            channel = report["channels"][0]
            rms[name] = math.sqrt(max(0.0, channel["difference_rms_a"]**2
                                      - channel["difference_mean_a"]**2))
        self.assertLess(rms["own"], 0.1 * rms["double"])
        self.assertEqual([c["channel"] for c in own["channels"]], ["de_x", "de_y", "nde_x", "nde_y"])

    def test_what_is_printed_is_what_the_json_holds(self):
        printed, report = self.compare("flexible_rotor_commissioned")
        self.assertIn(f"{report['compared']} of {ROWS} cycles compared", printed)
        lines = printed.splitlines()
        table = lines.index(next(line for line in lines if line.startswith("channel")))
        for line, channel in zip(lines[table + 1:], report["channels"]):
            name, recorded, mean, rms, largest, _ = line.split()
            self.assertEqual(name, channel["channel"])
            for shown, key in ((recorded, "recorded_rms_a"), (mean, "difference_mean_a"),
                               (rms, "difference_rms_a"), (largest, "difference_max_a")):
                self.assertAlmostEqual(float(shown), channel[key], delta=5.1e-7)

    def test_controller_for_other_axes_is_refused(self):
        self.write("other.yaml", edited(SHIPPED_CONTROLLER, ("\n  nde:", "\n  upper:")))
        self.refuse(BAD_INPUT, "upper", "replay", "s.lcmlog", "--controller", "other.yaml", "--csv",
                    "x.csv", "--json", "x.json")

    def test_record_in_which_nothing_can_be_compared_leaves_no_result(self):
        """The first 0.1 s fill the filters, so 50 ms leave nothing."""
        make_record(self.folder / "short.csv", rows=500)
        done = amb(self.folder, "import", "short.csv", "--rig", "flexible_rotor", "--out",
                   "short.lcmlog")
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.refuse(BAD_INPUT, "nothing to compare", "replay", "short.lcmlog", "--controller",
                    "flexible_rotor", "--csv", "x.csv", "--json", "x.json")

    def test_damage_is_told_and_what_is_left_is_compared(self):
        data = bytearray((self.folder / "s.lcmlog").read_bytes())
        middle = len(data) // 2
        data[middle:middle + 4096] = bytes(4096)
        (self.folder / "s.lcmlog").write_bytes(data)
        done = amb(self.folder, "export", "s.lcmlog", "--csv", "left.csv", "--json", "e.json")
        self.assertEqual(done.returncode, DONE, done.stderr)
        report = json.loads((self.folder / "e.json").read_text())
        missing = report["damage"]["missing_cycles"]
        self.assertGreater(missing, 0)
        self.assertEqual(report["rows"] + missing, ROWS)
        self.assertIn("Not everything could be read", done.stdout)
        self.assertEqual(len(self.rows("left.csv")), report["rows"])


if __name__ == "__main__":
    unittest.main()

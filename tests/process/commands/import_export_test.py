"""amb import and amb export: a record made here goes in, out, and in again, and nothing is lost."""

import json
import math
import unittest

from command import BAD_INPUT, DONE, OTHER, USAGE, CommandTest, amb, make_record

ROWS = 2_000
SPINNING = "4"  # of the modes in docs/formats.md
CHANNELS = ["de_x", "de_y", "nde_x", "nde_y"]


def table(path):
    """(names, rows of text cells)"""
    names, *lines = path.read_text().splitlines()
    return names.split(","), [line.split(",") for line in lines]


class ImportExport(CommandTest):
    def setUp(self):
        super().setUp()
        self.csv = make_record(self.folder / "record.csv", "unbalance", 3000, ROWS)

    def import_as(self, name, data=None):
        _, report = self.compute("import", data or self.csv, "--rig", "flexible_rotor", "--out",
                                 name, "--overwrite")
        return report

    def write_rows(self, name, names, rows, separator=","):
        lines = [separator.join(cells) for cells in [names, *rows]]
        return self.write(name, "\n".join(lines) + "\n")

    def test_every_number_comes_out_as_it_went_in(self):
        self.import_as("a.lcmlog")
        printed, report = self.compute("export", "a.lcmlog", "--csv", "a.csv")
        self.assertEqual(report["rows"], ROWS)
        self.assertEqual(report["cycles_without_frame"], 0)
        self.assertIn(f"a.csv: {ROWS} rows", printed)
        names, rows = table(self.csv)
        out_names, out_rows = table(self.folder / "a.csv")
        self.assertEqual(out_names, [*names, "mode"])
        self.assertEqual(len(out_rows), len(rows))
        for before, after in zip(rows, out_rows):
            for name, wanted, got in zip(names, before, after):
                # Speed is written with 12 digits, everything else to the bit.
                tolerance = 1e-11 * abs(float(wanted)) if name == "speed_rpm" else 0.0
                self.assertLessEqual(abs(float(got) - float(wanted)), tolerance, (name, wanted))
            self.assertEqual(after[-1], SPINNING)

    def test_second_round_trip_gives_the_same_bytes_and_the_same_simulation(self):
        self.csv = make_record(self.folder / "long.csv", "unbalance", 3000, 12_000)
        self.import_as("a.lcmlog")
        self.compute("export", "a.lcmlog", "--csv", "a.csv")
        self.import_as("b.lcmlog", "a.csv")
        self.compute("export", "b.lcmlog", "--csv", "b.csv")
        self.assertEqual((self.folder / "a.csv").read_bytes(), (self.folder / "b.csv").read_bytes())
        first, second = (self.compute("simulate", name)[1] for name in ("a.lcmlog", "b.lcmlog"))
        self.assertEqual(first["channels"], second["channels"])
        self.assertEqual(first["departures"][0]["place"], "1x of rotation")

    def test_a_session_that_is_there_is_not_lost_without_being_asked(self):
        self.import_as("a.lcmlog")
        before = (self.folder / "a.lcmlog").read_bytes()
        shorter = make_record(self.folder / "shorter.csv", rows=300)
        again = ("import", shorter, "--rig", "flexible_rotor", "--out", "a.lcmlog")
        told = self.refuse(USAGE, "is there already", *again)
        self.assertIn("--overwrite", told)
        self.refuse(USAGE, "is there already", "run", "--record", "a.lcmlog")
        self.assertEqual((self.folder / "a.lcmlog").read_bytes(), before)
        self.compute(*again, "--overwrite")
        self.assertLess((self.folder / "a.lcmlog").stat().st_size, len(before))

    def test_an_export_takes_the_rows_and_columns_asked_for(self):
        self.import_as("a.lcmlog")
        self.compute("export", "a.lcmlog", "--csv", "all.csv")
        names, rows = table(self.folder / "all.csv")
        printed, report = self.compute("export", "a.lcmlog", "--csv", "part.csv", "--from", "0.01",
                                       "--to", "0.02", "--every", "10", "--columns",
                                       "position_nde_x_m,mode")
        wanted = [names.index(name) for name in ("time_s", "position_nde_x_m", "mode")]
        expected = [[row[i] for i in wanted] for row in rows if 0.01 <= float(row[0]) <= 0.02][::10]
        found_names, found = table(self.folder / "part.csv")
        self.assertEqual(found_names, ["time_s", "position_nde_x_m", "mode"])
        self.assertEqual(found, expected)
        self.assertEqual(report["rows"], len(expected))
        self.assertIn(f"{len(expected)} rows", printed)

    def test_a_selection_of_nothing_is_refused_and_leaves_no_file(self):
        self.import_as("a.lcmlog")
        for option, value, told in (("--columns", "position_de_z_m", "nearest: position_de_x_m"),
                                    ("--every", "0", "--every"), ("--from", "nan", "--from"),
                                    ("--every", "-3", "--every")):
            self.refuse(USAGE, told, "export", "a.lcmlog", "--csv", "no.csv", option, value)
            self.assertFalse((self.folder / "no.csv").exists(), option)

    def test_an_export_spares_what_has_the_name_of_its_temporary_file(self):
        self.import_as("a.lcmlog")
        (self.folder / "precious").write_text("keep")
        (self.folder / "x.csv.part").symlink_to("precious")
        self.compute("export", "a.lcmlog", "--csv", "x.csv")
        self.assertEqual((self.folder / "precious").read_text(), "keep")
        self.assertFalse((self.folder / "x.csv").is_symlink())

    def test_a_full_disk_is_status_1_for_every_export(self):
        self.import_as("a.lcmlog")
        for option in ("--csv", "--mcap"):
            self.refuse(OTHER, "No space left on device", "export", "a.lcmlog", option, "/dev/full")
        self.refuse(USAGE, "no regular file", "export", "a.lcmlog", "--mat", "/dev/full")

    def test_endless_lines_are_refused(self):
        self.refuse(BAD_INPUT, "line 1 is longer than", "import", "/dev/zero", "--rig",
                    "flexible_rotor", "--out", "z.lcmlog")

    def test_report_of_an_import_agrees_with_the_file(self):
        printed = self.compute("import", self.csv, "--rig", "flexible_rotor", "--out",
                               "a.lcmlog")[0]
        report = json.loads((self.folder / "out.json").read_text())
        self.assertEqual(report["samples"], ROWS)
        self.assertAlmostEqual(report["duration_s"], (ROWS - 1) * 1e-4, delta=1e-9)
        self.assertEqual((report["drop_outs"], report["missing_samples"]), (0, 0))
        self.assertTrue(report["has_rotation"] and report["has_excitation"])
        self.assertIn(f"{ROWS} samples over {report['duration_s']:.4f} s", printed)
        self.assertEqual(report["rig"], "flexible_rotor")

    def test_a_drop_out_is_counted_and_stays_a_gap(self):
        names, rows = table(self.csv)
        del rows[500:530]
        gap = self.write_rows("gap.csv", names, rows)
        report = self.import_as("gap.lcmlog", gap)
        self.assertEqual((report["drop_outs"], report["missing_samples"]), (1, 30))
        self.compute("export", "gap.lcmlog", "--csv", "back.csv")
        _, back = table(self.folder / "back.csv")
        self.assertEqual([float(row[0]) for row in back], [float(row[0]) for row in rows])

    def test_units_semicolons_and_decimal_commas_mean_the_same_numbers(self):
        names, rows = table(self.csv)
        scale = {"position": ("_um", 1e6), "control": ("_ma", 1e3), "excitation": ("_ma", 1e3)}
        new_names, factors = [], []
        for name in names:
            ending, factor = scale.get(name.split("_")[0], (None, 1.0))
            new_names.append(name if ending is None else name.rsplit("_", 1)[0] + ending)
            factors.append(factor)
        converted = [[cell if f == 1.0 else repr(float(cell) * f) for cell, f in zip(row, factors)]
                     for row in rows]
        other = self.write_rows("other.csv", new_names,
                                [[cell.replace(".", ",") for cell in row] for row in converted],
                                ";")
        self.import_as("other.lcmlog", other)
        self.compute("export", "other.lcmlog", "--csv", "back.csv")
        _, back = table(self.folder / "back.csv")
        for before, after in zip(rows, back):
            for wanted, got in zip(before, after):
                # Two conversions of a number with 53 bits.
                self.assertTrue(math.isclose(float(wanted), float(got), rel_tol=1e-11,
                                             abs_tol=1e-18), (wanted, got))

    def test_record_without_rotation_and_excitation_stands(self):
        names, rows = table(self.csv)
        keep = [i for i, name in enumerate(names)
                if name == "time_s" or name.startswith(("position", "control"))]
        bare = self.write_rows("bare.csv", [names[i] for i in keep],
                               [[row[i] for i in keep] for row in rows])
        report = self.import_as("bare.lcmlog", bare)
        self.assertFalse(report["has_rotation"] or report["has_excitation"])
        self.compute("export", "bare.lcmlog", "--csv", "back.csv")
        names, back = table(self.folder / "back.csv")
        speed = names.index("speed_rpm")
        self.assertEqual({float(row[speed]) for row in back}, {0.0})

    def test_angle_alone_gives_the_speed(self):
        names, rows = table(self.csv)
        drop = names.index("speed_rpm")
        angle = self.write_rows("angle.csv", [n for i, n in enumerate(names) if i != drop],
                                [[c for i, c in enumerate(row) if i != drop] for row in rows])
        self.assertTrue(self.import_as("angle.lcmlog", angle)["has_rotation"])
        self.compute("export", "angle.lcmlog", "--csv", "back.csv")
        _, back = table(self.folder / "back.csv")
        for row in back[20:]:  # the slope spans 20 rows
            # The drive holds 3000 rpm; its friction moves it by less than 1 rpm.
            self.assertAlmostEqual(float(row[drop]), 3000.0, delta=1.0)

    def test_foreign_columns_are_named_misspelt_ones_refused(self):
        names, rows = table(self.csv)
        extra = self.write_rows("extra.csv", [*names, "temperature_c"],
                                [[*row, "21.5"] for row in rows])
        self.assertEqual(self.import_as("extra.lcmlog", extra)["ignored_columns"],
                         ["temperature_c"])
        misspelt = self.write_rows("misspelt.csv", [*names[:-1], "exitation_nde_y_a"], rows)
        told = self.refuse(BAD_INPUT, "exitation_nde_y_a", "import", misspelt, "--rig",
                           "flexible_rotor", "--out", "x.lcmlog")
        self.assertIn("excitation_nde_y_a", told)

    def test_bad_cells_are_named_by_line_and_leave_no_session(self):
        names, rows = table(self.csv)
        column = {name: i for i, name in enumerate(names)}
        cases = (("control_current_de_y_a", "nan"), ("time_s", "nan"), ("time_s", "inf"),
                 ("position_de_x_m", "12 um"), ("speed_rpm", ""), ("position_nde_x_m", "1e999"))
        for name, cell in cases:
            broken = [list(row) for row in rows]
            broken[1500][column[name]] = cell
            data = self.write_rows("broken.csv", names, broken)
            told = self.refuse(BAD_INPUT, "line 1502", "import", data, "--rig", "flexible_rotor",
                               "--out", "x.lcmlog", "--json", "x.json")
            self.assertIn(name, told)

    def test_position_that_is_not_a_number_is_data(self):
        names, rows = table(self.csv)
        rows[100][names.index("position_nde_y_m")] = "nan"
        self.import_as("nan.lcmlog", self.write_rows("nan.csv", names, rows))
        self.compute("export", "nan.lcmlog", "--csv", "back.csv")
        _, back = table(self.folder / "back.csv")
        self.assertEqual(back[100][names.index("position_nde_y_m")], "nan")

    def test_time_off_the_rigs_grid_is_refused(self):
        names, rows = table(self.csv)
        for name, change in (("backwards", lambda t: -t), ("off", lambda t: 0.5 * t),
                             ("still", lambda t: 0.0)):
            moved = [[repr(change(float(row[0]))), *row[1:]] for row in rows]
            data = self.write_rows(f"{name}.csv", names, moved)
            self.refuse(BAD_INPUT, "line 3", "import", data, "--rig", "flexible_rotor", "--out",
                        "x.lcmlog")

    def test_columns_of_another_rig_are_refused(self):
        names, rows = table(self.csv)
        renamed = self.write_rows("other.csv", [name.replace("nde_", "low_") for name in names],
                                  rows)
        told = self.refuse(BAD_INPUT, "position_nde_x", "import", renamed, "--rig",
                           "flexible_rotor", "--out", "x.lcmlog")
        self.assertIn("line 1", told)

    def test_input_is_never_overwritten(self):
        before = self.csv.read_bytes()
        self.refuse(USAGE, "the same file", "import", self.csv, "--rig", "flexible_rotor", "--out",
                    self.csv)
        self.assertEqual(self.csv.read_bytes(), before)
        self.import_as("a.lcmlog")
        session = (self.folder / "a.lcmlog").read_bytes()
        for arguments in (("export", "a.lcmlog", "--csv", "a.lcmlog"),
                          ("replay", "a.lcmlog", "--controller", "flexible_rotor", "--csv",
                           "./a.lcmlog"),
                          ("simulate", "a.lcmlog", "--csv", self.folder / "a.lcmlog")):
            self.refuse(USAGE, "the same file", *arguments)
            self.assertEqual((self.folder / "a.lcmlog").read_bytes(), session)

    def test_an_earlier_output_survives_a_failing_import(self):
        self.import_as("a.lcmlog")
        before = (self.folder / "a.lcmlog").read_bytes()
        broken = self.write("broken.csv", self.csv.read_text() + "0.5,what\n")
        done = amb(self.folder, "import", broken, "--rig", "flexible_rotor", "--out", "a.lcmlog",
                   "--overwrite")
        self.assertEqual(done.returncode, BAD_INPUT)
        self.assertEqual((self.folder / "a.lcmlog").read_bytes(), before)
        # And a sound one replaces it.
        names, rows = table(self.csv)
        short = self.write_rows("short.csv", names, rows[:700])
        self.assertEqual(self.import_as("a.lcmlog", short)["samples"], 700)
        self.assertEqual(amb(self.folder, "export", "a.lcmlog", "--csv", "s.csv").returncode, DONE)
        self.assertEqual(len(table(self.folder / "s.csv")[1]), 700)

    def test_a_packed_export_is_refused_since_none_is_packed(self):
        self.import_as("s.lcmlog")
        before = self.files()
        done = amb(self.folder, "export", "s.lcmlog", "--csv", "s.csv.xz")
        self.assertEqual(done.returncode, USAGE)
        self.assertIn("leave out .xz", done.stderr)
        packed = amb(self.folder, "export", "s.lcmlog", "--mat", "s.mat.zst")
        self.assertEqual(packed.returncode, USAGE)
        self.assertIn("leave out .zst", packed.stderr)
        some = amb(self.folder, "export", "s.lcmlog", "--lcm", "s.lcm", "--every", "2")
        self.assertEqual(some.returncode, USAGE)
        self.assertIn("writes the log whole", some.stderr)
        self.assertEqual(self.files(), before)


if __name__ == "__main__":
    unittest.main()

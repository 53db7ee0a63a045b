"""docs/my_data.md, command by command, on the file it speaks of."""

import csv
import math
import unittest

from command import BAD_INPUT, BINARIES, DONE, SOURCE, USAGE, CommandTest, amb, make_record

import page  # of tests/support

PAGE = (SOURCE / "docs/my_data.md").read_text()
CHANNELS = {"XA": "de_x", "YA": "de_y", "XB": "nde_x", "YB": "nde_y"}


def heading():
    """Comment, names and units that the page shows, with the tabs of the file."""
    block = PAGE.split("```text\n")[1].split("```")[0].splitlines()
    return [block[0]] + ["\t".join(line.split()) for line in block[1:]]


def own_file(path, contract):
    """The record as the page's logger writes it: probe YA upside down, 0.25 mm off."""
    lines = heading()
    names = lines[1].split("\t")
    with contract.open() as source:
        for row in csv.DictReader(source):
            own = {"t": 1e3 * float(row["time_s"]),
                   "phi": math.degrees(float(row["rotor_angle_rad"])),
                   "n": float(row["speed_rpm"])}
            for name, channel in CHANNELS.items():
                own[name] = 1e3 * float(row[f"position_{channel}_m"])
                own[f"I{name}"] = 1e3 * float(row[f"control_current_{channel}_a"])
            own["YA"] = 0.25 - own["YA"]
            lines.append("\t".join(repr(own[name]) for name in names))
    path.write_text("\n".join(lines) + "\n")


class MyData(CommandTest):
    def test_page_says_what_its_commands_do(self):
        own_file(self.folder / "mine.txt",
                 make_record(self.folder / "record.csv", "healthy", 3000, 15_000))
        steps = page.steps(PAGE)
        self.assertGreaterEqual(len(steps), 4, "the page is no longer read as it is written")
        for commands, lines in steps:
            status, printed = page.run(commands, self.folder, BINARIES)
            self.assertEqual(status, 0, commands + printed)
            self.assertIsNone(page.missing(lines, printed), commands + printed)

    def test_guess_is_an_object_of_what_it_printed_and_writes_no_session(self):
        own_file(self.folder / "mine.txt", make_record(self.folder / "record.csv", rows=500))
        before = self.files()
        printed, guess = self.compute("import", "mine.txt", "--rig", "flexible_rotor", "--guess")
        self.assertEqual(self.files() - before, {str(self.folder / "out.json")})
        self.assertEqual(guess["missing"], [])
        for column in guess["columns"]:
            self.assertIn(f'"{column["column"]}", is: {column["is"]}, unit: {column["unit"]}',
                          printed)

    def test_suggestion_mends_the_map_that_is_there(self):
        record = make_record(self.folder / "record.csv", "healthy", 3000, 15_000)
        names, *rows = record.read_text().splitlines()
        # Of unlike names, probe nde_x in volts and upside down, the other columns as they are.
        self.write("own.csv", "\n".join([names.replace("position_nde_x_m", "S3"), *(
            ",".join(f"{-1.5 - 8e3 * float(cell)!r}" if name == "position_nde_x_m" else cell
                     for name, cell in zip(names.split(","), row.split(","))) for row in rows)]) + "\n")
        line = '  - {column: "S3", is: position_nde_x, unit: mm, sign: %s, scale: 0.125, offset: -1.5}'
        self.write("map.yaml", f"kind: import_map\ncolumns:\n{line % 1}\n")
        printed = self.suggested("map.yaml")
        self.assertIn("position_nde_x has the wrong sign", printed)
        self.assertIn(line % -1, printed)
        self.write("mended.yaml", printed)
        self.assertIn("No error of the record", self.suggested("mended.yaml"))

    def suggested(self, name):
        done = amb(self.folder, "import", "own.csv", "--rig", "flexible_rotor", "--map", name, "--suggest")
        self.assertEqual((done.returncode, done.stderr), (DONE, ""), done.stdout)
        return done.stdout

    def test_column_left_out_is_told_as_what_the_record_lacks(self):
        record = make_record(self.folder / "r.csv", rows=500)
        names, *rows = record.read_text().splitlines()
        for own, told in (("exc_a_x", "ignored; it may be excitation_de_x (amb import --guess"),
                          ("temperature", "ignored\n")):
            self.write("own.csv", "\n".join([names.replace("excitation_de_x_a", own)
                                             .replace("excitation_", "voltage_"), *rows]))
            printed, _ = self.compute("import", "own.csv", "--rig", "flexible_rotor", "--out",
                                      f"{own}.lcm")
            self.assertIn(f'column "{own}" {told}', printed)

    def test_what_cannot_be_asked_for_is_status_2(self):
        own_file(self.folder / "mine.txt", make_record(self.folder / "record.csv", rows=500))
        (self.folder / "bus.log").write_text("")
        for words, options in (
                ("--out is required", ("mine.txt",)),
                ("sessions and logs of candump have no columns", ("run.lcm", "--suggest")),
                ("sessions and logs of candump have no columns", ("run.lcm.zst", "--suggest")),
                ("--map excludes --guess", ("mine.txt", "--map", "m.yaml", "--guess")),
                ("a log of candump has no columns",
                 ("bus.log", "--map", "m.yaml", "--out", "x.lcm"))):
            self.refuse(USAGE, words, "import", *options, "--rig", "flexible_rotor")

    def test_file_of_another_kind_is_refused_with_the_step_that_helps(self):
        for name, start, words in (("a.xlsx", b"PK\x03\x04 [Content_Types].xml", "Save As, CSV"),
                                   ("a.csv", b"PAR1", "to_csv"), ("a.tdms", b"TDSm", "nptdms"),
                                   ("a.mcap", b"\x89MCAP0\r\n", "amb export")):
            (self.folder / name).write_bytes(start + bytes(100))
            for options in (("--guess",), ("--out", "x.lcm")):
                told = self.refuse(BAD_INPUT, words, "import", name, "--rig", "flexible_rotor",
                                   *options)
                self.assertIn(name, told)

    def test_a_line_that_is_not_printed_is_noticed(self):
        self.assertIsNone(page.missing(["a 1 ...", "...", "c"], "a 1 x\nb\nc\n"))
        self.assertEqual(page.missing(["a", "d"], "a\nb\nc\n"), "d")
        self.assertEqual(page.missing(["c", "a"], "a\nb\nc\n"), "a")


if __name__ == "__main__":
    unittest.main()

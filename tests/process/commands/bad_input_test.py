"""What a user may get wrong: one clear message, the status of the contract, nothing left behind."""

import os
import unittest
from pathlib import Path

from command import (BAD_INPUT, OTHER, SHIPPED_CONTROLLER, SHIPPED_RIG, USAGE, CommandTest, amb, edited,
                     make_record)

ANALYSES = ("modes", "poles", "margins")
WITH_CONTROLLER = ("poles", "margins")
ABSENT = "/no/such/folder/file"


class BadInput(CommandTest):
    def test_rig_that_cannot_be_used(self):
        self.write("broken.yaml", "rotor: [1, 2\n")
        self.write("empty.yaml", "")
        self.write("typo.yaml", edited(SHIPPED_RIG, ("young_gpa: 193", "young_gppa: 193")))
        self.write("nan.yaml", edited(SHIPPED_RIG, ("young_gpa: 193", "young_gpa: .nan")))
        self.write("negative.yaml", edited(SHIPPED_RIG, ("gap_mm: 0.381", "gap_mm: -0.381")))
        self.write("unit.yaml", edited(SHIPPED_RIG, ("period_us: 100", "period_hz: 100")))
        (self.folder / "folder.yaml").mkdir()
        for command in ANALYSES:
            for rig, words in (("absent.yaml", "no such file"), ("flexible_rotr", "flexible_rotor"),
                               ("folder.yaml", "it is a folder"), ("broken.yaml", "broken.yaml:2"),
                               ("empty.yaml", "empty.yaml"), ("typo.yaml", "young_gpa"),
                               ("nan.yaml", "young_gpa"), ("negative.yaml", "gap_mm"),
                               ("unit.yaml", "period_us")):
                self.refuse(BAD_INPUT, words, command, "--rig", rig, "--json", "x.json")

    def test_controller_that_cannot_be_used(self):
        self.write("broken.yaml", "laws: {de: [\n")
        self.write("nan.yaml", edited(SHIPPED_CONTROLLER, ("kp_a_per_m: 4514.47",
                                                           "kp_a_per_m: .nan")))
        self.write("axis.yaml", edited(SHIPPED_CONTROLLER, ("\n  nde:", "\n  upper:")))
        for command in WITH_CONTROLLER:
            for controller, words in (("absent", "no such file"), (str(self.folder), "it is a folder"),
                                      ("broken.yaml", "broken.yaml:2"), ("nan.yaml", "kp_a_per_m"),
                                      ("axis.yaml", "upper"), (str(SHIPPED_RIG), "kind")):
                self.refuse(BAD_INPUT, words, command, "--controller", controller, "--json",
                            "x.json")

    def test_speeds_that_no_rotor_has(self):
        for command in ANALYSES:
            for speed in ("nan", "inf", "-inf", "fast", "0,nan", "1e999", "3000rpm"):
                self.refuse(USAGE, "--speed-rpm", command, f"--speed-rpm={speed}", "--json",
                            "x.json")

    def test_options_that_do_not_exist_and_values_out_of_range(self):
        for words, arguments in (
                ("subcommand is required", ()),
                ("--colour", ("modes", "--colour")),
                ("--modes", ("modes", "--modes", "0")),
                ("--modes", ("modes", "--modes", "21")),
                ("--modes", ("modes", "--modes", "two")),
                ("--up-to-hz", ("poles", "--up-to-hz", "-5")),
                ("--force-noise-percent", ("simulate", "s", "--force-noise-percent", "0")),
                ("--departures", ("simulate", "s", "--departures", "-1")),
                ("session", ("simulate",)),
                ("--out", ("import", "data.csv", "--rig", "flexible_rotor")),
                ("--rig", ("import", "data.csv", "--out", "s.lcmlog")),
                ("DATA", ("import", "--rig", "flexible_rotor", "--out", "s.lcmlog")),
                ("--csv", ("export", "s.lcmlog")),
                ("--speed", ("replay", "s.lcmlog", "--publish", "--speed", "0")),
                ("--publish", ("replay", "s.lcmlog", "--speed", "2")),
                ("excludes", ("replay", "s.lcmlog", "--publish", "--controller", "c")),
                ("--json", ("modes", "--json")),
                ("surplus", ("modes", "surplus")),
        ):
            with self.subTest(arguments=arguments):
                done = amb(self.folder, *arguments)
                self.assertEqual(done.returncode, USAGE, done.stderr)
                self.assertIn(words.lower(), done.stderr.lower())
                self.assertLessEqual(len(done.stderr.strip().splitlines()), 2, done.stderr)
                self.assertEqual(self.files(), set())

    def test_session_that_is_none(self):
        self.write("empty.lcmlog", "")
        self.write("text.lcmlog", "time_s,position_de_x_m\n0,0\n" * 100)
        (self.folder / "folder.lcmlog").mkdir()
        for command, output in (("simulate", ()), ("export", ("--csv", "x.csv")), ("replay", ()),
                                ("replay", ("--controller", "flexible_rotor", "--csv", "x.csv"))):
            for session, words in (("absent.lcmlog", "No such file"),
                                   ("empty.lcmlog", "empty, not a session"),
                                   ("text.lcmlog", "not a session"),
                                   ("folder.lcmlog", "not a file")):
                told = self.refuse(BAD_INPUT, words, command, session, *output, "--json", "x.json")
                self.assertIn(session, told)

    def test_data_that_is_none(self):
        self.write("empty.csv", "")
        self.write("names.csv", "time_s,position_de_x_m\n")
        self.write("noise.csv.xz", "this was never compressed")
        (self.folder / "folder.csv").mkdir()
        for data, words in (("absent.csv", "No such file"), ("empty.csv", "the file is empty"),
                            ("names.csv", "columns missing"), ("folder.csv", "it is a folder"),
                            ("noise.csv.xz", "noise.csv.xz")):
            self.refuse(BAD_INPUT, words, "import", data, "--rig", "flexible_rotor", "--out",
                        "x.lcmlog", "--json", "x.json")

    def test_names_without_rows_are_no_record(self):
        record = make_record(self.folder / "r.csv", rows=1)
        self.write("rows.csv", record.read_text().splitlines()[0] + "\n")
        self.refuse(BAD_INPUT, "no rows", "import", "rows.csv", "--rig", "flexible_rotor", "--out",
                    "x.lcmlog")

    def test_outputs_that_cannot_be_written(self):
        record = make_record(self.folder / "r.csv", rows=9_000)
        done = amb(self.folder, "import", record, "--rig", "flexible_rotor", "--out", "s.lcmlog")
        self.assertEqual(done.returncode, 0, done.stderr)
        (self.folder / "folder").mkdir()
        import_it = ("import", "r.csv", "--rig", "flexible_rotor", "--out")
        commands = [(*import_it, ABSENT), (*import_it, "folder"),
                    ("export", "s.lcmlog", "--csv", ABSENT), ("export", "s.lcmlog", "--csv", "folder"),
                    ("replay", "s.lcmlog", "--controller", "flexible_rotor", "--csv", ABSENT),
                    ("replay", "s.lcmlog", "--controller", "flexible_rotor", "--csv", "folder"),
                    ("replay", "s.lcmlog", "--controller", "flexible_rotor", "--json", ABSENT),
                    *(("simulate", "s.lcmlog", option, bad)
                      for option in ("--json", "--csv", "--svg") for bad in (ABSENT, "folder")),
                    *((command, option, bad) for command in ANALYSES
                      for option in ("--json", "--svg") for bad in (ABSENT, "folder"))]
        for command in commands:
            with self.subTest(command=command):
                self.refuse(BAD_INPUT, "cannot be", *command)
        for command in ANALYSES:
            for option in ("--json", "--svg"):
                with self.subTest(command=command, option=option):
                    self.refuse(OTHER, "No space left on device", command, option, "/dev/full")

    @unittest.skipIf(os.geteuid() == 0, "the superuser may write anywhere")
    def test_folder_of_somebody_else(self):
        locked = self.folder / "locked"
        locked.mkdir(mode=0o500)
        self.refuse(BAD_INPUT, "cannot be", "modes", "--json", locked / "x.json")

    def test_complaints_do_not_go_where_results_go(self):
        done = amb(self.folder, "modes", "--rig", "absent.yaml")
        self.assertEqual(done.stdout, "")
        self.assertTrue(done.stderr.startswith("amb: absent.yaml: "), done.stderr)

    def test_folder_of_the_shipped_files_can_be_another(self):
        """LEVITAS_CONFIG: what is not in it is not found, and the message says where it looked."""
        environment = dict(os.environ, LEVITAS_CONFIG=str(self.folder))
        done = amb(self.folder, "modes", environment=environment)
        self.assertEqual(done.returncode, BAD_INPUT)
        self.assertIn(str(self.folder / "rigs"), done.stderr)
        (self.folder / "rigs").mkdir()
        Path(self.folder / "rigs/flexible_rotor.yaml").write_text(SHIPPED_RIG.read_text())
        done = amb(self.folder, "modes", environment=environment)
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()

"""amb sessions: what was recorded is found again, by rig, date, tag and outcome."""

import json
import os
import unittest

from command import BAD_INPUT, DONE, USAGE, CommandTest, amb, make_record


class Sessions(CommandTest):
    def setUp(self):
        super().setUp()
        self.environment = dict(os.environ, LEVITAS_CATALOGUE=str(self.folder / "own/sessions.db"))
        make_record(self.folder / "r.csv", "unbalance", 3000, 2_000)

    def call(self, *arguments, status=DONE):
        done = amb(self.folder, *arguments, environment=self.environment)
        self.assertEqual(done.returncode, status, done.stderr)
        return done

    def record(self, name, *more):
        return self.call("import", "r.csv", "--rig", "flexible_rotor", "--out", name, "--overwrite",
                         *more)

    def json(self, name):
        return json.loads((self.folder / name).read_text())

    def found(self, *filters):
        self.call("sessions", *filters, "--json", "found.json")
        return [os.path.basename(entry["session"]) for entry in self.json("found.json")["sessions"]]

    def test_an_import_enters_itself_with_what_it_holds(self):
        self.record("a.lcmlog", "--tag", "first")
        self.call("sessions", "--json", "found.json")
        (entry,) = self.json("found.json")["sessions"]
        self.assertEqual(entry["session"], str(self.folder / "a.lcmlog"))
        self.assertEqual(entry["size_byte"], (self.folder / "a.lcmlog").stat().st_size)
        self.assertEqual((entry["rig"], entry["pace"], entry["outcome"], entry["tags"]),
                         ("flexible_rotor", "imported", "not_judged", ["first"]))
        self.assertEqual(entry["cycles"], 2_000)
        self.assertAlmostEqual(entry["top_speed_rpm"], 3000, delta=1)

    def test_a_run_enters_itself_with_its_verdict(self):
        self.call("run", "--duration", "1", "--record", "run.lcm", "--tag", "short")
        self.call("sessions", "--tag", "short", "--json", "found.json")
        (entry,) = self.json("found.json")["sessions"]
        self.assertEqual((entry["rig"], entry["scenario"]), ("flexible_rotor", "default"))
        self.assertEqual(entry["outcome"], "not_accepted")  # too short to settle
        # Entered by hand, from the file alone, it is the same run.
        self.call("sessions", "forget", "run.lcm")
        self.call("sessions", "add", "run.lcm")
        self.call("sessions", "--json", "found.json")
        (again,) = self.json("found.json")["sessions"]
        for key in ("start_utc", "duration_s", "cycles", "rig", "controller", "pace", "size_byte"):
            self.assertEqual(again[key], entry[key], key)

    def test_finds_by_tag_and_outcome_and_day(self):
        self.record("a.lcmlog", "--tag", "x")
        self.record("b.lcmlog")
        self.assertEqual(sorted(self.found()), ["a.lcmlog", "b.lcmlog"])
        self.assertEqual(self.found("--tag", "x"), ["a.lcmlog"])
        self.assertEqual(self.found("--outcome", "tripped"), [])
        self.assertEqual(self.found("--rig", "ufu_rig"), [])
        self.assertEqual(self.found("--to", "2001-01-01"), [])
        self.assertEqual(len(self.found("--from", "2001-01-01")), 2)
        self.call("sessions", "tag", "b.lcmlog", "x", "y")
        self.assertEqual(self.found("--tag", "x", "--tag", "y"), ["b.lcmlog"])
        self.call("sessions", "tag", "b.lcmlog", "y", "--remove")
        self.assertEqual(self.found("--tag", "y"), [])

    def test_a_search_that_finds_nothing_says_what_there_is(self):
        self.assertIn("nothing is recorded yet", self.call("sessions").stdout)
        self.record("a.lcmlog")
        self.assertIn("0 sessions of the 1 recorded ones match; their rigs: flexible_rotor",
                      self.call("sessions", "--rig", "nosuch").stdout)

    def test_says_which_files_are_gone_and_forgets_them(self):
        self.record("a.lcmlog")
        self.record("b.lcmlog")
        (self.folder / "a.lcmlog").unlink()
        self.assertIn("(gone)", self.call("sessions").stdout)
        self.assertIn("a.lcmlog", self.call("sessions", "forget", "--gone").stdout)
        self.assertEqual(self.found(), ["b.lcmlog"])

    def test_enters_a_folder_and_tells_what_it_could_not_read(self):
        self.record("a.lcmlog")
        self.call("sessions", "forget", "a.lcmlog")
        whole = (self.folder / "a.lcmlog").read_bytes()
        self.write("0.lcm", "no session")
        (self.folder / "1.lcm").write_bytes(whole[:200])  # a header that was cut off
        self.write("z.lcm", "no session")
        done = self.call("sessions", "add", ".", status=BAD_INPUT)
        for bad in ("0.lcm", "1.lcm", "z.lcm"):
            self.assertIn(bad, done.stderr)
        self.assertEqual(self.found(), ["a.lcmlog"])

    def test_compresses_sessions_and_keeps_entries_and_tags(self):
        self.record("a.lcmlog", "--tag", "x")
        self.record("b.lcm")
        plain = {name: (self.folder / name).read_bytes() for name in ("a.lcmlog", "b.lcm")}
        self.write("z.lcm", "no session")
        done = self.call("sessions", "compress", ".", "--json", "done.json", status=BAD_INPUT)
        self.assertIn("z.lcm", done.stderr)
        self.assertTrue((self.folder / "z.lcm").exists())
        told = {os.path.basename(one["session"]): one for one in self.json("done.json")["sessions"]}
        self.assertEqual(set(told), {"a.lcmlog.zst", "b.lcm.zst"})
        for name, content in plain.items():
            self.assertFalse((self.folder / name).exists())
            packed = self.folder / f"{name}.zst"
            self.assertEqual((told[packed.name]["before_byte"], told[packed.name]["after_byte"]),
                             (len(content), packed.stat().st_size))
            self.assertLess(packed.stat().st_size, len(content) / 2)
            self.call("export", packed, "--lcm", f"again_{name}")
            self.assertTrue((self.folder / f"again_{name}").read_bytes() == content)
        self.assertEqual(sorted(self.found()), ["a.lcmlog.zst", "b.lcm.zst"])
        self.assertEqual(self.found("--tag", "x"), ["a.lcmlog.zst"])

    def test_compress_replaces_nothing_and_passes_over_what_is_packed(self):
        self.record("a.lcm")
        before = (self.folder / "a.lcm").read_bytes()
        self.call("sessions", "compress", "a.lcm", "--keep")
        self.assertEqual(sorted(self.found()), ["a.lcm", "a.lcm.zst"])
        done = self.call("sessions", "compress", "a.lcm", status=BAD_INPUT)
        self.assertIn("is there already and is not replaced", done.stderr)
        self.assertEqual((self.folder / "a.lcm").read_bytes(), before)
        self.assertIn("is packed already", self.call("sessions", "compress", "a.lcm.zst").stdout)

    def test_a_catalogue_that_cannot_be_written_costs_no_record(self):
        self.environment["LEVITAS_CATALOGUE"] = "/proc/nowhere/sessions.db"
        done = self.record("a.lcmlog")
        self.assertIn("/proc/nowhere/sessions.db", done.stderr)
        self.assertTrue((self.folder / "a.lcmlog").exists())

    def test_refuses_with_a_remedy(self):
        self.record("a.lcmlog")
        for status, part, arguments in (
                (USAGE, "2026-13-01", ("--from", "2026-13-01")),
                (USAGE, "31", ("--to", "2026-11-31")),
                (USAGE, "outcome", ("--outcome", "good")),
                (USAGE, "--gone", ("forget",)),
                (BAD_INPUT, "amb sessions add", ("tag", "unknown.lcm", "x")),
                (BAD_INPUT, "not in the catalogue", ("forget", "unknown.lcm")),
                (BAD_INPUT, "no tag 'z'", ("tag", "a.lcmlog", "z", "--remove"))):
            with self.subTest(arguments):
                self.assertIn(part, self.call("sessions", *arguments, status=status).stderr)

    def test_without_a_catalogue_says_how_to_name_one(self):
        self.environment["LEVITAS_CATALOGUE"] = ""
        self.record("a.lcmlog")
        self.assertIn("--catalogue", self.call("sessions", status=USAGE).stderr)
        self.call("sessions", "add", "a.lcmlog", "--catalogue", "own.db")


if __name__ == "__main__":
    unittest.main()

"""What a command writes: never over what it reads or over its other output, never through a link,
never lost without a word, and no text of others steers the terminal.
"""

import os
import re
import shutil
import subprocess
import unittest

from command import (BAD_INPUT, BINARIES, DONE, LIMIT_S, OTHER, SHIPPED_CONTROLLER, SHIPPED_RIG,
                     SOURCE, USAGE, CommandTest, amb, make_record)

WRITES = {"--record", "--json", "--csv", "--mat", "--mcap", "--out", "--svg", "--plan", "--picture",
          "--write", "--document", "--html", "--worst-rig", "--write-design", "--page",
          "--write-rig", "--lcm"}
FOLDERS = {"--pictures"}
STOP = """kind: scenario
name: stop
steps:
  - {do: lift, until: levitating, timeout_s: 5, hold_s: 0.2}
  - {do: emergency_stop, until: tripped, timeout_s: 6, hold_s: 1}
"""


class Outputs(CommandTest):
    def setUp(self):
        super().setUp()
        self.environment = dict(os.environ, LEVITAS_CATALOGUE=str(self.folder / "own.db"))
        make_record(self.folder / "r.csv", rows=600)

    def call(self, *arguments, status=DONE):
        done = amb(self.folder, *arguments, environment=self.environment)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def session(self, name="s.lcm"):
        self.call("import", "r.csv", "--rig", "flexible_rotor", "--out", name)
        return name

    def run_session(self, name):
        self.call("run", "--duration", "0.05", "--no-dash", "--record", "made.lcm")
        (self.folder / "made.lcm").rename(self.folder / name)
        return name

    def pages(self):
        """{command: (needed arguments, options with a value and what the manual says of them)}"""
        text = amb(self.folder, "manual", "--markdown").stdout
        found = {}
        for command, page in re.findall(r"\n## amb ([a-z -]+)\n(.*?)(?=\n## |\Z)", text, re.S):
            rows = re.findall(r"^\| `([^`]+)` \| (.*) \|$", page, re.M)
            needed = [name for name, says in rows if says.endswith("(needed)")]
            found[command] = (needed, {name.split()[0].split(",")[0]: says for name, says in rows
                                       if name.startswith("--") and " " in name})
        self.assertGreater(len(found), 20, "the manual is no longer read as it is written")
        return found

    def test_every_option_that_writes_a_file_is_known_as_one(self):
        for command, (_, options) in self.pages().items():
            for name, says in options.items():
                if re.search(r"^(Also )?(Write|Draw|Keep)\b|(file|File|Session) to write", says):
                    self.assertIn(name, WRITES | FOLDERS, (command, says))

    def test_two_outputs_under_one_name_are_refused_by_every_command(self):
        tried = 0
        for command, (needed, options) in self.pages().items():
            outputs = sorted(WRITES & set(options))
            for one, other in zip(outputs, outputs[1:]):
                rest = ["--controller", "absent"] if command == "replay" else []  # --csv needs it
                for name in needed:
                    option = name.split()[0]
                    if option not in (one, other):
                        rest += [option, "absent"] if name.startswith("--") else ["absent"]
                with self.subTest(command=command, one=one, other=other):
                    told = self.refuse(USAGE, "the same file", *command.split(), *rest, one, "both",
                                       other, "./both")
                    self.assertIn(one, told)
                    self.assertIn(other, told)
                    tried += 1
        self.assertGreater(tried, 8)

    def test_every_command_looks_at_its_targets_before_it_computes(self):
        tried = 0
        for command, (needed, options) in self.pages().items():
            for option in sorted(WRITES & set(options)):
                if options[option].startswith("Folder "):
                    continue
                rest = ["--controller", "absent"] if command == "replay" else []
                for name in needed:
                    other = name.split()[0]
                    if other != option:  # nothing that is read is there: reading is not reached
                        given = "." if other == "PATH" else f"absent{len(rest)}"
                        rest += [other, given] if name.startswith("--") else [given]
                with self.subTest(command=command, option=option):
                    self.refuse(BAD_INPUT, "missing/file: cannot be written: folder missing: No such",
                                *command.split(), *rest, option, "missing/file")
                    tried += 1
        self.assertGreater(tried, 40)

    def test_what_is_read_is_not_written_over_by_whatever_name(self):
        self.session()
        self.write("r.yaml", SHIPPED_RIG.read_text())
        self.write("c.yaml", SHIPPED_CONTROLLER.read_text())
        (self.folder / "link").symlink_to("r.yaml")
        os.link(self.folder / "r.yaml", self.folder / "inode")
        for command in (("margins", "--rig", "r.yaml", "--json", "r.yaml"),
                        ("margins", "--rig", "link", "--json", "r.yaml"),
                        ("modes", "--rig", "r.yaml", "--json", "inode"),
                        ("modes", "--rig", "r.yaml", "--svg", "r.yaml"),
                        ("poles", "--svg", "both", "--json", "both"),
                        ("margins", "--controller", "c.yaml", "--svg", "c.yaml"),
                        ("bench", "lives", "--rig", "r.yaml", "--json", "r.yaml"),
                        ("design", "check", "--rig", "r.yaml", "--worst-rig", "r.yaml"),
                        ("poles", "--controller", "c.yaml", "--json", self.folder / "c.yaml"),
                        ("run", "--rig", "r.yaml", "--record", "r.yaml", "--overwrite"),
                        ("run", "--controller", "c.yaml", "--json", "c.yaml"),
                        ("replay", "s.lcm", "--json", "s.lcm"),
                        ("export", "s.lcm", "--mat", "s.lcm"),
                        ("simulate", "s.lcm", "--svg", "s.lcm"),
                        ("sessions", "add", "s.lcm", "--json", "s.lcm"),
                        ("sessions", "add", "r.csv", "--catalogue", "s.lcm", "--json", "s.lcm")):
            before = {path: path.read_bytes() for path in self.folder.iterdir() if path.is_file()}
            with self.subTest(command=command):
                self.refuse(USAGE, "would be lost", *command)
                self.assertEqual({path: path.read_bytes() for path in before}, before)

    def test_the_controller_that_the_rig_file_names_is_not_written_over_either(self):
        shutil.copytree(SOURCE / "config", self.folder / "config")
        self.environment["LEVITAS_CONFIG"] = str(self.folder / "config")
        named = {"controller": self.folder / "config/controllers/geared_rotor.yaml",
                 "scenario": self.folder / "config/scenarios/geared_rotor.yaml"}
        before = {kind: path.read_bytes() for kind, path in named.items()}
        for command, kind in (("margins", "controller"), ("poles", "controller"),
                              ("run", "controller"), ("run", "scenario")):
            with self.subTest(command=command, kind=kind):
                for option in ("--json",) if command == "run" else ("--json", "--svg"):
                    done = self.call(command, "--rig", "geared_rotor_4dof", option, named[kind],
                                     status=USAGE)
                    self.assertIn(f"the same file as the {kind} file", done.stderr)
        self.assertEqual({kind: path.read_bytes() for kind, path in named.items()}, before)

    def test_a_controller_by_itself_writes_over_nothing_it_reads(self):
        self.write("c.yaml", SHIPPED_CONTROLLER.read_text())
        before = (self.folder / "c.yaml").read_bytes()
        for given in (("--record", "x", "--json", "./x"), ("--json", "c.yaml"),
                      ("--record", "c.yaml", "--overwrite")):
            done = subprocess.run([BINARIES / "amb-controller", "--rig", "flexible_rotor",
                                   "--controller", "c.yaml", *given], cwd=self.folder, text=True,
                                  capture_output=True, timeout=LIMIT_S, check=False)
            self.assertEqual(done.returncode, USAGE, done.stderr)
            self.assertIn("would be lost", done.stderr)
        self.assertEqual((self.folder / "c.yaml").read_bytes(), before)
        self.assertFalse((self.folder / "x").exists())

    def test_an_earlier_answer_of_another_input_stays_beside_the_new_one(self):
        picture = self.folder / "p.svg"
        first = self.call("modes", "--rig", "flexible_rotor", "--svg", "p.svg")
        before = picture.read_bytes()
        again = self.call("modes", "--rig", "flexible_rotor", "--svg", "p.svg")
        self.assertNotIn("kept", first.stderr + again.stderr)
        other = self.call("modes", "--rig", "geared_rotor_4dof", "--svg", "p.svg", "--json", "m.json")
        self.assertIn("earlier files of other content are kept: p.svg.old\n", other.stderr)
        self.assertNotEqual(picture.read_bytes(), before)
        self.assertEqual((self.folder / "p.svg.old").read_bytes(), before)
        self.call("modes", "--rig", "flexible_rotor", "--json", "m.json")
        self.assertFalse((self.folder / "m.json.old").exists(), "programs write it again and again")

    def test_what_is_read_is_not_lost_to_what_is_kept_either(self):
        self.write("r.yaml.old", SHIPPED_RIG.read_text())
        self.write("r.yaml", "an earlier one")
        self.refuse(USAGE, "would be lost", "modes", "--rig", "r.yaml.old", "--svg", "r.yaml")

    def test_one_device_may_take_every_output(self):
        self.session()
        self.call("export", "s.lcm", "--csv", "/dev/null", "--mcap", "/dev/null", "--json", "/dev/null")

    def test_a_record_goes_through_no_link(self):
        (self.folder / "dangling").symlink_to("victim")
        (self.folder / "empty").write_text("")
        (self.folder / "to_empty").symlink_to("empty")
        for link in ("dangling", "to_empty"):
            self.refuse(USAGE, "is a symbolic link", "run", "--record", link)
            self.refuse(USAGE, "is a symbolic link", "import", "r.csv", "--rig", "flexible_rotor",
                        "--out", link)
            self.call("run", "--duration", "0.05", "--no-dash", "--record", link, "--overwrite")
            self.assertFalse((self.folder / link).is_symlink())
            self.assertGreater((self.folder / link).stat().st_size, 1000)
        self.assertFalse((self.folder / "victim").exists())
        self.assertEqual((self.folder / "empty").read_text(), "")

    def test_a_run_is_recorded_where_it_can_be_read(self):
        os.mkfifo(self.folder / "pipe")
        for path in ("pipe", "/dev/null"):
            self.refuse(USAGE, "judged by its record. Name a file", "run", "--record", path)

    def test_a_controller_by_itself_records_through_no_link(self):
        (self.folder / "dangling").symlink_to("victim")
        done = subprocess.run([BINARIES / "amb-controller", "--rig", "flexible_rotor", "--controller",
                               "flexible_rotor", "--record", "dangling"], cwd=self.folder, text=True,
                              capture_output=True, timeout=LIMIT_S, check=False)
        self.assertEqual(done.returncode, USAGE, done.stderr)
        self.assertIn("is a symbolic link", done.stderr)
        self.assertFalse((self.folder / "victim").exists())

    def test_a_full_disk_behind_standard_output_is_status_1(self):
        self.run_session("s.lcm")
        for command in (("modes",), ("poles",), ("margins",), ("sessions",), ("replay", "s.lcm"),
                        ("export", "s.lcm", "--csv", "x.csv"), ("--help",), ("effects",),
                        ("run", "--duration", "0.05", "--no-dash")):
            with self.subTest(command=command), open("/dev/full", "wb") as full:
                done = subprocess.run([BINARIES / "amb", *command], cwd=self.folder, stdout=full,
                                      stderr=subprocess.PIPE, text=True, timeout=LIMIT_S, check=False,
                                      env=self.environment)
                self.assertEqual(done.returncode, OTHER, done.stderr)
                self.assertIn("standard output: writing failed: No space left on device", done.stderr)

    def test_a_reader_that_has_read_enough_is_no_failure(self):
        done = subprocess.run(f"set -o pipefail; {BINARIES}/amb manual --markdown | head -n 1",
                              shell=True, executable="/bin/bash", cwd=self.folder, text=True,
                              capture_output=True, timeout=LIMIT_S, check=False)
        self.assertNotIn("writing failed", done.stderr)

    def test_a_full_disk_behind_the_catalogue_is_status_1(self):
        self.session()
        done = subprocess.run(
            ["unshare", "-rm", "bash", "-c", "mkdir t && mount -t tmpfs -o size=16k none t && "
             "head -c 8k /dev/zero > t/fill && exec $0 sessions add --catalogue t/c.db s.lcm",
             BINARIES / "amb"], cwd=self.folder, text=True, capture_output=True, timeout=LIMIT_S, check=False)
        if "unshare" in done.stderr or "mount" in done.stderr:
            self.skipTest("no mount namespace of our own here: " + done.stderr)
        self.assertEqual(done.returncode, OTHER, done.stderr)
        self.assertIn("the catalogue of sessions: writing failed: ", done.stderr)
        self.assertNotIn(b"\x1b", done.stdout.encode())

    def test_names_and_tags_of_others_do_not_steer_the_terminal(self):
        name = self.run_session("esc\x1b[31m\nforged row.lcm")
        shown = ""
        for command in (("sessions", "add", name), ("sessions", "tag", name, "t\x1b[5m\nforged tag"),
                        ("sessions",), ("replay", name), ("export", name, "--csv", "a\x1b[1m.csv"),
                        ("report", name, "--out", "page\x1b[1m.html"),
                        ("sessions", "forget", name), ("sessions", "add", "--tag", "x\x1b", name)):
            shown = self.call(*command).stdout
            self.assertNotIn("\x1b", shown, command)
            for line in shown.splitlines():
                self.assertFalse(line.startswith("forged"), (command, shown))
        self.assertIn("esc\\x1b[31m\\x0aforged row.lcm", shown)

    def test_trip_files_of_earlier_runs_stay_and_are_told(self):
        self.write("stop.yaml", STOP)
        self.session("old.lcm")
        earlier = [f"trip-20200101T0000{second}.000Z-over_speed.lcmlog" for second in range(10, 41)]
        for name in earlier:
            os.link(self.folder / "old.lcm", self.folder / name)
        done = self.call("run", "--scenario", "stop.yaml", "--record", "s.lcm", "--no-dash", status=4)
        for name in earlier:
            self.assertTrue((self.folder / name).exists(), name)
        self.assertIn("trip folder: 31 trip files of earlier runs", done.stderr)
        self.assertEqual(len(list(self.folder.glob("trip-*.lcmlog"))), 32)


if __name__ == "__main__":
    unittest.main()

"""The help of every command names each of its options, and each option it names is accepted."""

import os
import re
import shutil
import subprocess
import unittest

from command import BINARIES, DONE, SOURCE, USAGE, CommandTest, amb

OPTIONS = {
    "modes": {"--rig", "--speed-rpm", "--speeds", "--campbell", "--modes", "--svg", "--json"},
    "poles": {"--rig", "--controller", "--port", "--speed-rpm", "--speeds", "--up-to-hz", "--svg",
              "--json"},
    "margins": {"--rig", "--controller", "--port", "--speed-rpm", "--speeds", "--svg", "--json",
                "--require"},
    "compare": {"--rig", "--speed-rpm", "--speeds", "--orders", "--page", "--circle-um", "--json"},
    "trend": {"--rig", "--speed-rpm", "--baseline", "--svg", "--json"},
    "simulate": {"--rig", "--from", "--force-noise-percent", "--departures", "--free-run",
                 "--controller", "--csv", "--svg", "--json"},
    "import": {"--rig", "--out", "--map", "--guess", "--suggest", "--overwrite", "--tag", "--json"},
    "sessions": {"--rig", "--outcome", "--tag", "--text", "--from", "--to", "--catalogue", "--json"},
    "manual": {"--markdown", "--man", "--bash", "--of"},
    "export": {"--csv", "--mat", "--mcap", "--lcm", "--from", "--to", "--every", "--columns", "--json"},
    "replay": {"--controller", "--csv", "--publish", "--speed", "--port", "--key", "--json"},
    "report": {"--out", "--pictures", "--speeds", "--run-json", "--json"},
    "dash": {"--port", "--key", "--http-port", "--listen", "--allow-network", "--token", "--token-file", "--answer-within",
             "--json"},
    "run": {"--rig", "--controller", "--scenario", "--duration", "--pace", "--pace-factor", "--port", "--record",
            "--overwrite", "--tag", "--seed", "--bias-current-a", "--effect", "--write-rig", "--json", "--dash",
            "--no-dash"},
    "identify": set(),  # its subcommands follow
    "identify frf": {"--rig", "--controller", "--drop", "--highest-hz", "--orbit-um", "--csv", "--svg",
                     "--speed-rpm", "--json"},
    "identify modal": {"--rig", "--highest-hz", "--fit-amplifiers", "--fit-sensors", "--out", "--rotor",
                       "--svg", "--decibel-cost", "--starts", "--spread", "--spread-gains", "--json"},
    "identify live": {"--port", "--key", "--order", "--noise-order", "--degree", "--bandwidth-hz", "--products",
                      "--input-lag-hz", "--input-delay", "--sensor-a2", "--sensor-a3", "--sensor-table", "--forgetting",
                      "--tolerance", "--until-converged", "--patience", "--record", "--json"},
    "identify characteristic": {"--straight-error-um", "--places", "--rig", "--channel", "--out", "--json"},
    "balance": {"--rig", "--controller", "--plane", "--planes", "--drill", "--after", "--applied", "--top-rpm",
                "--svg", "--write-run-outs", "--json"},
    "diagnose": {"--rig", "--holdout", "--healthy", "--plan", "--scenario", "--controller", "--size", "--out", "--quick", "--as-is",
                 "--explain", "--json"},
    "doctor": {"--json"},
}
POSITIONAL = {"simulate": "session", "diagnose": "DATA", "import": "DATA", "export": "SESSION", "balance": "RECORD", "report": "SESSION", "compare": "RECORD", "trend": "SESSION", "replay": "SESSION",
              "identify frf": "DATA", "identify modal": "DATA", "identify characteristic": "TABLE"}


class Help(CommandTest):
    def help_of(self, *command):
        words = [word for part in command for word in part.split()]
        done = amb(self.folder, *words, "--help")
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.assertEqual(done.stderr, "")
        return done.stdout

    def test_the_word_help_is_the_option_of_that_name(self):
        for words in ((), ("margins",), ("diagnose",), ("identify", "frf")):
            told = amb(self.folder, "help", *words)
            asked = amb(self.folder, *words, "--help")
            self.assertEqual((told.returncode, told.stdout), (DONE, asked.stdout), told.stderr)
        unknown = amb(self.folder, "help", "margin")
        self.assertEqual(unknown.returncode, USAGE)
        self.assertIn("nearest: margins", unknown.stderr)

    def test_every_option_of_the_contract_is_explained(self):
        for command, options in OPTIONS.items():
            text = self.help_of(command)
            listed = set(re.findall(r"(?<![\w-])--[a-z][a-z0-9-]*", text))
            self.assertLessEqual(options, listed, command)
            for option in options - {"--speeds"}:  # another name of --speed-rpm
                # Something is said behind the option's name and type.
                said = re.search(rf"{option}\b[^\n]*\n?\s+(\w+\W+\w+[^\n]*)", text)
                self.assertIsNotNone(said, (command, option))

    def test_nothing_is_offered_that_this_table_does_not_know(self):
        """An option added without a line here has no test of its help."""
        for command, options in OPTIONS.items():
            if command in ("run", "doctor"):  # have more options, tested where they belong
                continue
            usage = self.help_of(command).split("Options:")[1]
            listed = {name for line in usage.splitlines() if re.match(r"  -", line)
                      for name in re.findall(r"--[a-z][a-z0-9-]*", line.split(" ... ")[0])}
            self.assertLessEqual(options, listed, command)
            own_lines = {name for name in listed if re.search(rf"^  (?:-h,)?(?:--[a-z0-9-]+,)?{name}\b",
                                                              usage, re.M)}
            self.assertEqual(own_lines - {"--help"}, options, command)

    def test_a_word_that_is_no_command_gets_the_nearest_one(self):
        for typed, meant in (("rnu", "run"), ("mode", "modes"), ("replya", "replay")):
            done = amb(self.folder, typed)
            self.assertEqual(done.returncode, USAGE)
            self.assertIn(f"no command '{typed}'; nearest: {meant}.", done.stderr)
        self.assertEqual(amb(self.folder).returncode, USAGE)

    def test_a_word_that_is_no_option_gets_the_nearest_one_of_its_command(self):
        for words, part in ((("run", "--rigg", "x"), "nearest to --rigg: --rig; see amb run --help"),
                            (("identify", "frf", "a.lcm", "--orbitum", "9"),
                             "nearest to --orbitum: --orbit-um; see amb identify frf --help")):
            done = amb(self.folder, *words)
            self.assertEqual(done.returncode, USAGE)
            self.assertIn(part, done.stderr)
            self.assertTrue(done.stderr.startswith("amb: "), done.stderr)

    def test_files_a_command_needs_are_named(self):
        for command, name in POSITIONAL.items():
            self.assertIn(name, self.help_of(command), command)
            self.assertEqual(amb(self.folder, *command.split()).returncode, USAGE, command)

    def test_general_help_lists_every_command_with_a_word_about_it(self):
        text = self.help_of()
        for command in OPTIONS:
            self.assertRegex(text, rf"\n  {command.split()[0]} +\w+", command)

    def test_the_version_is_the_projects(self):
        cmake = (SOURCE / "CMakeLists.txt").read_text(encoding="utf-8")
        version = re.search(r"project\(levitas VERSION ([\d.]+)", cmake).group(1)
        done = amb(self.folder, "--version")
        self.assertEqual((done.returncode, done.stdout), (DONE, f"levitas {version}\n"))

    def test_amb_and_amb_study_list_the_same_commands(self):
        study = subprocess.run([BINARIES / "amb-study", "--help"], capture_output=True, text=True,
                               check=True)
        self.assertEqual(self.help_of(), study.stdout)

    def test_amb_without_amb_study_says_what_builds_it(self):
        alone = self.folder / "amb"
        shutil.copy(BINARIES / "amb", alone)
        done = subprocess.run([alone, "identify", "frf"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("./amb identify", done.stderr)

    def test_amb_study_of_another_build_than_the_amb_that_starts_it_refuses_to_answer(self):
        command = [BINARIES / "amb-study", "effects"]
        alone = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual(alone.returncode, DONE, alone.stderr)
        self.assertEqual(amb(self.folder, "effects").stdout, alone.stdout)
        stale = subprocess.run(command, capture_output=True, text=True, check=False,
                               env=dict(os.environ, LEVITAS_STARTED_BY_BUILD="0123456789abcdef"))
        self.assertEqual(stale.returncode, 1)
        self.assertEqual(stale.stdout, "")
        self.assertRegex(stale.stderr, r"amb-study is of another build \(mark [0-9a-f]{16}\) than the "
                                       r"amb beside it \(mark 0123456789abcdef\)")
        self.assertIn("builds both", stale.stderr)

    def test_defaults_are_told(self):
        for command, default in (("modes", "flexible_rotor"), ("poles", "flexible_rotor"),
                                 ("modes", "=4"), ("poles", "=1000"), ("simulate", "=8")):
            self.assertIn(default, self.help_of(command), command)

    def test_every_command_of_the_documentation_exists(self):
        told = set()
        for page in (SOURCE / "docs/judging.md", SOURCE / "docs/formats.md"):
            told |= set(re.findall(r"`amb ([a-z]+)", page.read_text()))
        self.assertGreaterEqual(told, {"modes", "poles", "margins", "simulate", "import", "export",
                                       "replay"})
        self.assertLessEqual(told, set(OPTIONS), "documented, but there is no such command")

    def test_the_script_leaves_every_benchmark_of_accuracy_to_the_program(self):
        """The others are benchmarks of speed, which the script runs itself."""
        listed = re.search(r"=~ \^\(([a-z|-]+)\)\$ \]\]", (SOURCE / "amb").read_text())[1].split("|")
        pages = amb(self.folder, "manual", "--markdown").stdout
        self.assertEqual(set(listed), set(re.findall(r"^## amb bench (\S+)$", pages, re.M)))

    def test_help_needs_no_files(self):
        """Also where nothing of the project can be found."""
        self.assertIn("--json", self.help_of("modes", "--rig", "absent.yaml"))


if __name__ == "__main__":
    unittest.main()

"""amb manual: the committed page is the program's own; completion works in a real bash."""

import re
import shutil
import subprocess
import unittest

from command import BINARIES, DONE, SOURCE, USAGE, CommandTest, amb

PROGRAMS = ("amb", "amb-controller", "amb-plant", "amb-rig", "amb-study")
COMPLETE = """
source "$1"
COMP_WORDS=("${@:2}")
COMP_CWORD=$(( ${#COMP_WORDS[@]} - 1 ))
compopt() { :; }   # speaks only to a terminal
_amb
printf '%s\\n' "${COMPREPLY[@]}"
"""


class Manual(CommandTest):
    def print(self, *form):
        done = amb(self.folder, "manual", *form)
        self.assertEqual(done.returncode, DONE, done.stderr)
        return done.stdout

    def complete(self, *words):
        """What bash offers for the last of the words."""
        self.write("completion", self.print("--bash"))
        done = subprocess.run(["bash", "-c", COMPLETE, "bash", self.folder / "completion", *words],
                              capture_output=True, text=True, check=True, cwd=self.folder)
        self.assertEqual(done.stderr, "")
        return done.stdout.split()

    def test_the_committed_page_is_current(self):
        committed = (SOURCE / "docs/commands.md").read_text(encoding="utf-8")
        self.assertEqual(self.print("--markdown").splitlines(), committed.splitlines(),
                         "build/release/bin/amb manual --markdown > docs/commands.md")

    def test_every_command_of_the_help_is_on_the_page_and_in_the_manual(self):
        help_text = amb(self.folder, "--help").stdout
        commands = [line.split()[0] for line in help_text.split("Subcommands:")[1].splitlines()
                    if line.startswith("  ") and not line.startswith("   ")]
        self.assertIn("diagnose", commands)
        page, manual = self.print("--markdown"), self.print("--man")
        for command in commands:
            self.assertIn(f"## amb {command}\n", page)
            self.assertIn(f".SS amb {command}\n".replace("-", "\\-"), manual)

    def test_the_manual_page_is_one_that_troff_reads_without_a_warning(self):
        if shutil.which("groff") is None:
            self.skipTest("no groff here")
        for program in PROGRAMS:
            self.write("page.1", self.print("--man", "--of", program))
            done = subprocess.run(["groff", "-man", "-Tascii", "-ww", "-z", self.folder / "page.1"],
                                  capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stderr), (0, ""), program)

    def test_the_page_of_a_program_has_each_of_its_options_and_what_a_page_holds(self):
        whole = self.print("--markdown")
        for program in PROGRAMS[1:]:
            page = self.print("--man", "--of", program).replace("\\-", "-")
            for part in ("NAME", "SYNOPSIS", "DESCRIPTION", "EXIT STATUS", "ENVIRONMENT", "SEE ALSO"):
                self.assertIn(f".SH {part}\n", page, program)
            self.assertIn(f"\n## {program}\n", whole)
            if program == "amb-study":  # its options are amb's
                continue
            help_text = subprocess.run([BINARIES / program, "--help"], capture_output=True, text=True,
                                       check=True).stdout
            options = set(re.findall(r"^  (?:-h,)?(--[a-z-]+)", help_text, re.M))
            self.assertGreater(len(options), 10, help_text)
            examples = page.split(".SH EXAMPLES\n.nf\n")[1].split(".fi")[0]
            self.assertTrue(examples.startswith(f"  {program} "), examples)
            self.assertLessEqual(set(re.findall(r"--[a-z-]+", examples)), options)
            for option in options:
                self.assertRegex(page, rf"\.TP\n\\fB[^\n]*{option}\\fR", program)

    def test_bash_completes_commands_options_values_names_and_files(self):
        self.write("mine.yaml", "")
        self.assertEqual(self.complete("amb", "diag"), ["diagnose"])
        self.assertEqual(self.complete("amb", "identify", "mod"), ["modal"])
        self.assertEqual(self.complete("amb", "run", "--reco"), ["--record"])
        self.assertEqual(self.complete("amb", "run", "--pace", "r"), ["realtime"])
        self.assertIn("flexible_rotor", self.complete("amb", "run", "--rig", "f"))
        self.assertEqual(self.complete("amb", "run", "--rig", "mi"), ["mine.yaml"])
        self.assertEqual(self.complete("amb", "replay", "mi"), ["mine.yaml"])
        self.assertIn("forget", self.complete("amb", "sessions", ""))
        self.assertEqual(self.complete("amb", "run", "--no-such"), [])
        self.assertEqual(self.complete("amb-study", "diag"), ["diagnose"])
        self.assertEqual(self.complete("/usr/bin/amb-controller", "--reco"), ["--record"])
        self.assertIn("flexible_rotor", self.complete("amb-plant", "--rig", "f"))
        self.assertEqual(self.complete("amb-rig", "--on"), ["--on-a-real-bus"])

    def test_without_a_form_says_which_there_are(self):
        self.refuse(USAGE, "--bash", "manual")


if __name__ == "__main__":
    unittest.main()

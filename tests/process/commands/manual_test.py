"""amb manual: the committed page is the program's own; completion works in a real bash."""

import shutil
import subprocess
import unittest

from command import DONE, SOURCE, USAGE, CommandTest, amb

COMPLETE = """
source "$1"
COMP_WORDS=("${@:2}")
COMP_CWORD=$(( ${#COMP_WORDS[@]} - 1 ))
compopt() { :; }   # speaks only to a terminal
_amb
printf '%s\\n' "${COMPREPLY[@]}"
"""


class Manual(CommandTest):
    def print(self, form):
        done = amb(self.folder, "manual", form)
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
        self.write("amb.1", self.print("--man"))
        done = subprocess.run(["groff", "-man", "-Tascii", "-ww", "-z", self.folder / "amb.1"],
                              capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

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

    def test_without_a_form_says_which_there_are(self):
        self.refuse(USAGE, "--bash", "manual")


if __name__ == "__main__":
    unittest.main()

"""What holds for every command: --json beside the text, and the same exit statuses everywhere.

The list of commands is the program's own (amb manual): one that is added without a row here fails.
"""

import json
import re
import signal
import subprocess
import unittest

from command import BAD_INPUT, BINARIES, DONE, USAGE, CommandTest, amb, make_record
from lcm_network import Process
from waiting import found, until

# Have nothing to report: groups of commands, and the manual, whose text is the result.
WITHOUT_JSON = {"new", "identify", "design", "bench", "manual", "key"}
ABSENT = "absent.lcm"
# Quick enough to be run here; the others report in tests of their own.
QUICK = {
    "run": ("--duration", "0.5"),
    "new rig": ("mine", "--mass-kg", "8", "--length-mm", "300", "--speed-rpm", "3000", "--gap-mm",
                "0.4", "--bias-a", "2", "--ki-n-per-a", "60"),
    "modes": (),
    "poles": (),
    "margins": (),
    "replay": ("s.lcm",),
    "import": ("r.csv", "--rig", "flexible_rotor", "--out", "again.lcm"),
    "export": ("s.lcm", "--csv", "s.csv"),
    "can-dbc": ("--rig", "flexible_rotor"),
    "report": ("s.lcm", "--out", "s.html"),
    "compare": ("run.lcm",),
    "sessions": (),
    "sessions add": ("s.lcm",),
    "sessions tag": ("s.lcm", "one"),
    "sessions compress": ("s.lcm", "--keep"),
    "sessions forget": ("s.lcm",),
    "simulate": ("s.lcm",),
    "effects": (),
    "design uncertainty": (),
}
# A file that is not there: words of each command that make it look for one.
MISSING = {
    "run": ("--rig", ABSENT), "modes": ("--rig", ABSENT), "poles": ("--rig", ABSENT),
    "margins": ("--controller", ABSENT), "replay": (ABSENT,),
    "import": (ABSENT, "--rig", "flexible_rotor", "--out", "x.lcm"),
    "export": (ABSENT, "--csv", "x.csv"), "can-dbc": ("--rig", ABSENT),
    "report": (ABSENT, "--out", "x.html"), "compare": (ABSENT,), "trend": (ABSENT,), "sessions tag": (ABSENT, "one"),
    "sessions forget": (ABSENT,), "simulate": (ABSENT,),
    "identify frf": (ABSENT,), "identify modal": (ABSENT,),
    "identify full-spectrum": (ABSENT,), "identify controller": (ABSENT,),
    "identify characteristic": (ABSENT,), "identify live": (ABSENT,),
    "identify rotor-in-loop": (ABSENT, "--rig", "turbomolecular_pump"),
    "design hinf": ("--rig", ABSENT), "design pid": ("--rig", ABSENT), "design check": ("--controller", ABSENT),
    "design schedule": ("--rig", ABSENT), "design notch": ("--rig", ABSENT),
    "design uncertainty": ("--rig", ABSENT), "design compare": (ABSENT,),
    "balance": (ABSENT,), "bench mesh": ("--rig", ABSENT),
    "diagnose": (ABSENT, "--rig", "flexible_rotor", "--out", "d"),
}
# Look for no file that a user names; the nonlinear fits take theirs with more options.
NO_FILE = {"new", "new rig", "dash", "key", "doctor", "effects", "sessions", "sessions add", "sessions compress",
           "manual", "identify",
           "design", "bench",
           "bench diagnosis", "bench identification", "bench full-spectrum", "bench pump", "bench lives",
           "identify hammerstein-wiener", "identify narx", "identify narmax", "identify grey-box"}


class Contract(CommandTest):
    def commands(self):
        pages = amb(self.folder, "manual", "--markdown").stdout
        return dict(re.findall(r"\n## amb ([a-z -]+)\n(.*?)(?=\n## |\Z)", pages, re.S))

    def here(self, *arguments):
        return amb(self.folder, *arguments, environment=self.environment)

    def setUp(self):
        super().setUp()
        self.environment = {"LEVITAS_CATALOGUE": str(self.folder / "own/sessions.db"),
                            "PATH": "/usr/bin:/bin"}

    def test_every_command_that_reports_something_does_so_as_json(self):
        for command, page in self.commands().items():
            self.assertEqual("| `--json TEXT`" in page, command not in WITHOUT_JSON, command)

    def test_a_table_of_this_test_knows_every_command(self):
        self.assertEqual(set(self.commands()), set(MISSING) | NO_FILE)

    def test_a_wrong_option_is_status_2_and_leaves_nothing(self):
        for command in self.commands():
            done = self.here(*command.split(), "--no-such-option")
            self.assertEqual(done.returncode, USAGE, (command, done.stderr))
            self.assertEqual(done.stdout, "", command)
            self.assertTrue(done.stderr.startswith("amb: "), (command, done.stderr))
        self.assertEqual(self.files() - {str(self.folder / "own")}, set())

    def test_nan_is_no_number(self):
        for arguments in (("design", "notch", "--hysteresis-rpm", "nan"), ("bench", "mesh", "--impact-n-m", "NaN"),
                          ("bench", "mesh", "--hz", "15,nan"), ("balance", "absent.lcm", "--top-rpm", "-nan")):
            done = self.here(*arguments)
            self.assertEqual(done.returncode, USAGE, (arguments, done.stderr))
            self.assertEqual(done.stdout, "", arguments)
            self.assertIn(f"amb: {arguments[-2]}: found", done.stderr)
            self.assertIn("which is no number", done.stderr)

    def test_a_missing_file_is_status_3_is_named_and_leaves_no_json(self):
        for command, arguments in MISSING.items():
            done = self.here(*command.split(), *arguments, "--json", "x.json")
            self.assertEqual(done.returncode, BAD_INPUT, (command, done.stdout, done.stderr))
            self.assertIn("absent", done.stderr, command)
            self.assertFalse((self.folder / "x.json").exists(), command)

    def test_what_succeeds_is_status_0_and_its_json_an_object(self):
        make_record(self.folder / "r.csv", "healthy", 0, 6_000)
        done = self.here("import", "r.csv", "--rig", "flexible_rotor", "--out", "s.lcm")
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.assertEqual(self.here("run", "--duration", "1.5", "--record", "run.lcm").returncode, DONE)
        for command, arguments in QUICK.items():
            if command == "replay":  # an import has no law of its own to repeat
                arguments = ("run.lcm",)
            path = self.folder / f"{command.replace(' ', '_')}.json"
            done = self.here(*command.split(), *arguments, "--json", path)
            self.assertEqual(done.returncode, DONE, (command, done.stdout, done.stderr))
            told = json.loads(path.read_text())
            self.assertEqual(told["schema"], f"levitas_{command.replace(' ', '_')}_1")
            self.assertRegex(told["version"], r"^\d+\.\d+")

    def test_json_on_standard_output_is_alone_there(self):
        for command, arguments in (("modes", ()), ("poles", ("--speed-rpm", "0")), ("margins", ()),
                                   ("run", ("--duration", "1.5"))):
            done = self.here(command, *arguments, "--json", "-")
            self.assertEqual(done.returncode, DONE, (command, done.stderr))
            self.assertEqual(json.loads(done.stdout)["schema"], f"levitas_{command}_1")
            text = self.here(command, *arguments)
            if command != "run":  # which says how long it took
                self.assertEqual(done.stderr, text.stdout + text.stderr, command)
            self.assertFalse((self.folder / "-").exists(), command)
        # Appended to, not cut: the shell's file holds what was in it before.
        with open(self.folder / "all.json", "a") as kept:
            kept.write("before\n")
            kept.flush()
            subprocess.run([BINARIES / "amb", "modes", "--json", "-"], cwd=self.folder, stdout=kept,
                           stderr=subprocess.DEVNULL, check=True)
        self.assertTrue((self.folder / "all.json").read_text().startswith("before\n{"))

    def test_a_page_that_is_interrupted_has_done_what_it_should(self):
        page = Process(self.folder, "amb", "dash", "--json", "page.json")
        self.addCleanup(page.kill)
        until(lambda: found("page: ", page.said_so_far) or page.child.poll() is not None,
              "the address of the page", lambda: page.said_so_far)
        if page.child.poll() is not None:  # a machine without multicast says so
            self.assertEqual(page.status(), 1)
            self.skipTest(page.text)
        page.send_signal(signal.SIGINT)
        self.assertEqual(page.status(), DONE)
        address = json.loads((self.folder / "page.json").read_text())["page"]
        self.assertIn(address, page.text)


if __name__ == "__main__":
    unittest.main()

"""scripts/test_machine.sh tells what ran inside from what could not be run."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(os.environ["LEVITAS_SOURCE"]) / "scripts" / "test_machine.sh"
NOT_RUN = 77
KILLED = 124


def machine(*words, **environment):
    return subprocess.run([SCRIPT, *words], capture_output=True, text=True, check=False,
                          env=dict(os.environ, **environment))


class WithoutAKernel(unittest.TestCase):
    def setUp(self):
        cache = tempfile.TemporaryDirectory()
        self.addCleanup(cache.cleanup)
        self.cache = cache.name

    def test_a_command_is_not_run_rather_than_passed(self):
        done = machine("run", "true", XDG_CACHE_HOME=self.cache)
        self.assertEqual(done.returncode, NOT_RUN)
        self.assertIn("not run: its kernel is not built", done.stderr)

    def test_the_path_of_the_kernel_is_not_made_up(self):
        done = machine("kernel", XDG_CACHE_HOME=self.cache)
        self.assertEqual((done.returncode, done.stdout), (1, ""))


class Usage(unittest.TestCase):
    def test_unknown_words_and_a_missing_command_are_refused(self):
        for words in (["start"], ["run", "--fast", "true"], ["run"], []):
            self.assertEqual(machine(*words).returncode, 2, words)


@unittest.skipIf(machine("kernel").returncode != 0, "its kernel is not built")
class Inside(unittest.TestCase):
    def test_the_status_of_the_command_comes_out(self):
        for status in (0, 1, 3, NOT_RUN):
            self.assertEqual(machine("run", "sh", "-c", f"exit {status}").returncode, status)

    def test_what_it_prints_comes_out_and_nothing_else(self):
        done = machine("run", "sh", "-c", "echo first; echo 'second  one' >&2")
        self.assertEqual(done.stdout.split("\n")[:2], ["first", "second  one"])
        self.assertEqual(done.stderr, "")

    def test_words_and_settings_arrive_as_they_were_given(self):
        done = machine("run", "printf", "[%s]", "a b", "$HOME", "it's", LEVITAS_NOTE="x  'y'")
        self.assertEqual(done.stdout.strip(), "[a b][$HOME][it's]")
        done = machine("run", "printenv", "LEVITAS_NOTE", LEVITAS_NOTE="x  'y'")
        self.assertEqual(done.stdout.strip(), "x  'y'")

    def test_a_program_that_never_ends_is_killed_and_fails(self):
        done = machine("run", "sh", "-c", "while :; do :; done", LEVITAS_MACHINE_SECONDS="3")
        self.assertEqual(done.returncode, KILLED)
        self.assertIn("ended without a status", done.stderr)

    def test_a_machine_that_crashes_fails(self):
        done = machine("run", "sh", "-c", "echo c > /proc/sysrq-trigger; sleep 10", LEVITAS_MACHINE_SECONDS="5")
        self.assertEqual(done.returncode, KILLED)

    def test_files_of_the_host_are_there_and_temporary_ones_are_forgotten(self):
        name = f"/tmp/levitas-forgotten-{os.getpid()}"
        done = machine("run", "sh", "-c", 'test -f "$1" && touch "$2" && test -e "$2"', "sh",
                       str(SCRIPT), name)
        self.assertEqual(done.returncode, 0)
        self.assertFalse(pathlib.Path(name).exists())


if __name__ == "__main__":
    result = unittest.main(verbosity=2, exit=False).result
    sys.exit(0 if result.wasSuccessful() else 1)

"""scripts/setup.sh and scripts/test.sh function by function, with invented tools and machines.

Nothing is installed or built: apt-get, dpkg, dpkg-query, sudo, id, ninja, cmake and ctest are
scripts that write down how they were called; everything else is linked from the machine.
"""

import errno
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(os.environ["LEVITAS_SOURCE"]) / "tests/support"))
from waiting import LIMIT_S, until  # noqa: E402

SOURCE = Path(os.environ["LEVITAS_SOURCE"])
NEEDED = ("bash sh env sed sort comm grep head tail tee cut wc date mkdir rm touch flock awk nproc "
          "cat basename sleep mkfifo mv tr setsid").split()
RECORDING = '#!/bin/sh\necho "$(basename "$0") $*" >> "$CALLS"\n'


class SetUp(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.root = self.folder / "a folder with spaces"
        (self.root / "scripts").mkdir(parents=True)
        (self.root / "CMakePresets.json").write_text("{}")
        self.tools = self.folder / "tools"
        self.tools.mkdir()
        for name in NEEDED:
            (self.tools / name).symlink_to(shutil.which(name))
        self.packages("one\ntwo\n")

    def packages(self, text, name="packages.txt"):
        (self.root / name).write_text(text)

    def tool(self, name, body="exit 0\n"):
        path = self.tools / name
        path.unlink(missing_ok=True)
        path.write_text(RECORDING + body)
        path.chmod(0o755)

    def debian(self, installed, user=0):
        """A Debian machine on which these packages are installed."""
        answers = "".join(f"{status} {name}\\n" for name, status in installed.items())
        self.tool("dpkg-query", f"printf '{answers}'\n")
        self.tool("dpkg")
        self.tool("apt-get")
        self.tool("id", f"echo {user}\n")

    def run_shell(self, body):
        script = f"set -euo pipefail\nroot='{self.root}'\n. '{SOURCE}/scripts/setup.sh'\n"
        script += f". '{SOURCE}/scripts/test.sh'\nmkdir -p \"$build_root\"\n{body}\n"
        environment = {"PATH": str(self.tools), "CALLS": str(self.folder / "calls"),
                       "HOME": str(self.folder), "LEVITAS_JOBS": "2"}
        return subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=False,
                              env=environment, timeout=LIMIT_S)

    def install(self, lists='"$root/packages.txt"'):
        return self.run_shell(f"install_packages {lists}")

    def calls(self, tool):
        path = self.folder / "calls"
        lines = path.read_text().splitlines() if path.exists() else []
        return [line for line in lines if line.startswith(tool + " ")]


class Packages(SetUp):
    def test_with_everything_installed_nothing_is_called_and_nothing_said(self):
        self.debian({"one": "installed", "two": "installed"})
        done = self.install()
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(self.calls("apt-get") + self.calls("dpkg"), [])

    def test_a_package_that_was_removed_but_left_its_settings_counts_as_missing(self):
        for status in ("config-files", "half-installed", "unpacked", "not-installed"):
            with self.subTest(status):
                (self.folder / "calls").unlink(missing_ok=True)
                self.debian({"one": "installed", "two": status})
                self.assertEqual(self.install().returncode, 0)
                self.assertTrue(self.calls("apt-get")[-1].endswith(" two"), self.calls("apt-get"))

    def test_only_the_missing_ones_of_all_lists_are_installed_each_once(self):
        self.packages("three  # twice\none\n\n", "packages-ci.txt")
        self.packages("# a comment\none\n  \ntwo\nthree\n")
        self.debian({"one": "installed"})
        done = self.install('"$root/packages.txt" "$root/packages-ci.txt"')
        self.assertIn("installing 2 Debian packages: three two", done.stderr)
        self.assertTrue(self.calls("apt-get")[-1].endswith("--no-install-recommends three two"))

    def test_an_empty_list_needs_nothing(self):
        self.packages("# nothing\n\n")
        self.debian({})
        self.assertEqual((self.install().returncode, self.calls("apt-get")), (0, []))

    def test_without_network_the_lists_already_here_may_do(self):
        self.debian({})
        self.tool("apt-get", 'case "$*" in *update*) echo "Err: no network"; exit 100;; esac\n')
        self.assertEqual(self.install().returncode, 0)
        self.assertEqual(len(self.calls("apt-get")), 2)

    def test_without_network_and_lists_it_says_why_and_where_the_log_is(self):
        self.debian({})
        self.tool("apt-get", 'echo "E: Could not resolve deb.debian.org" >&2; exit 100\n')
        done = self.install()
        self.assertEqual(done.returncode, 1)
        self.assertIn("E: Could not resolve deb.debian.org", done.stderr)
        self.assertIn(f"installing failed; the log is {self.root}/build/amb-install.log", done.stderr)
        self.assertLessEqual(len(done.stderr.splitlines()), 5)

    def test_an_ordinary_user_installs_through_sudo_and_without_sudo_is_told_the_command(self):
        self.debian({"one": "installed"}, user=1000)
        done = self.install()
        self.assertEqual(done.returncode, 1)
        self.assertIn("As root: apt-get install two", done.stderr)
        self.assertEqual(self.calls("apt-get"), [])
        self.tool("sudo", 'exec "$@"\n')
        self.assertEqual(self.install().returncode, 0)
        self.assertTrue(any("apt-get" in line and " two" in line for line in self.calls("sudo")))

    def test_an_interrupted_installation_is_finished_before_the_next(self):
        self.debian({})
        self.install()
        order = [line.split()[0] + " " + line.split()[-1]
                 for line in (self.folder / "calls").read_text().splitlines()
                 if line.startswith(("dpkg ", "apt-get "))]
        self.assertEqual(order, ["dpkg -a", "apt-get update", "apt-get two"])

    def test_another_distribution_is_told_in_one_sentence_unless_it_has_the_tools(self):
        done = self.install()
        self.assertEqual(done.returncode, 1)
        self.assertEqual(len(done.stderr.splitlines()), 1)
        self.assertIn("not a Debian system: install what packages.txt names", done.stderr)
        self.tool("ninja")
        self.assertEqual((self.install().returncode, self.calls("apt-get")), (0, []))


class Jobs(SetUp):
    def test_the_number_of_jobs_is_a_whole_number_from_one(self):
        self.assertEqual(self.run_shell("LEVITAS_JOBS=3; job_count").stdout, "3\n")
        for bad in ("0", "-1", "2.5", "two", "1 2", "08"):
            with self.subTest(bad):
                done = self.run_shell(f"LEVITAS_JOBS='{bad}'; job_count")
                self.assertEqual(done.returncode, 1)
                self.assertIn(f"LEVITAS_JOBS = '{bad}'", done.stderr)

    def test_memory_limits_the_jobs_but_one_always_runs(self):
        for free_kb, cores, expected in ((16_000_000, 4, 4), (3_200_000, 4, 2), (100_000, 4, 1)):
            with self.subTest(free_kb=free_kb):
                self.tool("awk", f"echo {free_kb}\n")
                self.tool("nproc", f"echo {cores}\n")
                self.assertEqual(self.run_shell("LEVITAS_JOBS=; job_count").stdout, f"{expected}\n")


class Lock(SetUp):
    def test_a_second_one_says_that_it_waits_and_goes_on_when_the_first_is_done(self):
        # The first one holds the lock until the second one has said that it waits for it.
        body = ('cd "$root"; touch said; say() { echo "$*" >&2; echo "$*" >>said; }; mkfifo held\n'
                '(take_lock; echo first; echo >held\n'
                ' until grep -q "waiting for" said; do sleep 0.01; done; echo first-done) &\n'
                'read -r _ <held; take_lock; echo second; release_lock; wait')
        done = self.run_shell(body)
        self.assertEqual(done.stdout.split(), ["first", "first-done", "second"], done.stderr)
        self.assertEqual(done.stderr.count("waiting for another ./amb"), 1)


class Configure(SetUp):
    def configured(self):
        return self.run_shell("configure release").returncode

    def fake_cmake(self, status=0):
        cache = f"{self.root}/build/release"
        self.tool("cmake", f"mkdir -p '{cache}'; echo 'CMAKE_HOME_DIRECTORY:INTERNAL={self.root}' > "
                           f"'{cache}/CMakeCache.txt'; exit {status}\n")

    def test_is_done_once_and_again_when_the_presets_are_younger(self):
        self.fake_cmake()
        self.assertEqual([self.configured(), self.configured()], [0, 0])
        self.assertEqual(len(self.calls("cmake")), 1)
        stamp = self.root / "build/release/.amb-configured"
        os.utime(stamp, (1, 1))  # older than the presets
        self.configured()
        self.assertEqual(len(self.calls("cmake")), 2)

    def test_a_failed_one_leaves_no_stamp_and_is_tried_again(self):
        self.fake_cmake(status=1)
        self.assertEqual([self.configured(), self.configured()], [1, 1])
        self.assertEqual(len(self.calls("cmake")), 2)

    def test_the_cache_of_another_folder_is_removed_that_of_this_one_kept(self):
        build = self.root / "build/release"
        for home, kept in ((self.root, True), ("/elsewhere", False)):
            build.mkdir(parents=True, exist_ok=True)
            (build / "old.o").touch()
            (build / "CMakeCache.txt").write_text(f"CMAKE_HOME_DIRECTORY:INTERNAL={home}\n")
            self.fake_cmake()
            self.configured()
            self.assertEqual((build / "old.o").exists(), kept, home)


class Tests(SetUp):
    def run_tests(self, words, ctest_status=0):
        self.debian({"one": "installed", "two": "installed"})
        self.tool("cmake")
        self.tool("ninja")
        self.tool("ctest", f"echo '100% tests passed, 0 tests failed out of 3'; exit {ctest_status}\n")
        (self.root / "build/release").mkdir(parents=True, exist_ok=True)
        return self.run_shell(f"run_tests {words}")

    def test_labels_build_only_their_targets_and_select_exactly_themselves(self):
        done = self.run_tests("unit loop -R Pid")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(self.calls("ninja")[-1].endswith("tests_unit tests_loop"))
        # By name: among the single tests of their programs, too.
        self.assertIn("-L ^(single[.])?(unit|loop)$ -R Pid", self.calls("ctest")[-1])
        self.run_tests("unit")
        self.assertTrue(self.calls("ctest")[-1].endswith("-L ^(unit)$"), self.calls("ctest"))
        self.assertEqual(done.stdout, "100% tests passed, 0 tests failed out of 3\n")

    def test_without_a_label_the_tests_are_built_and_run_and_no_benchmark(self):
        self.run_tests("")
        targets = "tests_unit tests_loop tests_replay tests_process tests_hardware tests_build"
        self.assertTrue(self.calls("ninja")[-1].endswith(targets), self.calls("ninja"))
        self.assertTrue(self.calls("ctest")[-2].endswith(
            "-L ^(unit|loop|replay|process|hardware|build)$ -LE ^long$"), self.calls("ctest"))

    def test_without_a_label_what_is_long_is_left_out_and_named(self):
        """By its label, or among those of another one, it is run."""
        self.tool("ctest", "echo '  Test #7: process.outside'; echo '  Test #9: loop.evidence_test.0'\n")
        done = self.run_shell("say_long")
        self.assertIn("not run: 2 long tests (process.outside loop.evidence_test.0). ./amb test long runs them",
                      done.stderr)
        self.run_tests("long")
        self.assertTrue(self.calls("ctest")[-1].endswith("-L ^(long)$"), self.calls("ctest"))
        self.run_tests("process")
        self.assertTrue(self.calls("ctest")[-1].endswith("-L ^(process)$"), self.calls("ctest"))

    def test_an_unknown_label_and_all_with_more_are_usage_errors_before_anything_runs(self):
        for words in ("untit", "unit nothing", "--all unit"):
            with self.subTest(words):
                self.assertEqual(self.run_tests(words).returncode, 2)
                self.assertEqual(self.calls("ninja") + self.calls("ctest"), [])

    def ctest_of(self, *skipped):
        """A ctest whose run skipped these tests."""
        lines = "".join(f"  1/3 Test  #7: {name} .......***Skipped   0.06 sec\n" for name in skipped)
        return f"cat <<'END'\n  2/3 Test  #8: unit.good ....   Passed    0.06 sec\n{lines}" \
               "100% tests passed, 0 tests failed out of 3\nEND\n"

    def test_what_was_not_run_is_named_with_the_command_that_would(self):
        self.debian({"one": "installed", "two": "installed"})
        self.tool("ctest", self.ctest_of("process.dashboard.browser", "build.tidy",
                                         "hardware.can_run", "process.mcap"))
        done = self.run_shell("ctest_preset release")
        self.assertEqual(done.returncode, 0, done.stderr)
        for name, remedy in (("process.dashboard.browser", "./amb test --all"),
                             ("build.tidy", "./amb test --all"),
                             ("hardware.can_run", "./amb test hardware"),
                             ("process.mcap", "ctest --test-dir build/release -R 'process.mcap' -V")):
            self.assertRegex(done.stderr, f"not run: {re.escape(name)}\\. {re.escape(remedy)}")
        self.assertNotIn("unit.good", done.stderr)

    def close(self, *skipped):
        self.tool("ctest", self.ctest_of(*skipped))
        return self.run_shell("failed=(); ctest_preset release; close_all")

    def test_everything_passed_only_where_everything_was_run(self):
        self.assertIn("everything passed after", self.close().stderr)
        left = self.close("process.mcap", "unit.a/1")
        self.assertEqual(left.returncode, 0)
        self.assertNotIn("everything passed", left.stderr)
        self.assertIn("but not run: process.mcap unit.a/1", left.stderr)

    def test_a_page_that_no_browser_has_seen_is_a_failure_of_all(self):
        done = self.close("process.dashboard.memory")
        self.assertEqual(done.returncode, 1)
        self.assertIn("failed: process.dashboard.memory was not run", done.stderr)

    def aside(self, step):
        """One step beside the tests: scripts/aside.sh is an invented one that ends as `step` says."""
        (self.root / "scripts/aside.sh").write_text(f"#!/bin/sh\necho \"step $*\"\n{step}\n")
        (self.root / "scripts/aside.sh").chmod(0o755)
        return self.run_shell('aside build asan-ubsan unit\necho tests\n'
                              'end_aside || { echo "ended with $?"; exit 3; }')

    def test_a_step_beside_the_tests_is_waited_for_and_its_words_are_kept(self):
        done = self.aside("exit 0")
        self.assertEqual((done.returncode, done.stdout), (0, "tests\n"), done.stderr)
        self.assertIn("step build asan-ubsan unit", done.stderr)

    def test_a_step_beside_the_tests_that_fails_is_a_failure(self):
        done = self.aside("exit 5")
        self.assertEqual((done.returncode, done.stdout), (3, "tests\nended with 5\n"), done.stderr)

    def built_aside(self, step):
        """What the tests hear of what is built beside them, while the rest of the step goes on."""
        (self.root / "scripts/aside.sh").write_text(f"#!/bin/sh\n{step}\n")
        (self.root / "scripts/aside.sh").chmod(0o755)
        return self.run_shell('mkdir -p "$build_root"\nrm -f "$build_root/amb-aside-build.status"\n'
                              'aside both asan-ubsan unit\nstatus=0\n'
                              'await_build_aside || status=$?\necho "built with $status"')

    def test_what_is_built_beside_the_tests_is_not_waited_for_longer_than_it_takes(self):
        never = self.folder / "never"
        os.mkfifo(never)
        told = self.root / "build/amb-aside-build.status"
        for status in (0, 7):
            done = self.built_aside(f"echo {status} >'{told}.new'\nmv '{told}.new' '{told}'\n"
                                    f"read line <'{never}'")
            self.assertEqual(done.stdout, f"built with {status}\n", done.stderr)

    def test_what_is_built_beside_the_tests_and_dies_is_a_failure(self):
        self.assertEqual(self.built_aside("exit 0").stdout, "built with 1\n")

    def test_a_step_beside_the_tests_does_not_outlive_them(self):
        begun, never = self.folder / "begun", self.folder / "never"
        os.mkfifo(begun)
        os.mkfifo(never)
        # It has begun once its line is read, and then waits for a writer that never comes.
        (self.root / "scripts/aside.sh").write_text(
            f"#!/bin/sh\necho >'{begun}'\nwhile true; do read line <'{never}'; done\n")
        (self.root / "scripts/aside.sh").chmod(0o755)
        done = self.run_shell(f"aside build asan-ubsan unit\nread line <'{begun}'\nexit 4")
        self.assertEqual(done.returncode, 4, done.stderr)

        def gone():
            try:
                os.close(os.open(never, os.O_WRONLY | os.O_NONBLOCK))
            except OSError as error:  # nobody reads
                return error.errno == errno.ENXIO
            return False

        until(gone, "the step beside the tests to end")

    def test_the_status_of_failed_tests_is_passed_on_with_the_log(self):
        done = self.run_tests("unit", ctest_status=8)
        self.assertEqual(done.returncode, 8)
        self.assertIn(f"{self.root}/build/amb-test-release.log", done.stderr)


if __name__ == "__main__":
    unittest.main()

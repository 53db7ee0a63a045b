"""./amb sets up, builds and passes on: with a small program in a folder with spaces.

The real launcher and scripts are copied; CMakeLists.txt and packages.txt are small ones. Where
packages would be installed, apt-get, dpkg and dpkg-query are replaced by scripts that write down
how they were called.
"""

import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(os.environ["LEVITAS_SOURCE"]) / "tests/support"))
from waiting import LIMIT_S, pause  # noqa: E402

SOURCE = Path(os.environ["LEVITAS_SOURCE"])

PROJECT = """cmake_minimum_required(VERSION 3.25)
project(small LANGUAGES CXX)
add_custom_target(programs)
add_custom_target(running_programs)
add_executable(amb main.cpp)
set_target_properties(amb PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
add_dependencies(running_programs amb)
add_executable(amb-study main.cpp)
add_dependencies(programs amb amb-study)
"""
PRESETS = """{"version": 5, "configurePresets": [{"name": "release", "generator": "Ninja",
"binaryDir": "${sourceDir}/build/${presetName}"}]}"""
MAIN = """#include <cstdio>
int main(int count, char** words) {
  for (int i = 1; i < count; ++i) std::printf("[%s]", words[i]);
  return count;
}
"""
CALLS = "#!/bin/sh\necho \"$(basename \"$0\") $*\" >> \"$CALLS\"\n"


class Launcher(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.root = self.folder / "a folder"
        self.root.mkdir()
        shutil.copy(SOURCE / "amb", self.root)
        shutil.copytree(SOURCE / "scripts", self.root / "scripts")
        (self.root / "CMakeLists.txt").write_text(PROJECT)
        (self.root / "CMakePresets.json").write_text(PRESETS)
        (self.root / "main.cpp").write_text(MAIN)
        (self.root / "packages.txt").write_text("# what it needs\nbash  # is always there\n")
        self.environment = dict(os.environ)

    def command(self, *words):
        return [str(self.root / "amb"), *words]

    def amb(self, *words):
        return subprocess.run(self.command(*words), capture_output=True, text=True, check=False,
                              cwd="/", env=self.environment)

    def replace_package_tools(self, installed, apt_get="exit 0\n"):
        """Tools of Debian that only write down their calls; `installed`: what dpkg-query answers."""
        tools = self.folder / "tools"
        tools.mkdir()
        for name, rest in (("apt-get", apt_get), ("dpkg", "exit 0\n"), ("sudo", 'exec "$@"\n')):
            (tools / name).write_text(CALLS + rest)
        (tools / "dpkg-query").write_text(f"#!/bin/sh\nprintf '{installed}'\n")
        for tool in tools.iterdir():
            tool.chmod(0o755)
        self.environment["PATH"] = f"{tools}:{os.environ['PATH']}"
        self.environment["CALLS"] = str(self.folder / "calls")

    def calls(self):
        path = self.folder / "calls"
        return path.read_text() if path.exists() else ""

    def test_builds_then_passes_on_arguments_and_exit_status(self):
        done = self.amb("run", "two words", "")
        self.assertEqual((done.stdout, done.returncode), ("[run][two words][]", 4), done.stderr)

    def test_what_runs_a_rig_is_built_first_and_the_rest_when_it_is_asked_for(self):
        study = self.root / "build/release/amb-study"
        self.amb("run")
        self.assertFalse(study.exists())
        listed = re.findall(r'StudyCommand\{"(\w+)"', (SOURCE / "cli/commands/study_commands.hpp").read_text())
        self.assertIn("diagnose", listed)
        for name in set(listed) - {"bench"}:  # bench: below
            with self.subTest(name):
                study.unlink(missing_ok=True)
                self.assertEqual(self.amb(name).stdout, f"[{name}]")
                self.assertTrue(study.exists())

    def test_benchmarks_of_accuracy_are_the_programs_own(self):
        for name in ("diagnosis", "identification", "full-spectrum", "pump"):
            with self.subTest(name):
                done = self.amb("bench", name, "--seeds", "3")
                self.assertEqual(done.stdout, f"[bench][{name}][--seeds][3]", done.stderr)

    def test_says_nothing_of_its_own_when_everything_is_there(self):
        self.amb("run")
        self.assertEqual(self.amb("run").stderr, "")

    def test_builds_again_what_was_changed(self):
        self.amb("run")
        (self.root / "main.cpp").write_text(MAIN.replace("[%s]", "<%s>"))
        self.assertEqual(self.amb("run").stdout, "<run>")

    def test_works_through_a_symbolic_link(self):
        (self.folder / "link").symlink_to(self.root / "amb")
        done = subprocess.run([self.folder / "link", "x"], capture_output=True, text=True,
                              check=False, env=self.environment)
        self.assertEqual(done.stdout, "[x]", done.stderr)

    def test_two_started_at_once_both_succeed(self):
        both = [subprocess.Popen(self.command("x"), stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                 text=True, env=self.environment) for _ in range(2)]
        for one in both:
            out, err = one.communicate(timeout=LIMIT_S)
            self.assertEqual(out, "[x]", err)

    def test_an_interrupted_set_up_is_finished_by_the_next_call(self):
        for delay_s in (0.1, 0.4, 0.8):
            with self.subTest(delay_s):
                shutil.rmtree(self.root / "build", ignore_errors=True)
                first = subprocess.Popen(self.command("x"), stdout=subprocess.DEVNULL,
                                         stderr=subprocess.DEVNULL, start_new_session=True,
                                         env=self.environment)
                pause(delay_s, "the next call finishes what was interrupted, whenever that was")
                os.killpg(first.pid, signal.SIGINT)  # as Ctrl-C on a terminal does
                first.wait(timeout=LIMIT_S)
                self.assertEqual(self.amb("x").stdout, "[x]")

    def test_a_folder_that_was_moved_is_configured_afresh(self):
        self.amb("x")
        self.root = self.root.rename(self.folder / "moved")
        done = self.amb("x")
        self.assertEqual(done.stdout, "[x]", done.stderr)
        self.assertIn("belongs to another folder", done.stderr)

    def test_a_failed_build_shows_the_error_and_names_the_log(self):
        (self.root / "main.cpp").write_text("int main() { return nothing_known; }\n")
        done = self.amb("x")
        self.assertEqual(done.returncode, 1)
        self.assertIn("nothing_known", done.stderr)
        self.assertIn(str(self.root / "build/amb-build-release.log"), done.stderr)

    def test_a_failed_configuration_shows_the_error_and_names_the_log(self):
        (self.root / "CMakeLists.txt").write_text('message(FATAL_ERROR "layers are broken")\n')
        done = self.amb("x")
        self.assertEqual(done.returncode, 1)
        self.assertIn("layers are broken", done.stderr)
        self.assertIn("amb-configure-release.log", done.stderr)

    def test_refuses_a_number_of_jobs_that_is_none(self):
        self.environment["LEVITAS_JOBS"] = "many"
        done = self.amb("x")
        self.assertEqual(done.returncode, 1)
        self.assertIn("LEVITAS_JOBS = 'many'", done.stderr)

    def test_installs_only_what_is_missing(self):
        (self.root / "packages.txt").write_text("here\nabsent  # why\n")
        self.replace_package_tools("installed here\\n")
        done = self.amb("x")
        self.assertEqual(done.stdout, "[x]", done.stderr)
        self.assertIn("installing 1 Debian packages: absent", done.stderr)
        install = [line for line in self.calls().splitlines() if " install " in line][-1]
        self.assertTrue(install.endswith("install --no-install-recommends absent"), install)

    def test_calls_no_package_tool_when_nothing_is_missing(self):
        (self.root / "packages.txt").write_text("here\n")
        self.replace_package_tools("installed here\\n")
        self.assertEqual(self.amb("x").stdout, "[x]")
        self.assertEqual(self.calls(), "")

    def test_a_failed_installation_gives_the_reason_and_the_log(self):
        (self.root / "packages.txt").write_text("absent\n")
        self.replace_package_tools("", "echo 'E: Unable to locate package absent' >&2; exit 100\n")
        done = self.amb("x")
        self.assertEqual(done.returncode, 1)
        self.assertIn("E: Unable to locate package absent", done.stderr)
        self.assertIn("amb-install.log", done.stderr)

    def test_an_unknown_test_label_is_a_usage_error(self):
        done = self.amb("test", "units")
        self.assertEqual(done.returncode, 2)
        self.assertIn("labels: unit loop replay process hardware build", done.stderr)

    def test_help_of_test_runs_no_test(self):
        done = self.amb("test", "--help")
        self.assertEqual(done.returncode, 0)
        self.assertIn("./amb test LABEL...", done.stdout)
        self.assertFalse((self.root / "build").exists())


if __name__ == "__main__":
    unittest.main()

"""scripts/tidy.py with an invented clang-tidy: what is looked at, what is not looked at again."""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["LEVITAS_SOURCE"])
COMPILER = shutil.which("c++")
SKIP_STATUS = 77


ALL = {"law/header.hpp", "law/law.cpp", "rotor/rotor.cpp"}


class TidyCache(unittest.TestCase):
    def setUp(self):
        self.root = Path(tempfile.mkdtemp()).resolve()
        self.addCleanup(shutil.rmtree, self.root)
        (self.root / "scripts").mkdir()
        shutil.copy(SOURCE / "scripts/tidy.py", self.root / "scripts")
        self.write(".clang-tidy", "Checks: '-*'\n")
        self.write("law/header.hpp", "int Gain();\n")
        self.write("law/law.cpp", '#include "header.hpp"\nint Gain() { return 1; }\n')
        self.write("rotor/rotor.cpp", "int Modes() { return 8; }\n")
        self.write("tests/law_test.cpp", "int main() {}\n")
        self.write("build/tidy/generated.cpp", "int Generated() { return 0; }\n")
        names = ("law/law.cpp", "rotor/rotor.cpp", "tests/law_test.cpp", "build/tidy/generated.cpp")
        self.write("build/tidy/compile_commands.json", json.dumps(
            [{"file": str(self.root / name), "directory": str(self.root),
              "command": f"{COMPILER} -o x.o -c {self.root / name}"} for name in names]))
        self.version = "14.0.6"
        self.says()

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def says(self, finding=""):
        """clang-tidy finds `finding` in every file, or nothing."""
        path = self.root / "tools/clang-tidy-14"
        self.write("tools/clang-tidy-14", "#!/bin/sh\n"
                   f'[ "$1" != --version ] || {{ echo "{self.version}"; exit 0; }}\n'
                   'for word; do case "$word" in *.[ch]pp) '
                   f'echo "$word" >> {self.root}/looked_at;; esac; done\n'
                   + (f'echo "{finding}"; exit 1\n' if finding else "exit 0\n"))
        path.chmod(0o755)

    def tidy(self, *words, cache=None):
        """Exit status, output, and the files that were looked at."""
        (self.root / "looked_at").write_text("")
        environment = dict(os.environ, PATH=f"{self.root}/tools:{os.environ['PATH']}",
                           XDG_CACHE_HOME=str(cache or self.root / "cache"))
        done = subprocess.run([sys.executable, "-B", self.root / "scripts/tidy.py", "--jobs", "2",
                               *map(str, words)], capture_output=True, text=True, check=False,
                              env=environment, cwd=self.root)
        looked = set()
        for line in (self.root / "looked_at").read_text().splitlines():
            path = Path(line)
            batch = "headers" in path.parts
            names = re.findall(r'"(.+)"', path.read_text()) if batch else [path]
            looked |= {str(Path(name).relative_to(self.root)) for name in names}
        return done, looked

    def test_looks_at_our_sources_and_headers_not_at_tests_or_generated_code(self):
        self.write("tests/support.hpp", "int Support();\n")
        self.write("build/tidy/generated.hpp", "int Generated();\n")
        done, looked = self.tidy()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(looked, ALL)
        self.assertIn("clang-tidy: 3 files, 0 with findings", done.stdout)

    def test_does_not_look_again_until_text_header_or_settings_change(self):
        self.tidy()
        self.assertEqual(self.tidy()[1], set())
        self.write("rotor/rotor.cpp", "int Modes() { return 9; }\n")
        self.assertEqual(self.tidy()[1], {"rotor/rotor.cpp"})
        self.write("law/header.hpp", "int Gain();\nint More();\n")
        self.assertEqual(self.tidy()[1], {"law/header.hpp", "law/law.cpp"})
        self.write(".clang-tidy", "Checks: 'bugprone-*'\n")
        self.assertEqual(self.tidy()[1], ALL)

    def test_looks_again_when_asked_to_or_when_clang_tidy_or_the_flags_are_others(self):
        self.tidy()
        self.assertEqual(self.tidy("--no-cache")[1], ALL)
        self.version = "14.0.7"
        self.says()
        self.assertEqual(self.tidy()[1], ALL)
        database = self.root / "build/tidy/compile_commands.json"
        database.write_text(database.read_text().replace(" -o ", " -Wall -o "))
        self.assertEqual(self.tidy()[1], ALL)

    def test_a_comment_counts_because_it_may_silence_a_finding(self):
        self.write("rotor/rotor.cpp", "int Modes() { return 8; }  // NOLINT: as it should be\n")
        self.tidy()
        self.write("rotor/rotor.cpp", "int Modes() { return 8; }\n")
        self.assertEqual(self.tidy()[1], {"rotor/rotor.cpp"})

    def test_what_passed_in_one_clone_is_known_in_another(self):
        shared = self.root / "shared"
        self.tidy(cache=shared)
        first = self.root
        self.setUp()
        self.assertNotEqual(self.root, first)
        self.assertEqual(self.tidy(cache=shared)[1], set())
        self.assertEqual(self.tidy(cache=self.root / "own")[1], ALL)

    def test_what_the_repository_records_is_known_without_a_cache_until_its_text_changes(self):
        self.tidy("--record", cache=self.root / "first")
        self.assertEqual(self.tidy(cache=self.root / "second")[1], set())
        self.write("rotor/rotor.cpp", "int Modes() { return 9; }\n")
        self.assertEqual(self.tidy(cache=self.root / "third")[1], {"rotor/rotor.cpp"})

    def test_what_has_a_finding_is_not_recorded(self):
        self.says("header.hpp:1: something is wrong")
        self.tidy("--record")
        self.says()
        self.assertEqual(self.tidy(cache=self.root / "second")[1], ALL)

    def test_a_finding_fails_is_told_once_and_is_looked_at_again(self):
        self.says("header.hpp:1: something is wrong")
        for _ in range(2):
            done, looked = self.tidy()
            self.assertEqual(done.returncode, 1)
            self.assertEqual(done.stdout.count("something is wrong"), 1)
            self.assertIn("3 files, 3 with findings", done.stdout)
            self.assertEqual(looked, ALL)

    def test_looks_only_at_the_files_that_are_named(self):
        self.assertEqual(self.tidy("law/law.cpp")[1], {"law/law.cpp"})
        self.assertEqual(self.tidy("law/header.hpp")[1], {"law/header.hpp"})

    def test_a_header_in_a_folder_without_sources_is_looked_at_as_well(self):
        self.write("units/units.hpp", "double Metres();\n")
        self.assertEqual(self.tidy()[1], ALL | {"units/units.hpp"})

    def test_headers_of_a_folder_are_one_batch_and_each_compiles_by_itself(self):
        self.write("law/gain.hpp", "double Twice(Gain gain);\n")  # wants a type that another declares
        self.write("law/first.hpp", "using Gain = double;\n")
        done, looked = self.tidy()
        self.assertEqual(looked, ALL | {"law/gain.hpp", "law/first.hpp"})
        self.assertEqual(done.returncode, 1)
        self.assertIn("law/gain.hpp does not compile by itself", done.stdout)
        self.write("law/gain.hpp", '#include "first.hpp"\ndouble Twice(Gain gain);\n')
        self.assertEqual(self.tidy()[0].returncode, 0)

    def test_a_named_file_that_is_not_built_is_a_usage_error_not_a_pass(self):
        self.write("law/new.cpp", "int New();\n")
        for name in ("law/new.cpp", "law/misspelt.cpp", "tests/law_test.cpp"):
            with self.subTest(name):
                done, looked = self.tidy(name)
                self.assertEqual((done.returncode, looked), (2, set()))
                self.assertIn(name, done.stderr)

    def test_a_file_that_cannot_be_preprocessed_is_looked_at_every_time(self):
        self.write("law/law.cpp", '#include "nothing.hpp"\n')
        self.tidy()
        self.assertEqual(self.tidy()[1], {"law/law.cpp"})


if __name__ == "__main__":
    if COMPILER is None:
        print("there is no compiler to preprocess with; nothing was checked")
        sys.exit(SKIP_STATUS)
    unittest.main()

"""Every file of ours obeys the rules of source_rules.py, and each rule refuses a seeded violation."""

import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import source_rules as rules

SOURCE = Path(os.environ["LEVITAS_SOURCE"])


def violations(rule, suffixes=rules.CODE):
    return [f"{path.relative_to(SOURCE)}: {found}" for path in rules.source_files(SOURCE, suffixes)
            for found in rule(path.read_text(encoding="utf-8"))]


class Files(unittest.TestCase):
    maxDiff = None

    def assert_none(self, found):
        self.assertFalse(found, "\n" + "\n".join(found))

    def test_none_is_longer_than_400_lines(self):
        self.assert_none(violations(rules.too_long))

    def test_no_comment_is_wider_than_100_columns(self):
        self.assert_none(violations(rules.wide_comments, (".cpp", ".hpp")))

    def test_no_function_is_longer_than_60_lines(self):
        found = violations(rules.long_functions, (".cpp", ".hpp"))
        # Tables of cases are as long as their cases.
        self.assert_none([line for line in found if not line.startswith("tests/")])

    def test_none_keeps_a_note_to_self(self):
        self.assert_none(violations(rules.notes_to_self))

    def test_no_retired_word_comes_back(self):
        found = violations(rules.retired_words, (".cpp", ".hpp", ".md"))
        # The glossary explains them, the changelog says what was renamed, and one function writes
        # keys of version 1.0, which scripts still read.
        allowed = ("docs/conventions.md", "docs/formats.md", "CHANGELOG.md",
                   "report/diagnosis/old_keys.")
        self.assert_none([line for line in found if not line.startswith(allowed)])

    def test_every_test_asserts_something(self):
        self.assert_none(violations(rules.tests_without_assertion, (".cpp",)))

    def test_every_header_says_what_it_is(self):
        self.assert_none(violations(rules.header_without_description, (".hpp",)))

    def test_folders_include_each_other_in_one_direction(self):
        self.assertEqual(rules.folders_in_circles(SOURCE), [])

    def test_messages_are_decoded_in_one_place(self):
        found = violations(rules.decodes_unchecked, (".cpp", ".hpp"))
        # A test may read our own bytes as any other program of LCM does.
        programs = [line.split(":")[0] for line in found if not line.startswith("tests/")]
        self.assertEqual(programs, ["lcmtypes/checked_decode.hpp"])

    def test_what_runs_beside_a_rotor_speaks_through_one_path_that_never_waits(self):
        beside = ("common/", "controller/", "dashboard/", "hil/", "plant_sim/", "programs/", "rt/",
                  "session/", "transport/", "cli/run", "cli/main.cpp", "cli/options/enter_session.cpp")
        found = violations(rules.speaks_past_say, (".cpp", ".hpp"))
        self.assert_none([line for line in found if line.startswith(beside)])


class Tests(unittest.TestCase):
    """How much of the C++ is tests, and which headers none of them names."""

    AIM = 0.8
    LEAST = 0.6  # as far as it has come: it only grows

    # Rooms of which every header with something to be tested is in a test, and what is proven
    # otherwise.
    NAMED = ("controller/loop", "programs", "plant_sim", "report")
    OTHERWISE = {
        "controller/loop/operator_source.hpp": "an interface",
        "programs/controller/controller_run.hpp": "whole processes, tests/process",
        "plant_sim/effect/parameter_kinds.hpp": "words of the catalogue, through its rows",
        "plant_sim/plant/plant_impl.hpp": "private to plant.cpp, through Plant",
    }

    def test_lines_of_tests_over_lines_of_source_do_not_become_less(self):
        tests, source = rules.lines_of(SOURCE, True), rules.lines_of(SOURCE, False)
        print(f"C++: {tests} lines of tests, {source} of source: {tests / source:.3f}, aim {self.AIM}")
        for room in sorted({path.relative_to(SOURCE).parts[0]
                            for path in rules.source_files(SOURCE, (".hpp",))} - {"tests"}):
            print(f"  headers without a test in {room}:", *rules.untested_headers(SOURCE, room))
        self.assertGreaterEqual(tests / source, self.LEAST)

    def test_headers_of_rooms_that_are_named_by_tests_stay_so(self):
        found = {name for room in self.NAMED for name in rules.untested_headers(SOURCE, room)}
        self.assertEqual(found, set(self.OTHERWISE), "write a test, or take the exception off the list")


class Tour(unittest.TestCase):
    """The tours of README.md and docs/tour.md, done in a clone, leave git nothing to report."""

    @unittest.skipUnless((SOURCE / ".git").exists() and shutil.which("git"), "no clone, or no git")
    def test_files_it_writes_at_top_level_are_ignored_and_only_there(self):
        tour = "".join((SOURCE / page).read_text(encoding="utf-8") for page in ("README.md", "docs/tour.md"))
        written = set(re.findall(r"--(?:record|csv|out) ([\w.]+)", tour))
        written |= set(re.findall(r"run_picture.py \S+ (\S+)", tour))
        written |= set(re.findall(r"amb new rig (\w+)", tour))
        self.assertLessEqual({"run.svg", "spindle"}, written)
        for name in sorted(written):
            self.assertTrue(self.ignored(name), name)
            self.assertFalse(self.ignored("docs/" + name), "a file of the project could be lost")

    def ignored(self, name):
        # A folder is one by its slash.
        asked = name if "." in name else name + "/"
        return subprocess.run(["git", "-C", str(SOURCE), "check-ignore", "-q", asked],
                              check=False).returncode == 0


class Names(unittest.TestCase):
    @unittest.skipUnless((SOURCE / ".git").exists() and shutil.which("git"), "no clone, or no git")
    def test_none_reads_as_an_option(self):
        """What a program without options is given after `--help` becomes a file of that name."""
        names = subprocess.run(["git", "-C", str(SOURCE), "ls-files", "-z"], capture_output=True, text=True,
                               check=True).stdout.split("\0")
        self.assertFalse([name for name in names if Path(name).name.startswith("-")])


class Commits(unittest.TestCase):
    # The rule is younger than the project.
    SINCE = "2026-11-23T16:00:00Z"

    @unittest.skipUnless((SOURCE / ".git").exists() and shutil.which("git"), "no clone, or no git")
    def test_the_last_ones_say_what_changed_and_why(self):
        log = subprocess.run(["git", "-C", str(SOURCE), "log", "-50", "--no-merges", "--format=%s%x00%b%x01",
                              f"--since={self.SINCE}"], capture_output=True, text=True, check=True)
        found = []
        for commit in log.stdout.split("\x01"):
            subject, _, body = commit.strip("\n").partition("\0")
            if subject:
                found += rules.refused_message(subject, body)
        self.assertFalse(found, "\n" + "\n".join(found))


class SeededViolations(unittest.TestCase):
    def test_a_retired_word_is_refused_with_the_fields_own(self):
        self.assertEqual(rules.retired_words("gain\n// data Kept back\n"),
                         ["line 2: 'Kept back': say validation data"])
        for name in ("kKeptBack", "KeptBack()", "held_out_nat", "HuntCauses", "Part::kHeldOut",
                     "sharpened", "ExplainStrays"):
            self.assertTrue(rules.retired_words(name), name)
        for name in ("std::remainder(a, b)", "shunt", "HeldCurrents", "out_held", "Sharp", "astray"):
            self.assertFalse(rules.retired_words(name), name)

    def test_a_subject_of_73_characters_or_without_a_reason_is_refused(self):
        self.assertTrue(rules.refused_message("a" * 73, "why"))
        self.assertTrue(rules.refused_message("a" * 72, "\n"))
        self.assertFalse(rules.refused_message("a" * 72, "why"))

    def test_401_lines_are_refused_and_400_are_not(self):
        self.assertTrue(rules.too_long("x\n" * 401))
        self.assertFalse(rules.too_long("x\n" * 400))

    def test_a_comment_of_101_columns_is_refused_and_one_of_100_is_not(self):
        self.assertIn("line 2", rules.wide_comments("\n  // " + 96 * "x" + "\n")[0])
        self.assertFalse(rules.wide_comments("  // " + 95 * "x" + "\n"))

    def test_a_function_of_61_lines_is_refused_and_one_of_60_is_not(self):
        head = "namespace a {\nint Sum(int first,\n        int second) {\n"
        self.assertEqual(rules.long_functions(head + "  x();\n" * 61 + "}\n}\n"),
                         ["line 2: a function of 61 lines, allowed 60"])
        self.assertFalse(rules.long_functions(head + "  x();\n" * 60 + "}\n}\n"))
        method = "class A {\n public:\n  void B() {\n"
        self.assertTrue(rules.long_functions(method + "    x();\n" * 61 + "  }\n};\n"))

    def test_a_note_to_self_is_found_with_its_line(self):
        self.assertIn("line 2", rules.notes_to_self("int a;\n// TO" "DO: later\n")[0])
        self.assertFalse(rules.notes_to_self("the todo list of a user\n"))

    def test_a_test_that_only_computes_is_named(self):
        text = "TEST(Pid, Works) {\n  if (true) { Step(); }\n}\nTEST(Pid, Holds) {\n  EXPECT_EQ(1, 1);\n}\n"
        self.assertEqual(rules.tests_without_assertion(text), ["Pid.Works asserts nothing"])

    def test_an_asserting_helper_counts(self):
        self.assertFalse(rules.tests_without_assertion("TEST(A, B) { ExpectClose(1, 2); }\n"))

    def test_a_decoder_that_believes_what_it_reads_is_refused(self):
        for call in ("state.decode(data, 0, size)", "state->decode(data, 0, size)"):
            self.assertIn("line 2", rules.decodes_unchecked(f"\nif ({call} < 0) return;\n")[0])
        self.assertFalse(rules.decodes_unchecked("if (DecodeChecked(bytes, m)) return codec.Decode(b);\n"))

    def test_a_text_that_goes_past_the_one_path_is_refused(self):
        for call in ('fmt::print(stderr, "x");', 'std::cerr << "x";', 'perror("x");'):
            self.assertIn("line 2", rules.speaks_past_say(f"\n  {call}\n")[0])
        self.assertFalse(rules.speaks_past_say("// not to stderr\nrt::Say(text);  // to stderr\n"))

    def test_a_header_with_a_body_or_a_source_that_no_test_includes_is_found(self):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for name, text in (("room/data.hpp", "struct A {\n  double x{};\n};\n"),
                               ("room/inline.hpp", "inline int B() { return 1; }\n"),
                               ("room/declared.hpp", "int C();\n"), ("room/declared.cpp", "int C() { return 1; }\n"),
                               ("room/tested.hpp", "inline int D() noexcept { return 1; }\n"),
                               ("tests/unit/room/tested_test.cpp", '#include "room/tested.hpp"\n')):
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text, encoding="utf-8")
            self.assertEqual(rules.untested_headers(root, "room"), ["room/declared.hpp", "room/inline.hpp"])
            self.assertEqual((rules.lines_of(root, True), rules.lines_of(root, False)), (1, 7))

    def test_folders_that_include_each_other_are_found_and_who_stands_on_them_is_not(self):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for name, includes in (("ground/a.hpp", ()), ("first/b.hpp", ("ground/a.hpp", "second/c.hpp")),
                                   ("second/c.hpp", ("third/d.hpp",)), ("third/d.hpp", ("first/b.hpp",)),
                                   ("roof/e.cpp", ("first/b.hpp", "not_ours.hpp"))):
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text("".join(f'#include "{i}"\n' for i in includes), encoding="utf-8")
            self.assertEqual(rules.folders_in_circles(root), ["first", "second", "third"])
            (root / "third/d.hpp").write_text("", encoding="utf-8")
            self.assertEqual(rules.folders_in_circles(root), [])

    def test_a_header_without_words_is_refused(self):
        self.assertTrue(rules.header_without_description("#pragma once\n\n#include <vector>\n"))
        self.assertTrue(rules.header_without_description("// words\n#pragma once\n"))
        self.assertFalse(rules.header_without_description("#pragma once\n// What it is.\n"))


if __name__ == "__main__":
    unittest.main()

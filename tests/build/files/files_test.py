"""Every file of ours obeys the rules of source_rules.py, and each rule refuses a seeded violation."""

import os
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

    def test_none_keeps_a_note_to_self(self):
        self.assert_none(violations(rules.notes_to_self))

    def test_every_test_asserts_something(self):
        self.assert_none(violations(rules.tests_without_assertion, (".cpp",)))

    def test_every_header_says_what_it_is(self):
        self.assert_none(violations(rules.header_without_description, (".hpp",)))


class SeededViolations(unittest.TestCase):
    def test_401_lines_are_refused_and_400_are_not(self):
        self.assertTrue(rules.too_long("x\n" * 401))
        self.assertFalse(rules.too_long("x\n" * 400))

    def test_a_note_to_self_is_found_with_its_line(self):
        self.assertIn("line 2", rules.notes_to_self("int a;\n// TO" "DO: later\n")[0])
        self.assertFalse(rules.notes_to_self("the todo list of a user\n"))

    def test_a_test_that_only_computes_is_named(self):
        text = "TEST(Pid, Works) {\n  if (true) { Step(); }\n}\nTEST(Pid, Holds) {\n  EXPECT_EQ(1, 1);\n}\n"
        self.assertEqual(rules.tests_without_assertion(text), ["Pid.Works asserts nothing"])

    def test_an_asserting_helper_counts(self):
        self.assertFalse(rules.tests_without_assertion("TEST(A, B) { ExpectClose(1, 2); }\n"))

    def test_a_header_without_words_is_refused(self):
        self.assertTrue(rules.header_without_description("#pragma once\n\n#include <vector>\n"))
        self.assertTrue(rules.header_without_description("// words\n#pragma once\n"))
        self.assertFalse(rules.header_without_description("#pragma once\n// What it is.\n"))


if __name__ == "__main__":
    unittest.main()

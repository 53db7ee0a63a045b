"""Every field of every message carries its unit; a seeded bad message proves that the check bites."""

import os
import pathlib
import re
import unittest

import message_check

SOURCE = pathlib.Path(os.environ.get("LEVITAS_SOURCE", pathlib.Path(__file__).parents[3]))
MESSAGES = sorted((SOURCE / "lcmtypes").glob("*.lcm"))


class Messages(unittest.TestCase):
    def test_every_field_of_every_message_carries_its_unit(self):
        self.assertGreater(len(MESSAGES), 0)
        problems = []
        fields = 0
        for path in MESSAGES:
            count, found = message_check.check(path.read_text(), path.name)
            fields += count
            problems += found
        self.assertEqual(problems, [])
        print(f"{fields} fields of {len(MESSAGES)} messages carry a unit")

    def test_every_message_names_its_channel(self):
        for path in MESSAGES:
            self.assertRegex(path.read_text(), r"Channel LEVITAS_[A-Z]+", path.name)

    def test_every_message_is_generated(self):
        listed = (SOURCE / "lcmtypes" / "CMakeLists.txt").read_text()
        for path in MESSAGES:
            self.assertIn(path.name, listed)

    def test_every_message_is_in_the_document_of_formats(self):
        document = (SOURCE / "docs" / "formats.md").read_text()
        for path in MESSAGES:
            self.assertIn(f"`{path.stem}`", document)


class SeededBadMessage(unittest.TestCase):
    def setUp(self):
        path = pathlib.Path(__file__).with_name("seeded_bad.lcm")
        _, self.problems = message_check.check(path.read_text(), path.name)

    def lines(self):
        return [int(re.match(r"seeded_bad\.lcm:(\d+):", text)[1]) for text in self.problems]

    def test_every_bad_line_is_found_and_no_other(self):
        self.assertEqual(self.lines(), [6, 7, 8, 9, 10, 11, 12])

    def test_each_sentence_says_what_is_wrong(self):
        expected = [
            "position_m has no unit",
            "current_a has no unit",
            "speed_rad_per_s has the unknown unit [rpm]",
            "gap_m says [A], its name says [m]",
            "mode has a unit but no words",
            "a has no unit",
            "not one field with its comment",
        ]
        self.assertEqual(len(self.problems), len(expected))
        for sentence, text in zip(expected, self.problems):
            self.assertIn(sentence, text)

    def test_an_empty_message_is_a_problem(self):
        self.assertEqual(message_check.check("package p;\n", "e.lcm")[1], ["e.lcm: no field found"])


if __name__ == "__main__":
    unittest.main(verbosity=2)

"""docs/sources.md is what scripts/sources.py writes, and the data file may not claim what it lacks."""

import copy
import os
import sys
import unittest
from pathlib import Path

SOURCE = Path(os.environ["LEVITAS_SOURCE"])
sys.path.insert(0, str(SOURCE / "scripts"))
import sources  # noqa: E402
import sources_figures  # noqa: E402
import sources_rows  # noqa: E402

COMMAND = {"name": "modes", "run": "amb modes"}
ROW = {"says": "Two modes.", "commands": ["modes"],
       "figures": [{"take": "modes.f", "ours": [90.1, 252.0], "theirs": [90, 252]}]}
SMALL = {"tolerances": {"computed": 0.01}, "command": [COMMAND],
         "work": [{"name": "Work", "title": "A work.", "row": [ROW]}]}


def small(**changes):
    """The small file with keys of its row changed; None takes one away."""
    data = copy.deepcopy(SMALL)
    row = data["work"][0]["row"][0]
    row |= changes
    for key in [key for key in row if row[key] is None]:
        del row[key]
    return data


class Page(unittest.TestCase):
    maxDiff = None

    def test_is_the_committed_one(self):
        written = sources_rows.page(sources_rows.load())
        self.assertEqual(sources_rows.PAGE.read_text(encoding="utf-8").splitlines(),
                         written.splitlines(), "scripts/sources.py writes it")

    def test_shows_ours_and_theirs_and_the_state(self):
        text = sources_rows.page(small())
        self.assertIn("| Two modes. | `amb modes` | 90.1, 252 | 90, 252 | **reproduced** |", text)
        self.assertIn("1 rows: 1 reproduced, 0 differs, 0 not done", text)


class Claims(unittest.TestCase):
    def refused(self, words, data):
        with self.assertRaisesRegex(sources_rows.Refused, words):
            sources_rows.check(data)

    def test_a_figure_that_is_not_the_sources_needs_a_reason(self):
        off = {"figures": [{"take": "modes.f", "ours": 2.0, "at_most": 1.9}]}
        self.refused("say why in differs", small(**off))
        sources_rows.check(small(**off, differs="another rig"))

    def test_a_row_without_a_figure_or_a_reason_is_refused(self):
        self.refused("no figure of ours", small(figures=None))
        sources_rows.check(small(figures=[{"take": "modes.f", "ours": 1.0}]))

    def test_a_figure_that_nobody_measured_is_refused(self):
        self.refused("is not measured", small(figures=[{"take": "modes.f", "ours": []}]))

    def test_what_is_not_done_has_no_figure(self):
        self.refused("beside figures", small(not_done="no time"))

    def test_a_command_that_is_not_there_or_not_used_is_refused(self):
        self.refused("no command is named poles", small(commands=["poles", "modes"]))
        self.refused("used by no row", small(commands=None, figures=None, not_done="no rig"))


class Figures(unittest.TestCase):
    LEFT = {"modes": sources_figures.Fields(f=[90.1, 252.04], printed="peak 2.5 um")}

    def test_are_taken_from_json_and_text(self):
        for take, value in (("modes.f", [90.1, 252.04]), ("max(modes.f)", 252.04),
                            ("number(modes.printed, r'peak (\\S+)')", 2.5)):
            self.assertEqual(sources_figures.take({"take": take}, self.LEFT, "."), value)

    def test_beyond_the_tolerance_are_told_and_within_it_are_not(self):
        for ours, told in (([90.1, 252.0], 0), ([90.1, 260.0], 1), ([90.1], 1)):
            row = small(figures=[{"take": "modes.f", "ours": ours}])["work"][0]["row"][0]
            self.assertEqual(len(sources_figures.differences(row, self.LEFT, SMALL, ".")), told, ours)

    def test_measuring_writes_them_in_their_place(self):
        data = small()
        text = 'take = "modes.f", ours = [], theirs = [90, 252]'
        written, failed = sources.measured(text, data, self.LEFT, ".")
        self.assertEqual(written, 'take = "modes.f", ours = [90.1, 252.04], theirs = [90, 252]')
        self.assertEqual(failed, [])
        self.assertEqual(sources.measured(text, data, {}, ".")[0], text)

    def test_that_cannot_be_taken_are_told_and_stay(self):
        data = small(figures=[{"take": "modes.g", "ours": 1.0}])
        written, failed = sources.measured("ours = 1", data, self.LEFT, ".")
        self.assertEqual(written, "ours = 1")
        self.assertIn("modes.g", failed[0])


if __name__ == "__main__":
    unittest.main()

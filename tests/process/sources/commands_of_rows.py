"""Runs commands of docs/sources.toml and compares the figures of every row that needs no others."""

import os
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["LEVITAS_SOURCE"])
sys.path.insert(0, str(SOURCE / "scripts"))
sys.path.insert(0, str(SOURCE / "tests/support"))
import sources_figures  # noqa: E402
import sources_rows  # noqa: E402

DATA = sources_rows.load()
SLOW = sources_rows.slow_ones(DATA)


def needed_by(judged):
    """The commands of every row that needs one of these, and all that must run before them."""
    found = set(judged).union(*(row["commands"] for row in sources_rows.rows(DATA)
                                if judged & set(row.get("commands", []))))
    for command in reversed(DATA["command"]):
        if command["name"] in found:
            found |= set(command.get("after", []))
    return found


class CommandsOfRows(unittest.TestCase):
    names = set()  # of the commands that are run
    judged = set()  # a row is judged that needs one of these

    def test_every_figure_is_what_the_command_prints(self):
        with tempfile.TemporaryDirectory() as folder:
            left = sources_figures.run_all(DATA, folder,
                                           lambda command: command["name"] in self.names)
            self.assertEqual(set(left), self.names)
            for row in sources_rows.rows(DATA):
                needed = set(row.get("commands", []))
                if needed & self.judged and needed <= self.names:
                    with self.subTest(row["says"][:60]):
                        self.assertEqual(sources_figures.differences(row, left, DATA, folder), [],
                                         "scripts/sources.py --measure writes the new figures")

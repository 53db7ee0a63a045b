"""Every quick command of docs/sources.toml works, and prints the figures that docs/sources.md shows."""

import unittest

from commands_of_rows import DATA, SLOW, CommandsOfRows
from lcm_network import run
from sources_rows import rows


class QuickCommands(CommandsOfRows):
    names = judged = {command["name"] for command in DATA["command"]} - SLOW

    def test_of_the_rows_that_are_not_compared_here(self):
        """They are named as skipped, so that nobody takes them for passed."""
        left_out = [row for row in rows(DATA) if set(row.get("commands", [])) & SLOW]
        for row in left_out:
            with self.subTest(row["says"]):
                self.skipTest(f"not run, slow: {', '.join(row['commands'])}: process.sources_slow with "
                              "LEVITAS_SLOW_SOURCES=1")
        self.assertLess(len(left_out), len(rows(DATA)) / 3, "most rows must be compared by default")


del CommandsOfRows  # it has no commands of its own

if __name__ == "__main__":
    run()

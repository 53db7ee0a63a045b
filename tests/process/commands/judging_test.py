"""amb bench diagnosis --sweep and --constants: the numbers that decide, and what they do."""

import unittest

from command import BAD_INPUT, DONE, SOURCE, USAGE, CommandTest, amb


class Judging(CommandTest):
    def test_the_last_chapter_of_the_results_is_current(self):
        done = amb(self.folder, "bench", "diagnosis", "--constants")
        self.assertEqual(done.returncode, DONE, done.stderr)
        title, _, table = done.stdout.partition("\n")
        committed = (SOURCE / "docs/diagnosis_results.md").read_text(encoding="utf-8")
        chapter = committed.partition(f"\n#{title}\n")[2]
        self.assertEqual(table.splitlines(), chapter.splitlines(),
                         "docs/diagnosis_results.md ends with `amb bench diagnosis --constants`")

    def test_a_sweep_changes_what_is_said_of_a_healthy_rig(self):
        """Where no deviation is chance, what noise leaves is unknown although nothing is hidden."""
        done = amb(self.folder, "bench", "diagnosis", "--quick", "--clean", "1", "--first", "1003",
                   "--bits", "700", "--sweep", "unexplained_sigma=0,15")
        self.assertEqual(done.returncode, DONE, done.stderr)
        rows = [line.split() for line in done.stdout.splitlines()[-2:]]
        self.assertEqual([(row[0], row[3:6]) for row in rows],
                         [("0", ["0", "of", "1"]), ("15", ["1", "of", "1"])])

    def test_refuses_what_it_does_not_know(self):
        for text, status in (("decisive_nat", USAGE), ("decisive_nat=", USAGE),
                             ("decisive_nat=two", USAGE), ("nat=2", BAD_INPUT)):
            done = amb(self.folder, "bench", "diagnosis", "--clean", "1", "--sweep", text)
            self.assertEqual(done.returncode, status, text + done.stderr)


if __name__ == "__main__":
    unittest.main()

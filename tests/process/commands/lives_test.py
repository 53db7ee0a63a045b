"""amb bench lives: drawn faults in virtual time; the harm without a protection, none with it."""

import json
import unittest

from command import BAD_INPUT, DONE, OTHER, SOURCE, USAGE, CommandTest, amb

COMMISSIONED = SOURCE / "config/controllers/flexible_rotor_commissioned.yaml"
STUCK = ("bench", "lives", "--first", "119", "--seeds", "1", "--seconds", "5")  # a stuck sensor


class Lives(CommandTest):
    def test_one_life_tells_its_story(self):
        done = amb(self.folder, *STUCK, "--json", "lives.json")
        self.assertEqual(done.returncode, DONE, done.stdout + done.stderr)
        self.assertIn("seed 119 (position_stuck): no harm", done.stdout)
        self.assertIn("stuck at", done.stdout)
        told = json.loads((self.folder / "lives.json").read_text())
        self.assertEqual((told["failed"], len(told["lives"])), (0, 1))
        self.assertEqual(told["lives"][0]["fault"], "sensor_frozen")
        self.assertEqual(told["lives"][0]["releases"], 1)

    def test_a_life_that_fails_has_a_line_and_status_1(self):
        text = COMMISSIONED.read_text()
        self.assertIn("sensor_frozen_cycles: 50 ", text)
        (self.folder / "blind.yaml").write_text(
            text.replace("sensor_frozen_cycles: 50 ", "sensor_frozen_cycles: 1000000 "))
        done = amb(self.folder, *STUCK, "--controller", "blind.yaml", "--json", "lives.json")
        self.assertEqual(done.returncode, OTHER, done.stdout + done.stderr)
        self.assertIn("seed 119 (position_stuck): touched_under_current at ", done.stdout)
        told = json.loads((self.folder / "lives.json").read_text())
        self.assertEqual(told["failed"], 1)
        self.assertEqual(told["lives"][0]["harms"][0]["harm"], "touched_under_current")

    def test_rows_do_not_depend_on_the_number_of_jobs(self):
        one, two = (amb(self.folder, "bench", "lives", "--seeds", "4", "--seconds", "4", "--jobs", n)
                    for n in (1, 2))
        self.assertEqual((one.returncode, two.returncode), (DONE, DONE), one.stdout)
        self.assertEqual(one.stdout, two.stdout)

    def test_refuses_what_it_cannot_run(self):
        for words, status in ((("--seeds", "0"), USAGE), (("--seconds", "0"), USAGE),
                              (("--rig", "absent.yaml"), BAD_INPUT),
                              (("--controller", "absent.yaml"), BAD_INPUT)):
            done = amb(self.folder, "bench", "lives", *words)
            self.assertEqual(done.returncode, status, (words, done.stderr))


if __name__ == "__main__":
    unittest.main()

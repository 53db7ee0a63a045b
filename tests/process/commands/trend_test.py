"""amb trend refuses sessions from which no trend can be read: out of order, twice, of another rig."""

import unittest

from command import BAD_INPUT, DONE, USAGE, CommandTest, amb

RIG = ("--rig", "geared_rotor_4dof")


class Trend(CommandTest):
    def setUp(self):
        super().setUp()
        for name in ("older", "newer"):
            done = amb(self.folder, "run", *RIG, "--duration", "0.5", "--record", f"{name}.lcm", "--no-dash")
            self.assertIn(f"{name}.lcm", done.stdout + done.stderr)

    def trend(self, *arguments):
        done = amb(self.folder, "trend", *arguments)
        return done.returncode, done.stderr

    def test_sessions_stand_in_order_of_time_and_once_each(self):
        status, said = self.trend("newer.lcm", "older.lcm")
        self.assertEqual(status, USAGE, said)
        self.assertIn("older.lcm was recorded before newer.lcm", said)
        status, said = self.trend("older.lcm", "older.lcm")
        self.assertEqual(status, USAGE, said)
        self.assertIn("are the same run", said)
        # In order they are taken, and refused for what they do not hold.
        status, said = self.trend("older.lcm", "newer.lcm", "--speed-rpm", "1740")
        self.assertEqual(status, BAD_INPUT, said)
        self.assertIn("older.lcm: --speed-rpm 1740 is not held for 5 repeats of all wheels", said)
        self.assertIn("it holds none", said)

    def test_a_rig_that_is_not_the_sessions_is_warned_of(self):
        _, said = self.trend("older.lcm", "newer.lcm", *RIG)
        self.assertNotIn("warning", said)
        (self.folder / "stiffer.yaml").write_text(self.stiffer())
        _, said = self.trend("older.lcm", "newer.lcm", "--rig", "stiffer.yaml")
        self.assertIn("warning: older.lcm was recorded with another rig than --rig", said)
        self.assertIn("stiffness", said)

    def stiffer(self):
        done = amb(self.folder, "run", *RIG, "--duration", "0.1", "--write-rig", "own.yaml", "--no-dash")
        self.assertIn(done.returncode, (DONE, 1), done.stderr)
        text = (self.folder / "own.yaml").read_text()
        at = text.index("stiffness_n_per_m: ", text.index("gears:"))
        value = text[at:].split("\n")[0].split(": ")[1].split(",")[0].rstrip("}")
        return text[:at] + text[at:].replace(value, str(1.5 * float(value)), 1)


if __name__ == "__main__":
    unittest.main()

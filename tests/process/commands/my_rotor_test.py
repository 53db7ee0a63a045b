"""docs/my_rotor.md, command by command: from six numbers to an accepted run at 12 000 rpm."""

import json
import math
import os
import pty
import subprocess
import unittest

from command import BAD_INPUT, BINARIES, DONE, LIMIT_S, SOURCE, USAGE, CommandTest, amb

import page  # of tests/support

PAGE = (SOURCE / "docs/my_rotor.md").read_text()
SIX = ("--mass-kg", "8", "--length-mm", "300", "--speed-rpm", "3000", "--gap-mm", "0.4", "--bias-a",
       "2", "--ki-n-per-a", "60")


class MyRotor(CommandTest):
    def test_page_says_what_its_commands_do(self):
        steps = page.steps(PAGE)
        self.assertGreaterEqual(len(steps), 4, "the page is no longer read as it is written")
        for commands, lines in steps:
            status, printed = page.run(commands, self.folder, BINARIES)
            self.assertEqual(status, 0, commands + printed)
            self.assertIsNone(page.missing(lines, printed), commands + printed)

    def test_stable_loop_is_run_without_a_warning(self):
        self.compute("new", "rig", "own", *SIX)
        done = amb(self.folder, "run", "--rig", "own/own.yaml", "--duration", "0.5")
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.assertNotIn("unstable", done.stderr)

    def test_files_that_are_there_are_kept(self):
        _, made = self.compute("new", "rig", "own", *SIX)
        self.assertTrue(made["stable"])
        before = (self.folder / made["rig"]).read_text()
        self.refuse(USAGE, "--overwrite", "new", "rig", "own", *SIX, "--vertical")
        self.assertEqual((self.folder / made["rig"]).read_text(), before)
        self.compute("new", "rig", "own", *SIX, "--vertical", "--overwrite")
        self.assertIn("acceleration_m_per_s2: 0 ", (self.folder / made["rig"]).read_text())

    def test_strength_of_a_magnet_is_ki_or_ks_or_turns(self):
        without_ki = SIX[:-2]
        _, made = self.compute("new", "rig", "own", *without_ki, "--ks-n-per-m", "3e5")
        self.assertAlmostEqual(made["ki_n_per_a"], 60.0)  # ks gap / bias
        _, coil = self.compute("new", "rig", "coil", *without_ki, "--turns", "100",
                               "--pole-area-mm2", "200")
        # ki = mu0 n^2 A i0 cos(a) / s^2 with the gap s at the poles; along the axis it is s / cos(a).
        along = math.cos(math.radians(22.5))
        ki = 4e-7 * math.pi * 100**2 * 200e-6 * 2 * along / 0.4e-3**2
        self.assertAlmostEqual(coil["ki_n_per_a"], ki, delta=1e-6 * ki)
        self.assertAlmostEqual(coil["ks_n_per_m"], ki * 2 * along / 0.4e-3, delta=1.0)
        # The rig file has the coil itself, and the same magnet comes of it.
        magnet = self.compute("modes", "--rig", coil["rig"])[1]["bearings"][0]
        self.assertAlmostEqual(magnet["ki_n_per_a"], ki, delta=1e-4 * ki)

    def test_a_terminal_is_asked_for_what_is_missing(self):
        ours, theirs = pty.openpty()
        try:
            os.write(ours, b"heavy\n8\n60\n")
            asked = SIX[2:-2]  # all but mass and ki
            done = subprocess.run([str(BINARIES / "amb"), "new", "rig", "own", *asked],
                                  cwd=self.folder, stdin=theirs, stderr=theirs, text=True,
                                  stdout=subprocess.PIPE, timeout=LIMIT_S, check=False)
            told = os.read(ours, 4096).decode()
        finally:
            os.close(ours)
            os.close(theirs)
        self.assertEqual(done.returncode, DONE, told)
        self.assertIn("mass of all that turns [kg]", told)
        self.assertIn("found 'heavy', allowed: 0.01 to 50000", told)
        self.assertIn("rig own, 8 kg on 300 mm", done.stdout)

    def test_what_is_missing_is_named_at_once(self):
        told = self.refuse(USAGE, "missing:", "new", "rig", "own", *SIX[:4])
        self.assertIn("--speed-rpm --gap-mm --bias-a --ki-n-per-a", told)

    def test_what_no_rotor_is_is_refused_and_leaves_nothing(self):
        for status, words, options in (
                (BAD_INPUT, "the discs have 9 kg", ("--disc", "100:9:50")),
                (BAD_INPUT, "magnet cannot carry the rotor", ("--mass-kg", "800")),
                (BAD_INPUT, "allowed 0 to 300 mm", ("--disc", "400:1:50")),
                (BAD_INPUT, "must lie behind", ("--bearings-mm", "200,100")),
                (USAGE, "Z_MM:MASS_KG:DIAMETER_MM", ("--disc", "100:1")),
                (USAGE, "allowed: 0.01 to 50000", ("--mass-kg", "nan")),
                (USAGE, "excludes", ("--ks-n-per-m", "1e5"))):
            given = SIX if options[0] != "--mass-kg" else SIX[2:]
            self.refuse(status, words, "new", "rig", "own", *given, *options)

    def test_impossible_strength_is_told_of_its_options_and_of_no_file(self):
        short = SIX[:-4]  # without bias and ki
        bias, ki = ("--bias-a", "2"), ("--ki-n-per-a", "60")
        coil = ("--turns", "10000", "--pole-area-mm2", "1e6")
        for status, words, options in (
                (USAGE, "--bias-a: found '500', allowed: 0.01 to 100", ("--bias-a", "500", *ki)),
                # ki = k 4 bias / gap^2 of the least force constant, 1e-9 N m^2/A^2
                (BAD_INPUT, "--ki-n-per-a 0.01: found a magnet of 0.01 N/A, allowed 0.05 to 1e+05 N/A",
                 (*bias, "--ki-n-per-a", "0.01", "--vertical")),
                (BAD_INPUT, "--ks-n-per-m 1: found a magnet of 0.0002 N/A",
                 (*bias, "--ks-n-per-m", "1", "--vertical")),
                (BAD_INPUT, "--turns 10000 --pole-area-mm2 1e+06: found", (*bias, *coil)),
                # 7850 kg/m3 of steel: a bar of 300 mm that weighs 50 000 kg is 5.2 m thick
                (BAD_INPUT, "found a steel shaft of 5199 mm diameter, allowed 0.1 to 5000 mm",
                 (*bias, *ki, "--mass-kg", "50000", "--vertical"))):
            given = short if "--mass-kg" not in options else short[2:]
            told = self.refuse(status, words, "new", "rig", "own", *given, *options)
            self.assertNotIn("own.yaml", told)

    def test_what_no_file_can_hold_is_led_back_to_the_options(self):
        thin = ("--mass-kg", "0.01", "--length-mm", "20000", *SIX[4:], "--vertical")
        told = self.refuse(BAD_INPUT, "no file is written. Change the options", "new", "rig", "own", *thin)
        self.assertIn("frequency_hz", told)

    def test_another_rig_names_files_of_its_own_folder(self):
        self.compute("new", "rig", "own", *SIX)
        (self.folder / "elsewhere").mkdir()
        out = self.folder / "margins.json"
        done = amb(self.folder / "elsewhere", "margins", "--rig", "../own/own.yaml", "--json", out)
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.assertIn("own_controller.yaml", done.stdout)
        self.assertTrue(json.loads(out.read_text())["speeds"][0]["stable"])


if __name__ == "__main__":
    unittest.main()

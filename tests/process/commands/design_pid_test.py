"""amb design pid: what it writes is accepted and taken by other commands; what misses a limit is named."""

import json
import re
import signal
import unittest

from command import BAD_INPUT, DONE, OTHER, USAGE, CommandTest, amb
from lcm_network import Process

# The one-axis rig is designed in a tenth of a second.
QUICK = ("design", "pid", "--rig", "one_axis", "--evaluations", "300", "--draws", "1")


class DesignPid(CommandTest):
    def call(self, *arguments, status=DONE):
        done = amb(self.folder, *arguments)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def test_what_it_writes_is_accepted_and_margins_say_the_same(self):
        said = self.call(*QUICK, "--out", "law.yaml", "--json", "law.json", "--html", "law.html").stdout
        self.assertIn("ACCEPTED", said)
        self.assertTrue((self.folder / "law.yaml").read_text().startswith("# amb design pid: accepted"))
        design = json.loads((self.folder / "law.json").read_text())
        self.call("margins", "--rig", "one_axis", "--controller", "law.yaml", "--json", "margins.json")
        margins = json.loads((self.folder / "margins.json").read_text())
        peak = margins["speeds"][0]["axes"][0]["sensitivity_peak"]
        reached = next(r["reached"] for r in design["requirements"] if r["name"] == "|S| of an axis")
        # The search's own peak is a parabola through its grid.
        self.assertAlmostEqual(reached, peak, delta=0.02 * peak)
        self.assertIn("<svg", (self.folder / "law.html").read_text())

    def test_the_same_seed_writes_the_same_law(self):
        texts = []
        for name in ("a.yaml", "b.yaml"):
            self.call(*QUICK, "--out", name)
            texts.append((self.folder / name).read_text())
        self.assertEqual(*texts)

    def test_a_limit_out_of_reach_is_named_and_nothing_is_written(self):
        before = self.files()
        # Holding the mass needs Kp > ks/ki = 1000 A/m, which makes 0.5 mA of 0.5 um of noise.
        done = self.call(*QUICK, "--noise-current", "0.0001", "--out", "law.yaml", "--json", "law.json",
                         "--html", "law.html", status=OTHER)
        self.assertRegex(done.stderr, r"^amb: the requirements are not met together; the nearest law "
                                      r"misses current of noise, rms [\d.]+ A \(limit 0\.000 A\)")
        self.assertEqual(self.files(), before)

    def test_a_law_that_its_check_refuses_is_written_beside(self):
        # Met by what the search was asked, refused by a stricter judge.
        done = self.call(*QUICK, "--corner-sensitivity", "4", "--most-sensitivity", "1.01", "--out",
                         "law.yaml", status=OTHER)
        self.assertIn("NOT ACCEPTED: |S| reaches", done.stdout)
        self.assertFalse((self.folder / "law.yaml").exists())
        self.assertIn("NOT ACCEPTED", (self.folder / "law.rejected.yaml").read_text())

    def test_corners_and_mu_are_limits_where_they_are_asked_for(self):
        check = ("design", "check", "--rig", "one_axis", "--draws", "1", "--corners", "4")
        self.call(*check)
        for option, said in (("--most-corner-sensitivity", "in a corner; allowed 1.01"),
                             ("--most-mu", "mu reaches")):
            done = self.call(*check, option, "1.01" if "corner" in option else "0.01", status=OTHER)
            self.assertIn("NOT ACCEPTED: ", done.stdout)
            self.assertIn(said, done.stdout)

    def test_ctrl_c_judges_the_best_so_far(self):
        process = Process(self.folder, "amb", *QUICK[:4], "--evaluations", "1000000", "--draws", "1",
                          "--out", "law.yaml")
        self.addCleanup(process.kill)
        process.says("rig one_axis")
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.status(), DONE)
        self.assertIn("ended by a signal", process.text)
        self.assertTrue((self.folder / "law.yaml").exists())

    def test_translation_and_tilt_have_gains_of_their_own_in_one_law(self):
        said = self.call("design", "pid", "--rig", "flexible_rotor", "--tilt", "--evaluations", "600", "--draws",
                         "1", "--corners", "1", "--out", "tilt.yaml", "--json", "tilt.json", "--html",
                         "tilt.html").stdout
        self.assertRegex(said, r"law +translation Kp [\d.]+ A/m.*; tilt Kp [\d.]+ A/m")
        channels = json.loads((self.folder / "tilt.json").read_text())["channels"]
        self.assertEqual([channel["name"] for channel in channels], ["translation", "tilt"])
        self.assertIn(f"translation Kp {channels[0]['kp_a_per_m']:.6g} A/m",
                      (self.folder / "tilt.yaml").read_text().splitlines()[0])
        self.assertIn("STABLE", self.call("margins", "--rig", "flexible_rotor", "--controller",
                                          "tilt.yaml").stdout)

    def test_translation_and_tilt_are_refused_for_a_rig_without_them(self):
        before = self.files()
        for rig in ("one_axis", "geared_rotor_4dof"):
            done = self.call("design", "pid", "--rig", rig, "--tilt", "--out", "law.yaml", status=OTHER)
            self.assertIn("leave out --tilt", done.stderr)
        self.assertEqual(self.files(), before)

    def test_a_wrong_number_is_usage_and_a_rig_that_is_not_there_bad_input(self):
        self.call("design", "pid", "--sensitivity", "0.5", status=USAGE)
        done = self.call("design", "pid", "--rig", "absent", status=BAD_INPUT)
        self.assertTrue(re.search("absent", done.stderr))


if __name__ == "__main__":
    unittest.main()

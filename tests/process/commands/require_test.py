"""--require: what a script asks, told by exit status 5 after everything else was printed and written."""

import json
import unittest

from command import DONE, SOURCE, USAGE, CommandTest, amb

NOT_MET = 5


class Require(CommandTest):
    def call(self, *arguments, status=DONE):
        done = amb(self.folder, *arguments)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def test_margins_that_are_met_and_not(self):
        # The gains of another rig: stable, with peaks far beyond zone B.
        poor = ("margins", "--rig", "ufu_rig", "--controller", "flexible_rotor")
        self.call(*poor, "--require", "stable")
        done = self.call(*poor, "--require", "zone-b", "--json", "m.json", status=NOT_MET)
        self.assertRegex(done.stderr, r"amb: --require zone-b: not met: the sensitivity peak is in zone D at 0 rpm")
        self.assertIn("max |S|", done.stdout)
        speed = json.loads((self.folder / "m.json").read_text())["speeds"][0]
        self.assertGreater(max(axis["sensitivity_peak"] for axis in speed["axes"]), 5.0)
        good = ("margins", "--controller", "flexible_rotor_commissioned")
        self.call(*good, "--require", "zone-a")

    def test_an_unstable_loop_meets_nothing(self):
        lines = (SOURCE / "config/controllers/flexible_rotor.yaml").read_text().splitlines()
        (self.folder / "limp.yaml").write_text(
            "\n".join("    kp_a_per_m: 100" if "kp_a_per_m" in line else line for line in lines))
        done = self.call("margins", "--controller", "limp.yaml", "--require", "stable", status=NOT_MET)
        self.assertIn("does not hold the rotor at 0 rpm", done.stderr)

    def test_a_run_that_is_completed_and_not_accepted(self):
        # The shipped levitated rig within objectives of a tenth of a micrometre.
        rig = (SOURCE / "config/rigs/flexible_rotor.yaml").read_text()
        self.assertIn("standing_orbit_um: 7", rig)
        (self.folder / "strict.yaml").write_text(rig.replace("standing_orbit_um: 7",
                                                             "standing_orbit_um: 0.1"))
        run = ("run", "--rig", "strict.yaml", "--controller", "flexible_rotor_commissioned",
               "--duration", "2")
        self.call(*run, "--require", "zone-a")
        done = self.call(*run, "--require", "accepted", "--json", "v.json", status=NOT_MET)
        self.assertIn("amb: --require accepted: not met: NOT ACCEPTED", done.stderr)
        self.assertEqual(json.loads((self.folder / "v.json").read_text())["verdict"], "not_accepted")
        self.call("run", "--duration", "2", "--require", "accepted")

    def test_a_word_that_is_none_is_usage(self):
        self.call("margins", "--require", "zone-c", status=USAGE)
        self.call("margins", "--require", "accepted", status=USAGE)


if __name__ == "__main__":
    unittest.main()

"""amb bench mesh: gears with and without control, and torque impacts."""

import unittest

from command import BAD_INPUT, SOURCE, CommandTest, amb


class MeshBench(CommandTest):
    def test_the_mesh_bench_says_what_holding_the_shafts_costs_the_housing(self):
        _, mesh = self.compute("bench", "mesh", "--rig", "geared_rotor_12dof", "--hz", "15")
        at = mesh["speeds"][0]
        self.assertEqual(at["twisted"], ["motor to pinion", "gear to brake"])
        self.assertEqual([at[kind]["trouble"] for kind in ("off", "law", "vibration", "current")], 4 * [""])
        self.assertEqual(at["off"]["housing_level_db"], [0.0, 0.0])
        # What holds a shaft that runs out pushes: the stiller, the harder.
        moves = [at[kind]["displacement_rms_m"] for kind in ("off", "law", "vibration")]
        pushes = [at[kind]["housing_force_rms_n"][0] for kind in ("off", "law", "vibration")]
        self.assertEqual(moves, sorted(moves, reverse=True))
        self.assertEqual(pushes, sorted(pushes))
        self.assertLess(at["current"]["housing_force_rms_n"][0], 0.5 * at["law"]["housing_force_rms_n"][0])
        done = amb(self.folder, "bench", "mesh", "--rig", "flexible_rotor")
        self.assertEqual(done.returncode, BAD_INPUT)
        self.assertIn("the rig has no gears", done.stderr)

    def test_a_speed_that_the_drive_does_not_reach_is_refused(self):
        for what in ((), ("--impact-n-m", "4")):
            done = amb(self.folder, "bench", "mesh", "--hz", "50", *what)
            self.assertEqual(done.returncode, BAD_INPUT)
            self.assertIn("3000 rpm is beyond its drive, allowed 1920 rpm (32 Hz)", done.stderr)
            self.assertEqual(done.stdout, "")

    def test_a_torque_impact_passes_the_teeth_less_where_the_shafts_give_way(self):
        def passed(*options):
            _, json = self.compute("bench", "mesh", "--impact-n-m", "4", "--hz", "20", *options)
            at = json["impacts"][0]
            return {kind: at[kind]["torque_peak_n_m"] for kind in ("law", "once_begun", "known_beforehand")}

        shipped = passed()
        # Whoever knows more takes off more, of what the teeth pass on; what strikes the first shaft stays.
        self.assertLess(shipped["once_begun"][0], 0.8 * shipped["law"][0])
        self.assertLess(shipped["known_beforehand"][0], 0.9 * shipped["once_begun"][0])
        self.assertGreater(shipped["known_beforehand"][1], 0.8 * shipped["law"][1])
        text = (SOURCE / "config/controllers/geared_rotor.yaml").read_text()
        soft = self.folder / "soft.yaml"
        soft.write_text(text.replace("kp_a_per_m: 2.4e4", "kp_a_per_m: 6e3")
                        .replace("kd_a_s_per_m: 20", "kd_a_s_per_m: 10"))
        self.assertLess(passed("--controller", str(soft))["law"][0], 0.85 * shipped["law"][0])


if __name__ == "__main__":
    unittest.main()

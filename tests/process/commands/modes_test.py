"""amb modes: free whirl frequencies, mass and magnet constants, as printed and as JSON."""

import math
import unittest

from command import SHIPPED_RIG, CommandTest, edited, numbers, reference_rows

SHAFT_KG = math.pi / 4 * 9.525e-3**2 * 0.4572 * 7930.0
DISCS_KG = 0.6363 + 0.8021 + 0.6363


class Modes(CommandTest):
    def test_every_frequency_of_the_independent_campbell_diagram(self):
        table = reference_rows("flexible_rotor_campbell.csv")
        _, modes = self.compute("modes", "--campbell")
        by_speed = {round(at["speed_rpm"]): at for at in modes["speeds"]}
        self.assertEqual(sorted(by_speed), [row[0] for row in table])
        for row in table:
            at = by_speed[row[0]]
            for mode in range(4):
                # 0.1 %: what two right programs with different meshes agree to.
                for ours, theirs in ((at["backward_hz"], row[1 + 2 * mode]),
                                     (at["forward_hz"], row[2 + 2 * mode])):
                    self.assertAlmostEqual(ours[mode], theirs, delta=1e-3 * theirs, msg=row[0])

    def test_mass_and_magnet_constants_follow_from_the_rig_file(self):
        _, modes = self.compute("modes")
        self.assertAlmostEqual(modes["rotor_mass_kg"], SHAFT_KG + DISCS_KG, delta=1e-9)
        self.assertEqual([bearing["name"] for bearing in modes["bearings"]], ["de", "nde"])
        for bearing in modes["bearings"]:
            self.assertAlmostEqual(bearing["ki_n_per_a"], 40.0, delta=1e-9)
            # ks = ki i0 / s0
            self.assertAlmostEqual(bearing["ks_n_per_m"], 40.0 * 1.0 / 0.381e-3, delta=1e-3)

    def test_published_rig_has_its_published_figures(self):
        """doi 10.14393/ufu.di.2015.186, computed by an independent program."""
        _, modes = self.compute("modes", "--rig", "ufu_rig")
        # 0.05 %: positions are published to 0.1 mm, elements are some 10 mm long.
        self.assertAlmostEqual(modes["rotor_mass_kg"], 5.936, delta=5e-4 * 5.936)
        for bearing in modes["bearings"]:
            self.assertAlmostEqual(bearing["ki_n_per_a"], 55.73, delta=0.005)
            self.assertAlmostEqual(bearing["ks_n_per_m"], 1.290e5, delta=50.0)
        standing = modes["speeds"][0]
        for mode, published_hz in enumerate((104.2, 400.3, 768.2, 1117.6)):
            # 0.1 % of mesh, and half of the last printed digit.
            delta = 1e-3 * published_hz + 0.05
            self.assertAlmostEqual(standing["forward_hz"][mode], published_hz, delta=delta)
            self.assertAlmostEqual(standing["backward_hz"][mode], published_hz, delta=delta)

    def test_says_which_modes_lie_beyond_the_sampling_or_are_damped_less_than_material(self):
        above, bare = "Above half the sampling rate", "Less damped by the rig file"
        printed, _ = self.compute("modes", "--rig", "turbomolecular_pump")
        self.assertNotIn(above, printed)
        self.assertNotIn(bare, printed)
        # The pump's one bending mode, 561.0 Hz, at 1 kHz of sampling and with 0.004 % of damping.
        pump = SHIPPED_RIG.parent / "turbomolecular_pump.yaml"
        for change, note in ((("period_us: 50 ", "period_us: 1000 "), f"{above} (500 Hz)"),
                             (("damping_ratio: 0.004", "damping_ratio: 0.00004"), bare)):
            with self.subTest(note):
                rig = self.write("changed.yaml", edited(pump, change))
                printed, _ = self.compute("modes", "--rig", rig)
                lines = [line for line in printed.splitlines() if line.startswith(note)]
                self.assertEqual(len(lines), 1, printed)
                self.assertTrue(lines[0].endswith("561.0 Hz."), lines[0])

    def test_what_is_printed_is_what_the_json_holds(self):
        printed, modes = self.compute("modes", "--speeds", "0,2500,6000", "--modes", "3")
        lines = printed.splitlines()
        self.assertIn(f"rotor mass {modes['rotor_mass_kg']:.3f} kg", lines[0])
        self.assertIn(f"z = {1e3 * modes['centre_of_mass_z_m']:.1f} mm", lines[0])
        self.assertIn(f"{modes['transverse_inertia_kg_m2']:.5g} kg m2 transverse", lines[1])
        for line, bearing in zip(lines[2:4], modes["bearings"]):
            self.assertIn(f"static load {bearing['static_load_n']:.3f} N", line)
            self.assertIn(bearing["name"], line)
            self.assertIn(f"{bearing['ki_n_per_a']:.3f} N/A", line)
            self.assertIn(f"{bearing['ks_n_per_m']:.4e} N/m", line)
        for line, at in zip(lines[6:9], modes["speeds"]):
            pairs = [f for pair in zip(at["backward_hz"], at["forward_hz"]) for f in pair]
            shown = numbers(line)
            self.assertEqual(len(shown), 7)
            for value, wanted in zip(shown, [at["speed_rpm"], *pairs]):
                self.assertAlmostEqual(value, wanted, delta=0.00051)  # three decimals are printed
        self.assertIn(f"up to {modes['up_to_rpm']:.0f} rpm", lines[9])
        self.assertEqual(len(lines[10:]), len(modes["critical_speeds"]))
        for line, at in zip(lines[10:], modes["critical_speeds"]):
            self.assertIn(f"{at['speed_rpm']:.1f} rpm", line)
            self.assertIn(f"{at['frequency_hz']:.3f} Hz", line)
            self.assertTrue(line.endswith(at["whirl"]), line)

    def test_reversed_rotation_exchanges_forward_and_backward(self):
        _, modes = self.compute("modes", "--speed-rpm=-4000,4000")
        astern, ahead = modes["speeds"]
        for mode in range(4):
            # Six digits: what is left of 700 Hz after the eigenvalue solver is far below.
            self.assertAlmostEqual(astern["forward_hz"][mode], ahead["backward_hz"][mode], 6)
            self.assertAlmostEqual(astern["backward_hz"][mode], ahead["forward_hz"][mode], 6)
            self.assertGreater(ahead["forward_hz"][mode], ahead["backward_hz"][mode] + 0.5)

    def test_frequencies_go_with_the_root_of_youngs_modulus(self):
        rig = self.write("soft.yaml", edited(SHIPPED_RIG, ("young_gpa: 193", "young_gpa: 48.25")))
        _, soft = self.compute("modes", "--rig", rig)
        _, stiff = self.compute("modes")
        for a, b in zip(soft["speeds"][0]["forward_hz"], stiff["speeds"][0]["forward_hz"]):
            self.assertAlmostEqual(2.0 * a, b, delta=1e-6 * b)  # E/4, G goes with it

    def test_negative_stiffness_goes_with_current_over_gap(self):
        rig = self.write("gap.yaml", edited(SHIPPED_RIG, ("gap_mm: 0.381", "gap_mm: 0.762")))
        _, modes = self.compute("modes", "--rig", rig)
        for bearing in modes["bearings"]:
            self.assertAlmostEqual(bearing["ks_n_per_m"], 40.0 / 0.762e-3, delta=1e-3)

    def worn(self, *entries):
        return self.write("worn.yaml", SHIPPED_RIG.read_text() + "\neffects:\n" +
                          "".join(f"  - {{{entry}}}\n" for entry in entries))

    def test_effects_that_change_the_free_rotor_are_shown_beside_its_own_modes(self):
        nominal = self.compute("modes")[1]["speeds"]
        rig = self.worn("id: modal_frequency, mode: 1, frequency_hz: 80, at_s: 10",
                        "id: modal_damping, mode: 1, damping_ratio: 0.01")
        printed, modes = self.compute("modes", "--rig", rig)
        self.assertEqual(modes["speeds"], nominal)
        self.assertIn("With modal_frequency, modal_damping at full strength", printed)
        first, second = modes["with_effects"][0]["modes"][:2]  # one of each plane
        for mode in (first, second):
            # s = -z w +- j w sqrt(1 - z^2); nothing else acts on this mode at rest.
            self.assertAlmostEqual(mode["frequency_hz"], 80 * math.sqrt(1 - 0.01**2), 6)
            self.assertAlmostEqual(mode["damping_ratio"], 0.01, 9)
        # Modes that no effect touches stay: the reduced model keeps them within 0.1 %.
        third = modes["with_effects"][0]["modes"][2]["frequency_hz"]
        self.assertAlmostEqual(third, nominal[0]["forward_hz"][1], delta=1e-3 * third)

    def test_effects_that_are_not_applied_are_named(self):
        rig = self.worn("id: breathing_crack, z_mm: 250, depth: 0.3",
                        "id: current_gain, channels: [de_x], ratio: 0.9",
                        "id: sensor_noise, channels: [de_x], rms_um: 2")
        printed, modes = self.compute("modes", "--rig", rig)
        self.assertNotIn("with_effects", modes)
        for name in ("breathing_crack", "current_gain", "sensor_noise"):
            self.assertRegex(printed, rf"Not applied: {name} \(")

    def test_as_many_modes_as_asked_for_in_rising_order(self):
        for count in (1, 6):
            _, modes = self.compute("modes", "--modes", count)
            frequencies = modes["speeds"][0]["forward_hz"]
            self.assertEqual(len(frequencies), count)
            self.assertEqual(frequencies, sorted(frequencies))

    def test_speeds_come_back_in_the_order_asked_for(self):
        _, modes = self.compute("modes", "--speed-rpm", "3000,0,1500")
        self.assertEqual([round(at["speed_rpm"], 6) for at in modes["speeds"]], [3000, 0, 1500])


if __name__ == "__main__":
    unittest.main()

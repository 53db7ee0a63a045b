"""amb poles: poles of the sampled loop, as printed and as JSON, against an independent program."""

import cmath
import math
import re
import unittest

from command import (DONE, SOURCE, CommandTest, amb, numbers, reference_rows,
                     scaled_controller)

PERIOD_S = 1e-4
LIMIT_HZ = 1000.0  # up to here the reference goes


class Poles(CommandTest):
    def test_every_pole_of_the_independent_program_once_and_no_other(self):
        reference = reference_rows("flexible_rotor_closed_loop.csv")
        # The independent program is linear about the centre of a rotor without weight.
        shipped = (SOURCE / "config/rigs/flexible_rotor.yaml").read_text()
        weightless = shipped.replace("acceleration_m_per_s2: 9.81", "acceleration_m_per_s2: 0")
        self.assertNotEqual(weightless, shipped)
        rig = self.write("weightless.yaml", weightless)
        _, loop = self.compute("poles", "--rig", rig, "--speeds", "0,1600,3000,6000")
        self.assertEqual(len(loop["speeds"]), 4)
        for at in loop["speeds"]:
            wanted = [row for row in reference if row[0] == round(at["speed_rpm"])]
            left = [pole for pole in at["poles"] if abs(pole["frequency_hz"]) < LIMIT_HZ]
            self.assertEqual(len(left), len(wanted))
            self.assertEqual(len(wanted), 28)
            for _, frequency_hz, damping in wanted:
                # 0.5 % of the frequency, or three printed decimals where it hardly oscillates.
                near_hz = max(0.005, 0.005 * abs(frequency_hz))
                match = next((pole for pole in left
                              if abs(pole["frequency_hz"] - frequency_hz) <= near_hz
                              and abs(pole["damping_ratio"] - damping) <= 0.002), None)
                self.assertIsNotNone(match, (at["speed_rpm"], frequency_hz, damping))
                left.remove(match)

    def test_numbers_of_one_pole_belong_together(self):
        _, loop = self.compute("poles", "--speed-rpm", "3000")
        at = loop["speeds"][0]
        largest = 0.0
        for pole in at["poles"]:
            s = complex(pole["real_part_1_per_s"], pole["imaginary_part_rad_per_s"])
            # The frequency's sign is the whirl's direction; s is listed with positive imaginary part.
            self.assertGreaterEqual(s.imag, 0.0)
            self.assertAlmostEqual(abs(pole["frequency_hz"]), s.imag / 2 / math.pi, delta=1e-9)
            self.assertAlmostEqual(pole["damping_ratio"], -s.real / abs(s), delta=1e-9)
            self.assertTrue(-1e-9 <= pole["forward_share"] <= 1 + 1e-9, pole)
            largest = max(largest, abs(cmath.exp(s * PERIOD_S)))
        self.assertAlmostEqual(at["largest_pole_modulus"], largest, delta=1e-9)
        self.assertEqual(at["stable"], largest < 1.0)

    def test_whirl_at_speed_goes_the_way_its_frequency_says(self):
        _, loop = self.compute("poles", "--speed-rpm", "6000")
        bending = [pole for pole in loop["speeds"][0]["poles"]
                   if 200 < abs(pole["frequency_hz"]) < LIMIT_HZ and pole["damping_ratio"] < 0.1]
        # Second to fourth bending mode; the gyroscopic moment has split each by more than 10 Hz.
        self.assertEqual(sum(pole["frequency_hz"] > 0 for pole in bending), len(bending) / 2)
        self.assertGreaterEqual(len(bending), 6)
        for pole in bending:
            self.assertEqual(pole["forward_share"] > 0.9, pole["frequency_hz"] > 0, pole)

    def test_well_damped_critical_speeds_are_said_to_be(self):
        shipped = (SOURCE / "config/controllers/flexible_rotor.yaml").read_text()
        for factor, damped in ((1.0, False), (0.75, True)):
            self.write("law.yaml", re.sub(r"(kd_a_s_per_m: )([\d.]+)", lambda found: found[1]
                                          + str(factor * float(found[2])), shipped))
            printed, loop = self.compute("poles", "--controller", "law.yaml")
            rows = printed.split("Critical speeds, levitated, ")[1].splitlines()[1:]
            self.assertGreater(len(rows), 0)
            for row, at in zip(rows, loop["critical_speeds"], strict=True):
                self.assertEqual("critically damped" in row, 0.5 / at["damping_ratio"] < 2.5, row)
            self.assertEqual(any("critically damped" in row for row in rows), damped, rows)

    def test_what_is_printed_is_what_the_json_holds(self):
        printed, loop = self.compute("poles", "--speed-rpm", "1600", "--up-to-hz", "300")
        table, critical = printed.split("Critical speeds, levitated, ")
        self.assertTrue(critical.startswith(f"up to {loop['up_to_rpm']:.0f} rpm:\n"), critical)
        for row, at in zip(critical.splitlines()[1:], loop["critical_speeds"], strict=True):
            self.assertIn(f"{at['speed_rpm']:.1f} rpm", row)
            self.assertIn(f"damping {at['damping_ratio']:.5f}  {at['whirl']}", row)
            self.assertNotIn("critically damped", row)
        at = loop["speeds"][0]
        lines = [line for line in table.splitlines()
                 if "the notch given at" not in line and "Tustin's rule" not in line]
        title, delay, head, names, *rows = lines
        self.assertIn("rig flexible_rotor, controller flexible_rotor", title)
        self.assertIn("1.00 periods, of the rig file", delay)
        self.assertEqual(loop["delay_s"], 1e-4)
        self.assertIn("1600 rpm: STABLE", head)
        self.assertIn(f"{at['largest_pole_modulus']:.6f}", head)
        self.assertIn("frequency Hz", names)
        worst = at["poles"][:5]
        shown = [pole for pole in at["poles"]
                 if pole in worst or abs(pole["frequency_hz"]) <= 300]
        *rows, hidden = rows
        self.assertEqual(len(rows), len(shown))
        self.assertLess(len(shown), len(at["poles"]))  # the option limits the print, not the file
        left = [pole["damping_ratio"] for pole in at["poles"] if pole not in shown]
        self.assertIn(f"beyond 300 Hz {len(left)} more", hidden)
        self.assertAlmostEqual(numbers(hidden)[-1], min(left), delta=0.0000051)
        for row, pole in zip(rows, shown):
            frequency_hz, damping, real = numbers(row)
            self.assertAlmostEqual(frequency_hz, pole["frequency_hz"], delta=0.00051)
            self.assertAlmostEqual(damping, pole["damping_ratio"], delta=0.0000051)
            self.assertAlmostEqual(real, pole["real_part_1_per_s"], delta=0.00051)

    def test_the_worst_come_first(self):
        for rpm in (0, 30000):
            _, loop = self.compute("poles", "--rig", "geared_rotor_8dof", "--speed-rpm", rpm)
            poles = loop["speeds"][0]["poles"]
            unstable = [pole for pole in poles if pole["unstable"]]
            self.assertEqual([pole["real_part_1_per_s"] >= 0 for pole in unstable],
                             [True] * len(unstable))
            self.assertEqual(poles[:len(unstable)], unstable)
            decaying = [pole["damping_ratio"] for pole in poles[len(unstable):]]
            self.assertEqual(decaying, sorted(decaying))

    def test_the_limit_of_the_list_hides_no_pole_that_grows(self):
        """The geared rotor's growing pole at 30 000 rpm lies at 1.1 kHz, beyond the usual limit."""
        printed = amb(self.folder, "poles", "--rig", "geared_rotor_8dof", "--speed-rpm", "30000",
                      "--up-to-hz", "1").stdout
        _, loop = self.compute("poles", "--rig", "geared_rotor_8dof", "--speed-rpm", "30000")
        at = loop["speeds"][0]
        growing = [pole for pole in at["poles"] if pole["unstable"]]
        self.assertFalse(at["stable"])
        self.assertTrue(all(pole["frequency_hz"] > 1000 for pole in growing), growing)
        lines = printed.splitlines()
        listed = lines[[" frequency Hz" in line for line in lines].index(True) + 1:]
        self.assertEqual(sum("<- unstable" in line for line in listed), len(growing))
        self.assertIn("<- unstable", listed[0])
        # A stable loop has none such, with the same limit.
        steady = amb(self.folder, "poles", "--rig", "geared_rotor_8dof", "--up-to-hz", "1").stdout
        self.assertNotIn("<- unstable", steady)

    def test_gain_below_the_magnets_own_stiffness_is_called_unstable(self):
        """Drive end: ki Kp = 1.806e5 N/m against ks = 1.050e5 N/m, so half of it is too little."""
        weak = self.write("weak.yaml", scaled_controller(0.5))
        printed, loop = self.compute("poles", "--controller", weak)
        at = loop["speeds"][0]
        self.assertFalse(at["stable"])
        self.assertGreater(at["largest_pole_modulus"], 1.0)
        self.assertIn("0 rpm: UNSTABLE", printed)
        self.assertIn("<- unstable", printed)
        growing = [pole for pole in at["poles"] if pole["real_part_1_per_s"] > 0]
        # It falls to one side: what grows is slower than the rigid mode of 60.8 Hz at full gain.
        self.assertTrue(growing)
        self.assertTrue(all(abs(pole["frequency_hz"]) < 30.0 for pole in growing), growing)

    def test_an_unstable_loop_is_an_answer_not_an_error(self):
        weak = self.write("weak.yaml", scaled_controller(0.5))
        self.assertEqual(amb(self.folder, "poles", "--controller", weak).returncode, DONE)

    def test_standing_rotor_has_every_oscillation_in_both_directions(self):
        printed, loop = self.compute("poles")
        values = sorted(pole["frequency_hz"] for pole in loop["speeds"][0]["poles"]
                        if 1.0 < abs(pole["frequency_hz"]) < LIMIT_HZ)
        self.assertEqual(len(values), 22)  # of the reference's 28, six do not oscillate
        for value, other in zip(values, reversed(values)):
            # 1e-4 Hz: what the eigenvalue solver leaves of a double pole at this size.
            self.assertAlmostEqual(value, -other, delta=1e-4)
        # Without rotation neither direction is the forward one.
        table = printed.split("Critical speeds")[0]
        self.assertNotIn("forward", table)
        self.assertNotIn("backward", table)

    def test_same_question_same_numbers(self):
        first, second = (self.compute("poles", "--speed-rpm", "3000")[1] for _ in range(2))
        self.assertEqual(first, second)


if __name__ == "__main__":
    unittest.main()

"""amb margins: sensitivity peaks, zones and margins, proven with the poles of amb poles."""

import math
import re
import unittest

from command import (SHIPPED_CONTROLLER, SHIPPED_RIG, CommandTest, edited, numbers,
                     scaled_controller)

ZONES = (("A", 3.0), ("B", 4.0), ("C", 5.0), ("D", math.inf))  # ISO 14839-3: 9.5, 12, 14 dB


def zone_of(peak):
    return next(name for name, limit in ZONES if peak < limit)


def one_axis_scaled(factor):
    """The shipped controller, the law of de_x alone multiplied by `factor`."""
    text = SHIPPED_CONTROLLER.read_text()
    law = re.search(r"\n  de:\n(.*?)\n\n", text, re.S).group(1)
    for key in ("kp_a_per_m", "ki_a_per_m_s", "kd_a_s_per_m"):
        law = re.sub(rf"({key}: )([\d.]+)",
                     lambda found: found[1] + repr(float(found[2]) * factor), law)
    return edited(SHIPPED_CONTROLLER, ("\nsequence:", f"  de_x:\n{law}\n\nsequence:"))


class Margins(CommandTest):
    def test_zones_are_those_of_the_standard(self):
        seen = set()
        for controller in ("flexible_rotor", "flexible_rotor_commissioned"):
            _, margins = self.compute("margins", "--controller", controller, "--speeds", "0,6000")
            for at in margins["speeds"]:
                self.assertTrue(at["stable"])
                worst = max(axis["sensitivity_peak"] for axis in at["axes"])
                self.assertEqual(at["zone"], zone_of(worst))
                for axis in at["axes"]:
                    self.assertEqual(axis["zone"], zone_of(axis["sensitivity_peak"]), axis)
                    seen.add(axis["zone"])
        self.assertGreater(len(seen), 1)  # the table above was tried at more than one place

    def test_a_bias_that_falls_is_judged_down_to_its_lowest(self):
        mine = self.write("saving.yaml", (SHIPPED_CONTROLLER.read_text() +
                                          "\nbias_saving:\n  lowest_current_a: 0.25\n"))
        printed, margins = self.compute("margins", "--controller", mine, "--speeds", "0,3000")
        self.assertIn("bias saving: the loop from the rig's bias to the lowest", printed)
        rows = margins["bias_saving"]
        self.assertEqual([round(row["bias_current_a"], 6) for row in rows[:5]],
                         [1.0, 0.707107, 0.5, 0.353553, 0.25])
        self.assertEqual([row["speed_rpm"] for row in rows], 5 * [0.0] + 5 * [3000.0])
        # At the rig's bias the loop is the law's own.
        worst = max(axis["sensitivity_peak"] for axis in margins["speeds"][0]["axes"])
        self.assertAlmostEqual(rows[0]["sensitivity_peak"], worst, delta=1e-6 * worst)
        # What carries no load has no sensitivity.
        for row in rows:
            self.assertEqual(row["sensitivity_peak"] is None, bool(row["not_held_because"]), row)
        self.assertIsNone(rows[4]["sensitivity_peak"])
        self.assertIn("NOT HELD", printed)

    def test_the_controllers_file_is_told(self):
        mine = self.write("mine.yaml", scaled_controller(1.0))
        printed, margins = self.compute("margins", "--controller", mine)
        self.assertIn("controller flexible_rotor (mine.yaml)", printed)
        self.assertEqual(margins["controller_file"], "mine.yaml")
        self.assertNotIn("amb run", printed)

    def test_a_notch_that_stands_elsewhere_is_told_and_prewarp_puts_it_in_its_place(self):
        given = 862.316  # Hz; at 10 kHz Tustin's rule has it at atan(pi f T)/(pi T)
        stands = math.atan(math.pi * given * 1e-4) / (math.pi * 1e-4)
        printed, _ = self.compute("margins", "--controller", "flexible_rotor")
        self.assertIn(f"the notch given at {given:.1f} Hz stands at {stands:.1f} Hz", printed)
        self.assertNotIn("449.2 Hz", printed)  # 0.7 % below: not worth a line
        warped = self.write("warped.yaml", re.sub(
            r"(pole_damping: [\d.]+)", r"\1, prewarp: true", SHIPPED_CONTROLLER.read_text()))
        printed, _ = self.compute("margins", "--controller", warped)
        self.assertNotIn("stands at", printed)

    def test_the_reference_gains_are_not_taken_for_those_of_amb_run(self):
        printed, _ = self.compute("margins")
        self.assertIn("--controller flexible_rotor_commissioned", printed)

    def test_sensitivity_peak_bounds_the_margins_from_below(self):
        """|1 + L| >= 1/Ms everywhere: crossings of the real axis and the unit circle keep off -1."""
        _, margins = self.compute("margins", "--speeds", "0,3000,6000")
        for axis in (axis for at in margins["speeds"] for axis in at["axes"]):
            peak = axis["sensitivity_peak"]
            self.assertGreater(peak, 1.0)  # a magnet of negative stiffness leaves no other choice
            # 1 %: peak and crossings are searched on a grid.
            self.assertGreaterEqual(axis["gain_margin_up"], 0.99 * peak / (peak - 1))
            self.assertLessEqual(axis["gain_margin_down"], 1.01 * peak / (peak + 1))
            self.assertGreaterEqual(axis["phase_margin_rad"], 0.99 * 2 * math.asin(0.5 / peak))
            self.assertGreater(axis["phase_margin_at_hz"], 0.0)

    def test_largest_singular_value_is_no_smaller_than_any_axis(self):
        _, margins = self.compute("margins", "--speeds", "0,6000")
        for at in margins["speeds"]:
            for axis in at["axes"]:
                # A diagonal element never exceeds the norm; 0.1 % of grid.
                self.assertGreaterEqual(at["largest_singular_value"],
                                        0.999 * axis["sensitivity_peak"])

    def test_gain_margins_are_where_the_poles_leave_the_unit_circle(self):
        _, margins = self.compute("margins", "--speed-rpm", "3000")
        axis = margins["speeds"][0]["axes"][0]
        self.assertEqual(axis["channel"], "de_x")
        up, down = axis["gain_margin_up"], axis["gain_margin_down"]
        self.assertTrue(down < 1.0 < up, axis)
        for factor, stable in ((0.98 * up, True), (1.02 * up, False),
                               (1.02 * down, True), (0.98 * down, False)):
            self.write("one.yaml", one_axis_scaled(factor))
            _, loop = self.compute("poles", "--controller", "one.yaml", "--speed-rpm", "3000")
            self.assertEqual(loop["speeds"][0]["stable"], stable, factor)

    def test_takes_the_delay_of_the_buses_where_they_are_the_port(self):
        """On CAN the current of a sample acts a whole period later: less phase, larger peaks."""
        _, lcm = self.compute("margins", "--controller", "flexible_rotor_commissioned")
        printed, can = self.compute("margins", "--controller", "flexible_rotor_commissioned",
                                    "--port", "can")
        self.assertEqual((lcm["delay_s"], can["delay_s"]), (1e-4, 2e-4))
        self.assertIn("2.00 periods, the longer one of can and the rig file (1.00)", printed)
        peak = [max(axis["sensitivity_peak"] for axis in loop["speeds"][0]["axes"])
                for loop in (lcm, can)]
        self.assertGreater(peak[1], peak[0])

    def test_an_interface_that_is_not_there_is_computed_and_one_wire_for_two_buses_is_told(self):
        printed, one = self.compute("margins", "--port", "can:absent0")
        _, two = self.compute("margins", "--port", "can")
        self.assertEqual(one["speeds"], two["speeds"])
        self.assertIn("on real wires can:absent0 would not carry the loop", printed)
        self.assertIn("at most 5684 Hz fits", printed)
        printed, _ = self.compute("margins", "--port", "can:absent0,absent1")
        self.assertNotIn("real wires", printed)

    def test_delay_beyond_the_phase_margin_ends_stability(self):
        """A delay of T turns the phase at f by 2 pi f T: the margin allows phase/(2 pi f)."""
        _, margins = self.compute("margins")
        allowed = min(axis["phase_margin_rad"] / (2 * math.pi * axis["phase_margin_at_hz"])
                      for axis in margins["speeds"][0]["axes"])
        stable = []
        for share in (0.5, 2.0):  # all four axes are delayed, the margin is that of one
            late = self.write("late.yaml", edited(SHIPPED_RIG, (
                "delay_samples: 1 ", f"delay_samples: {1 + share * allowed / 1e-4:.3f} ")))
            _, loop = self.compute("poles", "--rig", late)
            stable.append(loop["speeds"][0]["stable"])
        self.assertEqual(stable, [True, False])

    def test_unstable_loop_gets_no_grade_however_small_its_peak(self):
        weak = self.write("weak.yaml", scaled_controller(0.5))
        printed, margins = self.compute("margins", "--controller", weak)
        at = margins["speeds"][0]
        self.assertFalse(at["stable"])
        self.assertIsNone(at["zone"])
        self.assertTrue(all(axis["zone"] is None for axis in at["axes"]))
        self.assertIn("UNSTABLE", printed)
        self.assertIn("no grade", printed)
        self.assertNotRegex(printed, r"zone [A-D]")

    def test_stability_is_judged_as_amb_poles_judges_it(self):
        for speed in ("0", "6000"):
            _, margins = self.compute("margins", "--speed-rpm", speed)
            _, loop = self.compute("poles", "--speed-rpm", speed)
            self.assertEqual(margins["speeds"][0]["stable"], loop["speeds"][0]["stable"])
            self.assertAlmostEqual(margins["speeds"][0]["largest_pole_modulus"],
                                   loop["speeds"][0]["largest_pole_modulus"], delta=1e-12)

    def test_what_is_printed_is_what_the_json_holds(self):
        printed, margins = self.compute("margins", "--speeds", "0,6000")
        blocks = re.split(r"\n(?=\d+ rpm: )", printed)[1:]
        self.assertEqual(len(blocks), 2)
        for block, at in zip(blocks, margins["speeds"]):
            lines = block.splitlines()
            self.assertTrue(lines[0].endswith(f"STABLE, zone {at['zone']}"), lines[0])
            for line, axis in zip(lines[2:6], at["axes"]):
                name, *_ = line.split()
                self.assertEqual(name, axis["channel"])
                self.assertIn(f" {axis['zone']} ", line)
                wanted = (axis["sensitivity_peak"], axis["frequency_hz"], axis["gain_margin_up"],
                          axis["gain_margin_down"], math.degrees(axis["phase_margin_rad"]))
                for shown, value in zip(numbers(line), wanted):
                    self.assertAlmostEqual(shown, value, delta=0.0051)  # two decimals
            self.assertIn(f"{at['largest_singular_value']:.3f}", lines[6])


if __name__ == "__main__":
    unittest.main()

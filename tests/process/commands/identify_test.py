"""From a rig that is not as its file says to a file that is: campaign, identification, a run with
what was identified, and the record against both files.
"""

import csv
import json
import re
import unittest
from pathlib import Path

from command import BAD_INPUT, DONE, SHIPPED_RIG, CommandTest, amb, edited

KI_N_PER_A = 46.0  # where the file has 40
BIAS_A = 1.0  # of the file
PUMP_RIG = SHIPPED_RIG.with_name("turbomolecular_pump.yaml")
AXES = ("de_x", "nde_x", "de_y", "nde_y")
# Four periods of 2 x 1023 samples on each axis: a quarter of the shipped campaign, standing only.
CAMPAIGN = """kind: scenario
name: short_campaign
steps:
  - {do: lift, until: levitating, timeout_s: 5, hold_s: 0.7}
""" + "".join(f"""  - do: nothing
    hold_s: 0.8184
    orbit_limit_um: 90
    excitation:
      - {{channel: {axis}, amplitude_a: 0.15, order: 10, divisor: 2}}
  - {{do: nothing, hold_s: 0.2}}
""" for axis in AXES) + """  - {do: land, until: 'off', timeout_s: 5, hold_s: 0.2}
"""


class Identify(CommandTest):
    def channels(self, record, rig):
        done = self.run_amb("simulate", record, "--rig", rig, "--from", "1", "--json", "s.json")
        self.assertEqual(done.returncode, DONE, done.stderr)
        found = json.loads((self.folder / "s.json").read_text())
        return [c["multiple_of_noise"] / c["expected_multiple"] for c in found["channels"]]

    def run_amb(self, *arguments):
        return amb(self.folder, *arguments)

    def expect_stiffness_without_static_current(self, printed):
        """The weight's current stiffens the magnets; it is told with what it makes."""
        axes = re.findall(r"(\w+) ([\d.]+) A makes ([\d.]+) % \((\d+) N/m without\)", printed)
        self.assertEqual(len(axes), 4, printed)
        for _, ampere, percent, _ in axes:
            self.assertAlmostEqual(float(percent), 100.0 * (float(ampere) / BIAS_A) ** 2, delta=0.1)
        # Both axes of a bearing carry alike: the rotor hangs at 45 degrees between them.
        carried = {name: float(ampere) for name, ampere, _, _ in axes}
        for bearing in ("de", "nde"):
            self.assertLess(abs(carried[bearing + "_x"] / carried[bearing + "_y"] - 1.0), 0.02)

    def test_a_rig_with_other_magnets_is_found_run_and_simulated(self):
        worn = edited(SHIPPED_RIG, ("ki_n_per_a: 40", f"ki_n_per_a: {KI_N_PER_A}"))
        self.write("worn.yaml", worn)
        self.write("short.yaml", CAMPAIGN)
        self.run_amb("run", "--rig", "worn.yaml", "--scenario", "short.yaml", "--record", "c.lcm")
        # From the shipped rig's numbers: the session's own are the answer.
        done = self.run_amb("identify", "modal", "c.lcm", "--rig", "flexible_rotor", "--out",
                            "identified.yaml", "--svg", "modal", "--json", "m.json", "--decibel-cost")
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.assertRegex(done.stdout, r"cost in decibels, weights 30 within 5 Hz of peaks")
        self.assertIn("was recorded with rig", done.stderr)
        self.assertIn("rig file -> identified", done.stdout)
        self.expect_stiffness_without_static_current(done.stdout)
        told = done.stdout.splitlines()[-1]
        self.assertTrue(told.startswith("wrote "), told)
        for name in told.removeprefix("wrote ").split(", "):
            self.assertTrue((self.folder / name).is_file(), name)
        here = {path.name for path in self.folder.glob("modal_*")} | {"identified.yaml", "m.json"}
        self.assertEqual(set(told.removeprefix("wrote ").split(", ")), here)
        found = json.loads((self.folder / "m.json").read_text())
        for speed in found["speeds"]:
            for before, after in zip(speed["channel_misfit_rig_file"],
                                     speed["channel_misfit_identified"]):
                # 15 % in ki is beyond the noise; what is left is the noise, of which this short
                # record tells the variance to about a tenth.
                self.assertGreater(before, 1.3 * after)
                self.assertLess(after, 1.5)
        for picture in ("bode", "campbell", "stabilisation"):
            self.assertIn("</svg>", (self.folder / f"modal_{picture}.svg").read_text())
        for speed in found["decibel_cost"]["speeds"]:
            self.assertLess(speed["of_decibel_fit"]["weighted_rms_db"], speed["of_modal_fit"]["weighted_rms_db"])

        for axis in found["axes"]:
            # 2 % is what is asked of a whole campaign; this one has a quarter of its data.
            product = axis["ki_n_per_a"] * axis["sensor_gain"]
            self.assertLess(abs(product / KI_N_PER_A - 1.0), 0.06, axis)

        # Its intervals are what a design takes for the uncertainty of that file.
        self.assertIn("gyroscopic:", (self.folder / "identified.yaml").read_text())
        done = self.run_amb("design", "uncertainty", "--rig", "identified.yaml", "--uncertainty",
                            "m.json", "--json", "u.json")
        self.assertEqual(done.returncode, DONE, done.stderr)
        told = {p["name"]: p for p in json.loads((self.folder / "u.json").read_text())["parameters"]}
        for axis in found["axes"]:
            ki = told[f"ki {axis['channel']} [1]"]
            sigma = axis["ki_sigma_n_per_a"] / axis["ki_n_per_a"]
            self.assertAlmostEqual(ki["high"] - ki["low"], 6.0 * sigma, 6)
        done = self.run_amb("design", "uncertainty", "--rig", "identified.yaml", "--uncertainty",
                            "u.json")
        self.assertEqual(done.returncode, BAD_INPUT, done.stderr)
        self.assertIn("not what amb identify modal --json writes", done.stderr)

        # What was identified levitates as any rig file does.
        done = self.run_amb("run", "--rig", "identified.yaml", "--controller",
                            "flexible_rotor_commissioned", "--scenario", "levitate")
        self.assertNotEqual(done.returncode, BAD_INPUT, done.stderr)
        self.assertNotIn("INCOMPLETE", done.stdout)

        # The record departs from the shipped file and hardly from the identified one.
        before = self.channels("c.lcm", "flexible_rotor")
        after = self.channels("c.lcm", "identified.yaml")
        for channel, (old, new) in enumerate(zip(before, after)):
            self.assertLess(abs(new - 1.0), abs(old - 1.0) + 0.01, AXES[channel])
        self.assertLess(sum(after), sum(before))

    def test_each_defect_of_a_measured_file_is_refused_with_one_sentence(self):
        self.write("short.yaml", CAMPAIGN)
        self.run_amb("run", "--scenario", "short.yaml", "--record", "c.lcm")
        self.run_amb("export", "c.lcm", "--csv", "c.csv")
        with open(self.folder / "c.csv", newline="", encoding="utf-8") as file:
            head, *good = list(csv.reader(file))
        column = {name: number for number, name in enumerate(head)}
        last = column["excitation_nde_y_a"]
        excited = [n for n, row in enumerate(good) if float(row[last] or 0.0) != 0.0]

        def changed(name, function):
            rows = [row[:] for row in good]
            for n, row in enumerate(rows):
                row[column[name]] = repr(function(n, float(row[column[name]] or 0.0)))
            return rows

        still = [[("0" if head[n].startswith("excitation") else cell) for n, cell in enumerate(row)]
                 for row in good]
        first = excited[0]
        cases = {
            "position nde_x is dead": changed("position_nde_x_m", lambda n, v: 1e-6),
            "position de_y is clipped": changed("position_de_y_m",
                                                lambda n, v: 400e-6 if v > 10e-6 else v),
            "position de_y is cut off below": changed("position_de_y_m",
                                                      lambda n, v: min(v, 10e-6)),
            "no excitation in the record": still,
            "does not repeat itself": good[:first + 3000],
            "samples are missing": good[:first + 3000] + good[first + 5046:],
            "that of nde_y after 100": changed(
                "excitation_nde_y_a",
                lambda n, v: v and (0.1 if (n - first) % 100 < 50 else -0.1)),
            "de_x moves with the current": changed("position_de_x_m", lambda n, v: -v),
            "de_x follows its excitation with the wrong sign": changed(
                "control_current_de_x_a", lambda n, v: -v),
        }
        for words, rows in cases.items():
            with self.subTest(words):
                with open(self.folder / "bad.csv", "w", newline="", encoding="utf-8") as file:
                    csv.writer(file).writerows([head, *rows])
                done = self.run_amb("identify", "modal", "bad.csv", "--out", "no.yaml")
                self.assertEqual(done.returncode, BAD_INPUT, done.stdout)
                self.assertIn(words, done.stderr)
                self.assertFalse(Path(self.folder / "no.yaml").exists())

    def test_a_run_without_excitation_is_refused_with_one_sentence(self):
        self.write("still.yaml", """kind: scenario
name: still
steps:
  - {do: lift, until: levitating, timeout_s: 5, hold_s: 0.3}
  - {do: land, until: 'off', timeout_s: 5}
""")
        self.run_amb("run", "--scenario", "still.yaml", "--record", "s.lcm")
        for method in ("frf", "modal"):
            done = self.run_amb("identify", method, "s.lcm", "--json", "no.json")
            self.assertEqual(done.returncode, BAD_INPUT)
            self.assertIn("no excitation in the record", done.stderr)
            self.assertFalse(Path(self.folder / "no.json").exists())

    def test_a_pump_of_other_magnets_and_sensors_runs_free_in_its_known_loop(self):
        worn = edited(PUMP_RIG, ("ki_n_per_a: 104.4", "ki_n_per_a: 98"))
        worn += """
effects:
  - {id: magnetic_saturation, knee_a: 3, exponent: 4}
  - {id: sensor_nonlinearity, channels: [ux, uy, lx, ly], a2_1_per_m: 1000, a3_1_per_m2: 1e7}
"""
        self.write("worn.yaml", worn)
        done = self.run_amb("run", "--rig", "worn.yaml", "--controller", "turbomolecular_pump",
                            "--scenario", "turbomolecular_pump_identify", "--record", "p.lcm")
        self.assertTrue((self.folder / "p.lcm").exists(), done.stderr)
        arguments = ("identify", "rotor-in-loop", "p.lcm", "--rig", "turbomolecular_pump",
                     "--sensor-a2", "1000,1000,1000,1000", "--sensor-a3", "1e7,1e7,1e7,1e7")
        done = self.run_amb(*arguments, "--fitted", "30000", "--json", "rotor.json")
        self.assertEqual(done.returncode, DONE, done.stderr)
        found = json.loads((self.folder / "rotor.json").read_text())
        for axis, rms_m in enumerate(found["test"]["rms_m"]):
            # 0.2 um of noise on the readings, and up to half as much that it does in the loop.
            self.assertGreater(rms_m, 0.2e-6, axis)
            self.assertLess(rms_m, 0.3e-6, axis)
        for mode in found["modes"]:
            self.assertAlmostEqual(mode["frequency_hz"], 561, delta=1)
        done = self.run_amb(*arguments, "--fitted", "5100")
        self.assertEqual(done.returncode, BAD_INPUT)
        self.assertIn("100 rows for 46 unknowns", done.stderr)

    def test_a_rotor_that_turns_is_refused(self):
        self.write("turning.yaml", """kind: scenario
name: turning
steps:
  - {do: lift, until: levitating, timeout_s: 5}
  - {do: spin, speed_rpm: 600, acceleration_rpm_per_s: 5000, until: speed_reached, timeout_s: 5}
  - do: nothing
    hold_s: 0.3
    excitation:
      - {channel: ux, signal: paprbs, point: measured_position, amplitude_um: 10, order: 15, divisor: 10}
  - {do: land, until: 'off', timeout_s: 5}
""")
        self.run_amb("run", "--rig", "turbomolecular_pump", "--scenario", "turning.yaml",
                     "--record", "t.lcm")
        done = self.run_amb("identify", "rotor-in-loop", "t.lcm", "--rig", "turbomolecular_pump")
        self.assertEqual(done.returncode, BAD_INPUT)
        self.assertIn("needed is a record of its standstill", done.stderr)


if __name__ == "__main__":
    unittest.main()

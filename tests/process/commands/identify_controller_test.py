"""An existing controller, read from a recorded run and from the columns of a file, becomes a law."""

import csv
import json
import unittest

from command import BAD_INPUT, DONE, USAGE, CommandTest, amb

RIG = ("--rig", "turbomolecular_pump")
SCENARIO = """kind: scenario
name: readings
steps:
  - {do: lift, until: levitating, timeout_s: 5, hold_s: 0.3}
""" + "".join(f"""  - do: nothing
    hold_s: 0.2
    excitation:
      - {{channel: {axis}, signal: prbs, point: measured_position, amplitude_um: 3, order: 11}}
""" for axis in ("ux", "uy", "lx", "ly")) + """  - {do: land, until: 'off', timeout_s: 5}
"""


class IdentifyController(CommandTest):
    def call(self, *arguments, status=DONE):
        done = amb(self.folder, *arguments)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def margins(self, controller):
        self.call("margins", *RIG, "--controller", controller, "--json", "margins.json")
        return json.loads((self.folder / "margins.json").read_text())["speeds"][0]["axes"]

    def record(self):
        self.write("readings.yaml", SCENARIO)
        amb(self.folder, "run", *RIG, "--scenario", "readings.yaml", "--record", "r.lcm", "--no-dash")

    def test_the_law_of_a_run_has_the_margins_of_the_one_that_ran(self):
        self.record()
        said = self.call("identify", "controller", "r.lcm", *RIG, "--out", "law.yaml", "--svg",
                         "law.svg", "--json", "law.json").stdout
        self.assertIn("wrote law.yaml, law.svg, law.json", said)
        self.assertIn("</svg>", (self.folder / "law.svg").read_text())
        for found in json.loads((self.folder / "law.json").read_text())["controllers"]:
            self.assertEqual(found["order"], 4, found["name"])
        for ran, found in zip(self.margins("turbomolecular_pump"), self.margins("law.yaml")):
            self.assertAlmostEqual(found["sensitivity_peak"], ran["sensitivity_peak"],
                                   delta=1e-3 * ran["sensitivity_peak"])

    def test_columns_of_a_file_are_a_controller_of_that_name(self):
        # First order: y[n+1] = 0.9 y[n] + u[n], an input that is no repetition.
        with open(self.folder / "c.csv", "w", newline="", encoding="utf-8") as file:
            rows = csv.writer(file)
            rows.writerow(("seen", "made"))
            state, made = 1, 0.0
            for _ in range(4000):
                state = (1103515245 * state + 12345) % 2**31
                seen = state / 2**30 - 1.0
                rows.writerow((seen, made))
                made = 0.9 * made + seen
        csv_call = ("identify", "controller", "c.csv", "--rate-hz", "10000", "--axis")
        self.call(*csv_call, "thrust=seen:made", "--time", "discrete", "--json", "law.json")
        (found,) = json.loads((self.folder / "law.json").read_text())["controllers"]
        self.assertEqual((found["name"], found["order"]), ("thrust", 1))
        self.assertAlmostEqual(found["poles"][0]["real"], 0.9, 6)
        # It is no axis of a radial rig, so there is no law of it.
        told = self.call(*csv_call, "thrust=seen:made", "--out", "law.yaml", status=BAD_INPUT).stderr
        self.assertIn("no controller for axis", told)
        self.assertFalse((self.folder / "law.yaml").exists())
        told = self.call(*csv_call, "thrust=seen", status=USAGE).stderr
        self.assertIn("allowed NAME=INPUT:OUTPUT", told)
        told = self.call(*csv_call, "thrust=absent:made", status=BAD_INPUT).stderr
        self.assertIn("absent", told)
        told = self.call(*csv_call, "thrust=seen:made", "--input-v-per-mm", "5", status=USAGE).stderr
        self.assertIn("both, or neither", told)


if __name__ == "__main__":
    unittest.main()

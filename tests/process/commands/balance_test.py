"""amb balance: weights from a run of the shipped rig, from session and CSV, and what is refused."""

import cmath
import json
import math
import re
import unittest

from command import BAD_INPUT, DONE, SHIPPED_RIG, USAGE, CommandTest, amb, edited, make_record

SCENARIO = """kind: scenario
name: quick_run_up
steps:
  - {do: lift, until: levitating, timeout_s: 5, hold_s: 0.5}
  - {do: spin, speed_rpm: 6000, acceleration_rpm_per_s: 1200, until: speed_reached, timeout_s: 12, hold_s: 0.2}
  - {do: spin, speed_rpm: 0, acceleration_rpm_per_s: 2000, until: standstill, timeout_s: 12}
  - {do: land, until: 'off', timeout_s: 5}
"""
PLANES = """kind: balance_planes
name: sleeves_and_disc
planes:
  - {name: drive_end, z_mm: 129.9, radius_mm: 20}
  - {name: disc, z_mm: 299.2, radius_mm: 30, holes: 12}
  - {name: far_end, z_mm: 399.6, radius_mm: 20}
"""
# Of config/rigs/flexible_rotor.yaml: g mm, rad.
TRUTH = {"drive_end": (5, 0.3), "disc": (18, 0.0), "far_end": (5, -1.1)}


def moment(entry):
    return cmath.rect(entry["moment_g_mm"], math.radians(entry["angle_deg"]))


class Balance(CommandTest):
    def call(self, *arguments, status=DONE):
        done = amb(self.folder, *arguments)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def json(self, name):
        return json.loads((self.folder / name).read_text())

    def record(self, name, rig="flexible_rotor"):
        self.write("run_up.yaml", SCENARIO)
        self.write("planes.yaml", PLANES)
        self.call("run", "--rig", rig, "--scenario", "run_up.yaml", "--record", name, "--no-dash")

    def test_weights_cancel_what_the_rig_file_hides_and_a_second_run_goes_on_from_there(self):
        self.record("before.lcm")
        said = self.call("balance", "before.lcm", "--planes", "planes.yaml", "--json", "b.json",
                         "--svg", "b.svg").stdout
        self.assertIn("wrote b.json, b.svg", said)
        self.assertIn("</svg>", (self.folder / "b.svg").read_text())
        found = self.json("b.json")
        left = {}
        for one in found["corrections"]:
            size, phase = TRUTH[one["plane"]]
            ratio = moment(one) / -cmath.rect(size, phase)
            self.assertLess(abs(abs(ratio) - 1), 0.05, one)
            self.assertLess(abs(math.degrees(cmath.phase(ratio))), 5, one)
            left[one["plane"]] = cmath.rect(size, phase) + moment(one)
        self.assertLess(found["left_percent"], 1)
        disc = next(one for one in found["corrections"] if one["plane"] == "disc")
        self.assertAlmostEqual(disc["mass_g"], disc["moment_g_mm"] / 30, places=9)
        self.assertTrue(all(1 <= weight["hole"] <= 12 for weight in disc["weights"]))
        # The weights go on; what is left is found from both runs.
        rig = edited(SHIPPED_RIG, *(
            (f"z_mm: {z}, moment_g_mm: {TRUTH[plane][0]}, phase_rad: {phase}}}",
             f"z_mm: {z}, moment_g_mm: {abs(left[plane])!r}, phase_rad: {cmath.phase(left[plane])!r}}}")
            for plane, z, phase in (("drive_end", "129.9", "0.3"), ("disc", "299.2", "0"),
                                    ("far_end", "399.6", "-1.1"))))
        self.write("balanced.yaml", rig)
        self.record("after.lcm", "balanced.yaml")
        applied = [word for one in found["corrections"]
                   for word in ("--applied",
                                f"{one['plane']}={one['mass_g']!r}@{one['angle_deg']!r}")]
        text = self.call("balance", "after.lcm", "--after", "before.lcm", "--rig", "flexible_rotor",
                         "--planes", "planes.yaml", *applied, "--json", "again.json").stdout
        self.assertIn("measured beside the model", text)
        again = self.json("again.json")
        # Largest orbits hold the noise of single windows, their squares' sum next to none.
        before, now = (sum(orbit["de"]["before_um"] ** 2 for orbit in said["orbits"]) ** 0.5
                       for said in (found, again))
        self.assertLess(now, 0.05 * before)
        for at in again["influence"][20::20]:
            ratio = [cmath.rect(m["amplitude_um"], math.radians(m["angle_deg"])) /
                     cmath.rect(e["amplitude_um"], math.radians(e["angle_deg"]))
                     for m, e in zip(at["measured"], at["model"])]
            self.assertLess(max(abs(one - 1) for one in ratio), 0.1, at)

    def test_a_csv_file_says_the_same_as_the_session_it_came_from(self):
        self.record("run.lcm")
        self.call("export", "run.lcm", "--csv", "run.csv")
        self.call("balance", "run.lcm", "--json", "session.json")
        self.call("balance", "run.csv", "--controller", "flexible_rotor_commissioned", "--json",
                  "csv.json")
        for one, other in zip(self.json("session.json")["corrections"],
                              self.json("csv.json")["corrections"]):
            self.assertLess(abs(moment(one) - moment(other)), 0.02 * abs(moment(one)))

    def test_drilling_takes_mass_on_the_other_side(self):
        self.record("run.lcm")
        plane = ("--plane", "disc=299.2,30")
        self.call("balance", "run.lcm", *plane, "--json", "add.json")
        text = self.call("balance", "run.lcm", *plane, "--drill", "--json", "drill.json").stdout
        self.assertIn("mass taken away", text)
        added = self.json("add.json")["corrections"][0]
        drilled = self.json("drill.json")["corrections"][0]
        self.assertLess(abs(moment(added) + moment(drilled)), 1e-6)
        # One plane does not reach what three hold.
        self.assertGreater(self.json("add.json")["left_percent"], 5)

    def test_run_out_that_is_found_is_written_for_the_law_to_take_off(self):
        amplitude_um, phase_deg = 6.0, 40.0
        hidden = edited(SHIPPED_RIG, ("\nbearings:", f"""
effects:
  - {{id: sensor_runout, channels: [nde_x], order: 1, amplitude_um: {amplitude_um}, phase_deg: {phase_deg}}}

bearings:"""))
        self.write("hidden.yaml", hidden)
        self.record("run.lcm", "hidden.yaml")
        self.call("balance", "run.lcm", "--rig", "flexible_rotor", "--write-run-outs", "clean.yaml")
        written = (self.folder / "clean.yaml").read_text()
        size, angle = re.search(r"channel: nde_x\s+amplitude_um: (\S+)\s+phase_deg: (\S+)", written).groups()
        found = cmath.rect(float(size), math.radians(float(angle)))
        true = cmath.rect(amplitude_um, math.radians(phase_deg))
        self.assertLess(abs(found - true), 0.1 * abs(true), written)
        self.call("run", "--rig", "hidden.yaml", "--controller", "clean.yaml", "--no-dash", "--require", "stable")
        self.call("balance", "run.lcm", "--rig", "flexible_rotor", "--controller", "flexible_rotor",
                  "--write-run-outs", "other.yaml")
        self.assertRegex((self.folder / "other.yaml").read_text(), r"(?m)^name: flexible_rotor$")

    def test_a_record_that_cannot_be_balanced_by_is_refused_in_one_sentence(self):
        make_record(self.folder / "still.csv", "healthy", 0, 5_000)
        self.assertIn("does not turn", self.call("balance", "still.csv", status=BAD_INPUT).stderr)
        make_record(self.folder / "slow.csv", "healthy", 600, 40_000)
        self.assertIn("a fifth of the rig's 6000 rpm",
                      self.call("balance", "slow.csv", status=BAD_INPUT).stderr)
        lines = (self.folder / "slow.csv").read_text().splitlines()
        (self.folder / "no_angle.csv").write_text(
            "\n".join(",".join(line.split(",")[:1] + line.split(",")[2:]) for line in lines) + "\n")
        self.assertIn("rotor_angle_rad",
                      self.call("balance", "no_angle.csv", status=BAD_INPUT).stderr)
        make_record(self.folder / "short.csv", "healthy", 3000, 3_000)
        self.assertIn("stretches of six turns",
                      self.call("balance", "short.csv", status=BAD_INPUT).stderr)

    def test_planes_and_weights_that_cannot_be_are_refused(self):
        make_record(self.folder / "r.csv", "healthy", 3000, 20_000)
        for words, status, part in (
                (("--plane", "disc"), USAGE, "NAME=Z_MM,RADIUS_MM"),
                (("--plane", "disc=900,30"), BAD_INPUT, "not on the shaft"),
                (("--plane", "disc=299.2,30,12,0,2,1"), USAGE, "must not be below the smallest"),
                (("--applied", "disc=1@2"), USAGE, "--after and --applied"),
                (("--after", "r.csv", "--applied", "disc=1@2"), USAGE, "no plane is named disc"),
                (("--planes", "absent.yaml"), BAD_INPUT, "absent.yaml")):
            done = self.call("balance", "r.csv", *words, status=status)
            self.assertIn(part, done.stderr, words)
            self.assertEqual(done.stdout, "", words)
        geared = self.call("balance", "r.csv", "--rig", "rao_geared_pair", status=BAD_INPUT)
        self.assertTrue(geared.stderr.startswith("amb: "), geared.stderr)


if __name__ == "__main__":
    unittest.main()

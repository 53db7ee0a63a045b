"""amb diagnose on a run of the very model it is given: lift, flight and landing, nothing wrong.

Whole runs as a newcomer records them. Contact, amplifiers that are off and the zeros of a rotor that
lies in its touchdown bearings are in them and must not be taken for a cause.
"""

import json
import os
import random
import re
import subprocess
import sys
import unittest
from pathlib import Path
from tempfile import TemporaryDirectory

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from waiting import LIMIT_S  # noqa: E402

BINARIES = Path(os.environ["LEVITAS_BINARIES"])
RECORDS = Path(os.environ["LEVITAS_SOURCE"]) / "tests/data/records"
CONFIG = Path(os.environ["LEVITAS_SOURCE"]) / "config"
USAGE = 2
BAD_INPUT = 3


def finished(folder, *arguments, **variables):
    return subprocess.run([str(BINARIES / "amb"), *map(str, arguments)], cwd=folder, text=True,
                          capture_output=True, timeout=LIMIT_S, check=False, env={**os.environ, **variables})


def amb(folder, *arguments):
    done = finished(folder, *arguments)
    assert done.returncode == 0, done.stderr
    return done.stdout


class DiagnoseOwnRotor(unittest.TestCase):
    """A run from lift to landing without a test signal, of a rotor that nobody here has shipped."""

    SEED = 3
    SIX = ("--mass-kg", "12", "--length-mm", "700", "--speed-rpm", "9000", "--gap-mm", "0.5",
           "--bias-a", "2.5", "--ki-n-per-a", "80", "--disc", "350:4:260")

    @classmethod
    def setUpClass(cls):
        cls.shared = TemporaryDirectory()
        amb(cls.shared.name, "new", "rig", "blower", *cls.SIX)

    @classmethod
    def tearDownClass(cls):
        cls.shared.cleanup()

    def answer(self, name, effects=""):
        """Of a run of the rig with these effects, asked with the rig file without them."""
        folder = Path(self.shared.name)
        own = (folder / "blower/blower.yaml").read_text()
        (folder / "blower" / (name + ".yaml")).write_text(own + effects)
        amb(folder, "run", "--rig", f"blower/{name}.yaml", "--record", name + ".lcm", "--no-dash")
        printed = amb(folder, "diagnose", name + ".lcm", "--rig", "blower/blower.yaml", "--quick",
                      "--out", name)
        return printed, json.loads((folder / name / "diagnosis.json").read_text())

    def test_a_coupling_that_pushes_at_rest_and_while_it_turns_is_named(self):
        draw = random.Random(self.SEED)
        force_n, phase_deg = draw.uniform(2.0, 5.0), draw.uniform(-180.0, 180.0)
        order = draw.choice((2, -2, 3))
        printed, answer = self.answer("hidden", "effects:\n  - {id: misalignment, z_mm: 0, "
                                      f"order: {order}, force_n: {force_n}, phase_deg: {phase_deg}}}\n")
        self.assertEqual((answer["cause"], answer["also_possible"]), ("misalignment", []), printed)
        self.assertEqual(answer["candidates"][0]["effect"], "misalignment", printed)
        forces = {p["where"]: p["value"] for p in answer["parameters"].values()
                  if (p["effect"], p["key"]) == ("misalignment", "force_n")}
        largest = max(forces, key=forces.get)
        self.assertEqual(largest, f"order {order}", forces)
        self.assertAlmostEqual(forces[largest], force_n, delta=0.1 * force_n)

    def test_the_same_run_without_it_has_no_cause(self):
        printed, answer = self.answer("healthy")
        self.assertEqual(answer["verdict"], "none", printed)


class DiagnoseOwnModel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.shared = TemporaryDirectory()
        cls.answers = {}
        amb(cls.shared.name, "run", "--record", "run.lcm")
        amb(cls.shared.name, "export", "run.lcm", "--csv", "run.csv")

    @classmethod
    def tearDownClass(cls):
        cls.shared.cleanup()

    def diagnose(self, data):
        """Each record is asked once: what several tests look at is one answer of half a minute."""
        if data not in self.answers:
            out = Path(self.shared.name) / ("answer_" + data.replace(".", "_"))
            printed = amb(self.shared.name, "diagnose", "--quick", "--explain", "--rig", "flexible_rotor", data,
                          "--out", out)
            self.answers[data] = printed, json.loads((out / "diagnosis.json").read_text())
        return self.answers[data]

    def test_a_session_of_the_model_itself_has_no_cause(self):
        printed, answer = self.diagnose("run.lcm")
        self.assertEqual(answer["verdict"], "none", printed)
        self.assertEqual(answer["all_causes"], [], printed)

    def test_the_answer_is_the_same_bytes_however_many_threads_compute_it(self):
        answers = set()
        for threads in ("1", "2", "4"):
            done = finished(self.shared.name, "diagnose", "--quick", "--rig", "flexible_rotor", "run.csv",
                            "--out", "threads", "--json", "-", LEVITAS_THREADS=threads)
            self.assertEqual(done.returncode, 0, done.stderr)
            answers.add(re.sub(r'"date_utc": *"[^"]*"', "", done.stdout))
        self.assertEqual(len(answers), 1)
        self.assertIn('"verdict"', answers.pop())

    def test_threads_that_are_no_number_are_refused(self):
        done = finished(self.shared.name, "diagnose", "--quick", "run.csv", "--out", "threads", LEVITAS_THREADS="many")
        self.assertEqual(done.returncode, USAGE)
        self.assertIn("LEVITAS_THREADS: found 'many', allowed 1 to 1024", done.stderr)

    def test_a_csv_of_the_same_run_lift_to_landing_has_no_cause(self):
        printed, answer = self.diagnose("run.csv")
        self.assertEqual(answer["verdict"], "none", printed)

    def test_none_without_a_test_signal_says_what_would_not_have_shown(self):
        printed, answer = self.diagnose("run.lcm")
        limits = answer["cannot_tell"]
        self.assertIn("extra_delay", limits["effects"])
        self.assertNotIn("unbalance", limits["effects"], "the rotor turns")
        self.assertIn(limits["sentence"], printed)
        self.assertEqual(answer["next_experiment"], limits["record_next"])
        page = (Path(self.shared.name) / "answer_run_lcm/report.html").read_text()
        self.assertIn(limits["sentence"], page)
        self.assertFalse(answer["achievable_gain"]["meaningful"], "the model itself was recorded")

    def test_every_calibrated_value_is_told_beside_its_nominal_one_and_read_back(self):
        printed, answer = self.diagnose("run.lcm")
        values = {(v["effect"], v["where"]): v for v in answer["calibrated"]}
        delay = values["extra_delay", "all axes"]
        self.assertEqual((delay["key"], delay["unit"], delay["nominal"]),
                         ("delay_samples", "samples", 1.0))
        for effect, where, key in (("current_gain", "de_x", "ratio"),
                                   ("modal_frequency", "mode 1", "frequency_hz"),
                                   ("sensor_offset", "nde_y", "offset_um"),
                                   ("sensor_runout", "order 1, de_x", "amplitude_um")):
            self.assertEqual(values[effect, where]["key"], key)
        for value in answer["calibrated"]:
            # Data can only narrow what the tolerance says; a law that bends does so by its slope.
            self.assertGreater(value["std"], 0.0, value)
            self.assertLess(value["std"], 1.05 * value["tolerance"], value)
        self.assertLess(abs(delay["calibrated"] - 1.0), 3 * delay["std"], "recorded with 1")
        modes = amb(self.shared.name, "modes", "--rig", "answer_run_lcm/calibrated_rig.yaml")
        self.assertIn("Hz", modes)
        self.assertIn("calibrated_rig.yaml", printed, "files that were written are named")
        for effect, where in values:
            self.assertTrue(any(effect in line and where in line for line in printed.splitlines()),
                            (effect, where))

    def test_a_rig_that_levitates_under_the_law_of_its_session_is_written_without_a_word(self):
        printed, answer = self.diagnose("run.lcm")
        levitation = answer["levitation"]
        self.assertEqual(levitation["sentences"], [], printed)
        self.assertEqual(levitation["records_without_law"], [])
        [law] = levitation["laws"]
        self.assertIn("of the session", law["law"])
        self.assertGreater(law["speed_rpm_to"], 1000.0, "the rotor turns in this run")
        for rig in ("rig_file", "extended_rig", "calibrated_rig"):
            self.assertIs(law[rig]["levitates"], True, rig)
        for text in self.written("answer_run_lcm"):
            self.assertNotIn("LEVITATE", text)
            self.assertNotIn("levitate under the law", text)

    def test_a_rig_that_falls_under_the_law_that_it_names_says_so_everywhere(self):
        folder = Path(self.shared.name)
        # A twentieth of the stiffness: less than that of the magnets, which is negative.
        law = (CONFIG / "controllers/flexible_rotor.yaml").read_text()
        weak = re.sub(r"(kp_a_per_m: *)([0-9.e+]+)",
                      lambda found: f"{found[1]}{0.05 * float(found[2])}", law)
        self.assertNotEqual(weak, law)
        (folder / "weak.yaml").write_text(weak)
        rig = (CONFIG / "rigs/flexible_rotor.yaml").read_text()
        self.assertNotIn("\nrun:", rig)
        (folder / "own.yaml").write_text(
            rig + "\nrun:\n  controller: ./weak.yaml\n  scenario: levitate\n")
        printed = amb(folder, "diagnose", "--quick", "--rig", "own.yaml", "run.csv", "--out", "weak")
        answer = json.loads((folder / "weak/diagnosis.json").read_text())
        sentence = answer["levitation"]["sentences"][0]
        self.assertIn("calibrated_rig.yaml DOES NOT LEVITATE", sentence)
        self.assertIn("which the rig file names", sentence)
        self.assertIn(sentence, printed)
        for text in self.written("weak"):
            self.assertIn("DOES NOT LEVITATE", text)
        amb(folder, "modes", "--rig", "weak/calibrated_rig.yaml")  # the comment leaves it readable

    def test_of_a_record_whose_law_nobody_names_it_is_said_that_it_was_not_judged(self):
        printed, answer = self.diagnose("run.csv")
        self.assertEqual(answer["levitation"]["records_without_law"], ["run.csv"])
        self.assertIn("not judged", printed)
        for text in self.written("answer_run_csv"):
            self.assertIn("levitate under the law of the records", text)
            self.assertNotIn("DOES NOT LEVITATE", text)

    def written(self, folder):
        names = ("report.html", "calibrated_rig.yaml", "extended_rig.yaml")
        return [(Path(self.shared.name) / folder / name).read_text() for name in names]

    def refuse(self, words, *arguments):
        done = finished(self.shared.name, "diagnose", "--quick", *arguments, "--out", "made/not")
        self.assertEqual(done.returncode, BAD_INPUT, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)
        self.assertFalse((Path(self.shared.name) / "made").exists(), "an empty folder is left")

    def test_what_was_fitted_may_not_validate(self):
        folder = Path(self.shared.name)
        (folder / "copy.csv").write_bytes((folder / "run.csv").read_bytes())
        (folder / "below").mkdir(exist_ok=True)
        for data, holdout in (("run.csv", "below/../run.csv"), ("run.csv", "copy.csv"),
                              ("run.lcm", "run.csv")):
            self.refuse(("--holdout", holdout.rsplit("/", 1)[-1], data), "--rig", "flexible_rotor",
                        data, "--holdout", holdout)
        self.refuse(("--healthy", "copy.csv"), "--rig", "flexible_rotor", "run.csv", "--healthy",
                    "copy.csv")
        self.refuse(("twice",), "--rig", "flexible_rotor", "run.csv", "copy.csv")

    def test_data_of_another_kind_or_rig_are_refused_in_one_line_with_a_way_on(self):
        (Path(self.shared.name) / "notes.txt").write_text("time position\n0 1\n")
        self.refuse(("notes.txt", "not a session", ".csv", ".mat", "candump"), "--rig",
                    "flexible_rotor", "notes.txt")
        self.refuse(("run.csv", "de_x", "ball_x", "--rig"), "--rig", "two_magnet_levitator",
                    "run.csv")

    def test_columns_in_another_unit_than_their_names_are_named_and_read_as_they_are(self):
        folder = Path(self.shared.name)
        head, rows = (folder / "run.csv").read_text().split("\n", 1)
        self.assertIn("_m,", head)
        positions = [f"position_{axis}" for axis in ("de_x", "de_y", "nde_x", "nde_y")]
        currents = [f"control_current_{axis}" for axis in ("de_x", "de_y", "nde_x", "nde_y")]
        milliampere = ",".join(name[:-2] + "_ma" if name.startswith("control_current") else name
                               for name in head.split(","))
        for name, wrong, columns in (("um.csv", head.replace("_m,", "_um,"), positions),
                                     ("ma.csv", milliampere, currents)):
            (folder / name).write_text(wrong + "\n" + rows)
            printed, answer = self.diagnose(name)
            errors = answer["record_errors"]
            self.assertEqual([(e["kind"], e["record"], sorted(e["channels"])) for e in errors],
                             [("unit", name, columns)], printed)
            self.assertIn(f"Error of the record {name}: " + ", ".join(columns), printed)
            self.assertIn("To mend it:", printed)
            self.assertEqual(answer["verdict"], "none", printed)

    def test_times_of_a_clock_that_is_slow_are_named_and_the_rows_taken_as_the_rigs(self):
        folder = Path(self.shared.name)
        head, *rows = (folder / "run.csv").read_text().splitlines()
        at = head.split(",").index("time_s")
        for n, row in enumerate(rows):
            cells = row.split(",")
            cells[at] = repr(1.02 * float(cells[at]))
            rows[n] = ",".join(cells)
        (folder / "slow.csv").write_text("\n".join([head, *rows]) + "\n")
        printed, answer = self.diagnose("slow.csv")
        self.assertEqual([e["kind"] for e in answer["record_errors"]], ["rate"], printed)
        self.assertIn("9803.92 rows a second, the rig samples 10000 times", printed)
        self.assertEqual(answer["verdict"], "none", printed)

    def test_as_is_looks_for_no_errors_of_the_record(self):
        folder = Path(self.shared.name)
        (folder / "unit.csv").write_text((folder / "run.csv").read_text().replace("_m,", "_um,", 8))
        done = finished(folder, "diagnose", "--quick", "--as-is", "--rig", "flexible_rotor",
                        "unit.csv", "--out", "as_is")
        self.assertEqual(done.returncode, BAD_INPUT, done.stderr)
        self.assertNotIn("Error of the record", done.stderr)

    def test_a_record_without_flight_is_refused_with_what_was_found(self):
        lines = (Path(self.shared.name) / "run.csv").read_text().splitlines(True)
        # The self-test and the lift: touchdown bearings have 190 um.
        (Path(self.shared.name) / "low.csv").write_text("".join(lines[:6000]))
        self.refuse(("low.csv", "free flight", "0.5 s", "190 um"), "--rig", "flexible_rotor",
                    "low.csv")


class DiagnoseForeignCampaigns(unittest.TestCase):
    def diagnose(self, campaign, folder, *more):
        data = sorted((RECORDS / campaign).glob("*.csv.xz"))
        printed = amb(folder, "diagnose", "--quick", "--rig", "flexible_rotor", *data, "--out",
                      "answer", *more)
        return printed, json.loads((Path(folder) / "answer/diagnosis.json").read_text())

    def test_parameters_have_keys_and_units_of_the_rig_file(self):
        with TemporaryDirectory() as folder:
            printed, answer = self.diagnose("eddy_current", folder)
            rig = (Path(folder) / "answer/extended_rig.yaml").read_text()
            self.assertEqual(set(p["key"] for p in answer["parameters"].values()), {"tau_us"})
            for parameter in answer["parameters"].values():
                written = [float(line.split()[1]) for line in rig.splitlines()
                           if line.strip().startswith("tau_us:")]
                self.assertTrue(any(abs(value - parameter["value"]) < 1e-4 * value
                                    for value in written), (written, parameter))
                self.assertEqual(parameter["unit"], "us")
            listed = [line for line in printed.splitlines() if line.startswith("  eddy_current tau_us")]
            self.assertEqual(len(listed), 1, "one value at all axes is told once")

    def test_the_calibrated_rig_predicts_what_the_calibrated_model_did(self):
        with TemporaryDirectory() as folder:
            _, first = self.diagnose("eddy_current", folder)
            data = sorted((RECORDS / "eddy_current").glob("*.csv.xz"))
            amb(folder, "diagnose", "--quick", "--rig", "answer/calibrated_rig.yaml", *data,
                "--out", "again")
            again = json.loads((Path(folder) / "again/diagnosis.json").read_text())
            gained = first["fit_percent"]["after"] - first["fit_percent"]["before"]
            left = first["fit_percent"]["after"] - again["fit_percent"]["before"]
            # All but the shapes of the modes, which have no key.
            self.assertGreater(gained, 5.0, "else there is nothing to compare")
            self.assertLess(abs(left), 0.05 * gained, (first["fit_percent"], again["fit_percent"]))

    def test_no_plan_is_written_where_nothing_is_left_to_separate(self):
        with TemporaryDirectory() as folder:
            printed, answer = self.diagnose("none", folder, "--plan", "next.yaml")
            off = [v for v in answer["calibrated"] if v["moved_deviations"] > 5.0]
            self.assertEqual("--healthy" in answer["next_experiment"], bool(off), printed)
            self.assertEqual(answer["next_experiment"] == "none needed", not off, printed)
            self.assertFalse(off and "Nothing to gain" in printed, printed)
            self.assertEqual(answer["cannot_tell"]["effects"], [])
            self.assertFalse((Path(folder) / "next.yaml").exists())
            self.assertIn("next.yaml is not written", printed)

    def test_a_plan_before_the_diagnosis_says_what_records_can_tell_apart_and_what_would_help(self):
        with TemporaryDirectory() as folder:
            (Path(folder) / "rest.yaml").write_text(
                "kind: scenario\nname: rest\nsteps:\n"
                "  - {do: lift, until: levitating, timeout_s: 9, hold_s: 1.5}\n"
                "  - {do: land, until: 'off', timeout_s: 9}\n")
            printed = amb(folder, "diagnose", "--plan", "next.yaml", "--rig", "flexible_rotor", "--scenario",
                          "rest.yaml", "--json", "plan.json")
            plan = json.loads((Path(folder) / "plan.json").read_text())
            faults = {fault["effect"]: fault for fault in plan["faults"]}
            self.assertEqual(faults["unbalance"]["answer"], "not_visible", "nothing turns")
            self.assertEqual(faults["dropped_samples"]["answer"], "found", printed)
            ways = {way["what"]: way["helps"] for way in plan["tried"]}
            for what, helps in ways.items():
                if "turning" not in what and "run-up" not in what:
                    self.assertNotIn("unbalance", helps, what)
            self.assertTrue(any("unbalance" in helps for helps in ways.values()), ways)
            self.assertTrue((Path(folder) / "next.yaml").exists())

    def test_a_plan_with_nothing_to_plan_from_or_with_options_of_a_diagnosis_is_refused(self):
        with TemporaryDirectory() as folder:
            for arguments, status, word in (
                    (("--plan",), USAGE, "--scenario"),
                    (("--plan", "--scenario", "default", "--quick"), USAGE, "--quick"),
                    (("--scenario", "default", "--out", "d", "x.lcm"), USAGE, "--plan"),
                    (("x.lcm",), USAGE, "--out is required"),
                    (("--plan", "absent.lcm"), BAD_INPUT, "absent.lcm"),
                    (("--plan", "--scenario", "absent"), BAD_INPUT, "absent"),
                    (("--plan", "--rig", "two_magnet_levitator", "--scenario", "two_magnet_levitator"), BAD_INPUT,
                     "levitator")):
                done = finished(folder, "diagnose", *arguments)
                self.assertEqual(done.returncode, status, (arguments, done.stderr))
                self.assertIn(word, done.stderr)
                self.assertEqual(list(Path(folder).iterdir()), [])


if __name__ == "__main__":
    unittest.main()

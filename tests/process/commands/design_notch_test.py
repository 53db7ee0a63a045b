"""amb design notch: what it accepts is run, replayed and judged by other commands; what it refuses is named."""

import json
import re
import unittest

from command import BAD_INPUT, DONE, OTHER, USAGE, CommandTest, amb

NOT_MET = 5

QUICK = ("design", "notch", "--draws", "2")
COMMISSIONED = ("--controller", "flexible_rotor_commissioned")


class DesignNotch(CommandTest):
    def call(self, *arguments, status=DONE):
        done = amb(self.folder, *arguments)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def test_what_it_accepts_is_run_with_its_events_and_replayed(self):
        self.call(*QUICK, *COMMISSIONED, "--from-rpm", "1500", "--to-rpm", "3900", "--out", "quiet.yaml", "--json",
                  "notch.json")
        self.assertTrue((self.folder / "quiet.yaml").read_text().startswith("# amb design notch: block unbalance"))
        notch = json.loads((self.folder / "notch.json").read_text())
        self.assertTrue(notch["allowed"])
        self.assertTrue(all(abs(at["slowest_decay"] - 1.0) < 0.1 for at in notch["speeds"]))
        said = self.call("run", "--controller", "quiet.yaml", "--record", "s.lcm")
        self.assertIn("ACCEPTED", said.stdout)
        events = (self.folder / "s.lcm").read_bytes()
        self.assertIn(b"synchronous control unbalance begins at 1500 rpm", events)
        self.assertIn(b"synchronous control unbalance ends at 1470 rpm", events)
        self.assertIn("every output bit", self.call("replay", "s.lcm").stdout)
        margins = self.call("margins", "--controller", "quiet.yaml", "--require", "stable").stdout
        self.assertIn("synchronous control: decay of each block", margins)

    def test_what_a_run_measured_serves_instead_of_the_rig_file(self):
        self.call("run", "--scenario", "identify", "--record", "id.lcm", "--no-dash")
        said = self.call(*QUICK, *COMMISSIONED, "--measured", "id.lcm", "--from-rpm", "1500", "--to-rpm", "2900",
                         "--out", "quiet.yaml", "--json", "notch.json").stdout
        self.assertIn("T is of the answer measured at 1600 rpm", said)
        notch = json.loads((self.folder / "notch.json").read_text())
        self.assertTrue(all(abs(at["slowest_decay"] - 1.0) < 0.2 for at in notch["speeds"]))
        run = self.call("run", "--controller", "quiet.yaml").stdout
        self.assertRegex(run, r"blocks    unbalance: acted \d+\.\d+ s")
        poles = self.call("poles", "--controller", "quiet.yaml", "--speeds", "600,2000").stdout
        self.assertEqual(poles.count("with synchronous control (unbalance): STABLE"), 1)
        beyond = self.call(*QUICK, *COMMISSIONED, "--measured", "id.lcm", "--order", "0.02", "--from-rpm", "1500",
                           "--to-rpm", "2200", status=BAD_INPUT)
        self.assertIn("has no lines around", beyond.stderr)

    def test_a_critical_speed_is_refused_with_its_range_and_nothing_is_written(self):
        before = self.files()
        done = self.call(*QUICK, "--from-rpm", "1500", "--out", "quiet.yaml", status=OTHER)
        self.assertRegex(done.stderr, r"^amb: refused at \d+ to \d+ rpm \(without its synchronous force the orbit")
        self.assertEqual(self.files(), before)
        # What it says is allowed can be asked for as it stands.
        first, last = re.search(r"allowed (\d+) to (\d+) rpm", done.stderr).groups()
        self.assertEqual(first, "1500")
        self.call(*QUICK, "--from-rpm", first, "--to-rpm", last, "--out", "quiet.yaml")
        text = (self.folder / "quiet.yaml").read_text()
        self.assertIn(f"from_rpm: {first}\n", text)
        self.assertIn(f"to_rpm: {last}\n", text)
        self.assertNotIn("taken as", self.call("margins", "--controller", "quiet.yaml").stdout)
        (self.folder / "orbit.yaml").write_text(text.replace("angle_from: rig", "angle_from: orbit"))
        self.assertIn("is taken as true", self.call("margins", "--controller", "orbit.yaml").stdout)

    def test_a_block_that_the_file_around_it_cannot_have_is_refused_before_it_is_written(self):
        self.call(*QUICK, *COMMISSIONED, "--from-rpm", "1500", "--to-rpm", "3900", "--out", "quiet.yaml")
        text = (self.folder / "quiet.yaml").read_text()
        self.assertIn("angle_from: rig", text)
        (self.folder / "orbit.yaml").write_text(text.replace("angle_from: rig", "angle_from: orbit"))
        before = self.files()
        done = self.call(*QUICK, "--controller", "orbit.yaml", "--target", "vibration", "--name", "high",
                         "--from-rpm", "4700", "--out", "both.yaml", status=BAD_INPUT)
        self.assertIn("both.yaml (not written)", done.stderr)
        self.assertIn("target current leaves it", done.stderr)
        self.assertEqual(self.files(), before)
        # The window ends at an odd speed: where the last judged speed rounded beyond it, it was refused.
        self.call(*QUICK, *COMMISSIONED, "--from-rpm", "1500", "--to-rpm", "3777", "--out", "odd.yaml")

    def test_a_run_with_an_estimated_angle_says_that_it_is_one(self):
        self.call(*QUICK, *COMMISSIONED, "--from-rpm", "1500", "--to-rpm", "3900", "--out", "quiet.yaml")
        text = (self.folder / "quiet.yaml").read_text()
        (self.folder / "orbit.yaml").write_text(text.replace("angle_from: rig", "angle_from: orbit"))
        run = self.call("run", "--controller", "orbit.yaml", "--scenario", "run_up_6000", "--record", "s.lcm").stdout
        self.assertRegex(run, r"unbalance: acted \d+\.\d+ s.* no mark on the shaft, its angle is estimated from the orbit")
        self.assertNotIn(b"angle jumped", (self.folder / "s.lcm").read_bytes())
        self.assertIn("every output bit", self.call("replay", "s.lcm").stdout)

    def test_a_block_that_its_rig_cannot_have_is_never_lifted(self):
        self.call(*QUICK, "--from-rpm", "1500", "--to-rpm", "3900", "--out", "quiet.yaml")
        text = (self.folder / "quiet.yaml").read_text()
        # The same block with T turned by half a turn.
        turned = []
        for line in text.splitlines():
            stem = line.strip()
            if stem.startswith(("real:", "imaginary:", "- real:")):
                key, value = line.split(": ")
                line = f"{key}: {-float(value)!r}"
            turned.append(line)
        (self.folder / "bad.yaml").write_text("\n".join(turned) + "\n")
        done = self.call("run", "--controller", "bad.yaml", status=BAD_INPUT)
        self.assertIn("synchronous block unbalance is not stable with this rig from 1470 to", done.stderr)
        self.assertIn("Nothing was lifted", done.stderr)
        self.call("margins", "--controller", "bad.yaml", "--require", "stable", status=NOT_MET)

    def test_without_a_rotor_it_is_slower_and_judged_with_the_files_rotor_all_the_same(self):
        self.call(*QUICK, *COMMISSIONED, "--without-rotor", "--from-rpm", "1500", "--to-rpm", "3900", "--out",
                  "quiet.yaml", "--json", "notch.json")
        speeds = json.loads((self.folder / "notch.json").read_text())["speeds"]
        self.assertTrue(all(0.2 <= at["slowest_decay"] < 2.0 for at in speeds))
        self.assertGreater(max(abs(at["slowest_decay"] - 1.0) for at in speeds), 0.3)
        self.assertIn("ACCEPTED", self.call("run", "--controller", "quiet.yaml").stdout)
        # Stable through the first bending, but no bearing holds the rotor there.
        done = self.call(*QUICK, *COMMISSIONED, "--without-rotor", "--from-rpm", "4800", "--json", "notch.json",
                         status=OTHER)
        self.assertIn("without its synchronous force the orbit could grow", done.stderr)
        speeds = json.loads((self.folder / "notch.json").read_text())["speeds"]
        self.assertTrue(all(at["slowest_decay"] > 0.0 for at in speeds))
        self.assertGreater(max(at["orbit_m"] for at in speeds), 190e-6)
        self.assertLess(max(at["orbit_alone_m"] for at in speeds), 36e-6)

    def test_a_second_block_stands_beside_the_first_and_a_name_replaces(self):
        self.call(*QUICK, "--from-rpm", "1500", "--to-rpm", "3900", "--name", "low", "--out", "a.yaml")
        for before, after, to in (("a.yaml", "b.yaml", "5800"), ("b.yaml", "c.yaml", "6000")):
            self.call(*QUICK, "--controller", before, "--target", "vibration", "--from-rpm", "4700", "--to-rpm", to,
                      "--name", "high", "--out", after)
        text = (self.folder / "c.yaml").read_text()
        self.assertEqual(text.count("name: low"), 1)
        self.assertEqual(text.count("name: high"), 1)
        self.assertIn("to_rpm: 6000", text)

    def test_bad_options_are_one_sentence(self):
        self.call(*QUICK, "--from-rpm", "3000", "--to-rpm", "2000", status=USAGE)
        done = self.call(*QUICK, "--order", "100", status=USAGE)
        self.assertIn("reaches half the sampling frequency at 3000 rpm", done.stderr)
        self.call(*QUICK, "--rig", "absent", status=BAD_INPUT)


if __name__ == "__main__":
    unittest.main()

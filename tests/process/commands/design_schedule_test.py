"""amb design schedule: tables of laws from files and from a search, and what other commands make of them."""

import json
import re
import unittest

from command import BAD_INPUT, DONE, OTHER, USAGE, CommandTest, amb

RIG = ("--rig", "flexible_rotor")
QUICK = ("--draws", "1", "--corners", "1")
COMMISSIONED = "flexible_rotor_commissioned"


class DesignSchedule(CommandTest):
    def call(self, *arguments, status=DONE):
        done = amb(self.folder, *arguments)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def schedule(self, *arguments, status=DONE):
        return self.call("design", "schedule", *RIG, *QUICK, *arguments, status=status)

    def peak(self, controller, rpm):
        self.call("margins", *RIG, "--controller", controller, "--speed-rpm", rpm, "--json", "m.json")
        told = json.loads((self.folder / "m.json").read_text())
        return [axis["sensitivity_peak"] for axis in told["speeds"][0]["axes"]]

    def test_a_table_of_files_has_the_law_of_each_at_its_speed(self):
        said = self.schedule("--law", f"0:{COMMISSIONED}", "--law", "6000:flexible_rotor",
                             "--most-sensitivity", "5", "--out", "table.yaml", "--html", "table.html", "--json", "table.json").stdout
        self.assertIn("ACCEPTED", said)
        self.assertIn("the schedule takes the largest |S| from", said)
        self.assertEqual(self.peak("table.yaml", 0), self.peak(COMMISSIONED, 0))
        self.assertEqual(self.peak("table.yaml", 6000), self.peak("flexible_rotor", 6000))
        self.assertNotEqual(self.peak("table.yaml", 6000), self.peak(COMMISSIONED, 6000))
        names = [law["name"] for law in json.loads((self.folder / "table.json").read_text())["laws"]]
        self.assertEqual(names, [COMMISSIONED, "flexible_rotor", "schedule"])
        self.assertIn("<svg", (self.folder / "table.html").read_text())
        run = self.call("run", *RIG, "--controller", "table.yaml", "--duration", "1.5", "--record",
                        "run.lcm").stdout
        self.assertIn("run.lcm", run)
        self.assertIn("every output bit", self.call("replay", "run.lcm").stdout)

    def test_a_law_of_another_structure_takes_over_while_the_rotor_is_levitated(self):
        self.call("design", "hinf", *RIG, "--draws", "1", "--corners", "0", "--out", "robust.yaml")
        said = self.schedule("--law", f"0:{COMMISSIONED}", "--law", "1500:robust.yaml", "--out", "both.yaml",
                             "--html", "both.html").stdout
        self.assertIn("robust.yaml takes over at 1500 rpm: its structure is another one", said)
        self.assertIn("ACCEPTED", said)
        self.assertIn("exchange: true", (self.folder / "both.yaml").read_text())
        self.assertEqual(self.peak("both.yaml", 1400), self.peak(COMMISSIONED, 1400))
        self.assertEqual(self.peak("both.yaml", 1600), self.peak("robust.yaml", 1600))
        self.assertIn("each law judged as far beyond it as it may act", said)
        self.call("run", *RIG, "--controller", "both.yaml", "--scenario", "run_up_6000", "--record", "run.lcm")
        told = re.findall(rb"law (\d) of the schedule takes over from law (\d) at (\d+) rpm",
                          (self.folder / "run.lcm").read_bytes())
        # 0.1 s of listening at 800 rpm/s, and 3 % below on the way down.
        self.assertEqual([at[:2] for at in told], [(b"2", b"1"), (b"1", b"2")])
        self.assertTrue(1570 < int(told[0][2]) < 1600 and 1360 < int(told[1][2]) < 1390, told)
        self.assertIn("every output bit", self.call("replay", "run.lcm").stdout)
        unmarked = (self.folder / "both.yaml").read_text().replace("exchange: true", "exchange: false")
        (self.folder / "unmarked.yaml").write_text(unmarked)
        refused = self.call("margins", *RIG, "--controller", "unmarked.yaml", status=BAD_INPUT).stderr
        self.assertIn("`exchange: true` lets it take over", refused)

    def test_a_search_writes_what_its_check_accepts(self):
        said = self.schedule("--evaluations", "400", "--speeds", "6000", "--out", "table.yaml",
                             "--sensitivity", "4", "--most-sensitivity", "9").stdout
        self.assertIn("laws for 2 speeds", said)
        self.assertIn("ACCEPTED", said)
        self.assertIn("speed_rpm: 6000", (self.folder / "table.yaml").read_text())

    def test_what_is_no_table_is_refused_and_leaves_nothing(self):
        before = self.files()
        laws = (f"0:{COMMISSIONED}", "6000")
        self.assertIn("expected RPM:CONTROLLER", self.schedule("--law", laws[0], "--law", laws[1], "--out",
                                                               "t.yaml", status=USAGE).stderr)
        done = self.schedule("--law", f"3000:{COMMISSIONED}", "--law", f"2000:{COMMISSIONED}", "--out",
                             "t.yaml", status=USAGE)
        self.assertIn(f"--law 2000:{COMMISSIONED}: the speeds of a table rise", done.stderr)
        done = self.call("design", "schedule", "--rig", "one_axis", "--out", "t.yaml", status=BAD_INPUT)
        self.assertIn("does not turn", done.stderr)
        self.assertEqual(self.files(), before)

    def test_a_table_that_drops_the_rotor_on_its_way_is_not_accepted(self):
        self.schedule("--law", f"0:{COMMISSIONED}", "--law", f"6000:{COMMISSIONED}", "--out", "same.yaml")
        # Three tenths of the gains at 3000 rpm: less than the magnets' negative stiffness.
        whole = (self.folder / "same.yaml").read_text()
        head, table = whole.split("\nschedule:")
        laws = "laws:" + head.split("laws:")[1].split("\nsequence:")[0].rstrip()
        weak = "".join(f"{line.split(':')[0]}: {0.3 * float(line.split(':')[1])}\n"
                       if line.strip().startswith(("kp_", "ki_")) else line + "\n"
                       for line in laws.splitlines())
        entry = "    - speed_rpm: 3000\n" + "".join("      " + line + "\n" for line in weak.splitlines())
        (self.folder / "weak.yaml").write_text(
            head + "\nschedule:" + table.replace("  speeds:\n", "  speeds:\n" + entry, 1))
        done = self.call("design", "check", *RIG, "--controller", "weak.yaml", *QUICK, status=OTHER)
        self.assertIn("NOT ACCEPTED: the loop", done.stdout)


if __name__ == "__main__":
    unittest.main()

"""amb identify live beside a real controller: what it says, records and shows on the page."""

import csv
import json
import signal
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from dashboard_rig import Rig, in_mode, until  # noqa: E402
from lcm_network import BINARIES, Process, run  # noqa: E402
from waiting import LIMIT_S  # noqa: E402

# Few parameters: what is looked at here does not depend on how many.
SMALL = ("--order", "2", "--degree", "2", "--noise-order", "0")
AXES = ("de_x", "de_y", "nde_x", "nde_y")


def settles(told):
    changes = told.get("change_percent", [])
    return len(changes) > 1 and min(changes[1:]) < changes[0]


class BesideTheLoop(unittest.TestCase):
    def test_tells_records_and_shows_how_far_it_has_come(self):
        rig = Rig(self)
        live = rig.started(Process(rig.folder, "amb", "identify", "live", *SMALL, "--patience", LIMIT_S,
                                   "--record", "convergence.csv", "--json", "live.json"))
        live.says("flexible_rotor: 4 axes, 10 kHz")
        self.assertEqual(rig.command("lift"), (200, "accepted"))
        until(rig.url, in_mode("levitating"))
        # From nothing the first estimate changes by 100 %, the next perhaps by more: rest, lift and the
        # levitated rotor are three different systems. Levitated, it settles.
        told = until(rig.url, lambda name, data: name == "convergence" and settles(data))
        self.assertEqual(len(told["fit_percent"]), 4)
        live.send_signal(signal.SIGINT)
        self.assertEqual(live.status(), 0, live.text)
        self.assertIn("rows learnt, cycles", live.text)
        self.assert_recorded(Path(rig.folder))
        rig.controller.says("levitating")  # and goes on: the listener's end is none of its business
        self.assertEqual(rig.command("land"), (200, "accepted"))

    def assert_recorded(self, folder):
        with (folder / "convergence.csv").open(encoding="utf-8") as lines:
            rows = list(csv.DictReader(lines))
        answer = json.loads((folder / "live.json").read_text())
        self.assertEqual(len(rows), len(answer["points"]))
        self.assertGreater(len(rows), 1)
        for axis in AXES:
            self.assertGreater(float(rows[-1][f"error_{axis}_m"]), 0.0)
            self.assertIn(f"curve2_{axis}_1_per_a", rows[-1])
        for row, point in zip(rows, answer["points"]):
            self.assertEqual(float(row["largest_change"]) * 100.0, point["largest_change_percent"])
        # 4 axes of 2 sections, 2 powers of their currents, and the constant, for each axis
        self.assertEqual((len(answer["parameters"]), len(answer["parameters"][0])), (25, 4))


class WithoutALoop(unittest.TestCase):
    def status_of(self, *arguments):
        done = subprocess.run([BINARIES / "amb", "identify", "live", *arguments], text=True,
                              capture_output=True, timeout=LIMIT_S, check=False)
        return done.returncode, done.stderr

    def test_says_that_no_controller_is_there_and_how_to_start_one(self):
        status, said = self.status_of("--patience", "0.3")
        self.assertEqual(status, 1, said)
        self.assertIn("no controller was heard on lcm within 0.3 s", said)
        self.assertIn("amb run", said)

    def test_refuses_a_file_that_is_no_session(self):
        status, said = self.status_of(__file__)
        self.assertEqual(status, 3, said)


if __name__ == "__main__":
    run()

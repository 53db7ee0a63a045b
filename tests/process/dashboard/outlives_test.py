"""`amb run --dash` at the clock's pace: the page outlives the run, whatever its end, until Ctrl-C."""

import json
import re
import signal
import sys
import tempfile
import unittest
import urllib.request
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from dashboard_rig import answer_of, in_mode, until  # noqa: E402
from lcm_network import Process, run  # noqa: E402
from waiting import LIMIT_S  # noqa: E402

SCENARIO = """kind: scenario
name: short
steps:
  - {do: lift, until: levitating, timeout_s: 5, hold_s: %s}
  - {do: land, until: off, timeout_s: 5}
"""
STAYS = "live page stays at "


class ThePageOutlivesTheRun(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def start(self, *arguments, hold_s=0.2):
        (self.folder / "short.yaml").write_text(SCENARIO % hold_s, encoding="utf-8")
        self.run_ = Process(self.folder, "amb", "run", "--scenario", self.folder / "short.yaml",
                            *arguments)
        self.addCleanup(self.run_.kill)
        self.url = self.run_.says(re.compile(r"live page: \S+(?=\s)")).rsplit("live page: ", 1)[1]

    def post(self, command):
        return answer_of(urllib.request.Request(
            self.url + "api/command", data=json.dumps({"command": command}).encode(),
            headers={"X-Levitas": "1"}))

    def end(self):
        """What a viewer is told who comes after the end; then Ctrl-C, and the exit status."""
        self.run_.says(STAYS)
        told = until(self.url, lambda name, _: name == "end")
        with urllib.request.urlopen(self.url + "api/history", timeout=LIMIT_S) as answer:
            self.assertGreater(len(answer.read()), 8 + 20 * 18 * 4)  # half a second at least
        self.run_.send_signal(signal.SIGINT)
        return told["text"], self.run_.status()

    def test_after_an_orderly_end_with_what_the_run_has_said_before(self):
        self.start("--dash")
        said = self.run_.says(STAYS)
        self.assertIn("paced at 1 x the clock", said)
        self.assertIn("Verdict on rig", said.split(STAYS)[0])  # the verdict is not held back
        told, status = self.end()
        self.assertTrue(told.startswith("The run has ended. NOT ACCEPTED: the rotor was not"), told)
        self.assertEqual(status, 0)

    def test_after_a_trip_with_the_exit_status_of_a_trip(self):
        self.start("--dash", hold_s=600)
        until(self.url, in_mode("levitating"))
        self.assertEqual(self.post("emergency_stop")[0], 200)
        told, status = self.end()
        self.assertTrue(told.startswith("The run has ended with a trip. TRIPPED emergency_stop"), told)
        self.assertEqual(status, 4)

    def test_not_where_ctrl_c_has_ended_the_run(self):
        self.start("--dash", hold_s=600)
        until(self.url, in_mode("levitating"))
        self.run_.send_signal(signal.SIGINT)
        self.assertNotEqual(self.run_.status(), 0)
        self.assertNotIn(STAYS, self.run_.text)

    def test_a_run_without_a_page_ends_by_itself(self):
        (self.folder / "short.yaml").write_text(SCENARIO % 0.2, encoding="utf-8")
        plain = Process(self.folder, "amb", "run", "--scenario", self.folder / "short.yaml",
                        "--pace-factor", "50")
        self.addCleanup(plain.kill)
        self.assertEqual(plain.status(), 0, plain.said_so_far)
        self.assertIn("paced at 50 x the clock", plain.text)
        self.assertNotIn("live page", plain.text)

    def test_a_factor_without_a_paced_run_is_refused(self):
        wrong = Process(self.folder, "amb", "run", "--pace", "realtime", "--pace-factor", "2")
        self.addCleanup(wrong.kill)
        self.assertEqual(wrong.status(), 2)
        self.assertIn("--pace-factor is for --pace paced", wrong.text)


if __name__ == "__main__":
    run()

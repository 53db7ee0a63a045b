"""`amb run` that hears nothing of a run any more (a firewall, a lost membership) lands the rotor.

A preloaded library makes it deaf, and moves its clock past its limits: no test waits for them.
"""

import os
import struct
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from lcm_network import Process, preloaded, run  # noqa: E402
from rotor_fate import SPIN, Fate  # noqa: E402
from waiting import until  # noqa: E402

SILENCE_S = 16  # 15 s without telemetry are the limit of a run
GRACE_S = 6     # 5 s are what programs get that are to end


class BlindRun(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.session = self.folder / "session.lcmlog"
        self.wish = self.folder / "wish"
        self.wish.write_bytes(bytes(16))

    def start(self, hold_s):
        (self.folder / "spin.yaml").write_text(SPIN % hold_s, encoding="utf-8")
        environment = {**os.environ, "TMPDIR": str(self.folder),
                       "LEVITAS_DEAF_FILE": str(self.wish), **preloaded("deaf.so")}
        self.run_ = Process(self.folder, "amb", "run", "--scenario", self.folder / "spin.yaml",
                            "--record", self.session, env=environment)
        self.addCleanup(self.run_.kill)
        # 1.1 s to lift, 1.5 s to run up, of 10 000 records of 500 bytes each.
        until(lambda: self.session.exists() and self.session.stat().st_size > 27_000 * 500,
              "a record of a turning rotor", lambda: self.run_.said_so_far,
              lambda: self.run_.child.poll() is None)

    def make(self, ahead_s, deaf):
        with self.wish.open("r+b") as file:
            file.write(struct.pack("=qq", round(ahead_s * 1e9), deaf))

    def test_lands_the_rotor_and_kills_nothing_however_long_the_landing_takes(self):
        self.start(600)
        self.make(SILENCE_S, deaf=True)
        self.run_.says("; landing the rotor")
        self.make(SILENCE_S + GRACE_S, deaf=True)  # a kill at the limit would meet it turning
        self.assertEqual(self.run_.status(), 1, self.run_.text)
        text = self.run_.text
        fate = Fate(self.session)
        self.assertTrue(fate.landed, f"{fate}\n{text}")
        self.assertIn("no telemetry for 15 s: amb-controller is ", text)
        self.assertIn("amb-controller was asked to land the rotor, and ended with exit status 0", text)

    def test_a_run_that_hears_goes_on_whatever_its_clock_does(self):
        self.start(0.5)
        self.make(SILENCE_S, deaf=False)
        self.assertNotEqual(self.run_.status(), 1, self.run_.text)
        self.assertNotIn("no telemetry", self.run_.text)
        self.assertTrue(Fate(self.session).landed)


if __name__ == "__main__":
    run()

"""Ctrl-C during amb diagnose: once for the best answer so far, twice for the end at once."""

import json
import os
import pty
import signal
import sys
import threading
import unittest
from pathlib import Path
from tempfile import TemporaryDirectory

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from lcm_network import Process  # noqa: E402
from waiting import until  # noqa: E402

RECORDS = Path(os.environ["LEVITAS_SOURCE"]) / "tests/data/records/unbalance"
OTHER = 1


def catches_interrupts(pid):
    """Whether a handler stands between the process and SIGINT."""
    for line in Path(f"/proc/{pid}/status").read_text().splitlines():
        if line.startswith("SigCgt:"):
            return bool(int(line.split()[1], 16) >> (signal.SIGINT - 1) & 1)
    return False


class Diagnosis:
    """On a terminal of its own, which shows how far it is."""

    def __init__(self, folder):
        self.shown = b""
        ours, terminal = pty.openpty()
        self.program = Process(folder, "amb", "diagnose", "--rig", "flexible_rotor", RECORDS / "standing.csv.xz",
                               RECORDS / "spinning.csv.xz", "--out", "answer", stderr=terminal)
        os.close(terminal)
        self.reader = threading.Thread(target=self.read, args=(ours,))
        self.reader.start()

    def read(self, ours):
        try:
            while got := os.read(ours, 4096):
                self.shown += got
        except OSError:  # the other side is closed
            pass
        os.close(ours)

    def interrupt_while_calibrating(self):
        until(lambda: b"calibrating" in self.shown, "the search to begin", said=lambda: self.shown,
              running=lambda: self.program.child.poll() is None)
        self.program.send_signal(signal.SIGINT)

    def ended(self):
        status = self.program.status()
        self.reader.join()
        return status, self.program.text


class StoppedDiagnosis(unittest.TestCase):
    def setUp(self):
        shared = TemporaryDirectory()
        self.addCleanup(shared.cleanup)
        self.folder = Path(shared.name)
        self.diagnosis = Diagnosis(self.folder)
        self.addCleanup(self.diagnosis.program.kill)

    def test_once_leaves_the_answer_so_far_which_neither_clears_nor_proves(self):
        self.diagnosis.interrupt_while_calibrating()
        status, printed = self.diagnosis.ended()
        self.assertEqual(status, OTHER, printed)
        self.assertIn(b"the search was stopped before its end", self.diagnosis.shown)
        self.assertIn("search was stopped", printed)
        answer = json.loads((self.folder / "answer/diagnosis.json").read_text())
        self.assertTrue(answer["stopped"])
        self.assertIn(answer["verdict"], ("unknown", "suspected"))
        self.assertGreater(len(answer["candidates"]), 10, "screened")
        self.assertTrue((self.folder / "answer/report.html").exists())

    def test_twice_ends_at_once_and_leaves_nothing(self):
        self.diagnosis.interrupt_while_calibrating()
        child = self.diagnosis.program.child
        until(lambda: not catches_interrupts(child.pid), "the first to be noted", running=lambda: child.poll() is None)
        self.diagnosis.program.send_signal(signal.SIGINT)
        status, printed = self.diagnosis.ended()
        self.assertEqual((status, printed), (-signal.SIGINT, ""))
        self.assertFalse((self.folder / "answer/diagnosis.json").exists())


if __name__ == "__main__":
    unittest.main()

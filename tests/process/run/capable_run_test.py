"""`kill -9` of `amb run` where the controller has a file capability, as for real time without root.

The kernel then forgets the child's wish to be told of its parent's end (prctl(2), PR_SET_PDEATHSIG).
"""

import os
import shutil
import signal
import struct
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from lcm_network import BINARIES, Process, run  # noqa: E402
from rotor_fate import SPIN, Fate  # noqa: E402
from waiting import until  # noqa: E402

SOMEBODY = 1234  # any user that is not root
SYS_NICE = 23
# capabilities(7): version 2, effective; then permitted and inheritable, low and high words.
CAPABILITY = struct.pack("<IIIII", 0x02000001, 1 << SYS_NICE, 0, 0, 0)


def state(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rsplit(")", 1)[1].split()[0]
    except (OSError, IndexError):
        return "gone"


class CapableRun(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.programs = self.folder / "bin"
        self.programs.mkdir()
        for name in ("amb", "amb-controller", "amb-plant"):
            shutil.copy(BINARIES / name, self.programs)
        try:
            os.setxattr(self.programs / "amb-controller", "security.capability", CAPABILITY)
            for path in (self.folder, self.programs):
                os.chown(path, SOMEBODY, SOMEBODY)
        except OSError as error:
            self.skipTest(f"needs root, and a file system with capabilities: {error}")
        (self.folder / "spin.yaml").write_text(SPIN % 600, encoding="utf-8")
        self.session = self.folder / "session.lcmlog"

    def test_a_killed_run_leaves_programs_that_land_the_rotor(self):
        run_ = Process(self.folder, self.programs / "amb", "run", "--scenario",
                       self.folder / "spin.yaml", "--record", self.session, user=SOMEBODY,
                       group=SOMEBODY, extra_groups=[],
                       env={**os.environ, "TMPDIR": str(self.folder), "HOME": str(self.folder)})
        self.addCleanup(run_.kill)
        # 1.1 s to lift, 1.5 s to run up, of 10 000 records of 500 bytes each.
        until(lambda: self.session.exists() and self.session.stat().st_size > 27_000 * 500,
              "a record of a turning rotor", lambda: run_.said_so_far,
              lambda: run_.child.poll() is None)
        pid = run_.child.pid
        children = Path(f"/proc/{pid}/task/{pid}/children").read_text(encoding="utf-8").split()
        self.assertEqual(len(children), 2)
        self.addCleanup(lambda: [os.kill(int(child), signal.SIGKILL) for child in children
                                 if state(child) != "gone"])
        run_.kill()
        until(lambda: all(state(child) in ("gone", "Z") for child in children),
              "the end of both programs")
        fate = Fate(self.session)
        self.assertTrue(fate.landed, str(fate))


if __name__ == "__main__":
    run()

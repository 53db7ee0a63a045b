"""What happens to `amb run` from outside while the rotor turns at 3000 rpm: its programs land it."""

import fcntl
import os
import pty
import signal
import subprocess
import sys
import tempfile
import termios
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from lcm_network import BINARIES, Process, run  # noqa: E402
from rotor_fate import SPIN, Fate  # noqa: E402
from waiting import LIMIT_S, pause, until  # noqa: E402


def alive(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rsplit(")", 1)[1].split()[0] != "Z"
    except (OSError, IndexError):
        return False


class OutsideRun(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.session = self.folder / "session.lcmlog"
        (self.folder / "spin.yaml").write_text(SPIN % 600, encoding="utf-8")
        (self.folder / "short.yaml").write_text(SPIN % 0.1, encoding="utf-8")

    def environment(self):
        return {**os.environ, "TMPDIR": str(self.folder)}

    def start(self, *more, **options):
        self.run_ = Process(self.folder, "amb", "run", "--scenario", self.folder / "spin.yaml",
                            "--record", self.session, *more, env=self.environment(), **options)
        self.addCleanup(self.run_.kill)
        return self.run_

    def log(self):
        """For messages of failures."""
        return self.run_.said_so_far

    def children(self):
        pid = self.run_.child.pid
        children = Path(f"/proc/{pid}/task/{pid}/children")
        return [int(pid) for pid in children.read_text(encoding="utf-8").split()]

    def turning(self):
        """Waits until the record, which is written while it grows, shows full speed."""
        # 1.1 s to lift, 1.5 s to run up, of 10 000 records of 500 bytes each.
        until(lambda: self.session.exists() and self.session.stat().st_size > 27_000 * 500,
              "a record of a turning rotor", self.log, lambda: self.run_.child.poll() is None)

    def assert_landed(self, children):
        """The children end by themselves, after the landing."""
        until(lambda: not any(alive(pid) for pid in children), "the end of both programs", self.log)
        fate = Fate(self.session)
        print(f"{self.id().rsplit('.', 1)[1]}: {fate}")
        self.assertTrue(fate.landed, f"{fate}\n{self.log()}")

    def test_a_killed_run_leaves_programs_that_land_the_rotor(self):
        self.start()
        self.turning()
        children = self.children()
        self.assertEqual(len(children), 2)
        self.run_.kill()
        self.assert_landed(children)

    def test_a_closed_terminal_lands_the_rotor_however_often_it_says_so(self):
        self.start()
        self.turning()
        children = self.children()
        for _ in range(3):
            self.run_.send_signal(signal.SIGHUP)
            pause(0.4, "this or longer does not count as one request")
        self.assertEqual(self.run_.status(), 1, self.log())
        self.assert_landed(children)
        self.assertIn("stopped by the operator before the end; the rotor was landed", self.run_.text)

    def test_a_reader_that_has_gone_or_stopped_does_not_keep_ctrl_c_from_landing(self):
        for stopped in (False, True):
            with self.subTest(stopped=stopped):
                here, there = os.pipe()
                fcntl.fcntl(there, fcntl.F_SETPIPE_SZ, 4096)
                if stopped:
                    os.write(there, b"x" * 4096)
                self.start(stderr=there)
                os.close(there)
                if not stopped:
                    os.close(here)
                self.turning()
                children = self.children()
                self.run_.send_signal(signal.SIGINT)
                self.assertEqual(self.run_.status(), 1, self.log())
                self.assert_landed(children)
                if stopped:
                    os.close(here)
                self.session.unlink()

    def test_a_stopped_terminal_does_not_keep_ctrl_c_from_landing(self):
        ours, terminal = pty.openpty()
        self.start(stderr=terminal)
        self.turning()
        children = self.children()
        termios.tcflow(terminal, termios.TCOOFF)  # Ctrl-S
        pause(0.5, "the run meets it meanwhile with words of its own, or later")
        self.run_.send_signal(signal.SIGINT)
        self.assertEqual(self.run_.status(), 1, self.log())
        self.assert_landed(children)
        os.close(ours)
        os.close(terminal)

    def test_a_killed_page_is_no_part_of_the_control(self):
        port = 9867
        network = f"lcm:udpm://239.255.76.67:{port}?ttl=0"
        self.start("--port", network)
        page = Process(self.folder, "amb", "dash", "--port", network)
        self.addCleanup(page.kill)
        page.says("page: ")
        self.turning()
        children = self.children()
        page.kill()
        pause(0.5, "this or longer for it to matter, if it mattered")
        self.assertEqual([pid for pid in children if not alive(pid)], [])
        self.run_.send_signal(signal.SIGINT)
        self.assertEqual(self.run_.status(), 1, self.log())
        self.assert_landed(children)

    # Disks that are full. The small ones exist within a mount namespace of the command alone.

    def on_small_disk(self, kilobytes, command):
        small = self.folder / "small"
        small.mkdir(exist_ok=True)
        script = f"mount -t tmpfs -o size={kilobytes}k none {small} && {command}"
        return subprocess.run(["unshare", "-m", "sh", "-c", script], capture_output=True, text=True,
                              timeout=LIMIT_S, check=False, cwd=self.folder, env=self.environment())

    def test_a_record_that_breaks_off_for_want_of_room_is_incomplete_and_status_1(self):
        done = self.on_small_disk(3000, f"{BINARIES}/amb run --scenario short.yaml --record small/x.lcm")
        self.assertIn("INCOMPLETE: recording stopped: No space left on device", done.stdout)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)

    def test_a_full_folder_of_temporary_files_is_named_as_the_cause(self):
        done = self.on_small_disk(3000, f"TMPDIR=small {BINARIES}/amb run --scenario short.yaml")
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn("no space is left in small", done.stderr)
        self.assertNotIn("not a report", done.stderr)


if __name__ == "__main__":
    run()

"""What limits the controller from outside: a pipe that nobody reads, processor time, the stack."""

import os
import resource
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from lcm_network import BINARIES, TELEMETRY, Bus, controller, plant, run  # noqa: E402
from rotor_fate import SPEED_RPM, SPIN, Fate, rpm  # noqa: E402
from waiting import LIMIT_S  # noqa: E402

SLOWER = int(os.environ.get("LEVITAS_SLOWER", "1"))  # under a sanitizer
SMALL = 96 << 10  # bytes of stack; without a remedy the programs end with SIGSEGV
ENOUGH = 1 << 20
SPINNING = 4


def limited(what, soft, hard):
    return lambda: resource.setrlimit(what, (soft, hard))


class Limits(unittest.TestCase):
    def setUp(self):
        from levitas_msg import controller_state_t
        self.state_type = controller_state_t
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "spin.yaml").write_text(SPIN % 600, encoding="utf-8")
        self.pipe = self.folder / "pipe"
        os.mkfifo(self.pipe)

    def start(self, *words, **options):
        self.rig = plant(self.folder)
        self.addCleanup(self.rig.kill)
        control = controller(self.folder, "--scenario", self.folder / "spin.yaml", *words, **options)
        self.addCleanup(control.kill)
        return control

    def reader(self):
        """Has the pipe open, and reads nothing."""
        pipe = os.open(self.pipe, os.O_RDONLY | os.O_NONBLOCK)
        self.addCleanup(os.close, pipe)
        return pipe

    # Pipes

    def test_a_record_into_a_pipe_that_nobody_reads_is_refused_at_once(self):
        with controller(self.folder, "--record", self.pipe) as control:
            self.assertEqual(control.status(), 3, control.text)
            self.assertIn("a pipe that nobody reads. Start its reader first", control.text)

    def test_a_report_into_a_pipe_that_nobody_reads_keeps_no_program_from_its_end(self):
        with controller(self.folder, "--json", self.pipe) as control:
            control.says("no sensor frames")
            control.terminate()
            self.assertEqual(control.status(), 1, control.text)
            self.assertIn("--json", control.text)
            self.assertIn("a pipe that nobody reads", control.text)

    def test_a_reader_that_stops_ends_the_recording_and_not_the_control(self):
        states = Bus(TELEMETRY)
        self.addCleanup(states.close)
        self.reader()
        control = self.start("--record", self.pipe)
        control.says("recording stopped: the reader of this pipe takes nothing any more")
        for channel, payload in states.messages():
            if channel == "LEVITAS_STATE":
                state = self.state_type.decode(payload)
                if state.mode == SPINNING and rpm(state) > 0.99 * SPEED_RPM:
                    break
        control.terminate()
        self.assertEqual(control.status(), 0, control.text)
        self.assertIn("landing -> off", control.text)
        self.rig.says("amplifiers off, as commanded")

    # Processor time

    def test_the_rotor_is_landed_before_the_processor_time_is_up(self):
        session = self.folder / "session.lcmlog"
        most_s = 6 * SLOWER  # half is enough to turn the rotor, and half to land it
        control = self.start("--record", session,
                             preexec_fn=limited(resource.RLIMIT_CPU, most_s, most_s))
        self.assertEqual(control.status(), 0, control.text)
        self.assertIn(f"(ulimit -t): the rotor is landed after {most_s // 2} s of it", control.text)
        self.assertIn("landing, asked by a signal", control.text)
        fate = Fate(session)
        self.assertTrue(fate.landed, str(fate))

    def test_processor_time_that_leaves_none_for_a_landing_is_refused(self):
        with controller(self.folder, preexec_fn=limited(resource.RLIMIT_CPU, 1, 1)) as control:
            self.assertEqual(control.status(), 1, control.text)
            self.assertIn("leaves none for a landing", control.text)

    # Stack. As a pair: the soft limit alone, which is raised, and the hard one.

    def test_a_small_stack_is_raised_or_refused_in_a_sentence(self):
        rig = ["--rig", "flexible_rotor"]
        for words in (["amb", "modes", *rig], ["amb-plant", *rig, "--help"],
                      ["amb-controller", *rig, "--help"]):
            for hard, status in ((ENOUGH, 0), (SMALL, 1)):
                with self.subTest(f"{words[0]}, {hard}"):
                    done = subprocess.run(
                        [str(BINARIES / words[0]), *words[1:]], capture_output=True, text=True,
                        timeout=LIMIT_S, check=False,
                        preexec_fn=limited(resource.RLIMIT_STACK, SMALL, hard))
                    self.assertEqual(done.returncode, status, done.stderr)
                    if status:
                        self.assertIn(f"{words[0]}: the stack is limited to 96 KiB (ulimit -s)",
                                      done.stderr)

    def test_threads_of_real_time_have_the_raised_stack_too(self):
        control = controller(self.folder, "--pace", "realtime",
                             preexec_fn=limited(resource.RLIMIT_STACK, SMALL, ENOUGH))
        self.addCleanup(control.kill)
        control.says("no sensor frames")
        control.terminate()
        self.assertEqual(control.status(), 0, control.text)


if __name__ == "__main__":
    run()

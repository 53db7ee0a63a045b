"""What comes from outside while the rotor turns at 3000 rpm, one by one: the rotor is landed."""

import fcntl
import os
import pty
import resource
import signal
import sys
import tempfile
import termios
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from lcm_network import (COMMAND, TELEMETRY, Bus, Process, plant, run,  # noqa: E402
                         short_message)
from rotor_fate import SPEED_RPM, SPIN, Fate  # noqa: E402
from waiting import pause  # noqa: E402

# A key with the escape that clears a terminal, as YAML writes it, and one as it is.
NONSENSE = 'kind: excitation\n"nonsense \\e[2J \\x9b": 1\n'
SPINNING = 4
EMERGENCY_STOP = 5  # command


class Outside(unittest.TestCase):
    def setUp(self):
        from levitas_msg.controller_state_t import controller_state_t
        self.state_type = controller_state_t
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.session = self.folder / "session.lcmlog"
        (self.folder / "spin.yaml").write_text(SPIN % 600, encoding="utf-8")
        self.states = None

    def start(self, *more, record=True, **options):
        """The rig and a controller that turns the rotor; both are ended with the test."""
        if self.states is not None:
            self.states.close()
        self.states = Bus(TELEMETRY)  # empty: nothing of a run before
        self.addCleanup(self.states.close)
        rig = plant(self.folder)
        self.addCleanup(rig.kill)
        self.rig = rig
        words = ["--rig", "flexible_rotor", "--controller", "flexible_rotor_commissioned",
                 "--scenario", self.folder / "spin.yaml", "--trip-folder", self.folder, *more]
        if record:
            words += ["--record", self.session, "--overwrite"]
        self.control = Process(self.folder, "amb-controller", *words, **options)
        self.addCleanup(self.control.kill)
        return self.control

    def log(self):
        """For messages of failures."""
        return self.control.said_so_far

    def turning(self, control):
        for channel, payload in self.states.messages():
            if channel != "LEVITAS_STATE":
                continue
            state = self.state_type.decode(payload)
            if state.mode == SPINNING and state.speed_rad_per_s > 0.999 * SPEED_RPM * 0.10472:
                return
            self.assertIsNone(control.child.poll(), f"ended before the rotor turned:\n{self.log()}")
        self.fail(f"the rotor does not turn:\n{self.log()}")

    def assert_landed(self, control, status=0):
        self.assertEqual(control.status(), status, self.log())
        fate = Fate(self.session)
        print(f"{self.id().rsplit('.', 1)[1]}: {fate}")
        self.assertTrue(fate.landed, f"{fate}\n{self.log()}")
        self.assertEqual(self.rig.status(), 0, self.rig.text)
        self.assertIn("amplifiers off, as commanded", self.rig.text)

    # Signals

    def test_a_closed_terminal_lands_the_rotor_however_often_it_says_so(self):
        control = self.start()
        self.turning(control)
        for _ in range(4):
            control.send_signal(signal.SIGHUP)
            pause(0.3, "longer in all, or far longer, than two requests that mean two")
        self.assert_landed(control)

    def test_the_end_of_the_machine_and_of_a_shell_lands_the_rotor(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGPWR, signal.SIGXCPU):
            with self.subTest(number.name):
                control = self.start()
                self.turning(control)
                control.send_signal(number)
                control.send_signal(number)  # delivered twice, asked once
                self.assert_landed(control)

    def test_signals_of_no_concern_change_nothing(self):
        control = self.start()
        self.turning(control)
        for number in (signal.SIGTSTP, signal.SIGTTIN, signal.SIGTTOU, signal.SIGXFSZ,
                       signal.SIGPIPE, signal.SIGALRM, signal.SIGVTALRM, signal.SIGPROF,
                       signal.SIGUSR1, signal.SIGUSR2, signal.SIGIO, signal.SIGRTMIN,
                       signal.SIGRTMAX, signal.SIGWINCH, signal.SIGURG, signal.SIGCHLD):
            control.send_signal(number)
            self.rig.send_signal(number)
        for channel, payload in self.states.messages():
            if channel == "LEVITAS_STATE":
                break
        self.turning(control)
        control.terminate()
        self.assert_landed(control)

    def test_the_same_signal_again_ends_at_once(self):
        control = self.start()
        self.turning(control)
        control.send_signal(signal.SIGTERM)
        pause(0.6, "this or longer does not count as one request")
        control.send_signal(signal.SIGTERM)
        self.assertEqual(control.status(), 0, self.log())
        self.assertEqual(self.rig.status(), 0, self.rig.text)
        self.assertIn("the same signal again ends at once", self.control.text)

    def test_quit_is_an_emergency_stop_that_brakes_the_levitated_rotor(self):
        control = self.start()
        self.turning(control)
        control.send_signal(signal.SIGQUIT)
        self.assert_landed(control, status=4)
        self.assertIn("emergency_stop", self.control.text)

    def test_a_rig_that_is_asked_to_end_with_its_controller_stays_until_the_rotor_lies(self):
        control = self.start()
        self.turning(control)
        self.rig.terminate()  # a terminal's Ctrl-C reaches both, the rig perhaps first
        self.rig.says("staying until the controller has switched the amplifiers off")
        control.terminate()
        self.assert_landed(control)

    # Standard error

    def warn(self):
        """Makes the controller say something."""
        from levitas_msg.excitation_request_t import excitation_request_t
        message = excitation_request_t()
        message.sequence, message.step_yaml = time.monotonic_ns(), NONSENSE
        bus = Bus(COMMAND)
        bus.send(short_message("LEVITAS_EXCITATION", message.encode()))
        bus.close()

    def test_a_reader_of_standard_error_that_has_gone_changes_nothing(self):
        here, there = os.pipe()
        control = self.start(stderr=there)
        os.close(there)
        self.turning(control)
        os.close(here)
        self.warn()
        control.terminate()
        self.assert_landed(control)

    def test_a_closed_standard_error_lands_in_no_other_file(self):
        control = self.start(preexec_fn=lambda: os.closerange(0, 3))
        self.turning(control)
        self.warn()
        control.terminate()
        self.assert_landed(control)
        self.assertNotIn(b"amb-controller:", self.session.read_bytes())

    def test_a_log_on_a_full_disk_changes_nothing(self):
        with open("/dev/full", "wb") as full:
            control = self.start(stderr=full)
        self.turning(control)
        self.warn()
        control.terminate()
        self.assert_landed(control)

    def test_a_reader_of_standard_error_that_has_stopped_holds_nothing_up(self):
        here, there = os.pipe()
        fcntl.fcntl(there, fcntl.F_SETPIPE_SZ, 4096)
        os.set_blocking(there, False)
        while True:  # full before the first word
            try:
                os.write(there, b"x")
            except BlockingIOError:
                break
        os.set_blocking(there, True)
        control = self.start(stderr=there)
        os.close(there)
        self.addCleanup(os.close, here)
        self.turning(control)
        for _ in range(600):
            self.warn()
        control.terminate()
        self.assert_landed(control)

    def test_a_reader_that_has_stopped_keeps_no_emergency_stop_from_being_heeded(self):
        from levitas_msg.operator_command_t import operator_command_t
        here, there = os.pipe()
        fcntl.fcntl(there, fcntl.F_SETPIPE_SZ, 4096)
        os.write(there, b"x" * 4096)
        control = self.start(stderr=there)
        os.close(there)
        self.addCleanup(os.close, here)
        self.turning(control)
        for _ in range(200):
            self.warn()
        stop = operator_command_t()
        stop.sequence, stop.command = time.monotonic_ns(), EMERGENCY_STOP
        bus = Bus(COMMAND)
        bus.publish("LEVITAS_COMMAND", stop)
        bus.close()
        self.assert_landed(control, status=4)

    def test_a_stopped_terminal_holds_nothing_up(self):
        ours, terminal = pty.openpty()
        self.addCleanup(os.close, ours)
        control = self.start(stderr=terminal)
        self.turning(control)
        termios.tcflow(terminal, termios.TCOOFF)  # Ctrl-S
        for _ in range(600):
            self.warn()
        control.terminate()
        self.assert_landed(control)
        os.close(terminal)

    def test_what_the_network_says_steers_no_terminal(self):
        control = self.start()
        self.turning(control)
        self.warn()
        control.terminate()
        self.assert_landed(control)
        text = control.log.read_bytes()
        self.assertIn(b"nonsense", text)
        self.assertEqual([byte for byte in text if byte < 0x20 and byte != 0x0a], [])
        self.assertNotIn(0x9b, text)

    # Disk

    def test_a_limit_on_the_size_of_files_ends_the_recording_and_not_the_control(self):
        limit = 3 << 20
        control = self.start(preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE,
                                                                   (limit, limit)))
        self.turning(control)
        control.says("recording stopped: File too large")
        self.assertLessEqual(self.session.stat().st_size, limit)
        control.terminate()
        self.assertEqual(control.status(), 0, self.log())
        self.assertIn("landing -> off", self.control.text)
        self.rig.says("amplifiers off, as commanded")


if __name__ == "__main__":
    run()

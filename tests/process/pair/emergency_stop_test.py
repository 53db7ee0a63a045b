"""The operator's emergency stop, whatever else is asked of the controller or goes wrong around it.

No time is judged: that a stop is taken at all, in which order, and under which number it is answered.
"""

import os
import re
import socket
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from lcm_network import (COMMAND, GROUP, LOOPBACK, TELEMETRY, Bus,  # noqa: E402
                         controller, plant, run, short_message)
from waiting import LIMIT_S, until  # noqa: E402

LIFT, LAND, STOP, RESET, EXCITE, END_EXCITATION = 1, 4, 5, 6, 7, 8
ACCEPTED, REFUSED = 1, 2
# One signal as large as a request may be: a good part of a second of work.
COSTLY = "kind: excitation\nhold_s: 60\nexcitation:\n" \
    "  - {channel: de_x, signal: multisine, amplitude_a: 0.01, from_hz: 10, to_hz: 2200," \
    " repeat_s: 1.5}\n"


class Sender:
    """From a port of its own, as each operator's program."""

    def __init__(self):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, LOOPBACK)
        self.socket.connect((GROUP, COMMAND))
        self.port = self.socket.getsockname()[1]

    def publish(self, channel, message):
        self.socket.send(short_message(channel, message.encode()))


class EmergencyStop(unittest.TestCase):
    def setUp(self):
        from levitas_msg import command_answer_t, excitation_request_t, operator_command_t
        self.answer_type, self.request_type = command_answer_t, excitation_request_t
        self.command_type = operator_command_t
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.telemetry = Bus(TELEMETRY)
        self.addCleanup(self.telemetry.close)
        self.desk = self.sender()
        self.number = 0

    def sender(self):
        sender = Sender()
        self.addCleanup(sender.socket.close)
        return sender

    def command(self, command, number=None):
        self.number = self.number + 1 if number is None else number
        message = self.command_type()
        message.sequence, message.command = self.number, command
        self.desk.publish("LEVITAS_COMMAND", message)
        return self.number

    def request(self, text, number):
        message = self.request_type()
        message.sequence, message.step_yaml = number, text
        self.desk.publish("LEVITAS_EXCITATION", message)

    def answers(self, seconds=LIMIT_S):
        for channel, payload in self.telemetry.messages(seconds):
            if channel == "LEVITAS_ANSWER":
                answer = self.answer_type.decode(payload)
                if answer.sender_port == self.desk.port:
                    yield answer

    def answer_to(self, number):
        for answer in self.answers():
            if answer.sequence == number:
                return answer
        self.fail(f"number {number} was not answered")

    def stop_and_reset(self):
        """A stop said once; then a reset, said again until it is taken."""
        number = self.command(STOP)
        answer = self.answer_to(number)
        self.assertEqual((answer.command, answer.outcome), (STOP, ACCEPTED))
        number = self.number + 1
        end = time.monotonic() + LIMIT_S
        while time.monotonic() < end:
            self.command(RESET, number)
            for answer in self.answers(0.1):
                if answer.sequence == number and answer.outcome == ACCEPTED:
                    return
                if answer.sequence == number:
                    number += 1  # refused: the rotor was not at rest yet
                    break
        self.fail("no reset was taken")

    def test_overtakes_test_signals_that_take_long_to_make(self):
        with plant(self.folder), controller(self.folder) as control:
            control.says("rig found")
            for number in range(1, 4):
                self.request(COSTLY, number)
            # Answered when they have been handed to the thread that makes them.
            self.answer_to(self.command(RESET, 4))
            self.command(STOP, 5)
            heard = []
            for answer in self.answers():
                heard.append(answer)
                if answer.sequence == 3:
                    break
            order = [answer.sequence for answer in heard]
            self.assertIn(5, order, control.said_so_far)  # before the last signal was made
            self.assertIn("emergency stop", heard[-1].text)  # which then was not begun
            self.assertEqual(heard[-1].outcome, REFUSED)
            control.says("TRIP")

    def test_is_taken_each_time_although_others_flood_the_controller(self):
        message = self.command_type()
        message.command = LAND
        ending = threading.Event()

        def flood():
            sender = Sender()
            while not ending.is_set():
                for _ in range(200):
                    message.sequence += 1
                    sender.publish("LEVITAS_COMMAND", message)
            sender.socket.close()

        with plant(self.folder), controller(self.folder) as control:
            control.says("rig found")
            flooding = threading.Thread(target=flood)
            flooding.start()
            try:
                for _ in range(10):
                    self.stop_and_reset()
            finally:
                ending.set()
                flooding.join()

    def test_trips_again_and_again_leave_the_newest_trip_files_only(self):
        kept = self.folder / "a note of the operator.lcmlog"
        kept.write_text("not a trip file")
        with plant(self.folder), controller(self.folder, "--trip-budget", "3", "100") as control:
            control.says("rig found")
            for _ in range(6):
                self.stop_and_reset()
            control.terminate()
            self.assertEqual(control.status(), 4, control.text)  # it tripped
        files = sorted(path.name for path in self.folder.glob("trip-*.lcmlog"))
        removed = re.findall(r"--trip-budget\): (trip-\S+\.lcmlog)", control.text)
        self.assertEqual((len(files), len(removed)), (3, 3), control.text)
        self.assertLess(max(removed), min(files))  # their names begin with their time
        self.assertTrue(kept.exists())

    def test_is_taken_while_nobody_reads_what_the_controller_says(self):
        with plant(self.folder):
            read_end, write_end = os.pipe()
            self.addCleanup(os.close, read_end)
            control = controller(self.folder, stderr=write_end)
            os.close(write_end)
            try:
                for number in range(1, 3_001):  # far more text than a pipe holds
                    self.request(f"kind: excitation\nhold_s: 99999999\nnonsense: {number}\n", number)
                numbers = []

                def taken():
                    numbers.append(self.command(STOP))
                    return any(a.sequence in numbers for a in self.answers(0.1))

                until(taken, "a stop that is answered")
            finally:
                control.kill()

    def test_old_numbers_are_not_taken_and_each_answer_names_its_command(self):
        with plant(self.folder), controller(self.folder) as control:
            control.says("rig found")
            self.command(LIFT, 5)
            self.assertEqual(self.answer_to(5).outcome, ACCEPTED)
            refused = self.command(END_EXCITATION, 7)
            self.assertEqual(self.answer_to(refused).command, END_EXCITATION)
            for number, command in ((5, LIFT), (6, LAND), (7, END_EXCITATION), (5, LIFT)):
                self.command(command, number)
            self.command(RESET, 8)
            answer = next(self.answers())
            self.assertEqual((answer.sequence, answer.command, answer.outcome), (8, RESET, REFUSED))
            self.assertIn("refused", answer.text)


if __name__ == "__main__":
    run()

"""An operator with a socket of its own: commands, test signals, and the answers under their numbers."""

import contextlib
import queue
import socket
import threading
import time

from lcm_network import COMMAND, GROUP, LOOPBACK, TELEMETRY, Bus, short_message

LAND, STOP, RESET = 4, 5, 6
ACCEPTED = 1
# Lines times samples: 4.9e7 steps of work, of 5e7 that a request may take.
SIGNAL = ("  - {channel: de_x, signal: multisine, amplitude_a: 0.01, from_hz: 10, to_hz: 2200,"
          " repeat_s: 1.5}\n")


def command(number, which):
    from levitas_msg.operator_command_t import operator_command_t

    message = operator_command_t()
    message.sequence, message.command = number, which
    return short_message("LEVITAS_COMMAND", message.encode())


def sender():
    out = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    out.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, LOOPBACK)
    out.connect((GROUP, COMMAND))
    return out


class Desk:
    """Asks over the network and hears the answers to its own numbers."""

    def __init__(self):
        self.out, self.number = sender(), 0
        self.port = self.out.getsockname()[1]
        self.answers = queue.Queue()
        threading.Thread(target=self.listen, args=(Bus(TELEMETRY),), daemon=True).start()

    def listen(self, bus):
        from levitas_msg.command_answer_t import command_answer_t

        for channel, payload in bus.messages(86_400):
            if channel == "LEVITAS_ANSWER":
                answer = command_answer_t.decode(payload)
                if answer.sender_port == self.port:
                    self.answers.put(answer)

    def ask(self, which, patience=1.0, repeat=0.1):
        """True, False or None: accepted, refused, no answer."""
        self.number += 1
        end = time.monotonic() + patience
        while time.monotonic() < end:
            self.out.send(command(self.number, which))
            wait = time.monotonic() + min(repeat, patience)
            while (left := wait - time.monotonic()) > 0:
                with contextlib.suppress(queue.Empty):
                    answer = self.answers.get(timeout=left)
                    if answer.sequence == self.number:
                        return answer.outcome == ACCEPTED
        return None

    def stop(self):
        return self.ask(STOP, repeat=1.0) is True

    def request(self, signals):
        from levitas_msg.excitation_request_t import excitation_request_t

        self.number += 1
        message = excitation_request_t()
        message.sequence = self.number
        message.step_yaml = "kind: excitation\nhold_s: 60\nexcitation:\n" + SIGNAL * signals
        self.out.send(short_message("LEVITAS_EXCITATION", message.encode()))

    def reset(self):
        """Until it is taken; a late answer is waited for, since a second reset would be refused."""
        end = time.monotonic() + 30
        while (left := end - time.monotonic()) > 0:
            if self.ask(RESET, patience=left):
                return
        raise AssertionError("no reset was taken within 30 s")

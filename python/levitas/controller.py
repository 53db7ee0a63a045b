"""Commands to a running controller, and what it says of itself, over this machine's loopback interface.

No route and no LCM library is needed. A controller that was given a key takes commands of those that
have it alone (docs/dashboard.md): from the page, not from here.
"""

import socket
import struct
import time

from . import messages
from .session import MODES

MAGIC = 0x4C433032
COMMANDS = {"lift": 1, "spin": 2, "coast_down": 3, "land": 4, "emergency_stop": 5, "reset": 6, "end_excitation": 8, "mark": 9}
ACCEPTED = 1
RPM = 3.141592653589793 / 30.0


class Refused(RuntimeError):
    """A command that the controller did not take; the text is its reason."""


class NoAnswer(TimeoutError):
    """No controller was heard in time."""


class Controller:
    """with levitas.Controller() as rig: rig.lift(); rig.wait("levitating"); rig.spin(3000, 1000); rig.land()

    `group` and `port` are those of the controller's --port; the controller of `amb run` prints its own.
    """

    def __init__(self, group="239.255.76.67", port=7667, patience_s=5.0):
        self.patience_s = patience_s
        self.number = 0
        self.types = {name: messages.fields(name) for name in
                      ("operator_command_t", "command_answer_t", "controller_state_t")}
        loopback = socket.inet_aton("127.0.0.1")
        self.out = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.out.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, loopback)
        self.out.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)
        self.out.connect((group, port + 3))
        self.heard = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.heard.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        self.heard.bind((group, port + 2))
        self.heard.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, socket.inet_aton(group) + loopback)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self.out.close()
        self.heard.close()

    def _messages(self, channel, patience_s):
        """Messages of a channel, as they come; NoAnswer when none has come for so long."""
        end = time.monotonic() + patience_s
        while (left := end - time.monotonic()) > 0:
            self.heard.settimeout(left)
            try:
                packet = self.heard.recv(65536)
            except TimeoutError:
                break
            name, _, payload = packet[8:].partition(b"\0")
            if packet[:4] == struct.pack(">I", MAGIC) and name.decode("ascii", "replace") == channel[0]:
                yield messages.decode(self.types[channel[1]], payload)
        raise NoAnswer(f"no {channel[0]} within {patience_s:g} s: is a controller running at this port, without a key?")

    def state(self):
        """The newest state: mode and fault as numbers, position_m, control_current_a, speed_rad_per_s ..."""
        return next(self._messages(("LEVITAS_STATE", "controller_state_t"), self.patience_s))

    def wait(self, mode, timeout_s=60.0):
        """Until the controller is in this mode; returns that state. Refused as soon as it has tripped."""
        end = time.monotonic() + timeout_s
        while time.monotonic() < end:
            state = self.state()
            found = MODES[state["mode"]]
            if found == mode:
                return state
            if found == "tripped":
                raise Refused(f"tripped by fault {state['fault']} while it was to become {mode}")
        raise NoAnswer(f"not {mode} within {timeout_s:g} s")

    def command(self, name, speed_rpm=0.0, acceleration_rpm_per_s=0.0):
        """Sends it until it is answered; returns the controller's sentence, Refused with its reason."""
        self.number += 1
        values = {"sequence": self.number, "command": COMMANDS[name], "speed_rad_per_s": speed_rpm * RPM,
                  "acceleration_rad_per_s2": acceleration_rpm_per_s * RPM}
        payload = messages.encode(self.types["operator_command_t"], values)
        packet = struct.pack(">II", MAGIC, self.number) + b"LEVITAS_COMMAND\0" + payload
        own_port = self.out.getsockname()[1]
        end = time.monotonic() + self.patience_s
        while time.monotonic() < end:
            self.out.send(packet)
            try:
                for answer in self._messages(("LEVITAS_ANSWER", "command_answer_t"), 0.2):
                    if (answer["sender_port"], answer["sequence"]) != (own_port, self.number):
                        continue
                    if answer["outcome"] != ACCEPTED:
                        raise Refused(answer["text"])
                    return answer["text"]
            except NoAnswer:
                continue
        raise NoAnswer(f"no answer to {name} within {self.patience_s:g} s: "
                       "is a controller running at this port, without a key?")

    def lift(self):
        return self.command("lift")

    def spin(self, speed_rpm, acceleration_rpm_per_s):
        return self.command("spin", speed_rpm, acceleration_rpm_per_s)

    def coast_down(self):
        return self.command("coast_down")

    def land(self):
        return self.command("land")

    def emergency_stop(self):
        return self.command("emergency_stop")

    def reset(self):
        return self.command("reset")

    def mark(self):
        """An instant to find again: the event "command mark (cycle N)" of the session."""
        return self.command("mark")

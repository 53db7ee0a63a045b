"""Two machines on one cable: with the defaults nothing that the other one sends moves a rig."""

import re
import socket
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from forged import LIFT, STOP, command, everything, sensor_frame  # noqa: E402
from lcm_network import (COMMAND, GROUP, SENSOR, SKIPPED, TELEMETRY, Bus, controller,  # noqa: E402
                         plant, run)
from two_machines import OWN, OtherMachine, possible  # noqa: E402
from waiting import LIMIT_S  # noqa: E402


class TwoMachines(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.other = OtherMachine()
        self.addCleanup(self.other.close)
        self.own = Bus(COMMAND)
        self.addCleanup(self.own.close)

    def test_the_cable_carries_what_the_other_machine_sends(self):
        """Otherwise the tests below would prove nothing."""
        listener = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.addCleanup(listener.close)
        listener.bind((GROUP, COMMAND + 1000))
        listener.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP,
                            socket.inet_aton(GROUP) + socket.inet_aton(OWN))
        listener.settimeout(LIMIT_S)
        self.other.send([(COMMAND + 1000, b"x")], 1)
        self.assertEqual(listener.recv(10), b"x")

    def test_only_the_commands_of_the_own_machine_are_taken(self):
        with plant(self.folder) as rig, controller(self.folder) as control:
            control.says("rig found")
            self.other.send(everything())
            _, lift = command(LIFT)
            self.own.send(lift)
            control.says("-> levitating")
            self.other.send(everything())
            control.terminate()
            self.assertEqual(control.status(), 0, control.text)
            self.assertEqual(rig.status(), 0, rig.text)
        self.assertEqual(re.findall("command (?!land)[a-z_]+", control.text), ["command lift"])
        self.assertNotIn("TRIP", control.text)

    def test_messages_of_the_own_machine_do_what_those_of_the_other_do_not(self):
        with plant(self.folder) as rig, controller(self.folder) as control:
            control.says("rig found")
            self.own.send(command(LIFT, 1)[1])
            control.says("-> levitating")
            self.own.send(command(STOP, 2)[1])
            control.says("TRIP")
            control.terminate()
            self.assertEqual(control.status(), 4, control.text)
            self.assertEqual(rig.status(), 0, rig.text)

    def test_a_lonely_controller_does_not_take_the_other_machine_for_its_rig(self):
        with controller(self.folder, "--partner-timeout", 3) as control:
            control.says("no sensor frames at")
            self.other.send([sensor_frame()])
            self.assertEqual(control.status(), 1, control.text)
        self.assertNotIn("rig found", control.text)

    def test_nothing_of_a_run_leaves_the_machine(self):
        listeners = [self.other.listen(self.folder, port) for port in (SENSOR, TELEMETRY)]
        with plant(self.folder) as rig, controller(self.folder, "--scenario", "levitate",
                                                   "--duration", 0.2) as control:
            self.assertEqual(control.status(), 0, control.text)
            self.assertEqual(rig.status(), 0, rig.text)
        for listener in listeners:
            listener.kill()
            self.assertEqual(listener.text, "listening\n")


if __name__ == "__main__":
    if not possible():
        print("not run: no pair of joined network namespaces here")
        sys.exit(SKIPPED)
    run()

"""levitas.Controller: commands and states of a controller on this machine, without a route and without LCM.

Not run (status 77) where no interpreter has numpy.
"""

import importlib
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["LEVITAS_SOURCE"])
sys.path.insert(0, str(SOURCE / "tests/support"))
sys.path.insert(0, str(SOURCE / "python"))
from interpreter import go_on_with  # noqa: E402

go_on_with("numpy")

from lcm_network import controller, plant, run  # noqa: E402
from waiting import LIMIT_S  # noqa: E402

import levitas  # noqa: E402
from levitas import messages  # noqa: E402


class Messages(unittest.TestCase):
    def test_fingerprints_are_those_of_lcms_own_generator(self):
        for name in ("cycle_record_t", "operator_command_t", "controller_state_t", "command_answer_t",
                     "event_t", "session_header_t"):
            generated = getattr(importlib.import_module(f"levitas_msg.{name}"), name)
            with self.subTest(name):
                self.assertEqual(messages.fingerprint(messages.fields(name)).to_bytes(8, "big"),
                                 generated._get_packed_fingerprint())

    def test_a_command_has_the_bytes_of_lcms_own_encoder(self):
        from levitas_msg.operator_command_t import operator_command_t
        theirs = operator_command_t()
        theirs.sequence, theirs.command, theirs.speed_rad_per_s = 7, 2, 12.5
        ours = messages.encode(messages.fields("operator_command_t"),
                               {"sequence": 7, "command": 2, "speed_rad_per_s": 12.5})
        self.assertEqual(ours, theirs.encode())


class Commands(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        # No route: what the package sends and hears goes over the loopback interface all the same.
        subprocess.run(["ip", "route", "flush", "224.0.0.0/4"], check=False)
        for start in (plant, controller):
            process = start(folder.name)
            self.addCleanup(process.kill)

    def test_lifts_spins_and_stops_a_rotor_and_hears_why_not(self):
        with levitas.Controller(patience_s=LIMIT_S) as rig:
            self.assertIn("command lift", rig.lift())
            state = rig.wait("levitating", LIMIT_S)
            self.assertEqual(len(state["position_m"]), 4)
            with self.assertRaisesRegex(levitas.Refused, "command reset refused in mode levitating"):
                rig.reset()
            self.assertIn("command spin to 600 rpm", rig.spin(600, 1000))
            rig.wait("spinning", LIMIT_S)
            self.assertIn("command mark (cycle", rig.mark())
            self.assertIn("emergency_stop", rig.emergency_stop())
            with self.assertRaisesRegex(levitas.Refused, "tripped by fault"):
                rig.wait("levitating", LIMIT_S)

    def test_says_when_no_controller_answers(self):
        with levitas.Controller(port=7900, patience_s=0.5) as rig:
            with self.assertRaisesRegex(levitas.NoAnswer, "no answer to lift within 0.5 s"):
                rig.lift()


if __name__ == "__main__":
    run()

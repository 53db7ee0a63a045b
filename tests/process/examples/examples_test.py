"""The C++ examples, built on an installation and run: what each of them claims."""

import os
import re
import signal
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
import own_program  # noqa: E402
from lcm_network import Process  # noqa: E402
from waiting import until  # noqa: E402

CLEARANCE_UM = 190.0  # config/rigs/flexible_rotor.yaml
OBJECTIVE_UM = 7.0    # the same file: orbit at standstill to stay below
TRIPPED = 4


def number(pattern, text):
    found = re.search(pattern, text)
    assert found, f"{pattern!r} is not in\n{text}"
    return float(found[1])


class Examples(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.prefix = Path(folder.name) / "usr"
        cls.built = Path(folder.name) / "built"
        own_program.install(cls.prefix)
        # The installation holds no rigs: they come with the programs.
        (cls.prefix / "share/levitas").mkdir(parents=True, exist_ok=True)
        for kind in ("rigs", "controllers", "scenarios"):
            (cls.prefix / "share/levitas" / kind).symlink_to(own_program.SOURCE / "config" / kind)
        own_program.build(cls.prefix / "share/levitas/examples", cls.built, cls.prefix)

    def run_example(self, name, *words):
        return own_program.run_on(self.prefix, self.built / name / name, *words)

    def test_forty_lines_close_the_loop(self):
        text = (own_program.SOURCE / "examples/closed_loop/main.cpp").read_text(encoding="utf-8")
        self.assertLessEqual(len(text.splitlines()), 40)
        done = self.run_example("closed_loop")
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = re.findall(r"^([\d.]+) s +(\w+) +orbit +([\d.]+) um$", done.stdout, re.M)
        self.assertEqual([mode for _, mode, _ in lines if mode != "lift"], ["self_test"] + 6 * ["levitating"])
        first, last = float(lines[0][2]), float(lines[-1][2])
        self.assertGreater(first, 0.9 * CLEARANCE_UM)  # it lay in the touchdown bearings
        self.assertLess(last, OBJECTIVE_UM)
        self.assertEqual(lines[-1][0], "2.0")

    def test_a_law_of_ones_own_levitates_where_none_lets_the_rotor_lie(self):
        own = self.run_example("own_law")
        self.assertEqual(own.returncode, 0, own.stdout + own.stderr)
        self.assertIn("levitating", own.stdout)
        self.assertLess(number(r"largest orbit ([\d.]+) um", own.stdout), 0.1 * CLEARANCE_UM)
        self.assertEqual(number(r"contact ([\d.]+) N", own.stdout), 0.0)
        none = self.run_example("own_law", "none")
        self.assertEqual(none.returncode, TRIPPED, none.stdout + none.stderr)
        self.assertIn("lift_failed", none.stdout)

    def test_a_port_of_ones_own_carries_a_whole_run_without_losing_a_cycle(self):
        done = self.run_example("own_port")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertRegex(done.stdout, r"\boff\n")  # landed at the end of the scenario
        self.assertLess(number(r"largest orbit ([\d.]+) um", done.stdout), OBJECTIVE_UM)
        # scenario levitate: 0.2 s self-test, 0.5 s ramp, 5 s hold, 0.5 s ramp at least, of 100 us each
        self.assertGreater(number(r"(\d+) cycles", done.stdout), 62_000)

    def test_a_port_of_ones_own_ends_the_loop_when_the_rig_has_gone(self):
        with Process(self.built, self.built / "own_port/own_port",
                     env={**os.environ, "LEVITAS_CONFIG": str(self.prefix / "share/levitas")}) as example:
            children = Path(f"/proc/{example.child.pid}/task/{example.child.pid}/children")
            rig = int(until(lambda: children.read_text(encoding="utf-8").split(), "its second process")[0])
            os.kill(rig, signal.SIGKILL)
            self.assertEqual(example.status(), 1)
            self.assertIn("the rig has gone", example.text)

    def test_an_example_names_what_it_does_not_find(self):
        done = own_program.run_on("/nowhere", self.built / "closed_loop/closed_loop")
        self.assertEqual(done.returncode, 1)
        self.assertIn("flexible_rotor: no such file", done.stderr)


if __name__ == "__main__":
    unittest.main()

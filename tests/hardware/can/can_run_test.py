"""The programs over a bus of the kernel: the same controller binary as over LCM, the same orbits."""

import csv
import hashlib
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["LEVITAS_SOURCE"])
sys.path.insert(0, str(SOURCE / "tests/support"))
from lcm_network import BINARIES, Process  # noqa: E402

CYCLES = 20_000
# Positions are rounded to 20 nm on the bus, currents to 0.1 mA; the loop answers a change of its
# reading by less than 5 times as much anywhere (its sensitivity peak is 2.6), and a step of the
# sensor's converter (49 nm) may fall to either side.
SAME_ORBIT_M = 5 * (10e-9 + 49e-9)
SCENARIO = """kind: scenario
name: standing
steps:
  - {do: lift, until: levitating, timeout_s: 5, hold_s: 0.9}
  - {do: land, until: off, timeout_s: 5}
"""


def amb(*words, **more):
    return subprocess.run([BINARIES / "amb", *map(str, words)], capture_output=True, text=True,
                          check=False, **more)


def positions(session, folder):
    table = folder / "positions.csv"
    result = amb("export", session, "--csv", table)
    assert result.returncode == 0, result.stderr
    with table.open(encoding="utf-8") as rows:
        return [[float(value) for name, value in row.items() if name.startswith("position_")]
                for row in csv.DictReader(rows)]


def unit_of(session, folder):
    with (folder / "positions.csv").open(encoding="utf-8") as rows:
        name = next(name for name in next(csv.reader(rows)) if name.startswith("position_"))
    return {"m": 1.0, "um": 1e-6, "mm": 1e-3}[name.rsplit("_", 1)[1]]


class OverTheBus(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        subprocess.run("ip link add dev vcan0 type vcan; ip link set vcan0 mtu 72 up", shell=True,
                       check=True)
        cls.folder = pathlib.Path(tempfile.mkdtemp())
        # Both runs with the delay of the slower way, so that only the bus differs.
        rig = (SOURCE / "config/rigs/flexible_rotor.yaml").read_text(encoding="utf-8")
        cls.rig = cls.folder / "rig.yaml"
        cls.rig.write_text(rig.replace("delay_samples: 1 ", "delay_samples: 2 "), encoding="utf-8")
        cls.scenario = cls.folder / "standing.yaml"
        cls.scenario.write_text(SCENARIO, encoding="utf-8")

    def run_over(self, *port):
        session = self.folder / f"{port[-1].replace(':', '_') if port else 'lcm'}.lcm"
        verdict = session.with_suffix(".json")
        result = amb("run", "--rig", self.rig, "--scenario", self.scenario, "--record", session,
                     "--json", verdict, *port, cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr + result.stdout)
        return session, json.loads(verdict.read_text(encoding="utf-8"))

    def test_the_same_binary_gives_the_same_orbits_as_over_lcm(self):
        binary = BINARIES / "amb-controller"
        print("amb-controller sha256", hashlib.sha256(binary.read_bytes()).hexdigest())
        over_lcm, _ = self.run_over()
        over_can, _ = self.run_over("--port", "can:vcan0")
        lcm = positions(over_lcm, self.folder)
        can = positions(over_can, self.folder)
        scale = unit_of(over_can, self.folder)
        self.assertEqual(len(lcm), len(can))
        self.assertGreaterEqual(len(can), CYCLES)
        worst = max(abs(a - b) * scale for one, other in zip(lcm[:CYCLES], can[:CYCLES])
                    for a, b in zip(one, other))
        print(f"largest difference over {CYCLES} cycles: {worst * 1e9:.1f} nm")
        self.assertLess(worst, SAME_ORBIT_M)
        replay = amb("replay", over_can)
        print("replay:", replay.stdout.strip().splitlines()[0] if replay.stdout else replay.stderr)
        self.assertEqual(replay.returncode, 0, replay.stdout + replay.stderr)

    def start(self, *more):
        rig = Process(self.folder, "amb-rig", "--rig", self.rig, "--port", "can:vcan0", "--stay",
                      *more)
        controller = Process(
            self.folder, "amb-controller", "--rig", self.rig, "--controller",
            "flexible_rotor_commissioned", "--scenario", self.scenario, "--port", "can:vcan0",
            "--trip-folder", self.folder)
        self.addCleanup(rig.kill)
        self.addCleanup(controller.kill)
        return rig, controller

    def test_a_killed_controller_is_found_by_the_rigs_watchdog_and_the_rotor_lands(self):
        rig, controller = self.start()
        rig.says("amplifiers on")
        controller.send_signal(signal.SIGKILL)
        text = rig.says("the rotor lies on its touchdown bearings")
        print(text)
        self.assertIn("amplifiers off: no valid current for 20 periods", text)
        rig.terminate()
        self.assertEqual(rig.status(), 0)

    def test_a_bus_that_does_not_carry_the_loop_is_refused_before_anything_moves(self):
        slow = self.folder / "slow.yaml"
        slow.write_text(self.rig.read_text(encoding="utf-8").replace(
            "data_bit_rate_mbit_per_s: 5", "data_bit_rate_mbit_per_s: 2"), encoding="utf-8")
        result = amb("run", "--rig", slow, "--port", "can:vcan0", cwd=self.folder)
        self.assertEqual(result.returncode, 3)
        self.assertIn("Hz fits", result.stderr)

    def test_an_interface_that_is_not_there_is_named_with_the_remedy(self):
        # Two names: one real bus for both directions would be refused for its load first.
        result = amb("run", "--rig", self.rig, "--port", "can:nocan,nocan2", cwd=self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertIn("ip link add dev nocan type vcan", result.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)

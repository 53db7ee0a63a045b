#!/usr/bin/env python3
"""How fast two processes exchange frames: raw UDP, our sockets, liblcm, and the real programs.

    benchmark/speed/lockstep_vs_udp.py [--repeats N] [--seconds S]

Every process runs under SCHED_FIFO where the machine grants it, so that other load stays outside
the comparison. All contestants take turns in each repeat, so that they meet the same machine; medians over the
repeats and ratios to raw UDP of the same repeat are printed. Each payload has the size of a sensor
frame and a current frame of four axes. Runs in a network namespace of its own.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("LEVITAS_BUILD", ROOT / "build/release"))
sys.path.insert(0, str(ROOT / "tests/support"))
from lcm_network import enter_namespace  # noqa: E402

SPIN_US = 20  # what the programs use
ONE_CORE = ["taskset", "-c", "0"]
ROWS = {
    "raw UDP, blocking": ("udp", 0, []),
    "raw UDP, blocking, one core": ("udp", 0, ONE_CORE),
    "raw UDP, spinning": ("udp", 1000, []),
    "own sockets, blocking": ("own", 0, []),
    "own sockets, blocking, one core": ("own", 0, ONE_CORE),
    "own sockets, adaptive spin": ("own", SPIN_US, []),
    "liblcm": ("liblcm", 0, []),
    "liblcm, one core": ("liblcm", 0, ONE_CORE),
}
PAIR = "amb-controller + amb-plant"
PAIR_ONE_CORE = "amb-controller + amb-plant, one core"


def fifo():
    """The prefix for SCHED_FIFO, empty where it is not granted."""
    prefix = ["chrt", "-f", "50"]
    return prefix if subprocess.run([*prefix, "true"], capture_output=True).returncode == 0 else []


def pingpong(transport, spin_us, prefix, seconds):
    done = subprocess.run([*prefix, str(BUILD / "bench/transport_pingpong"), transport,
                           str(seconds), str(spin_us)], capture_output=True, text=True, check=True)
    return float(done.stdout)


def pair(prefix):
    """Cycles per second of the whole chain: plant, network, controller, telemetry."""
    with tempfile.TemporaryDirectory() as folder:
        rig = subprocess.Popen([*prefix, str(BUILD / "bin/amb-plant"), "--rig", "flexible_rotor"],
                               stderr=subprocess.DEVNULL)
        subprocess.run([*prefix, str(BUILD / "bin/amb-controller"), "--rig", "flexible_rotor",
                        "--controller", "flexible_rotor", "--scenario", "levitate",
                        "--trip-folder", folder, "--json", f"{folder}/c.json"],
                       stderr=subprocess.DEVNULL, check=True)
        rig.wait(20)
        result = json.loads(Path(f"{folder}/c.json").read_text())
        return result["cycles"] / result["wall_s"]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--seconds", type=float, default=1.0)
    wanted, _ = parser.parse_known_args()
    scheduling = fifo()
    rates = {}
    for _ in range(wanted.repeats):
        for name, (transport, spin_us, prefix) in ROWS.items():
            rates.setdefault(name, []).append(pingpong(
                transport, spin_us, [*scheduling, *prefix], wanted.seconds))
        for name, prefix in ((PAIR, []), (PAIR_ONE_CORE, ONE_CORE)):
            rates.setdefault(name, []).append(pair([*scheduling, *prefix]))
    yardstick = rates["raw UDP, blocking"]
    print(f"lockstep exchanges, medians of {wanted.repeats}; "
          f"ratio to raw UDP, blocking, of the same repeat; "
          f"{'SCHED_FIFO' if scheduling else 'ordinary scheduling'}; load {os.getloadavg()[0]:.1f}")
    results = {}
    for name, values in rates.items():
        ratio = statistics.median(v / y for v, y in zip(values, yardstick))
        median = statistics.median(values)
        results[name] = {"per_second": median, "ratio_to_raw_udp_blocking": ratio}
        print(f"  {name:<38} {median:10.0f} /s   {ratio:5.2f}")
    best = max(results, key=lambda n: results[n]["per_second"] if n.startswith("raw") else 0.0)
    print(f"  fastest raw UDP of this run: {best}; the programs reach "
          f"{max(results[PAIR]['per_second'], results[PAIR_ONE_CORE]['per_second']) / results[best]['per_second']:.2f} of it")
    if out := os.environ.get("BENCH_JSON"):
        Path(out).write_text(json.dumps(results, indent=2))


if __name__ == "__main__":
    enter_namespace()
    main()

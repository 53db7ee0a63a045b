#!/usr/bin/env python3
"""Wake-up error of the real-time loop beside cyclictest, in alternation.

    benchmark/speed/realtime_vs_cyclictest.py [--seconds S] [--repeats N]        full proof: --seconds 60

In each repeat cyclictest (-i 100 -p 80) runs alone, then amb-controller with amb-plant at 10 kHz.
Printed are medians over the repeats, the ratio of each percentile to cyclictest's of the same
repeat, skipped periods (cyclictest: those it did not run; its late wake-ups are more than a period
late) and lost messages. Runs in a network namespace of its own; needs root or rtprio. Status 77 and a
sentence where cyclictest is missing or cannot run.
"""

import argparse
import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("LEVITAS_BUILD", ROOT / "build/release"))
sys.path.insert(0, str(ROOT / "tests/support"))
from lcm_network import enter_namespace  # noqa: E402

PERIOD_US = 100
PERCENTILES = (("p50", 0.5), ("p99", 0.99), ("p999", 0.999))
NOT_RUN = 77
AIMS = {"p50": 0.1, "p99": 0.5, "p999": 1.0}


def not_run(reason):
    """Ends with the status by which amb bench knows that nothing was measured, and nothing failed."""
    print(f"  not run: {reason}")
    sys.exit(NOT_RUN)


def cyclictest(seconds):
    """Percentiles [us] and late periods, from cyclictest's histogram."""
    done = subprocess.run(["cyclictest", "-m", "-i", str(PERIOD_US), "-p", "80", "-q", "-h",
                           "5000", "-D", str(seconds)], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        said = (done.stderr.strip() or done.stdout.strip()).splitlines()
        not_run(f"cyclictest ended with status {done.returncode}: {said[0] if said else 'no word'}")
    counts, overflow = {}, 0
    for line in done.stdout.splitlines():
        fields = line.split()
        if line.startswith("# Histogram Overflows:"):
            overflow = int(fields[-1])
        elif len(fields) == 2 and fields[0].isdigit():
            counts[int(fields[0])] = int(fields[1])
    total = sum(counts.values()) + overflow
    result = {"late": overflow + sum(n for late, n in counts.items() if late >= PERIOD_US),
              "skipped": max(0, seconds * 1_000_000 // PERIOD_US - total), "cycles": total}
    for name, part in PERCENTILES:
        seen = 0
        for late in sorted(counts):
            seen += counts[late]
            if seen >= part * total:
                result[name] = float(late)
                break
        else:
            result[name] = 5000.0
    return result


def pair(seconds):
    """The same of amb-controller, with what it and amb-plant counted."""
    with tempfile.TemporaryDirectory() as folder:
        common = ["--rig", "flexible_rotor", "--pace", "realtime", "--json"]
        rig = subprocess.Popen([str(BUILD / "bin/amb-plant"), *common, f"{folder}/p.json"],
                               stderr=subprocess.DEVNULL)
        done = subprocess.run([str(BUILD / "bin/amb-controller"), *common, f"{folder}/c.json",
                               "--controller", "flexible_rotor", "--duration", str(seconds),
                               "--trip-folder", folder], stderr=subprocess.DEVNULL, check=False)
        rig.wait(20)
        control = json.loads(Path(f"{folder}/c.json").read_text())
        plant = json.loads(Path(f"{folder}/p.json").read_text())
    wakeup = control["timing"]["wakeup"]
    return {**{name: wakeup[f"{name}_ns"] / 1000 for name, _ in PERCENTILES},
            "skipped": control["skipped_periods"], "cycles": control["cycles"],
            "missing": control["missing_frames"], "rig_skipped": plant["skipped_periods"],
            "lost": control["messages_lost"] + plant["messages_lost"],
            "latency_p50": control["timing"]["latency"]["p50_ns"] / 1000,
            "latency_p99": control["timing"]["latency"]["p99_ns"] / 1000,
            "blamed": control["timing"]["blamed"], "status": done.returncode}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--seconds", type=int, default=10)
    parser.add_argument("--repeats", type=int, default=3)
    wanted, _ = parser.parse_known_args()
    runs = []
    for _ in range(wanted.repeats):
        runs.append((cyclictest(wanted.seconds), pair(wanted.seconds)))
    print(f"wake-up error at {1000 // PERIOD_US} kHz, {wanted.seconds} s each, medians of "
          f"{wanted.repeats} alternations; load {os.getloadavg()[0]:.1f}")
    print(f"  {'':<6}{'cyclictest':>12}{'controller':>12}{'ratio':>8}{'aim':>6}")
    results = {"runs": runs}
    for name, _ in PERCENTILES:
        theirs = statistics.median(c[name] for c, _ in runs)
        ours = statistics.median(p[name] for _, p in runs)
        ratio = statistics.median(p[name] / max(c[name], 1.0) for c, p in runs)
        results[name] = {"cyclictest_us": theirs, "controller_us": ours, "ratio": ratio}
        print(f"  {name:<6}{theirs:9.2f} us{ours:9.2f} us{ratio:8.3f}{AIMS[name]:6.1f}")
    for who, at, keys in (("cyclictest", 0, ("late", "skipped", "cycles")),
                          ("controller", 1, ("skipped", "missing", "rig_skipped", "lost", "cycles"))):
        sums = {key: sum(run[at][key] for run in runs) for key in keys}
        print(f"  {who}: " + ", ".join(f"{key} {value}" for key, value in sums.items()))
    print("  sample to current, p50 / p99: "
          f"{statistics.median(p['latency_p50'] for _, p in runs):.1f} / "
          f"{statistics.median(p['latency_p99'] for _, p in runs):.1f} us")
    if out := os.environ.get("BENCH_JSON"):
        Path(out).write_text(json.dumps(results, indent=2))


if __name__ == "__main__":
    if shutil.which("cyclictest") is None:
        not_run("the comparison needs cyclictest (Debian package rt-tests: apt-get install rt-tests)")
    enter_namespace()
    main()

#!/usr/bin/env python3
"""What one sampling period of each rig costs, and how many times faster than real time that is.

    benchmark/speed/rigs_table.py [--repeats N]        also by ./amb bench rigs_table
    benchmark/speed/rigs_table.py --install-ross       ROSS into build/bench/ross, once; needs the network

Rows come from rigs_bench (the plant alone, levitated, noise and true magnet forces included). Where
ROSS (Timbo et al. 2020, J. Open Source Softw. 5(48) 2120) is installed, its time response of its
own model of the UFU rig, magnetic bearings closed, stands beside our unreduced one: same rig, same
step of 100 us, interleaved in one run. ROSS integrates all six degrees of freedom of a node and
linear bearings; we both bending planes and the true magnet force.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "build/release/bench/rigs_bench"
ROSS = ROOT / "build/bench/ross"
ROSS_PACKAGES = ("ross-rotordynamics==2.3.0", "plotly==5.24.1")
AIMS = {"flexible_rotor": 40.0, "geared_rotor_12dof": 40.0, "ufu_rig_not_reduced": 1.0}

# Run by the interpreter that has ROSS; prints one line of JSON.
ROSS_SCRIPT = """
import json, sys, time
import numpy as np
import ross
rotor = ross.rotor_amb_example()
def steps_per_s(steps, **options):
    t = np.arange(steps + 1) * 1e-4
    force = np.zeros((len(t), rotor.ndof))
    force[:, 27 * rotor.number_dof] = np.cos(100.0 * t)
    start = time.process_time()
    rotor.run_time_response(100.0, force, t, method="newmark", **options)
    return steps / (time.process_time() - start)
sys.stdout = sys.stderr
full = steps_per_s(100)
reduced = steps_per_s(3000, model_reduction={"num_modes": 24})
sys.stdout = sys.__stdout__
print(json.dumps({"version": ross.__version__, "degrees_of_freedom": rotor.ndof,
                  "full_steps_per_s": full, "reduced_steps_per_s": reduced}))
"""


def measure_rigs():
    """One pass over all rigs: name -> (ns per period, x real time, degrees of freedom)."""
    done = subprocess.run([PROGRAM, "--benchmark_format=json", "--benchmark_min_time=0.1"],
                          capture_output=True, text=True, check=True)
    rows = {}
    for row in json.loads(done.stdout)["benchmarks"]:
        name = row["name"].removeprefix("Rig/")
        if row.get("error_occurred"):
            print(f"  {name}: not measured, {row.get('error_message')}", file=sys.stderr)
            continue
        rows[name] = (row["cpu_time"], row["x_real_time"], int(row["degrees_of_freedom"]))
    return rows


def measure_ross():
    """What ROSS does in a second, or None where it is not installed."""
    python = Path(os.environ.get("LEVITAS_ROSS_PYTHON", ROSS / "bin/python"))
    if not python.exists():
        return None
    environ = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    done = subprocess.run([python, "-c", ROSS_SCRIPT], capture_output=True, text=True, check=False,
                          env=environ)
    if done.returncode != 0:
        print(f"  ROSS failed: {done.stderr.strip()[-300:]}", file=sys.stderr)
        return None
    return json.loads(done.stdout.strip().splitlines()[-1])


def median(passes, name, index):
    return statistics.median(p[name][index] for p in passes)


def print_rigs(passes):
    """The table of the rigs; returns the names of those that miss their aim."""
    print(f"  {'rig':<34} {'DOF':>4} {'ns per period':>14} {'x real time':>12}  aim")
    missed = []
    for name in passes[0]:
        ratio = median(passes, name, 1)
        aim = AIMS.get(name)
        said = ""
        if aim is not None:
            said = f">= {aim:g}: {'met' if ratio >= aim else 'MISSED'}"
            if ratio < aim:
                missed.append(name)
        print(f"  {name:<34} {passes[0][name][2]:>4} {median(passes, name, 0):>14.0f} "
              f"{ratio:>12.1f}  {said}".rstrip())
    return missed


def print_ross(passes, ross):
    """ROSS beside our model of the same rig, both with all degrees of freedom and reduced."""
    print(f"  ROSS {ross[0]['version']}, rig UFU, its own model with magnetic bearings, steps of "
          "100 us per second of one core")
    for ours, theirs, what in (("ufu_rig_not_reduced", "full_steps_per_s", "all"),
                               ("ufu_rig", "reduced_steps_per_s", "reduced")):
        mine = 1e9 / median(passes, ours, 0)
        other = statistics.median(r[theirs] for r in ross)
        print(f"  {what:<10} levitas {mine:>12.0f}   ROSS {other:>10.0f}   ratio "
              f"{mine / other:.0f}")


def main():
    parser = argparse.ArgumentParser(description="Cost of one period of every rig.")
    parser.add_argument("--repeats", type=int, default=3, help="passes behind each median")
    parser.add_argument("--install-ross", action="store_true", help="ROSS from PyPI, then end")
    options = parser.parse_args()
    if options.install_ross:
        venv.create(ROSS, with_pip=True)
        subprocess.run([ROSS / "bin/pip", "install", "-q", *ROSS_PACKAGES], check=True)
        return 0
    passes, ross = [], []
    for _ in range(max(1, options.repeats)):  # interleaved: both meet the same machine
        passes.append(measure_rigs())
        found = measure_ross()
        if found:
            ross.append(found)
    missed = print_rigs(passes)
    if ross:
        print_ross(passes, ross)
    else:
        print("  ROSS is not installed: benchmark/speed/rigs_table.py --install-ross")
    if "BENCH_JSON" in os.environ:
        Path(os.environ["BENCH_JSON"]).write_text(
            json.dumps({"rigs": passes, "ross": ross}, indent=2) + "\n")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())

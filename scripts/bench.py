#!/usr/bin/env python3
"""Runs every benchmark: the machine first, then medians over repeats.

    ./amb bench [FILTER] [--repeats N] [--min-time S]

Google Benchmark programs are build/release/bench/*_bench; process-level measurements are the
executable benchmark/speed/*.py and *.sh, which print their own lines and get BENCH_JSON, the file they
may write to; what a machine lacks for one of them is said, and the rest goes on. Everything lands in build/bench/. Compare rows of one run only: another run met
another machine load.
"""

import argparse
import json
import os
import platform
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BINARIES = ROOT / "build/release/bench"
OUT = ROOT / "build/bench"
NOT_RUN = 77  # status of a script that says what it lacks on this machine


def read(path, otherwise="unknown"):
    try:
        return Path(path).read_text().strip()
    except OSError:
        return otherwise


def environment():
    """What a reader must know to judge the numbers."""
    model = re.search(r"^model name\s*:\s*(.*)$", read("/proc/cpuinfo"), re.M)
    memory = re.search(r"^MemTotal:\s*(\d+)", read("/proc/meminfo"), re.M)
    build = re.search(r"^CMAKE_BUILD_TYPE:\w+=(.*)$",
                      read(ROOT / "build/release/CMakeCache.txt"), re.M)
    return {
        "cpu": model.group(1) if model else platform.machine(),
        "cores": os.cpu_count(),
        "memory_mb": int(memory.group(1)) // 1024 if memory else None,
        "kernel": platform.release(),
        "realtime_kernel": read("/sys/kernel/realtime", "0") == "1",
        "governor": read("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "none"),
        "rt_runtime_us": read("/proc/sys/kernel/sched_rt_runtime_us"),
        "load_1min": os.getloadavg()[0],
        "build_type": build.group(1) if build else "unknown",
    }


def print_environment(facts):
    print("environment")
    for key, value in facts.items():
        print(f"  {key:<16} {value}")
    if facts["load_1min"] > 0.5:
        print("  note             the machine is busy: trust ratios within this run only")


def readable_time(nanoseconds):
    for limit, unit, scale in ((1e3, "ns", 1.0), (1e6, "us", 1e3), (1e9, "ms", 1e6)):
        if nanoseconds < limit:
            return f"{nanoseconds / scale:8.1f} {unit}"
    return f"{nanoseconds / 1e9:8.2f} s "


TO_NANOSECONDS = {"ns": 1.0, "us": 1e3, "ms": 1e6, "s": 1e9}


def print_medians(result):
    by_name = {}
    for row in result["benchmarks"]:
        if row["run_type"] == "aggregate":
            by_name.setdefault(row["run_name"], {})[row["aggregate_name"]] = row
    if not by_name:  # one repetition has no aggregates: it is its own median
        by_name = {row["run_name"]: {"median": row} for row in result["benchmarks"]}
    for name, aggregates in by_name.items():
        median, spread = aggregates["median"], aggregates.get("cv")
        time_ns = median["cpu_time"] * TO_NANOSECONDS[median["time_unit"]]
        variation = f"{100 * spread['cpu_time']:5.1f} %" if spread else "    -  "
        known = set(RESERVED_KEYS) | {"items_per_second", "bytes_per_second"}
        counters = [f"{k} {v:.4g}" for k, v in median.items()
                    if k not in known and isinstance(v, (int, float))]
        if "items_per_second" in median:
            counters.insert(0, f"{median['items_per_second']:.3g} /s")
        print(f"  {name:<44} {readable_time(time_ns)}  {variation}  {'  '.join(counters)}".rstrip())


RESERVED_KEYS = ("name", "family_index", "per_family_instance_index", "run_name", "run_type",
                 "repetitions", "repetition_index", "threads", "aggregate_name", "aggregate_unit",
                 "iterations", "real_time", "cpu_time", "time_unit")


def run_google_benchmark(program, options):
    out = OUT / f"{program.name}.json"
    done = subprocess.run(
        [program, f"--benchmark_repetitions={options.repeats}",
         f"--benchmark_min_time={options.min_time}", "--benchmark_report_aggregates_only=true",
         f"--benchmark_out={out}", "--benchmark_out_format=json"],
        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        print(f"  failed with status {done.returncode}: {done.stderr.strip()[-300:]}")
    else:
        print_medians(json.loads(out.read_text()))
    return done.returncode


def run_script(script):
    environ = dict(os.environ, BENCH_JSON=str(OUT / f"{script.stem}.json"),
                   LEVITAS_BINARIES=str(ROOT / "build/release/bin"))
    status = subprocess.run([script], env=environ, check=False).returncode
    if status not in (0, NOT_RUN):
        print(f"  failed with status {status}")
    return status


def repeats(text):
    if int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text} repeats: expected 1 or more")
    return int(text)


def seconds(text):
    if not 0 < float(text) < 3600:
        raise argparse.ArgumentTypeError(f"{text} s: expected more than 0 and less than 3600")
    return float(text)


def main():
    parser = argparse.ArgumentParser(prog="amb bench", description="Runs the benchmarks.")
    parser.add_argument("filter", nargs="?", default="", help="only those whose name contains this")
    parser.add_argument("--repeats", type=repeats, default=5, help="repetitions behind each median")
    parser.add_argument("--min-time", type=seconds, default=0.2, help="seconds per repetition")
    options = parser.parse_args()
    OUT.mkdir(parents=True, exist_ok=True)
    facts = environment()
    print_environment(facts)
    (OUT / "environment.json").write_text(json.dumps(facts, indent=2) + "\n")

    programs = sorted(BINARIES.glob("*_bench"))
    scripts = sorted(p for p in (ROOT / "benchmark/speed").iterdir()
                     if p.suffix in (".py", ".sh") and os.access(p, os.X_OK))
    chosen = [p for p in programs + scripts if options.filter in p.name]
    if not chosen:
        names = ", ".join(p.name for p in programs + scripts)
        print(f"amb bench: nothing is called '{options.filter}'; there are: {names}", file=sys.stderr)
        return 2
    failed, not_run = [], []
    print(f"\nmedian of {options.repeats} repetitions, variation (standard deviation / mean)")
    for item in chosen:
        print(f"\n{item.stem}", flush=True)
        status = run_google_benchmark(item, options) if item in programs else run_script(item)
        if status == NOT_RUN:
            not_run.append(item.name)  # it has said why
        elif status != 0:
            failed.append(item.name)
    print(f"\nresults as JSON: {OUT.relative_to(ROOT)}/")
    if not_run:
        print(f"amb bench: not run: {', '.join(not_run)}", file=sys.stderr)
    if failed:
        print(f"amb bench: failed: {', '.join(failed)}", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

"""Runs fuzz targets, two at a time: run.py FOLDER [--seconds S] [--runs N] [--jobs J] [TARGET ...]

FOLDER holds the programs fuzz_* (build/fuzz/fuzzers). Each starts with seeds of its own making and
may use 10 s for an input and 2 GiB. Status 1 when one of them fails; the input that broke it, and
how to repeat it, are printed, and the input is kept in FOLDER/failed.
"""

import argparse
import concurrent.futures
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

LIMITS = ["-timeout=10", "-rss_limit_mb=2048", "-print_final_stats=1", "-verbosity=1"]
# What a program refuses it says on stderr; the fuzzer keeps its own.
OPTIONS = {"ASAN_OPTIONS": "detect_leaks=1:allocator_may_return_null=0", "UBSAN_OPTIONS": "print_stacktrace=1"}


def said(text, pattern):
    found = re.findall(pattern, text)
    return int(found[-1]) if found else 0


def fuzz(program, seconds, runs):
    """(name, inputs tried, what it printed, whether it failed)."""
    kept = program.parent / "failed"
    kept.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="levitas-fuzz-") as corpus:
        environment = {**os.environ, **OPTIONS}
        subprocess.run([program, f"--seeds={corpus}"], check=True, env=environment,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=60)
        command = [program, corpus, *LIMITS, f"-artifact_prefix={kept}/{program.name}-"]
        command += [f"-max_total_time={seconds}"] if seconds else []
        command += [f"-runs={runs}"] if runs else []
        done = subprocess.run(command, env=environment, stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, check=False)
    text = done.stderr.decode(errors="replace")
    return program.name, said(text, r"stat::number_of_executed_units:\s+(\d+)"), text, done.returncode


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("targets", nargs="*")
    parser.add_argument("--seconds", type=int, default=60)
    parser.add_argument("--runs", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=2)
    return parser.parse_intermixed_args()


def main():
    asked = arguments()
    names = asked.targets or sorted(path.name for path in asked.folder.glob("fuzz_*"))
    if not names:
        sys.exit(f"{asked.folder}: no fuzz_* in it")
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(asked.jobs) as pool:
        tries = [pool.submit(fuzz, asked.folder.resolve() / name, asked.seconds, asked.runs)
                 for name in names]
        for done in concurrent.futures.as_completed(tries):
            name, inputs, text, status = done.result()
            print(f"{name}: {inputs} inputs, {'FAILED' if status else 'nothing found'}", flush=True)
            if status:
                failed += 1
                print(text[-6000:], flush=True)
                print(f"repeat: {asked.folder}/{name} FILE, with the file named above", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""clang-tidy over every source file of the project; a finding fails.

    scripts/tidy.py [--build build/tidy] [--jobs N] [FILE...]

A file whose preprocessed text and settings passed before is not looked at again: its digest is
kept in BUILD/tidy-passed. Headers are checked through the sources that include them.
"""

import argparse
import concurrent.futures
import hashlib
import json
import os
import shlex
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
CLANG_TIDY = "clang-tidy-14"


def commands(build):
    """Our sources of the compilation database: path -> argument list."""
    found = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        path = Path(entry["file"])
        if path.is_relative_to(ROOT) and not path.is_relative_to(build) and "tests" not in path.parts:
            found[path] = (shlex.split(entry["command"]), entry["directory"])
    return found


def digest(arguments, directory, settings):
    """Of what clang-tidy will see: the preprocessed text and the settings."""
    words = list(arguments)
    if "ccache" in words[0]:
        words.pop(0)
    words[words.index("-c")] = "-E"
    words[words.index("-o") + 1] = "-"
    done = subprocess.run(words, cwd=directory, capture_output=True, check=False)
    return hashlib.sha256(settings + done.stdout).hexdigest() if done.returncode == 0 else None


def check(path, build, command, settings):
    """Empty when clean, otherwise what clang-tidy says."""
    key = digest(*command, settings)
    passed = build / "tidy-passed" / (key or "none")
    if key and passed.exists():
        return ""
    done = subprocess.run([CLANG_TIDY, "--quiet", "-p", build, path], capture_output=True,
                          text=True, check=False)
    if done.returncode != 0:
        return done.stdout or done.stderr
    if key:
        passed.touch()
    return ""


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=Path, default=ROOT / "build/tidy")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("files", nargs="*", type=Path)
    options = parser.parse_args()
    build = options.build.resolve()
    (build / "tidy-passed").mkdir(exist_ok=True)
    sources = commands(build)
    if options.files:
        chosen = {path.resolve() for path in options.files}
        if strangers := chosen - set(sources):
            names = ", ".join(os.path.relpath(path, ROOT) for path in sorted(strangers))
            print(f"tidy.py: no source that {build} builds: {names}", file=sys.stderr)
            return 2
        sources = {path: command for path, command in sources.items() if path in chosen}
    settings = (ROOT / ".clang-tidy").read_bytes()
    findings, seen = 0, set()
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        jobs = [pool.submit(check, path, build, command, settings)
                for path, command in sources.items()]
        for number, job in enumerate(concurrent.futures.as_completed(jobs), 1):
            if sys.stderr.isatty():
                print(f"\r\033[Kclang-tidy {number}/{len(jobs)}", end="", file=sys.stderr)
            if text := job.result():
                findings += 1
                # One header's finding comes once, not once per file that includes it.
                if text not in seen:
                    print(text, flush=True)
                seen.add(text)
    if sys.stderr.isatty():
        print("\r\033[K", end="", file=sys.stderr)
    print(f"clang-tidy: {len(sources)} files, {findings} with findings")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())

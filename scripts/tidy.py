#!/usr/bin/env python3
"""clang-tidy over every source file and header of the project; a finding fails.

    scripts/tidy.py [--build build/tidy] [--jobs N] [FILE...]

A file whose preprocessed text, flags and settings passed before is not looked at again: its digest
is kept in ~/.cache/levitas/tidy-passed (XDG_CACHE_HOME is heard; --no-cache looks at everything).
Comments are part of the digest, because NOLINT is one; places in the file system are not, so that
another clone of the same text is quick too. A header is checked once, as a file of its own with the
flags of the nearest source, and not again through every source that includes it; so every header
also has to compile by itself.
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


def header_commands(sources):
    """Our headers, each with the command of the nearest source: its own, or one of its folder."""
    found = {}
    for path in sorted(ROOT.rglob("*.hpp")):
        parts = path.relative_to(ROOT).parts
        if parts[0] in ("build", "tests"):
            continue
        source = path.with_suffix(".cpp")
        if source not in sources:
            below = [other for other in sorted(sources) if other.is_relative_to(ROOT / parts[0])]
            beside = [other for other in below if other.parent == path.parent]
            source = (beside or below or sorted(sources))[0]
        arguments, directory = sources[source]
        arguments = [str(path) if Path(directory, word) == source else word for word in arguments]
        arguments.insert(arguments.index("-c"), "-xc++")
        found[path] = (arguments, directory)
    return found


def look(path, build, command):
    """Runs clang-tidy on one file."""
    flags = []
    if path.suffix == ".hpp":  # the compilation database does not know headers
        words = list(command[0])[1:]
        while not words[0].startswith("-"):
            words.pop(0)
        at = words.index("-o")
        flags = ["--", *words[:at], *words[at + 2:], "-Wno-pragma-once-outside-header"]
        flags = [word for word in flags if word not in ("-c", str(path))]
    return subprocess.run([CLANG_TIDY, "--quiet", "-p", build, path, *flags], cwd=command[1],
                          capture_output=True, text=True, check=False)


def digest(path, arguments, directory, settings):
    """Of what clang-tidy will see: the name, the flags, the preprocessed text, the settings."""
    words = list(arguments)
    if "ccache" in words[0]:
        words.pop(0)
    # A header as a file of its own has its #pragma once in the main file.
    words[words.index("-c") : words.index("-c") + 1] = [
        "-Wno-pragma-once-outside-header", "-E", "-P", "-CC"]
    words[words.index("-o") + 1] = "-"
    done = subprocess.run(words, cwd=directory, capture_output=True, check=False)
    if done.returncode != 0:
        return None
    flags = [word for word in words if word.startswith(("-W", "-f", "-std", "-m", "-O"))]
    head = " ".join([str(path.relative_to(ROOT)), *flags]).encode()
    return hashlib.sha256(b"\0".join([settings, head, done.stdout])).hexdigest()


def cache_folder():
    """Where the digests of clean files are kept, made if need be."""
    home = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    folder = Path(home) / "levitas" / "tidy-passed"
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def check(path, build, command, settings, cache):
    """Empty when clean, otherwise what clang-tidy says; without `cache` every file is looked at."""
    key = digest(path, *command, settings) if cache else None
    passed = cache / key if key else None
    if passed and passed.exists():
        return ""
    done = look(path, build, command)
    if done.returncode != 0:
        return done.stdout or done.stderr
    if passed:
        passed.touch()
    return ""


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=Path, default=ROOT / "build/tidy")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--no-cache", action="store_true", help="look at every file again")
    parser.add_argument("files", nargs="*", type=Path)
    options = parser.parse_args()
    build = options.build.resolve()
    cache = None if options.no_cache else cache_folder()
    sources = commands(build)
    sources |= header_commands(sources)
    if options.files:
        chosen = {path.resolve() for path in options.files}
        if strangers := chosen - set(sources):
            names = ", ".join(os.path.relpath(path, ROOT) for path in sorted(strangers))
            print(f"tidy.py: no header, and no source that {build} builds: {names}", file=sys.stderr)
            return 2
        sources = {path: command for path, command in sources.items() if path in chosen}
    version = subprocess.run([CLANG_TIDY, "--version"], capture_output=True, check=True).stdout
    settings = version + (ROOT / ".clang-tidy").read_bytes()
    findings, seen = 0, set()
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        jobs = [pool.submit(check, path, build, command, settings, cache)
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

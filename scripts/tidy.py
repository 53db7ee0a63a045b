#!/usr/bin/env python3
"""clang-tidy over every source file and header of the project; a finding fails.

    scripts/tidy.py [--build build/tidy] [--jobs N] [--record] [FILE...]

A file whose preprocessed text, flags and settings passed before is not looked at again: its digest
is kept in ~/.cache/levitas/tidy-passed (XDG_CACHE_HOME is heard; --no-cache looks at everything).
Comments are part of the digest, because NOLINT is one; places in the file system are not, so that
another clone of the same text is quick too. scripts/tidy_passed.txt brings digests along for machines
that have no cache: --record writes there what has passed. It need not be up to date, since a text
that it does not know is looked at. Sources are looked at in the batches they are built in
(CMAKE_UNITY_BUILD), so that the headers that they share are walked through once, and a header with a
source of its own along with that. The other headers of a top folder are a batch, too, and each of
them has to compile by itself, with the flags of the nearest source.
"""

import argparse
import concurrent.futures
import functools
import hashlib
import json
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
CLANG_TIDY = "clang-tidy-14"
RECORD = ROOT / "scripts/tidy_passed.txt"


def batch_of(path, build):
    """The sources that a generated batch includes; a source that is built alone is its own batch."""
    if not path.is_relative_to(build):
        return [path]
    text = path.read_text() if "Unity" in path.parts else ""
    return [Path(name) for name in re.findall(r'^#include "(.+)"$', text, re.MULTILINE)]


def is_ours(path, build):
    """Of the project, neither a test nor generated."""
    return (path.is_relative_to(ROOT) and not path.is_relative_to(build)
            and "tests" not in path.relative_to(ROOT).parts)


def commands(build):
    """Batches of our sources: path of what is compiled -> (argument list, directory, sources)."""
    found = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        path = Path(entry["file"])
        sources = [source for source in batch_of(path, build) if is_ours(source, build)]
        if sources:
            found[path] = (shlex.split(entry["command"]), entry["directory"], sources)
    return found


def nearest_command(header, batches, compiled):
    """Flags and directory with which a header is compiled by itself: those of the nearest source."""
    below = [other for other in sorted(compiled)
             if other.is_relative_to(ROOT / header.relative_to(ROOT).parts[0])]
    beside = [other for other in below if other.parent == header.parent]
    batch = compiled[(beside or below or sorted(compiled))[0]]
    arguments, directory, _ = batches[batch]
    return compiling(header, batch, arguments, directory), directory


def compiling(path, instead_of, arguments, directory):
    """The arguments with another file compiled, as C++."""
    arguments = [str(path) if Path(directory, word) == instead_of else word for word in arguments]
    arguments.insert(arguments.index("-c"), "-xc++")
    return arguments


def header_commands(batches, build):
    """Our headers without a source of their own, a batch for each top folder, and how each compiles
    by itself: header -> (argument list, directory)."""
    compiled = {source: path for path, batch in batches.items() for source in batch[2]}
    alone = {}
    for path in sorted(ROOT.rglob("*.hpp")):
        if (path.relative_to(ROOT).parts[0] not in ("build", "tests")
                and path.with_suffix(".cpp") not in compiled):
            alone[path] = nearest_command(path, batches, compiled)
    found = {}
    for top in sorted({header.relative_to(ROOT).parts[0] for header in alone}):
        headers = [header for header in alone if header.relative_to(ROOT).parts[0] == top]
        batch = build / "headers" / f"{top}.cpp"
        batch.parent.mkdir(exist_ok=True)
        batch.write_text("".join(f'#include "{header}"\n' for header in headers))
        # Where one header needs a library, all are compiled with its flags.
        arguments, directory = alone[headers[0]]
        more = [word for header in headers for word in pairs(alone[header][0])
                if word not in pairs(arguments)]
        arguments = compiling(batch, headers[0], arguments, directory)
        for pair in dict.fromkeys(more):
            arguments[1:1] = pair
        found[batch] = (arguments, directory, headers)
    return found, alone


def pairs(arguments):
    """The include paths and definitions among the arguments, each with its word before it."""
    words = [(word, after) for word, after in zip(arguments, arguments[1:]) if word in ("-isystem", "-I")]
    return words + [(word,) for word in arguments if re.match(r"-[ID].", word)]


def look(path, build, command):
    """Runs clang-tidy on one batch or header."""
    flags = []
    if command[2] != [path]:
        ours = "|".join(sorted({source.relative_to(ROOT).parts[0] for source in command[2]}))
        # A batch is made of what this one check refuses.
        flags = ["--checks=-bugprone-suspicious-include",
                 f"--header-filter=^{re.escape(str(ROOT))}/({ours})/.*[.]hpp$"]
    if path.parent.name == "headers":  # the compilation database does not know these
        words = list(command[0])[1:]
        while not words[0].startswith("-"):
            words.pop(0)
        at = words.index("-o")
        flags += ["--", *(word for word in words[:at] + words[at + 2:] if word not in ("-c", str(path)))]
    return subprocess.run([CLANG_TIDY, "--quiet", "-p", build, path, *flags], cwd=command[1],
                          capture_output=True, text=True, check=False)


def refused_alone(header, arguments, directory):
    """What the compiler says of a header by itself; empty when it compiles."""
    words = [word for word in arguments if "ccache" not in word]
    words[words.index("-c")] = "-fsyntax-only"
    # A header as a file of its own has its #pragma once in the main file.
    words.insert(1, "-Wno-pragma-once-outside-header")
    done = subprocess.run(words, cwd=directory, capture_output=True, text=True, check=False)
    return f"{header} does not compile by itself:\n{done.stderr}" if done.returncode != 0 else ""


def digest(path, arguments, directory, settings):
    """Of what clang-tidy will see: the name, the flags, the preprocessed text, the settings."""
    words = list(arguments)
    if "ccache" in words[0]:
        words.pop(0)
    words[words.index("-c") : words.index("-c") + 1] = ["-E", "-P", "-CC"]
    words[words.index("-o") + 1] = "-"
    done = subprocess.run(words, cwd=directory, capture_output=True, check=False)
    if done.returncode != 0:
        return None
    flags = [word for word in words if word.startswith(("-W", "-f", "-std", "-m", "-O"))
             and not word.startswith("-ffile-prefix-map=")]  # names the clone
    head = " ".join([str(path.relative_to(ROOT)), *flags]).encode()
    return hashlib.sha256(b"\0".join([settings, head, done.stdout])).hexdigest()


def cache_folder():
    """Where the digests of clean files are kept, made if need be."""
    home = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    folder = Path(home) / "levitas" / "tidy-passed"
    folder.mkdir(parents=True, exist_ok=True)
    return folder


PASSED = set()  # digests, of this run


@functools.cache
def recorded():
    """The digests that the repository brings along."""
    return set(RECORD.read_text().split()) if RECORD.exists() else set()


def check(path, build, command, alone, settings, cache):
    """Empty when clean, otherwise what clang-tidy says, or the compiler of the headers that have to
    compile by themselves; without `cache` every file is looked at."""
    key = digest(path, *command[:2], settings) if cache else None
    passed = cache / key if key else None
    if passed and (key in recorded() or passed.exists()):
        passed.touch()
        PASSED.add(key)
        return ""
    done = look(path, build, command)
    if done.returncode != 0:
        return done.stdout or done.stderr
    for header in command[2]:
        if header in alone and (said := refused_alone(header, *alone[header])):
            return said
    if passed:
        passed.touch()
        PASSED.add(key)
    return ""


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=Path, default=ROOT / "build/tidy")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--no-cache", action="store_true", help="look at every file again")
    parser.add_argument("--record", action="store_true", help=f"write what passed to {RECORD.name}")
    parser.add_argument("files", nargs="*", type=Path)
    options = parser.parse_args()
    if options.record and (options.no_cache or options.files):
        parser.error("--record writes what passed of everything: not with --no-cache or files")
    build = options.build.resolve()
    cache = None if options.no_cache else cache_folder()
    sources = commands(build)
    headers, alone = header_commands(sources, build)
    sources |= headers
    known = {file for command in sources.values() for file in command[2]}
    known |= {header for file in known if (header := file.with_suffix(".hpp")).exists()}
    if options.files:
        chosen = {path.resolve() for path in options.files}
        if strangers := chosen - known:
            names = ", ".join(os.path.relpath(path, ROOT) for path in sorted(strangers))
            print(f"tidy.py: no header, and no source that {build} builds: {names}", file=sys.stderr)
            return 2
        chosen |= {file.with_suffix(".cpp") for file in chosen - set(sources) - set(alone)}
        sources = {path: command for path, command in sources.items()
                   if chosen & {path, *command[2]}}
    version = subprocess.run([CLANG_TIDY, "--version"], capture_output=True, check=True).stdout
    settings = version + (ROOT / ".clang-tidy").read_bytes()
    findings, seen = 0, set()
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        jobs = [pool.submit(check, path, build, command, alone, settings, cache)
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
    if options.record:
        RECORD.write_text("".join(f"{key}\n" for key in sorted(PASSED)))
    files = sum(len(command[2]) for command in sources.values())
    print(f"clang-tidy: {files} files, {findings} with findings")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""Writes docs/sources.md: what the published works say, beside what our commands print.

    scripts/sources.py                     writes the page from docs/sources.toml
    scripts/sources.py --measure           runs all commands first, writes our figures into that file
    scripts/sources.py --measure NAME...   of these commands alone, and of what they need

The programs are those of build/release (`./amb manual` builds them), or of the folder LEVITAS_BINARIES.
"""

import argparse
import re
import sys
import tempfile
import textwrap

import sources_figures
import sources_rows
from sources_rows import DATA, PAGE

# What --measure replaces: a figure is the only thing that has this key.
OURS = re.compile(r"\bours = (\[[^\]]*\]|[^,}\s]+)")


def written(value):
    digits = f".{sources_figures.SIGNIFICANT}g"
    if isinstance(value, list):
        return f"[{', '.join(format(one, digits) for one in value)}]"
    return format(value, digits)


def measured(text, data, left, folder):
    """(the data file's text with our figures as they are now, what could not be taken)."""
    values, failed = [], []
    for row in sources_rows.rows(data):
        for figure in row.get("figures", []):
            values.append(None)
            if sources_figures.can_be_taken(row, left):
                try:
                    values[-1] = sources_figures.take(figure, left, folder)
                except ValueError as error:
                    failed.append(str(error))
    if len(values) != len(OURS.findall(text)):
        raise sources_rows.Refused("every figure needs a key 'ours', [] before it is measured")
    following = iter(values)

    def replaced(match):
        value = next(following)
        return match[0] if value is None else f"ours = {written(value)}"

    return OURS.sub(replaced, text), failed


def measure(names):
    """Runs the commands (all without a name) and writes what they give; returns what went wrong."""
    data = sources_rows.load()
    unknown = set(names) - {command["name"] for command in data["command"]}
    if unknown:
        return [f"no such command: {', '.join(sorted(unknown))}; --help lists them"]
    wanted = sources_rows.with_needed(names, data)
    with tempfile.TemporaryDirectory() as folder:
        left = sources_figures.run_all(
            data, folder, lambda command: not wanted or command["name"] in wanted,
            lambda text: print(" ", text, flush=True))
        text, failed = measured(DATA.read_text(encoding="utf-8"), data, left, folder)
    DATA.write_text(text, encoding="utf-8")
    return failed


def main(arguments):
    data = sources_rows.load()
    names = [command["name"] for command in data["command"]]
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog=textwrap.fill("commands: " + ", ".join(names), 100))
    parser.add_argument("--measure", nargs="*", metavar="NAME",
                        help="run these commands, or all of them, and write our figures")
    wanted = parser.parse_args(arguments).measure
    failed = [] if wanted is None else measure(wanted)
    data = sources_rows.load()
    try:
        PAGE.write_text(sources_rows.page(data), encoding="utf-8")
    except sources_rows.Refused as refused:
        failed += str(refused).splitlines()
    if failed:
        sys.exit("\n".join([f"{DATA}:", *failed]))
    print(sources_rows.counted(sources_rows.rows(data)))


if __name__ == "__main__":
    main(sys.argv[1:])

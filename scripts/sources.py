#!/usr/bin/env python3
"""Writes docs/sources.md: what the published works say, beside what our commands print.

    scripts/sources.py                      writes the page from docs/sources.toml
    scripts/sources.py --measure            runs every command first and writes our figures into that file
    scripts/sources.py --measure NAME...    of these commands alone, and of what they need

The programs are those of build/release, or of the folder LEVITAS_BINARIES.
"""

import re
import sys
import tempfile

import sources_figures
import sources_rows
from sources_rows import DATA, PAGE

# What --measure replaces: a figure is the only thing that has this key.
OURS = re.compile(r"\bours = (\[[^\]]*\]|[^,}\s]+)")


def written(value):
    return f"[{', '.join(f'{one:g}' for one in value)}]" if isinstance(value, list) else f"{value:g}"


def measured(text, data, left, folder):
    """The data file's text with our figures as the commands give them now."""
    values = []
    for row in sources_rows.rows(data):
        for figure in row.get("figures", []):
            fresh = sources_figures.can_be_taken(row, left)
            values.append(sources_figures.take(figure, left, folder) if fresh else None)
    if len(values) != len(OURS.findall(text)):
        raise sources_rows.Refused("every figure needs a key 'ours', [] before it is measured")
    following = iter(values)

    def replaced(match):
        value = next(following)
        return match[0] if value is None else f"ours = {written(value)}"

    return OURS.sub(replaced, text)


def with_needed(names, data):
    """The commands and all that must run before them."""
    before = {command["name"]: command.get("after", []) for command in data["command"]}
    found = set()
    while names:
        found |= set(names)
        names = [one for name in names for one in before[name] if one not in found]
    return found


def main(arguments):
    data = sources_rows.load()
    if arguments[:1] == ["--measure"]:
        unknown = set(arguments[1:]) - {command["name"] for command in data["command"]}
        if unknown:
            sys.exit(f"no such command in {DATA}: {', '.join(sorted(unknown))}")
        names = with_needed(arguments[1:], data)
        with tempfile.TemporaryDirectory() as folder:
            left = sources_figures.run_all(
                data, folder, lambda command: not names or command["name"] in names,
                lambda text: print(" ", text, flush=True))
            DATA.write_text(measured(DATA.read_text(encoding="utf-8"), data, left, folder),
                            encoding="utf-8")
        data = sources_rows.load()
    elif arguments:
        sys.exit(__doc__)
    try:
        PAGE.write_text(sources_rows.page(data), encoding="utf-8")
    except sources_rows.Refused as refused:
        sys.exit(f"{DATA.name}:\n{refused}")
    print(sources_rows.counted(sources_rows.rows(data)))


if __name__ == "__main__":
    main(sys.argv[1:])

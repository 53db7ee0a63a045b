"""Reads docs/sources.toml, refuses what it may not say, and writes the page docs/sources.md of it.

The file's head says what each key means. A row's state is computed, never typed: `not done` with a
reason; `differs` with a reason; else `reproduced`, which needs a figure of ours, and every figure
within what the source prints.
"""

import re
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
DATA = ROOT / "docs/sources.toml"
PAGE = ROOT / "docs/sources.md"
STATES = ("reproduced", "differs", "not done")
LIMITS = {"theirs": "", "at_most": "at most ", "at_least": "at least "}
HEAD = """# The published works, row by row

What each of the three works behind the shipped rigs says, the command that does the same here, our figure beside
theirs, and why they differ or why it is not done. Written by `scripts/sources.py` from `docs/sources.toml`; do not edit.
Figures of ours are what the commands print; the test `process.sources` runs them and compares. Those marked slow are
run by `process.sources_slow` where `LEVITAS_SLOW_SOURCES=1` asks for it, and named as not run otherwise.
`scripts/sources.py --measure` runs everything and writes file and page anew, in a few minutes.

- **reproduced**: done here, with a figure of ours, and as the source says wherever it prints something to compare with.
- **differs**: done here in another way or with another result, for the reason given.
- **not done**: the reason is given.

None of the works publishes its rig's numbers in full, so the rigs are the project's own, chosen to meet what is printed
([rigs.md](rigs.md)). Agreement shows that methods and statements carry over, not that a rig was copied.
"""


class Refused(Exception):
    """The data file says what it may not; the text lists everything."""


def load(path=DATA):
    return tomllib.loads(path.read_text(encoding="utf-8"))


def rows(data):
    return [row for work in data["work"] for row in work["row"]]


def slow_ones(data):
    """Names of the slow commands, and of those that read what they leave."""
    found = set()
    for command in data["command"]:
        if command.get("slow") or found & set(command.get("after", [])):
            found.add(command["name"])
    return found


def listed(value):
    return value if isinstance(value, list) else [value]


def agrees(figure):
    """Whether our figure is what the source prints; True where it prints nothing."""
    ours = listed(figure["ours"])
    if "theirs" in figure:
        theirs, share = listed(figure["theirs"]), figure.get("agrees", 0.01)
        return len(ours) == len(theirs) and all(
            abs(a - b) <= share * abs(b) for a, b in zip(ours, theirs))
    return (all(value <= figure.get("at_most", value) for value in ours) and
            all(value >= figure.get("at_least", value) for value in ours))


def state(row):
    if "not_done" in row:
        return "not done"
    return "differs" if "differs" in row else "reproduced"


def wrong_with(row, commands):
    """What the row may not say."""
    figures, told = row.get("figures", []), []
    if "not_done" in row:
        return ["'not done' beside figures"] if figures or "differs" in row else []
    if not figures:
        told.append("no figure of ours, and no reason in not_done")
    for name in row.get("commands", []):
        if name not in commands:
            told.append(f"no command is named {name}")
    for figure in figures:
        take = figure["take"]
        # By its name, or by a file that is named after it.
        if not any(re.search(rf"\b{name}", take) for name in row.get("commands", [])):
            told.append(f"'{take}' is taken from none of the row's commands")
        if figure.get("ours") in (None, []):
            told.append(f"'{take}' is not measured: scripts/sources.py --measure")
        elif not agrees(figure) and "differs" not in row:
            told.append(f"'{take}' is {figure['ours']}, not what the source prints: "
                        "say why in differs")
    return told


def check(data):
    """Raises Refused with everything that is wrong."""
    names = [command["name"] for command in data["command"]]
    told = [f"two commands are named {name}" for name in set(names) if names.count(name) > 1]
    used = {name for row in rows(data) for name in row.get("commands", [])}
    used |= {name for command in data["command"] for name in command.get("after", [])}
    told += [f"command {name} is used by no row" for name in names if name not in used]
    for row in rows(data):
        told += [f"{row['says'][:60]}: {fault}" for fault in wrong_with(row, names)]
    if told:
        raise Refused("\n".join(told))


def shown(figure, key, form):
    """A figure, or what the source prints for it, with its unit."""
    text = ", ".join(format(value, form).replace("-", "−") for value in listed(figure[key]))
    unit = figure.get("unit", "")
    return text + (unit if unit == "°" else f" {unit}" if unit else "")


def named(figure, text):
    return f"{figure['of']}: {text}" if "of" in figure else text


def shown_ours(row):
    return "; ".join(named(figure, shown(figure, "ours", figure.get("form", ".4g")))
                     for figure in row.get("figures", []))


def shown_theirs(row):
    """What the source prints: its own words where the row has them, else its numbers."""
    if "theirs" in row:
        return row["theirs"]
    found = [named(figure, words + shown(figure, key, "g")) for figure in row.get("figures", [])
             for key, words in LIMITS.items() if key in figure]
    return "; ".join(found) or "no figure"


def cell(text):
    return text.replace("|", "\\|").replace("\n", " ").strip()


def line(row, commands, slow):
    runs = "<br>".join(f"`{commands[name]['run']}`" + (" (slow)" if name in slow else "")
                       for name in row.get("commands", []))
    why = row.get("differs", row.get("not_done", row.get("note", "")))
    said = f"**{row['at']}** {row['says']}" if "at" in row else row["says"]
    judged = f"**{state(row)}**" + (f": {why}" if why else "")
    cells = (said, runs, shown_ours(row), shown_theirs(row), judged)
    return "| " + " | ".join(map(cell, cells)) + " |"


def counted(some):
    """'31 rows: 20 reproduced, 7 differs, 4 not done'."""
    counts = [f"{[state(row) for row in some].count(name)} {name}" for name in STATES]
    return f"{len(some)} rows: {', '.join(counts)}"


def with_needed(names, data):
    """The commands and all that must run before them."""
    before = {command["name"]: command.get("after", []) for command in data["command"]}
    found = set()
    while names:
        found |= set(names)
        names = [one for name in names for one in before[name] if one not in found]
    return found


def needed(row_list, data):
    """Commands that others of these rows need, in the file's order."""
    wanted = with_needed({name for row in row_list for name in row.get("commands", [])}, data)
    before = {name for command in data["command"] if command["name"] in wanted
              for name in command.get("after", [])}
    return [command for command in data["command"] if command["name"] in before]


def shown_file(file):
    if "replaced" in file:
        changes = "\n".join(
            f"```yaml\n{old}\n```\n\nbecomes\n\n```yaml\n{new}\n```\n" for old, new in file["replaced"]
        )
        return f"`{file['name']}` is `{file['copy_of']}`, where\n\n{changes}"
    after = f", after all of `{file['copy_of']}`" if "copy_of" in file else ""
    language = "yaml" if file["name"].endswith(".yaml") else ""
    return f"`{file['name']}`{after}:\n\n```{language}\n{file['text'].strip()}\n```\n"


def page(data):
    """The text of docs/sources.md."""
    check(data)
    commands, slow = {command["name"]: command for command in data["command"]}, slow_ones(data)
    parts = [HEAD, f"In all {counted(rows(data))}.\n"]
    for work in data["work"]:
        parts.append(f"## {work['name']}\n\n{work['title']}\n\n{counted(work['row'])}.\n")
        first = needed(work["row"], data)
        if first:
            runs = "\n".join(command["run"] for command in first)
            parts.append("Commands of this table read what these leave, in this order:\n\n"
                         f"```sh\n{runs}\n```\n")
        parts.append("| what it says | command | ours | theirs | state, and why |\n"
                     "|---|---|---|---|---|\n" +
                     "\n".join(line(row, commands, slow) for row in work["row"]) + "\n")
    if data.get("file"):
        parts.append("## Files that the commands read\n\n" + "\n".join(map(shown_file, data["file"])))
    return "\n".join(parts)

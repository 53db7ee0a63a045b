"""Runs the commands of docs/sources.toml and takes our figures from what they print."""

import json
import math
import os
import re
import shlex
import subprocess
from pathlib import Path

import sources_records
from sources_rows import ROOT, listed

LIMIT_S = 1800  # of a command that hangs
SIGNIFICANT = 8  # digits of a figure that are kept: more than any tolerance asks for


class Fields(dict):
    """An object of JSON whose members are reached by a dot."""

    def __getattr__(self, name):
        try:
            return self[name]
        except KeyError as error:
            raise AttributeError(name) from error


def run(command, folder):
    """What the command leaves: its JSON, its text as `printed`. Raises where it fails."""
    words = shlex.split(command["run"])
    if words[0] != "amb":
        raise ValueError(f"not a command of amb: {command['run']}")
    binaries = Path(os.environ.get("LEVITAS_BINARIES", ROOT / "build/release/bin"))
    out = Path(folder) / f"{command['name']}.json"
    more = ["--json", str(out)] if command.get("json", True) else []
    done = subprocess.run([str(binaries / "amb"), *words[1:], *more], cwd=folder, text=True,
                          capture_output=True, check=False, timeout=LIMIT_S,
                          env=os.environ | {"LEVITAS_CATALOGUE": ""})
    if done.returncode != command.get("status", 0):
        raise RuntimeError(f"{command['run']}: status {done.returncode}\n{done.stdout}{done.stderr}")
    left = json.loads(out.read_text(encoding="utf-8"), object_hook=Fields) if more else Fields()
    if isinstance(left, dict):
        left["printed"] = done.stdout
    return left


def text_of(file):
    """What the rows' file holds: a copy with its replacements made, then its own text."""
    before = (ROOT / file["copy_of"]).read_text(encoding="utf-8") if "copy_of" in file else ""
    for old, new in file.get("replaced", []):
        if old not in before:
            raise ValueError(f"{file['name']}: '{old}' is not in {file.get('copy_of')}")
        before = before.replace(old, new)
    return before + file.get("text", "")


def run_all(data, folder, wanted=lambda command: True, told=print):
    """name -> what it left, of every wanted command whose predecessors were run."""
    for file in data.get("file", []):
        (Path(folder) / file["name"]).write_text(text_of(file), encoding="utf-8")
    left = {}
    for command in data["command"]:
        if wanted(command) and all(name in left for name in command.get("after", [])):
            told(command["run"])
            left[command["name"]] = run(command, folder)
    return left


def first_number(text, pattern):
    """The number that the pattern's first group finds in a printed text."""
    found = re.search(pattern, text)
    if not found:
        raise ValueError(f"nothing in the text is like {pattern}")
    return float(found[1])


def rounded(value):
    return float(f"{value:.{SIGNIFICANT}g}")


def take(figure, left, folder):
    """Our figure: a number, or a list of them, from an expression over what the commands left.

    The expression is Python without its builtins; a command's name is its JSON.
    """
    records = {name: lambda path, *more, _do=do, **keys: _do(Path(folder) / path, *more, **keys)
               for name, do in sources_records.MEASURES.items()}
    known = {"max": max, "min": min, "abs": abs, "len": len, "sum": sum, "log10": math.log10,
             "degrees": math.degrees, "sqrt": math.sqrt, "number": first_number, "zip": zip,
             "sorted": sorted, "range": range, "polynomial": sources_records.polynomial,
             "least_gain_hz": sources_records.least_gain_hz, "__builtins__": {}} | records
    try:
        value = eval(figure["take"], known | left)
    except Exception as error:  # whatever an expression may raise
        raise ValueError(f"{figure['take']}: {error!r}") from error
    return [rounded(one) for one in value] if isinstance(value, (list, tuple)) else rounded(value)


def can_be_taken(row, left):
    return all(name in left for name in row["commands"])


def tolerance(figure, row, data):
    """Relative; the widest of the row's commands unless the figure has its own."""
    kinds = {command["name"]: command.get("kind", "computed") for command in data["command"]}
    return figure.get("tolerance", max(data["tolerances"][kinds[name]] for name in row["commands"]))


def differences(row, left, data, folder):
    """What no longer is as the file has it, a line each."""
    told = []
    for figure in row.get("figures", []):
        now, then = listed(take(figure, left, folder)), listed(figure["ours"])
        share = tolerance(figure, row, data)
        if len(now) != len(then) or any(abs(a - b) > share * abs(b) for a, b in zip(now, then)):
            told.append(f"{row['says'][:60]}: {figure['take']} is {now}, in the file {then}, "
                        f"allowed {100 * share:g} %")
    return told

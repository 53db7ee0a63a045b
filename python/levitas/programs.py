"""The program `amb` as functions: options by keyword, its JSON as the result."""

import json
import os
import shutil
import subprocess
from pathlib import Path

NOT_MET = 5  # exit status of --require: an answer, not a failure


class Failed(RuntimeError):
    """A command that ended with another status than 0; .status, and what it said in .stderr."""

    def __init__(self, words, status, stderr):
        super().__init__(f"{' '.join(words)}: exit status {status}: {stderr.strip()}")
        self.status, self.stderr = status, stderr


def program():
    """$LEVITAS_AMB, else `amb` on the path, else that of the clone that this file lies in."""
    built = Path(__file__).resolve().parents[2] / "build/release/bin/amb"
    found = os.environ.get("LEVITAS_AMB") or shutil.which("amb") or (str(built) if built.exists() else None)
    if not found:
        raise FileNotFoundError("no program `amb`: install the package, or name it in LEVITAS_AMB")
    return found


def _options(options):
    """max_speed_rpm=3000 is --max-speed-rpm 3000; True a flag; a list its values one after another."""
    for name, value in options.items():
        if value is None or value is False:
            continue
        yield "--" + name.rstrip("_").replace("_", "-")
        if value is not True:
            yield from (str(one) for one in (value if isinstance(value, (list, tuple)) else [value]))


def amb(*command, check=True, **options):
    """`amb COMMAND... --json -`, its JSON; Failed for another status than 0, unless check=False.

        amb("design", "pid", rig="flexible_rotor", tilt=True, out="law.yaml")
    """
    words = [program(), *(str(word) for word in command), *_options(options), "--json", "-"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode != 0 and (check or not done.stdout.strip()):
        raise Failed(words[1:], done.returncode, done.stderr)
    result = json.loads(done.stdout)
    if not check:
        result["exit_status"] = done.returncode
    return result


def run(check=True, **options):
    """A run with the simulated or the real rig, and its verdict: run(rig=..., scenario=..., record=...)."""
    return amb("run", check=check, no_dash=True, **options)


def margins(**options):
    return amb("margins", **options)


def poles(**options):
    return amb("poles", **options)


def identify(kind, *records, **options):
    """identify("modal", "campaign.lcm", out="identified.yaml"); kinds: amb identify --help."""
    return amb("identify", kind, *records, **options)


def diagnose(*records, **options):
    """diagnose("id.lcm", rig="flexible_rotor", quick=True)"""
    return amb("diagnose", *records, **options)

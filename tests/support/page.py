"""A page of docs/ as what it promises: its commands, run one after the other in one folder, and
what it says they print.

A block ```sh holds commands; a block ``` without a language right behind it is what they print, in
its order, perhaps shortened: "..." in a line stands for any text, a line "..." for any lines. Blocks
of other languages are for the reader alone.
"""

import os
import re
import subprocess

from waiting import LIMIT_S


def steps(text):
    """[(commands, printed lines)] of a page; the lines are empty where the page shows none."""
    found = []
    behind = False  # the last block held commands
    for language, block in re.findall(r"^```(\w*)\n(.*?)^```$", text, re.S | re.M):
        if language == "sh":
            found.append((block, []))
        elif language == "" and behind:
            found[-1] = (found[-1][0], block.splitlines())
        behind = language == "sh"
    return found


def pattern(line):
    """A printed line as a regular expression: blanks by their order, "..." any text."""
    parts = [r"\s+".join(map(re.escape, part.split())) for part in line.strip().split("...")]
    return r"\s*.*?\s*".join(parts)


def missing(lines, printed):
    """The first line of the page that the command did not print in its turn; None: all are there."""
    told = printed.splitlines()
    at = 0
    for line in lines:
        if line.strip() in ("", "..."):
            continue
        wanted = re.compile(pattern(line) + r"\s*$")
        for place in range(at, len(told)):
            if wanted.match(told[place].strip()):
                at = place + 1
                break
        else:
            return line
    return None


def run(commands, folder, binaries):
    """What the commands print, both streams; the shell stops at the first that fails."""
    environment = dict(os.environ, PATH=f"{binaries}:{os.environ['PATH']}", HOME=str(folder))
    done = subprocess.run(["bash", "-euo", "pipefail", "-c", commands.replace("./amb ", "amb ")],
                          cwd=folder, env=environment, text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, timeout=LIMIT_S, check=False)
    return done.returncode, done.stdout

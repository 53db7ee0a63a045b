"""Waiting for what a process says or does, with one limit for all tests.

No test may depend on how busy the machine is: it waits for what it is about to judge, and only a
failing test waits for LIMIT_S. tests/build/waiting refuses what goes round this file.
"""

import os
import re
import time
from pathlib import Path

# Far above any delay of a busy machine [s], but so short that a run of all tests still hears from the
# one that hangs. Under a sanitizer everything takes several times as long.
LIMIT_S = min(600 * int(os.environ.get("LEVITAS_SLOWER", "1")), 1200)
# Between two looks [s].
PAUSE_S = 0.02


def until(condition, awaited, said=lambda: "", running=lambda: True, limit_s=LIMIT_S):
    """The first true value of condition().

    Fails when LIMIT_S is over, or when what it waits for has ended without it: names what was
    awaited and shows everything that said() returns.
    """
    end = time.monotonic() + limit_s
    while True:
        went_on = running()  # asked first: what was done before the end is not overlooked
        if value := condition():
            return value
        if not went_on:
            raise AssertionError(f"ended without it: {awaited}\n{said()}")
        if time.monotonic() > end:
            raise AssertionError(f"not within {limit_s} s: {awaited}\n{said()}")
        time.sleep(PAUSE_S)


def pause(seconds, reason):
    """Lets time pass on purpose: the reason says why a machine that makes it longer changes nothing."""
    assert reason
    time.sleep(seconds)


def until_file(path, holds="", limit_s=LIMIT_S):
    """The text of a file once it is there and holds the words."""
    path = Path(path)
    text = [""]

    def there():
        if not path.exists():
            return False
        text[0] = path.read_text(encoding="utf-8", errors="replace")
        return holds in text[0]

    until(there, f"{holds!r} in {path}", lambda: text[0], limit_s=limit_s)
    return text[0]


def found(words, text):
    """The text up to the end of the words, or of what the pattern matches; None without them."""
    if isinstance(words, re.Pattern):
        match = words.search(text)
        return text[:match.end()] if match else None
    at = text.find(words)
    return text[:at + len(words)] if at >= 0 else None


def ended(child, said=lambda: "", limit_s=LIMIT_S):
    """Exit status of a child of subprocess."""
    until(lambda: child.poll() is not None, f"the end of {child.args}", said, limit_s=limit_s)
    return child.returncode

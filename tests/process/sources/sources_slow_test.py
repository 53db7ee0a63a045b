"""The slow commands of docs/sources.toml; run where LEVITAS_SLOW_SOURCES=1 asks for them."""

import os
import sys

from commands_of_rows import SLOW, CommandsOfRows, needed_by
from lcm_network import SKIPPED, run


class SlowCommands(CommandsOfRows):
    names = needed_by(SLOW)
    judged = SLOW


del CommandsOfRows  # it has no commands of its own

if __name__ == "__main__":
    if not os.environ.get("LEVITAS_SLOW_SOURCES"):
        print(f"not run: {len(SLOW)} slow commands of docs/sources.toml; LEVITAS_SLOW_SOURCES=1 runs them")
        sys.exit(SKIPPED)
    run()

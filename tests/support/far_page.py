"""amb dash on the other machine, with a clock of the day of its own; and a program with such a clock."""

import json
import re
import shutil
import struct
import subprocess
import sys
from pathlib import Path

from lcm_network import BINARIES, Process, preloaded
from waiting import LIMIT_S

POST = """
import sys, urllib.error, urllib.request
request = urllib.request.Request(sys.argv[1], data=sys.argv[2].encode(),
                                 headers={"X-Levitas": "1"})
try:
    print(urllib.request.urlopen(request, timeout=float(sys.argv[3])).read().decode())
except urllib.error.HTTPError as refused:
    print(refused.read().decode())
"""


class Clock:
    """How far the clock of the day of a program is ahead [s]; give `environment` to its start."""

    def __init__(self, path, ahead_s=0):
        self.path = Path(path)
        self.path.write_bytes(bytes(8))
        self.set(ahead_s)
        self.environment = {"LEVITAS_CLOCK_FILE": str(self.path.resolve()),
                            **preloaded("shifted_clock.so")}

    def set(self, ahead_s):
        with self.path.open("r+b") as file:
            file.write(struct.pack("=q", round(ahead_s * 1e9)))


class FarPage:
    """The live page on the machine `other`; its commands come from there too."""

    def __init__(self, other, folder, *arguments, clock=None):
        self.other = other
        environment = [f"{name}={value}" for name, value in (clock.environment if clock else {}).items()]
        self.process = Process(folder, shutil.which("nsenter"), "-n", f"-t{other.holder.pid}", "env",
                               *environment, (BINARIES / "amb").resolve(), "dash",
                               "--answer-within", 50, *arguments)
        self.url = re.search(r"page: (\S+)", self.process.says("with the same --port"))[1]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()

    def command(self, name, **more):
        """What became of it: accepted, refused, unanswered."""
        done = subprocess.run(
            self.other.command(sys.executable, "-c", POST, self.url + "api/command",
                               json.dumps({"command": name, **more}), LIMIT_S),
            check=True, capture_output=True, text=True, timeout=LIMIT_S)
        return json.loads(done.stdout)["outcome"]

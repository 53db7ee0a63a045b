"""A private LCM network for tests that start processes, and a plain client of it.

A test calls `run()` instead of unittest.main(): it starts itself again in a network namespace of its
own, with loopback up and a route for multicast, so that tests disturb neither each other nor the
machine. Status 77 (skipped, with the reason) when the machine allows no namespaces.
"""

import os
import signal
import socket
import struct
import subprocess
import sys
import time
import unittest
from pathlib import Path

import waiting

BINARIES = Path(os.environ.get("LEVITAS_BINARIES", "build/release/bin"))
BUILD = Path(os.environ.get("LEVITAS_BUILD", BINARIES.parent))
GROUP = "239.255.76.67"
SENSOR, CURRENT, TELEMETRY, COMMAND = 7667, 7668, 7669, 7670
LOOPBACK = socket.inet_aton("127.0.0.1")  # where the programs meet with ttl 0
SKIPPED = 77
UNSHARE = ["unshare", "-n" if os.geteuid() == 0 else "-rn"]
SET_UP = "ip link set lo up && ip route add 224.0.0.0/4 dev lo && exec \"$@\""

sys.path.insert(0, str(BUILD / "lcmtypes/python"))


def run():
    """Runs the unittest of the calling script inside a namespace."""
    if os.environ.get("LEVITAS_TEST_NAMESPACE"):
        unittest.main()
    probe = subprocess.run([*UNSHARE, "sh", "-c", SET_UP, "sh", "true"], capture_output=True,
                           text=True, check=False)
    if probe.returncode != 0:
        print(f"not run: no network namespace here: {probe.stderr.strip()}")
        sys.exit(SKIPPED)
    os.environ["LEVITAS_TEST_NAMESPACE"] = "1"
    os.execvp("unshare", [*UNSHARE, "sh", "-c", SET_UP, "sh", sys.executable, "-B", *sys.argv])


def enter_namespace():
    """Starts the calling script, a bench, again inside a namespace; without one it fails."""
    if os.environ.get("LEVITAS_BENCH_NAMESPACE"):
        return
    os.environ["LEVITAS_BENCH_NAMESPACE"] = "1"
    os.execvp("unshare", [*UNSHARE, "sh", "-c", SET_UP, "sh", sys.executable, *sys.argv])


def preloaded(library):
    """The environment that loads one of tests/support/CMakeLists.txt into a program before all else."""
    path = (BUILD / "tests/support" / library).resolve()
    if not path.exists():
        raise FileNotFoundError(f"{path} is not built: the loader would only warn and go on without it")
    # The sanitizer wants to be loaded first; nothing of it is replaced by these.
    options = filter(None, (os.environ.get("ASAN_OPTIONS"), "verify_asan_link_order=0"))
    return {"LD_PRELOAD": str(path), "ASAN_OPTIONS": ":".join(options)}


def short_message(channel, payload, sequence=0):
    return b"LC02" + struct.pack(">I", sequence) + channel.encode() + b"\0" + payload


def listens(port):
    """Whether a program listens to a UDP port of this network."""
    table = Path("/proc/net/udp").read_text(encoding="utf-8").splitlines()[1:]
    return any(line.split()[1].endswith(f":{port:04X}") for line in table)


class Bus:
    """Sends to one port of the group and listens to it."""

    def __init__(self, port):
        self.port = port
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4 << 20)
        self.socket.bind((GROUP, port))
        self.socket.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP,
                               socket.inet_aton(GROUP) + LOOPBACK)
        self.socket.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, LOOPBACK)
        self.sequence = 0

    def close(self):
        self.socket.close()

    def send(self, data):
        self.socket.sendto(data, (GROUP, self.port))

    def publish(self, channel, message):
        self.send(short_message(channel, message.encode(), self.sequence))
        self.sequence += 1

    def messages(self, seconds=waiting.LIMIT_S):
        """(channel, payload) of every short message until the time is over."""
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0:
            self.socket.settimeout(left)
            try:
                data = self.socket.recv(65536)
            except TimeoutError:
                return
            if data[:4] == b"LC02":
                channel, _, payload = data[8:].partition(b"\0")
                yield channel.decode(), payload


class Process:
    """A program of ours with its output in a file; ended when the test ends.

    `output` takes its standard output and error instead of the file. What it says arrives when it
    arrives: says() waits for it, and `text` is for a process that has ended.
    """

    def __init__(self, folder, name, *arguments, output=None, **options):
        self.name = Path(name).name
        self.log = Path(folder) / f"{self.name}-{time.monotonic_ns()}.log"
        with self.log.open("wb") as log:
            options = {"stdout": log, "stderr": log, "cwd": folder, **options}
            if output is not None:
                options["stdout"] = options["stderr"] = output
            self.child = subprocess.Popen([str(BINARIES / name), *map(str, arguments)], **options)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.kill()

    @property
    def text(self):
        """Everything that it said; it must have ended, else more may be on its way."""
        if self.child.poll() is None:
            raise AssertionError(f"{self.name} still runs: wait for its words with says(), or for "
                                 "its end with status(), before you read what it said")
        return self.said_so_far

    @property
    def said_so_far(self):
        """For messages of failures only: what it says may be on its way."""
        return self.log.read_text(encoding="utf-8", errors="replace")

    def status(self, limit_s=waiting.LIMIT_S):
        return waiting.ended(self.child, lambda: self.said_so_far, limit_s)

    def says(self, words, limit_s=waiting.LIMIT_S):
        """Everything said until the words (or a compiled pattern), which are waited for."""
        return waiting.until(lambda: waiting.found(words, self.said_so_far),
                             f"{self.name} says {words!r}", lambda: self.said_so_far,
                             lambda: self.child.poll() is None, limit_s)

    def send_signal(self, number):
        self.child.send_signal(number)

    def terminate(self):
        self.send_signal(signal.SIGTERM)

    def kill(self):
        if self.child.poll() is None:
            self.child.kill()
        self.child.wait()


def plant(folder, *arguments, **options):
    return Process(folder, "amb-plant", "--rig", "flexible_rotor", *arguments, **options)


def controller(folder, *arguments, **options):
    return Process(folder, "amb-controller", "--rig", "flexible_rotor", "--controller",
                   "flexible_rotor", "--trip-folder", folder, *arguments, **options)


def log_events(path):
    """(channel, data) of every event of an LCM log (format: sync, number, time, lengths)."""
    data = Path(path).read_bytes()
    at = 0
    while at + 28 <= len(data):
        sync, _, _, channel_length, data_length = struct.unpack_from(">IqqII", data, at)
        assert sync == 0xEDA1DA01, f"no event at byte {at} of {path}"
        at += 28
        yield (data[at:at + channel_length].decode(),
               data[at + channel_length:at + channel_length + data_length])
        at += channel_length + data_length

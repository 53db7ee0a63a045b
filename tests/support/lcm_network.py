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


def short_message(channel, payload, sequence=0):
    return b"LC02" + struct.pack(">I", sequence) + channel.encode() + b"\0" + payload


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

    def messages(self, seconds):
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
    """A program of ours with its output in a file; ended when the test ends."""

    def __init__(self, folder, name, *arguments):
        self.log = Path(folder) / f"{name}-{time.monotonic_ns()}.log"
        with self.log.open("w", encoding="utf-8") as out:
            self.child = subprocess.Popen([str(BINARIES / name), *map(str, arguments)], stdout=out,
                                          stderr=subprocess.STDOUT, cwd=folder)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.kill()

    @property
    def text(self):
        return self.log.read_text(encoding="utf-8")

    def status(self, timeout=60):
        try:
            return self.child.wait(timeout)
        except subprocess.TimeoutExpired as late:
            raise AssertionError(f"did not end within {timeout} s:\n{self.text}") from late

    def says(self, words, timeout=30):
        """Waits until the output holds the words; a time-out is a failure that shows the output."""
        end = time.monotonic() + timeout
        while words not in self.text:
            if time.monotonic() > end or (self.child.poll() is not None and words not in self.text):
                raise AssertionError(f"never said {words!r}:\n{self.text}")
            time.sleep(0.02)

    def terminate(self):
        self.child.send_signal(signal.SIGTERM)

    def kill(self):
        if self.child.poll() is None:
            self.child.kill()
            self.child.wait()


def plant(folder, *arguments):
    return Process(folder, "amb-plant", "--rig", "flexible_rotor", *arguments)


def controller(folder, *arguments):
    return Process(folder, "amb-controller", "--rig", "flexible_rotor", "--controller",
                   "flexible_rotor", "--trip-folder", folder, *arguments)


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

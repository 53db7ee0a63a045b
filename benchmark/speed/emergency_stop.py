#!/usr/bin/env python3
"""How long the operator's emergency stop takes, whatever else is asked of the controller.

    benchmark/speed/emergency_stop.py [--stops N] [--only NAME ...] [--json FILE]        full proof: --stops 1000

Rig and controller at 10 kHz in real time. Under each load N stops, each said once, answered under its
number, and reset before the next; one that is not answered within a second is said again and counted.
  to trip   datagram received by the controller to the current of the trip written, as its report has
            it: the histogram's edges are 4 % apart.
  wake-up   error of the loop's own wake-ups in the same run: what this machine does to anybody.
  answered  said to answered, as the one who asks sees it: here the wait for telemetry is in.
Loads: nothing; test signals (20 requests before each stop, half as large as is taken, half larger);
a flood of 60 000 commands a second; standard error that nobody reads; and through the page, 40 sockets
that send a byte now and then, and 16 viewers. Runs in a network namespace of its own; needs root or
rtprio.
"""

import argparse
import contextlib
import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import urllib.error
import urllib.request
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
os.environ.setdefault("LEVITAS_BINARIES", str(ROOT / "build/release/bin"))
os.environ.setdefault("LEVITAS_BUILD", str(ROOT / "build/release"))
sys.path.insert(0, str(ROOT / "tests/support"))
from lcm_network import BINARIES, enter_namespace  # noqa: E402
from operator_desk import LAND, Desk, command, sender  # noqa: E402

FLOOD_PER_S, VIEWERS, SLOW_SOCKETS = 60_000, 16, 40


class Page:
    """amb dash, and the stop as its button gives it."""

    def __init__(self, folder, stack):
        self.log = Path(folder) / "dash.log"
        with self.log.open("w", encoding="utf-8") as out:
            self.child = subprocess.Popen([str(BINARIES / "amb"), "dash"], stdout=out,
                                          stderr=subprocess.STDOUT)
        stack.callback(end, self.child)
        self.url = self.address().rstrip("/")

    def address(self):
        for _ in range(600):
            if "page: " in (text := self.log.read_text(encoding="utf-8")):
                return text.split("page: ")[1].split()[0]
            time.sleep(0.05)
        sys.exit("amb dash did not start")

    def stop(self):
        asked = urllib.request.Request(self.url + "/api/command", b'{"command":"emergency_stop"}',
                                       {"X-Levitas": "1", "Content-Type": "application/json"})
        try:
            with urllib.request.urlopen(asked, timeout=60) as answer:
                return answer.status == 200
        except urllib.error.HTTPError:
            return False


def end(child):
    child.terminate()
    with contextlib.suppress(subprocess.TimeoutExpired):
        child.wait(20)
    if child.poll() is None:
        child.kill()
        child.wait()


def flood():
    """FLOOD_PER_S commands, in bursts of a millisecond; runs in a process of its own."""
    out = sender()
    first = time.monotonic()
    sent = 0
    while True:
        while sent < (time.monotonic() - first) * FLOOD_PER_S:
            sent += 1
            out.send(command(sent, LAND))
        time.sleep(0.001)


def flooded(_, stack):
    child = subprocess.Popen([sys.executable, __file__, "--flood"])
    stack.callback(end, child)
    return None


def with_test_signals(desk, _):
    def before():
        for i in range(20):
            desk.request(1 if i % 2 else 8)
    return before


def slow_sockets(page, stack):
    host, port = page.url.split("//")[1].split(":")
    head = b"POST /api/command HTTP/1.1\r\nHost: localhost\r\nContent-Length: 60000\r\n\r\n"
    ending = threading.Event()

    def trickle():
        while not ending.is_set():
            try:
                with socket.create_connection((host, int(port)), timeout=10) as slow:
                    slow.sendall(head)
                    while not ending.wait(2):
                        slow.sendall(b"a")
            except OSError:
                ending.wait(0.5)

    stack.callback(ending.set)
    for _ in range(SLOW_SOCKETS):
        threading.Thread(target=trickle, daemon=True).start()
    time.sleep(1)


def viewers(page, stack):
    def watch(stream):
        with contextlib.suppress(OSError, ValueError, AttributeError):
            while stream.read1(65536):
                pass

    for _ in range(VIEWERS):
        stream = stack.enter_context(urllib.request.urlopen(page.url + "/events", timeout=30))
        threading.Thread(target=watch, args=(stream,), daemon=True).start()


# name: (through the page, what makes the load, standard error is read)
LOADS = {"nothing": (False, None, True),
         "test signals": (False, with_test_signals, True),
         "flood": (False, flooded, True),
         "stalled log": (False, with_test_signals, False),
         "slow sockets": (True, slow_sockets, True),
         "viewers": (True, viewers, True)}


def measure(name, stops):
    through_page, load, read = LOADS[name]
    with tempfile.TemporaryDirectory() as folder, contextlib.ExitStack() as stack:
        common = ["--rig", "flexible_rotor", "--pace", "realtime"]
        desk = Desk()
        asker = Page(folder, stack) if through_page else desk
        rig = subprocess.Popen([str(BINARIES / "amb-plant"), *common], stderr=subprocess.DEVNULL)
        stack.callback(end, rig)
        read_end, write_end = os.pipe()
        stack.callback(os.close, read_end)
        report = Path(folder) / "report.json"
        control = subprocess.Popen([str(BINARIES / "amb-controller"), *common, "--controller",
                                    "flexible_rotor_commissioned", "--trip-folder", folder,
                                    "--json", str(report)],
                                   stderr=subprocess.DEVNULL if read else write_end)
        stack.callback(end, control)
        os.close(write_end)
        time.sleep(2)
        before = load(asker, stack) if load else None
        seconds, unanswered = [], 0
        for _ in range(stops):
            if before:
                before()
            begin = time.monotonic()
            while not asker.stop():
                unanswered += 1
            seconds.append(time.monotonic() - begin)
            desk.reset()
        control.send_signal(signal.SIGTERM)
        control.wait(60)
        told = json.loads(report.read_text(encoding="utf-8"))
    seconds.sort()
    return {"stops": stops, "said_again": unanswered, "trips": told["trips"],
            "to_trip": told["emergency_stop"], "wakeup": told["timing"]["wakeup"],
            "answered_p50_s": seconds[len(seconds) // 2],
            "answered_p99_s": seconds[min(len(seconds) - 1, int(0.99 * len(seconds)))],
            "answered_max_s": seconds[-1]}


def line(name, row):
    def three(times):
        return " / ".join(f"{times[key] / 1e3:.0f}" for key in ("p50_ns", "p99_ns", "max_ns"))

    print(f"{name:13} {row['stops']:6} {row['trips']:6} {row['said_again']:6}  "
          f"{three(row['to_trip']):>22}  {three(row['wakeup']):>22}  "
          f"{row['answered_p50_s'] * 1e3:7.1f} / {row['answered_p99_s'] * 1e3:.1f} / "
          f"{row['answered_max_s'] * 1e3:.1f}", flush=True)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--stops", type=int, default=100, help="under each load")
    arguments.add_argument("--only", nargs="+", choices=tuple(LOADS), default=tuple(LOADS))
    arguments.add_argument("--json", help="write the figures to this file")
    arguments.add_argument("--flood", action="store_true", help=argparse.SUPPRESS)
    options = arguments.parse_args()
    if options.flood:
        flood()
    enter_namespace()
    print(f"{'load':13} {'stops':>6} {'trips':>6} {'again':>6}  {'to trip p50/p99/max us':>22}  "
          f"{'wake-up p50/p99/max us':>22}  answered p50/p99/max ms", flush=True)
    figures = {}
    for name in options.only:
        figures[name] = measure(name, options.stops)
        line(name, figures[name])
    if options.json:
        Path(options.json).write_text(json.dumps(figures, indent=2), encoding="utf-8")


if __name__ == "__main__":
    main()

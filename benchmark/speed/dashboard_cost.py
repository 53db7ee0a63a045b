#!/usr/bin/env python3
"""What the live page costs: latency from cycle to page, processor time, the controller's timing.

    benchmark/speed/dashboard_cost.py [--what timing drawing] [--runs N] [--seconds S] [--json FILE]

Each run is amb-plant and amb-controller at 10 kHz in real time with amb dash beside them.
  timing   windows without and with three viewers in alternation within a run; the ratio of each
           percentile with viewers to the one of the window before, median over all pairs. Viewers
           read the page's stream as a browser does and draw nothing: theirs are other machines.
  share    of one processor, of all threads of amb dash, in the same windows.
  cycle to sent, to viewer   sampling instant of the newest cycle to the making of the message, and
           to its arrival at a viewer, in the same windows.
  viewer to screen  arrival to the end of the drawing that shows it, in a headless Chromium before a
           run in lockstep: beside two real-time loops two processors have no time to draw. Not
           measured where there is no Chromium.
Runs in a network namespace of its own; needs root or rtprio.
"""

import argparse
import contextlib
import json
import os
import re
import statistics
import sys
import tempfile
import threading
import time
import urllib.request
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
os.environ.setdefault("LEVITAS_BINARIES", str(ROOT / "build/release/bin"))
os.environ.setdefault("LEVITAS_BUILD", str(ROOT / "build/release"))
sys.path.insert(0, str(ROOT / "tests/support"))
from chromium import Browser, find  # noqa: E402
from dashboard_rig import Rig  # noqa: E402
from lcm_network import TELEMETRY, Bus, Process, enter_namespace  # noqa: E402

VIEWERS = 3
WINDOW_S = 3.0
ROWS = ("wakeup", "compute", "latency")
PERCENTILES = (0.5, 0.99)
STAMPS = re.compile(rb'"sample_ns":(\d+),"sent_ns":(\d+)')
WATCH = """(() => { window.drawn = []; new MutationObserver(() => window.drawn.push(
    [performance.timeOrigin + performance.now(), Number(document.documentElement.dataset.drawn)]))
    .observe(document.documentElement, {attributes: true, attributeFilter: ['data-drawn']}); })()"""


class Trio:
    """The page, then rig and controller at 10 kHz in real time; for a with statement."""

    def __init__(self, folder):
        # The page first: beside two real-time loops a busy machine starts nothing in good time.
        self.folder = folder
        self.dash = Process(folder, "amb", "dash")
        self.url = self.dash.says(re.compile(r"page: \S+(?=\s)")).rsplit("page: ", 1)[1]
        self.parts = [self.dash]

    def start(self, seconds):
        common = ("--rig", "flexible_rotor", "--pace", "realtime")
        self.parts.append(Process(self.folder, "amb-plant", *common))
        self.parts.append(Process(self.folder, "amb-controller", *common, "--controller",
                                  "flexible_rotor_commissioned", "--duration", seconds,
                                  "--trip-folder", self.folder))
        self.parts[2].says("rig found")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for part in reversed(self.parts):
            part.kill()

    def processor_s(self):
        """User and system time of amb dash so far."""
        fields = Path(f"/proc/{self.dash.child.pid}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Histograms(threading.Thread):
    """The controller's histograms since its start, as they are told about once a second."""

    def __init__(self):
        super().__init__(daemon=True)
        self.heard = []
        self.bus = Bus(TELEMETRY)
        self.start()

    def run(self):
        from levitas_msg.loop_histogram_t import loop_histogram_t

        for channel, payload in self.bus.messages(3600):
            if channel == "LEVITAS_HISTOGRAM":
                self.heard.append((time.monotonic(), loop_histogram_t.decode(payload)))

    def between(self, begin, end):
        """Percentiles [ns] of what was counted in that time; None where too little was."""
        inside = [histogram for heard, histogram in self.heard if begin <= heard <= end]
        if len(inside) < 2:
            return None
        return {(row, part): percentile(inside[0], inside[-1], row, part)
                for row in ROWS for part in PERCENTILES}


def percentile(first, last, row, part):
    before = list(getattr(first, row)) + [0] * last.bins
    counts = [after - before[i] for i, after in enumerate(getattr(last, row))]
    wanted, seen, low = part * sum(counts), 0, 0
    for edge, count in zip(last.edge_ns, counts):
        if count and seen + count >= wanted:
            return low + (edge - low) * (wanted - seen) / count  # evenly spread within a bin
        seen, low = seen + count, edge
    return float(low)


def read(stream, late_ms):
    """Takes the stream; notes how old each tick's newest cycle is when sent and on arrival."""
    try:
        for line in stream:
            # Only that is looked at: three viewers in one interpreter wait for each other.
            if found := STAMPS.search(line):
                sample_ns, sent_ns = map(int, found.groups())
                late_ms.append(((sent_ns - sample_ns) / 1e6,
                                (time.monotonic_ns() - sample_ns) / 1e6))
    except (OSError, ValueError, AttributeError):
        pass  # closed at the end of the window


def window(trio, histograms, viewers, late_ms):
    """(percentiles, share of a processor) of one window."""
    streams = [urllib.request.urlopen(trio.url + "events", timeout=30) for _ in range(viewers)]
    for stream in streams:
        threading.Thread(target=read, args=(stream, late_ms), daemon=True).start()
    begin, used = time.monotonic(), trio.processor_s()
    time.sleep(WINDOW_S)
    end = time.monotonic()
    share = (trio.processor_s() - used) / (end - begin)
    for stream in streams:
        stream.close()
    return histograms.between(begin, end), share


def timing_run(seconds):
    """[(without, with)] of the pairs of windows in one run, the shares of both, and latencies."""
    pairs, shares, late_ms = [], {0: [], VIEWERS: []}, []
    histograms = Histograms()
    with tempfile.TemporaryDirectory() as folder, Trio(folder) as trio:
        trio.start(seconds)
        time.sleep(1)
        for _ in range(int((seconds - 2) / (2 * WINDOW_S))):
            without, idle = window(trio, histograms, 0, late_ms)
            beside, busy = window(trio, histograms, VIEWERS, late_ms)
            shares[0].append(idle)
            shares[VIEWERS].append(busy)
            if without and beside:
                pairs.append((without, beside))
    return pairs, shares, late_ms


def offset_ms(page):
    """The page's clock minus CLOCK_MONOTONIC, from the quickest of many questions."""
    best = None
    for _ in range(30):
        asked = time.monotonic_ns()
        there = page.value("performance.timeOrigin + performance.now()")
        answered = time.monotonic_ns()
        if best is None or answered - asked < best[0]:
            best = (answered - asked, there - (asked + answered) / 2e6)
    return best[1]


class Keeper:
    """What dashboard_rig.Rig asks of a test: to clean up at the end."""

    def __init__(self):
        self.stack = contextlib.ExitStack()
        self.addCleanup = self.stack.callback


def drawing_run(browser, seconds):
    """[ms] sent by amb dash to drawn, of every drawing."""
    keeper = Keeper()
    with keeper.stack:
        rig = Rig(keeper)
        page = browser.open(rig.url)
        page.until("document.documentElement.dataset.drawn")
        offset = offset_ms(page)
        page.value(WATCH)
        time.sleep(seconds)
        drawn = page.value("window.drawn")
        page.close()
    return [there - offset - sent_ns / 1e6 for there, sent_ns in drawn]


def quantile(values, part):
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, int(part * len(ordered)))]


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--runs", type=int, default=4)
    arguments.add_argument("--seconds", type=float, default=20.0, help="of one run")
    arguments.add_argument("--what", nargs="+", choices=("timing", "drawing"),
                           default=("timing", "drawing"))
    arguments.add_argument("--json", help="write the figures to this file")
    options = arguments.parse_args()
    enter_namespace()
    figures = {}
    if "timing" in options.what:
        measure_timing(options, figures)
    if "drawing" in options.what:
        measure_drawing(options, figures)
    if options.json:
        Path(options.json).write_text(json.dumps(figures, indent=2), encoding="utf-8")


def measure_timing(options, figures):
    pairs, shares, late_ms = [], {0: [], VIEWERS: []}, []
    for _ in range(options.runs):
        more, used, late = timing_run(options.seconds)
        pairs += more
        late_ms += late
        for viewers, values in used.items():
            shares[viewers] += values
    if not pairs:
        sys.exit("nothing measured: the machine left the controller's telemetry no time")
    for row in ROWS:
        for part in PERCENTILES:
            without = statistics.median(pair[0][row, part] for pair in pairs)
            ratios = [pair[1][row, part] / pair[0][row, part] for pair in pairs
                      if pair[0][row, part] > 0]
            figures[f"{row}_p{part * 100:g}"] = {
                "without_us": without / 1e3, "ratio": statistics.median(ratios),
                "lowest": min(ratios), "highest": max(ratios), "pairs": len(ratios)}
    for name, one in figures.items():
        print(f"{name:14} {one['without_us']:9.1f} us without viewers, with {VIEWERS}: ratio "
              f"{one['ratio']:.3f} (median of {one['pairs']} pairs, {one['lowest']:.2f} to "
              f"{one['highest']:.2f})")
    for viewers, values in shares.items():
        figures[f"share_{viewers}_viewers"] = statistics.median(values)
        print(f"amb dash, {viewers} viewers: {100 * statistics.median(values):.1f} % of a processor "
              f"(median of {len(values)} windows, most {100 * max(values):.1f} %)")
    tell_latency(figures, "cycle to sent", [sent for sent, _ in late_ms])
    tell_latency(figures, "cycle to viewer", [arrived for _, arrived in late_ms])


def tell_latency(figures, name, late_ms):
    if not late_ms:
        print(f"{name}: nothing came in that time")
        return
    figures[name.replace(" ", "_") + "_ms"] = {part: quantile(late_ms, share) for part, share in
                                               (("p50", 0.5), ("p99", 0.99))}
    print(f"{name}: median {quantile(late_ms, 0.5):.0f} ms, 99 % {quantile(late_ms, 0.99):.0f} ms "
          f"({len(late_ms)})")


def measure_drawing(options, figures):
    if find() is None:
        print("viewer to screen: not measured, no Chromium here")
        return
    with Browser() as browser:
        tell_latency(figures, "viewer to screen", drawing_run(browser, options.seconds))


if __name__ == "__main__":
    main()

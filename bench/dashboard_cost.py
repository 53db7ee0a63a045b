#!/usr/bin/env python3
"""What the live page costs: latency from cycle to page, processor time, the controller's timing.

    bench/dashboard_cost.py [--runs N] [--seconds S] [--json FILE]

Each run is amb-plant and amb-controller at 10 kHz in real time with amb dash beside them.
  timing   windows without and with three viewers in alternation within a run; the ratio of each
           percentile with viewers to the one of the window before, median over all pairs. Viewers
           read the page's stream as a browser does and draw nothing: theirs are other machines.
  share    of one processor, of all threads of amb dash, in the same windows.
  latency  sampling instant of the newest cycle to the end of the drawing that shows it, in a
           headless Chromium on this machine (not measured where there is none).
Runs in a network namespace of its own; needs root or rtprio.
"""

import argparse
import json
import os
import statistics
import sys
import tempfile
import threading
import time
import urllib.request
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
os.environ.setdefault("LEVITAS_BINARIES", str(ROOT / "build/release/bin"))
os.environ.setdefault("LEVITAS_BUILD", str(ROOT / "build/release"))
sys.path.insert(0, str(ROOT / "tests/support"))
from chromium import Browser, find  # noqa: E402
from lcm_network import SET_UP, TELEMETRY, Bus, Process  # noqa: E402

VIEWERS = 3
WINDOW_S = 3.0
ROWS = ("wakeup", "compute", "latency")
PERCENTILES = (0.5, 0.99)
WATCH = """(() => { window.drawn = []; new MutationObserver(() => window.drawn.push(
    [performance.timeOrigin + performance.now(), Number(document.documentElement.dataset.drawn)]))
    .observe(document.documentElement, {attributes: true, attributeFilter: ['data-drawn']}); })()"""


def enter_namespace():
    if os.environ.get("LEVITAS_BENCH_NAMESPACE"):
        return
    os.environ["LEVITAS_BENCH_NAMESPACE"] = "1"
    unshare = ["unshare", "-n" if os.geteuid() == 0 else "-rn"]
    os.execvp(unshare[0], [*unshare, "sh", "-c", SET_UP, "sh", sys.executable, *sys.argv])


class Trio:
    """Rig, controller and page at 10 kHz in real time, for a with statement."""

    def __init__(self, folder, seconds):
        common = ("--rig", "flexible_rotor", "--pace", "realtime")
        self.parts = [Process(folder, "amb-plant", *common)]
        self.parts.append(Process(folder, "amb-controller", *common, "--controller",
                                  "flexible_rotor_commissioned", "--duration", seconds,
                                  "--trip-folder", folder))
        self.parts[1].says("rig found")
        self.dash = Process(folder, "amb", "dash")
        self.parts.append(self.dash)
        self.dash.says("page: ")
        self.url = self.dash.text.split("page: ")[1].split()[0]

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


def read(stream):
    try:
        while stream.read1(65536):
            pass
    except (OSError, ValueError, AttributeError):
        pass  # closed at the end of the window


def window(trio, histograms, viewers):
    """(percentiles, share of a processor) of one window."""
    streams = [urllib.request.urlopen(trio.url + "events", timeout=30) for _ in range(viewers)]
    for stream in streams:
        threading.Thread(target=read, args=(stream,), daemon=True).start()
    begin, used = time.monotonic(), trio.processor_s()
    time.sleep(WINDOW_S)
    end = time.monotonic()
    share = (trio.processor_s() - used) / (end - begin)
    for stream in streams:
        stream.close()
    return histograms.between(begin, end), share


def timing_run(seconds):
    """[(without, with)] of the pairs of windows in one run, and the shares of both."""
    pairs, shares = [], {0: [], VIEWERS: []}
    with tempfile.TemporaryDirectory() as folder, Trio(folder, seconds) as trio:
        histograms = Histograms()
        time.sleep(1)
        for _ in range(int((seconds - 2) / (2 * WINDOW_S))):
            without, idle = window(trio, histograms, 0)
            beside, busy = window(trio, histograms, VIEWERS)
            shares[0].append(idle)
            shares[VIEWERS].append(busy)
            if without and beside:
                pairs.append((without, beside))
    return pairs, shares


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


def latency_run(browser, seconds):
    """[ms] sampling instant to drawn, of every drawing."""
    with tempfile.TemporaryDirectory() as folder, Trio(folder, seconds) as trio:
        page = browser.open(trio.url)
        page.until("document.documentElement.dataset.drawn")
        offset = offset_ms(page)
        page.value(WATCH)
        time.sleep(max(1.0, seconds - 8.0))
        drawn = page.value("window.drawn")
        page.close()
    return [there - offset - sampled_ns / 1e6 for there, sampled_ns in drawn]


def quantile(values, part):
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, int(part * len(ordered)))]


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--runs", type=int, default=4)
    arguments.add_argument("--seconds", type=float, default=20.0, help="of one run")
    arguments.add_argument("--json", help="write the figures to this file")
    options = arguments.parse_args()
    enter_namespace()
    figures = {}
    pairs, shares = [], {0: [], VIEWERS: []}
    for _ in range(options.runs):
        more, used = timing_run(options.seconds)
        pairs += more
        for viewers, values in used.items():
            shares[viewers] += values
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
    if find() is None:
        print("latency: not measured, no Chromium here")
    else:
        with Browser() as browser:
            late = [ms for _ in range(2) for ms in latency_run(browser, options.seconds)]
        figures["latency_ms"] = {"p50": quantile(late, 0.5), "p99": quantile(late, 0.99),
                                 "drawings": len(late)}
        print(f"latency cycle to page: median {quantile(late, 0.5):.0f} ms, 99 % "
              f"{quantile(late, 0.99):.0f} ms, {len(late)} drawings")
    if options.json:
        Path(options.json).write_text(json.dumps(figures, indent=2), encoding="utf-8")


if __name__ == "__main__":
    main()

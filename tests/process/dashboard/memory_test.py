"""The page and its program do not grow: ten minutes in a headless Chromium, when asked for.

Not run unless LEVITAS_PAGE_SECONDS says how long (600 is the whole proof, 120 the shortest that
judges anything: within the first minute histories fill up). The rig works half of the time, so that
one processor is half busy.
"""

import json
import os
import signal
import sys
import threading
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from chromium import Browser, find  # noqa: E402
from dashboard_rig import Rig, in_mode, until  # noqa: E402
from lcm_network import SKIPPED, run  # noqa: E402

SECONDS = float(os.environ.get("LEVITAS_PAGE_SECONDS", "0"))
FILLED_S = 75.0  # waterfall (240 spectra), traces, events: full by then
EVERY_S = 5.0
# What ten minutes may add [MB]: a page that kept every tick would add some 40 MB.
MOST_MB = 3.0


def resident_mb(pid):
    pages = int(Path(f"/proc/{pid}/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 1e6


def slope(times, values):
    """Least squares, per second."""
    mean_t, mean_v = sum(times) / len(times), sum(values) / len(values)
    above = sum((t - mean_t) * (v - mean_v) for t, v in zip(times, values))
    return above / sum((t - mean_t) ** 2 for t in times)


class HalfTime(threading.Thread):
    """Stops a process every other twentieth of a second."""

    def __init__(self, child):
        super().__init__(daemon=True)
        self.child = child
        self.ended = threading.Event()
        self.start()

    def run(self):
        while not self.ended.wait(0.05):
            self.child.send_signal(signal.SIGSTOP)
            self.ended.wait(0.05)
            self.child.send_signal(signal.SIGCONT)


class TheLongRun(unittest.TestCase):
    def test_adds_nothing_to_memory(self):
        rig = Rig(self)
        pace = HalfTime(rig.plant.child)
        self.addCleanup(pace.join)
        self.addCleanup(pace.ended.set)
        self.assertEqual(rig.command("lift"), (200, "accepted"))
        until(rig.url, in_mode("levitating"))
        rig.command("spin", speed_rpm=600, acceleration_rpm_per_s=30)
        with Browser() as browser:
            page = browser.open(rig.url)
            page.call("HeapProfiler.enable")
            samples = self.samples(rig, page)
            self.assertEqual(page.problems(), [])
        settled = [one for one in samples if one["t_s"] > min(FILLED_S, SECONDS / 2)]
        times = [one["t_s"] for one in settled]
        print(json.dumps(samples))
        for what in ("amb_mb", "heap_mb"):
            values = [one[what] for one in settled]
            per_s = slope(times, values)
            print(f"{what}: {values[0]:.2f} to {values[-1]:.2f}, {60e3 * per_s:+.1f} kB a minute")
            self.assertLess(600 * per_s, MOST_MB, what)

    def samples(self, rig, page):
        samples, begin = [], time.monotonic()
        while (now := time.monotonic() - begin) < SECONDS:
            page.call("HeapProfiler.collectGarbage")
            heap = page.call("Runtime.getHeapUsage")["usedSize"] / 1e6
            samples.append({"t_s": round(now, 1), "heap_mb": round(heap, 3),
                            "amb_mb": round(resident_mb(rig.dash.child.pid), 3)})
            time.sleep(EVERY_S)
        return samples


if __name__ == "__main__":
    if find() is None or SECONDS <= 0:
        print("not run: set LEVITAS_PAGE_SECONDS, and have Chromium (Debian package chromium)")
        sys.exit(SKIPPED)
    os.environ.setdefault("XDG_CONFIG_HOME", "/tmp")
    run()

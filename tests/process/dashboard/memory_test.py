"""The page and its program do not grow: minutes in a headless Chromium, in ./amb test --all.

Not run unless LEVITAS_PAGE_SECONDS says how long (600 is the whole proof, 180 the shortest that
judges anything: histories fill up first, and the heap is uncertain by 1 MB). Seconds are those of
the page, which gets 20 figures in each: on a busy machine fewer arrive, and the test takes longer.
The rig works half of the time, so that one processor is half busy.
"""

import json
import os
import signal
import sys
import threading
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from chromium import Browser, find  # noqa: E402
from dashboard_rig import Rig, in_mode, until  # noqa: E402
from lcm_network import SKIPPED, run  # noqa: E402

SECONDS = float(os.environ.get("LEVITAS_PAGE_SECONDS", "0"))
TICKS_PER_S = 20
# Waterfall (240 spectra, four a second), traces, events: full by then.
FILLED_TICKS, FILLED_SPECTRA = 75 * TICKS_PER_S, 250
EVERY_TICKS = 5 * TICKS_PER_S
# What ten minutes may add [MB]: a page that kept every tick would add some 40 MB.
MOST_MB, MOST_TICKS = 3.0, 600 * TICKS_PER_S
# By so much single readings of the heap jump, with what the collector has left at that moment: in
# the shortest run the line through them may rise by it, a quarter of what is looked for there.
UNCERTAIN_MB = {"amb_mb": 0.0, "heap_mb": 1.0}
# Counts what the page hears, by name.
COUNT = """window.heard = {tick: 0, spectrum: 0};
const add = EventSource.prototype.addEventListener;
EventSource.prototype.addEventListener = function (name, handler, ...more) {
  return add.call(this, name, (message) => {
    window.heard[name] = (window.heard[name] ?? 0) + 1;
    handler(message);
  }, ...more);
};"""


def resident_mb(pid):
    pages = int(Path(f"/proc/{pid}/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 1e6


def slope(ticks, values):
    """Least squares, per tick."""
    mean_t, mean_v = sum(ticks) / len(ticks), sum(values) / len(values)
    above = sum((t - mean_t) * (v - mean_v) for t, v in zip(ticks, values))
    return above / sum((t - mean_t) ** 2 for t in ticks)


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
            page = browser.open(rig.url, before=COUNT)
            page.call("HeapProfiler.enable")
            samples = self.samples(rig, page)
            self.assertEqual(page.problems(), [])
        ticks = [one["ticks"] for one in samples]
        print(json.dumps(samples))
        for what in ("amb_mb", "heap_mb"):
            values = [one[what] for one in samples]
            per_tick = slope(ticks, values)
            print(f"{what}: {values[0]:.2f} to {values[-1]:.2f}, "
                  f"{1e3 * 60 * TICKS_PER_S * per_tick:+.1f} kB a minute")
            watched = ticks[-1] - ticks[0]
            most = MOST_MB * watched / MOST_TICKS + UNCERTAIN_MB[what]
            self.assertLess(watched * per_tick, most, what)

    def samples(self, rig, page):
        """Readings from the time on at which the histories are full."""
        page.until(f"heard.tick >= {FILLED_TICKS} && heard.spectrum >= {FILLED_SPECTRA}")
        samples, ticks, begin = [], page.value("heard.tick"), page.value("heard.tick")
        while ticks - begin < (SECONDS - 75) * TICKS_PER_S:
            page.until(f"heard.tick >= {ticks + EVERY_TICKS}")
            ticks = page.value("heard.tick")
            page.call("HeapProfiler.collectGarbage")
            heap = page.call("Runtime.getHeapUsage")["usedSize"] / 1e6
            samples.append({"ticks": ticks, "heap_mb": round(heap, 3),
                            "amb_mb": round(resident_mb(rig.dash.child.pid), 3)})
        return samples


if __name__ == "__main__":
    if find() is None or SECONDS < 180:
        print("not run: set LEVITAS_PAGE_SECONDS (180 or more), and have Chromium (Debian package chromium)")
        sys.exit(SKIPPED)
    os.environ.setdefault("XDG_CONFIG_HOME", "/tmp")
    run()

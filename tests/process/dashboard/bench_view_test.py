"""Scope and test signals of the page, in a real headless Chromium before a real controller."""

import csv
import io
import os
import sys
import unittest
import urllib.request
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from chromium import Browser, find  # noqa: E402
from dashboard_rig import Rig, fits_screens, in_mode, until  # noqa: E402
from lcm_network import SKIPPED, TELEMETRY, Bus, run  # noqa: E402
from waiting import LIMIT_S  # noqa: E402

MODE = "document.getElementById('mode').textContent"
EXCITATION = "document.getElementById('excitation-answer').textContent"
SCOPE = "document.getElementById('scope-answer').textContent"
CAPTURE = "document.getElementById('capture-what').textContent"
AMPLITUDE_A = 0.5


def levitating(test):
    rig = Rig(test)
    assert rig.command("lift") == (200, "accepted")
    until(rig.url, in_mode("levitating"))
    return rig


def reach_m(axis, batches=40):
    """Largest distance from the mean at an axis, in batches of full rate as the network carries them."""
    from levitas_msg.sample_batch_t import sample_batch_t

    values = []
    bus = Bus(TELEMETRY)
    try:
        for channel, payload in bus.messages():
            if channel != "LEVITAS_SAMPLES":
                continue
            batch = sample_batch_t.decode(payload)
            values += batch.position_m[axis::batch.axes]
            if len(values) >= batches * 128:
                break
    finally:
        bus.close()
    mean = sum(values) / len(values)
    return max(abs(value - mean) for value in values)


class BenchView(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.__exit__)
        cls.browser.call("Browser.getVersion")  # it answers: from here on nothing is its start

    def open(self, rig, **how):
        page = self.browser.open(rig.url + "#bench", **how)
        self.addCleanup(page.close)
        page.until("document.querySelector('#scope [name=channel]').options.length == 4")
        return page

    def fill(self, page, form, **values):
        for name, value in values.items():
            page.value(f"(() => {{ const f = document.getElementById({form!r}).elements[{name!r}];"
                       f" f.value = {str(value)!r};"
                       " f.dispatchEvent(new Event('change', {bubbles: true})); })()")

    def submit(self, page, form):
        page.value(f"document.querySelector('#{form} [type=submit]').click()")

    def excite(self, page, **values):
        self.fill(page, "excitation", signal="chirp")
        self.fill(page, "excitation", channel="de_x", amplitude=AMPLITUDE_A, from_hz=20, to_hz=120,
                  repeat_s=1, hold_s=600, orbit_limit_um=60, **values)
        self.submit(page, "excitation")

    def test_a_test_signal_moves_the_rotor_and_ends_when_it_is_told_to(self):
        rig = levitating(self)
        page = self.open(rig)
        quiet_m = reach_m(0)
        self.excite(page)
        page.until(f"{EXCITATION}.includes('accepted: command excite')")
        page.until("!document.getElementById('excited').hidden")
        # The signal drives the axis well beyond its noise: three times is far from both.
        for _ in range(20):
            moved_m = reach_m(0)
            if moved_m > 3 * quiet_m:
                break
        self.assertGreater(moved_m, 3 * quiet_m)
        page.value("document.getElementById('excitation-end').click()")
        page.until(f"{EXCITATION}.includes('accepted: command end_excitation')")
        page.until("document.getElementById('excited').hidden")
        self.assertEqual(page.problems(), [])

    def test_a_test_signal_is_refused_while_the_rotor_lies_and_where_a_number_is_wrong(self):
        rig = Rig(self)
        until(rig.url, in_mode("off"))
        page = self.open(rig)
        self.excite(page)
        page.until(f"{EXCITATION}.includes('refused: command excite refused in mode off')")
        self.fill(page, "excitation", amplitude=100)
        self.submit(page, "excitation")
        page.until(f"{EXCITATION}.includes('not understood') && {EXCITATION}.includes('amplitude_a')")
        self.assertTrue(page.value("document.getElementById('excited').hidden"))

    def test_the_scope_captures_the_event_that_it_waits_for(self):
        rig = levitating(self)
        page = self.open(rig)
        # Far above the noise of standing still, within the reach of the signal that follows.
        level_um = max(15.0, 1e6 * 2 * reach_m(0))
        self.fill(page, "scope", source="position")
        self.fill(page, "scope", channel="de_x", level=level_um, edge="rising", length_ms=50,
                  before_percent=20)
        self.submit(page, "scope")
        page.until(f"{SCOPE}.includes('armed')")
        self.assertIn("none yet", page.value(CAPTURE))
        self.excite(page)
        page.until(f"{CAPTURE}.includes('rises above')")
        page.until("document.querySelectorAll('#capture-position canvas').length == 1")
        with urllib.request.urlopen(rig.url + "api/scope.csv", timeout=LIMIT_S) as answer:
            rows = list(csv.DictReader(io.StringIO(answer.read().decode())))
        self.assertEqual(len(rows), 501)  # 50 ms at 10 kHz, both ends
        triggers = [i for i, row in enumerate(rows) if float(row["time_s"]) == 0.0]
        self.assertEqual(triggers, [100])
        self.assertLess(float(rows[99]["position_de_x_m"]), level_um * 1e-6)
        self.assertGreaterEqual(float(rows[100]["position_de_x_m"]), level_um * 1e-6)
        cycles = [int(row["cycle"]) for row in rows]
        self.assertEqual(cycles, list(range(cycles[0], cycles[0] + 501)))  # every one of them
        self.zooms(page)
        self.assertEqual(page.problems(), [])

    def zooms(self, page):
        """Zooming one picture zooms the other; the drawn time is the plots' own."""
        before = page.value("document.querySelector('#capture-current canvas').toDataURL()")
        page.value("document.querySelector('[data-zoom=\"0.5\"]').click()")
        page.until(f"document.querySelector('#capture-current canvas').toDataURL() != {before!r}")
        page.value("document.querySelector('[data-zoom=all]').click()")
        page.until(f"document.querySelector('#capture-current canvas').toDataURL() == {before!r}")

    def test_both_viewers_see_the_same_capture(self):
        rig = levitating(self)
        page, other = self.open(rig), self.open(rig)
        self.fill(page, "scope", source="now", length_ms=20)
        self.submit(page, "scope")
        for one in (page, other):
            one.until(f"{CAPTURE}.startsWith('1: ')")

    def test_says_what_is_wrong_with_a_trigger(self):
        rig = levitating(self)
        page = self.open(rig)
        self.fill(page, "scope", length_ms=50000)
        self.submit(page, "scope")
        page.until(f"{SCOPE}.includes('not understood') && {SCOPE}.includes('length_ms')")

    def test_fits_a_small_screen_and_a_phone_with_the_stop_button_in_view(self):
        rig = levitating(self)

        def with_a_capture(**screen):
            page = self.open(rig, **screen)
            self.fill(page, "scope", source="now", length_ms=20)
            self.submit(page, "scope")
            page.until(f"{CAPTURE}.includes('next cycle')")
            return page

        fits_screens(self, with_a_capture)


if __name__ == "__main__":
    if find() is None:
        print("not run: no Chromium here (Debian package chromium)")
        sys.exit(SKIPPED)
    os.environ.setdefault("XDG_CONFIG_HOME", "/tmp")
    run()

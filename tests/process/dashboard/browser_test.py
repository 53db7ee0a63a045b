"""The page in a real headless Chromium before a real controller; not run where there is none."""

import os
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from chromium import Browser, find  # noqa: E402
from dashboard_rig import Rig, fits_screens  # noqa: E402
from lcm_network import SKIPPED, run  # noqa: E402

MODE = "document.getElementById('mode').textContent"
# Pixels of a canvas that are not transparent: something was drawn.
DRAWN = """(() => { const c = document.querySelector(%r); return c && c.width > 0 && c.getContext('2d')
    .getImageData(0, 0, c.width, c.height).data.some((v) => v > 0); })()"""
CANVASES = ("#orbits canvas", "#positions canvas", "#currents canvas", "#spectrum canvas",
            "#waterfall", "#timing")


class ThePage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.__exit__)
        cls.browser.call("Browser.getVersion")  # it answers: from here on nothing is its start

    def rig_and_page(self):
        rig = Rig(self)
        page = self.open(rig)
        page.until(f"{MODE} == 'off'")
        return rig, page

    def open(self, rig, **how):
        page = self.browser.open(rig.url, **how)
        self.addCleanup(page.close)  # before the programs end, which it would report
        return page

    def press(self, page, what):
        page.value(f"document.querySelector({what!r}).click()")

    def answer(self, page, words):
        page.until(f"document.getElementById('answer').textContent.includes({words!r})")

    def test_draws_every_picture_without_an_error(self):
        _, page = self.rig_and_page()
        for canvas in CANVASES:
            with self.subTest(canvas):
                page.until(DRAWN % canvas)
        before = page.value("document.getElementById('time').textContent")
        page.until(f"document.getElementById('time').textContent != {before!r}")
        self.assertEqual(page.problems(), [])

    def test_lifts_and_trips_the_controller_by_its_buttons(self):
        rig, page = self.rig_and_page()
        self.press(page, "[data-command=lift]")
        self.answer(page, "accepted: command lift")
        page.until(f"{MODE} == 'levitating'")
        self.press(page, "#stop")
        page.until(f"{MODE} == 'tripped'")
        rig.controller.says("emergency_stop")
        page.until("!document.getElementById('trip').hidden")
        # The banner takes height: the controller's answer stays readable to its end.
        self.answer(page, "accepted: command emergency_stop")
        self.assertTrue(page.value("(() => { const p = document.getElementById('answer');"
                                   " return p.scrollHeight <= p.clientHeight + 1; })()"))
        # What the sentence foretold is done: the rotor lies, and the reset is the next step.
        page.until("document.getElementById('trip').textContent.endsWith('carry no current any more.')")
        page.until("document.getElementById('next').textContent == 'Next: Reset.'")
        self.assertEqual(page.problems(), [])

    def test_follows_its_address_from_view_to_view(self):
        _, page = self.rig_and_page()
        for view in ("over-speed", "bench"):
            page.value(f"location.hash = '#{view}'")
            page.until(f"!document.getElementById('{view}').hidden")
        page.value("history.back()")
        page.until("!document.getElementById('over-speed').hidden && document.getElementById('bench').hidden")
        self.assertEqual(page.problems(), [])

    def test_spins_with_the_numbers_that_the_page_proposes(self):
        _, page = self.rig_and_page()
        self.press(page, "[data-command=lift]")
        page.until(f"{MODE} == 'levitating'")
        self.press(page, "#spin [type=submit]")
        self.answer(page, "accepted: command spin to 1500 rpm")

    def test_trips_the_controller_by_a_key_wherever_the_cursor_is(self):
        rig, page = self.rig_and_page()
        page.value("document.getElementById('rpm').focus()")
        page.press("Escape")
        page.until(f"{MODE} == 'tripped'")
        rig.controller.says("emergency_stop")

    def test_says_that_a_command_was_refused(self):
        _, page = self.rig_and_page()
        # The page would not offer it; a mode may change between a look and a press.
        page.value("document.querySelector('[data-command=land]').disabled = false")
        self.press(page, "[data-command=land]")
        self.answer(page, "refused")

    def test_comes_back_when_the_program_was_started_again(self):
        rig, page = self.rig_and_page()
        port = rig.url.rsplit(":", 1)[1].strip("/")
        rig.dash.kill()
        page.until("document.getElementById('connection').textContent.includes('lost')")
        rig.start_dash("--http-port", port)
        page.until("document.getElementById('connection').textContent == 'live'")
        before = page.value("document.getElementById('time').textContent")
        page.until(f"document.getElementById('time').textContent != {before!r}")

    def test_is_loaded_again_when_one_of_its_parts_did_not_arrive(self):
        rig = Rig(self)
        page = self.browser.blank()
        self.addCleanup(page.close)
        page.refuse("*/plot.js")
        page.call("Page.addScriptToEvaluateOnNewDocument",
                  source="sessionStorage.loads = 1 + Number(sessionStorage.loads ?? 0);")
        page.call("Page.navigate", url=rig.url)
        page.until("Number(sessionStorage.loads) > 1")
        page.refuse()
        page.until("document.getElementById('mode')?.textContent == 'off'")  # none while it loads

    def test_serves_two_viewers_the_same_run(self):
        rig, page = self.rig_and_page()
        other = self.open(rig)
        self.press(page, "[data-command=lift]")
        for one in (page, other):
            one.until(f"{MODE} == 'levitating'")

    def test_fits_a_small_screen_and_a_phone_with_the_stop_button_in_view(self):
        rig = Rig(self)

        def live(**screen):
            page = self.open(rig, **screen)
            page.until(f"{MODE} == 'off'")
            return page

        fits_screens(self, live)


if __name__ == "__main__":
    if find() is None:
        print("not run: no Chromium here (Debian package chromium)")
        sys.exit(SKIPPED)
    # Of its own, so that a test as another user finds a place it may write to.
    os.environ.setdefault("XDG_CONFIG_HOME", "/tmp")
    run()

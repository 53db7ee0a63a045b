"""What the page offers beyond the newest figures, in a real headless Chromium before a real controller."""

import csv
import io
import os
import re
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from chromium import Browser, find  # noqa: E402
from dashboard_rig import Rig, until as told  # noqa: E402
from lcm_network import SKIPPED, Process, run  # noqa: E402
from waiting import until  # noqa: E402

MODE = "document.getElementById('mode').textContent"
TIME = "parseFloat(document.getElementById('time').textContent)"
AGO = "document.getElementById('ago').textContent"
STATE = "document.body.dataset.state"
PICTURE = "document.querySelector('#%s canvas').toDataURL()"
OPEN = ("[...document.querySelectorAll('[data-command]:not([disabled])')]"
        ".map((one) => one.dataset.command).join()")
NEXT = "document.getElementById('next').textContent"
CURSOR = "document.querySelector('#%s .values')"


class Exploring(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.__exit__)
        cls.browser.call("Browser.getVersion")

    def rig_and_page(self, **how):
        rig = Rig(self)
        page = self.open(rig, **how)
        page.until(f"{MODE} == 'off' && {TIME} > 0 && !!{CURSOR % 'positions'}")
        return rig, page

    def open(self, rig, **how):
        page = self.browser.open(rig.url, **how)
        self.addCleanup(page.close)
        return page

    def press(self, page, what):
        page.value(f"document.querySelector({what!r}).click()")

    def levitate(self, page):
        self.press(page, "[data-command=lift]")
        page.until(f"{MODE} == 'levitating'")

    def spin(self, page):
        self.levitate(page)
        self.press(page, "#spin [type=submit]")
        page.until(f"{MODE} == 'spinning'")

    def later(self, page, seconds):
        """The rig has gone on for so long."""
        page.until(f"{TIME} > {page.value(TIME) + seconds}")

    def place(self, page, box, share):
        return page.value(f"""(() => {{ const r = document.querySelector('#{box} .u-over')
            .getBoundingClientRect(); return [r.left + {share} * r.width, r.top + r.height / 2]; }})()""")

    # Commands

    def test_offers_in_each_mode_what_the_controller_would_take_and_names_the_next_step(self):
        _, page = self.rig_and_page()
        page.until(f"{OPEN} == 'lift' && {NEXT}.includes('Lift')")
        self.levitate(page)
        page.until(f"{OPEN} == 'land,spin' && {NEXT}.includes('Spin')")
        self.press(page, "#spin [type=submit]")
        page.until(f"{MODE} == 'spinning' && {OPEN} == 'spin,coast_down'")
        self.press(page, "#stop")
        page.until(f"{MODE} == 'tripped' && {OPEN} == 'reset' && {NEXT}.includes('Reset')")
        self.assertFalse(page.value("document.getElementById('stop').disabled"))

    def test_takes_nothing_away_where_no_controller_is_heard_and_dims_what_is_old(self):
        rig, page = self.rig_and_page()
        fresh = page.value("getComputedStyle(document.querySelector('#positions canvas')).opacity")
        self.assertEqual((page.value(STATE), fresh), ("live", "1"))
        rig.controller.kill()
        page.until(f"{STATE} == 'silent' && {MODE} == 'controller silent'")
        page.until("document.getElementById('connection').textContent.startsWith('no data for')")
        page.until(f"{OPEN} == 'lift,land,reset,spin,coast_down'")
        for what in ("#positions canvas", "#orbits canvas", "#speed"):
            dimmed = page.value(f"getComputedStyle(document.querySelector({what!r})).opacity")
            self.assertLess(float(dimmed), 0.5, what)
        self.assertEqual(page.value("getComputedStyle(document.getElementById('stop')).opacity"), "1")

    def test_says_how_fast_the_rigs_time_runs_against_the_clock(self):
        _, page = self.rig_and_page()
        page.until("/^[0-9.]+ × real time$/.test(document.getElementById('pace').textContent)")

    def test_shows_one_who_comes_after_the_end_how_the_run_ended(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        run_ = Process(folder.name, "amb", "run", "--dash", "--pace-factor", "50")
        self.addCleanup(run_.kill)
        url = run_.says(re.compile(r"live page: \S+(?=\s)")).rsplit("live page: ", 1)[1]
        run_.says("live page stays at")
        page = self.browser.open(url)
        self.addCleanup(page.close)
        page.until(f"{STATE} == 'ended' && {MODE} == 'ended, off'")
        page.until("!document.getElementById('ended').hidden && document.getElementById('trip').hidden")
        page.until(f"{TIME} > 3 && {OPEN} == ''")
        self.assertEqual(page.value("document.getElementById('speed').textContent"), "0 rpm")
        self.assertFalse(page.value("document.getElementById('stop').disabled"))
        page.until("document.getElementById('back').max > 3")  # what came before it was opened
        self.assertEqual(page.problems(), [])

    # Time

    def test_holds_the_pictures_while_the_run_goes_on_and_goes_back_to_its_beginning(self):
        _, page = self.rig_and_page()
        self.later(page, 1)
        page.until(f"{AGO} == 'now'")
        self.press(page, "#hold")
        page.until("document.body.classList.contains('held')")
        self.later(page, 1)
        page.until(f"{AGO}.endsWith(' s ago')")
        held = page.value(PICTURE % "positions")
        self.later(page, 1)
        self.assertEqual(page.value(PICTURE % "positions"), held)
        page.value("""(() => { const back = document.getElementById('back');
            back.value = Number(back.min) + 0.5; back.dispatchEvent(new Event('input')); })()""")
        page.until(f"{PICTURE % 'positions'} != {held!r}")
        self.press(page, "#hold")
        page.until(f"{AGO} == 'now' && !document.body.classList.contains('held')")
        self.assertEqual(page.problems(), [])

    def test_begins_with_what_was_before_it_was_opened(self):
        rig, first = self.rig_and_page()
        self.later(first, 2)
        opened_s = first.value(TIME)
        late = self.open(rig)
        late.until(f"document.getElementById('back').max > {opened_s}")
        self.assertLess(float(late.value("document.getElementById('back').min")), opened_s - 1)
        self.assertEqual(late.problems(), [])

    # Values

    def test_tells_the_values_at_the_cursor_and_under_a_finger(self):
        rig, page = self.rig_and_page()
        self.later(page, 1)
        for box, unit in (("positions", "µm"), ("currents", "A"), ("spectrum", "Hz")):
            with self.subTest(box):
                x, y = self.place(page, box, 0.5)
                page.call("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y)
                page.until(f"!{CURSOR % box}.hidden && {CURSOR % box}.textContent.includes({unit!r})")
        self.assertIn("de_x", page.value(f"{CURSOR % 'positions'}.textContent"))
        phone = self.open(rig, width=390, height=844, phone=True)
        phone.until(f"{TIME} > 0 && !!{CURSOR % 'positions'}")
        phone.value("document.getElementById('positions').scrollIntoView({block: 'center'})")
        x, y = self.place(phone, "positions", 0.5)
        phone.call("Emulation.setTouchEmulationEnabled", enabled=True)
        phone.call("Input.dispatchTouchEvent", type="touchStart", touchPoints=[{"x": x, "y": y}])
        phone.until(f"!{CURSOR % 'positions'}.hidden")

    def test_has_one_cursor_in_all_pictures_over_time_and_draws_nothing_for_it(self):
        rig, page = self.rig_and_page()
        self.later(page, 1)
        line = """document.querySelector('#%s .u-cursor-x').getBoundingClientRect().left"""
        time_of = "%s.textContent.split('\\n')[0]"
        at = {box: (CURSOR % box, line % box, time_of % (CURSOR % box)) for box in ("positions", "currents")}
        for box, other, unit, share in (("positions", "currents", "A", 0.4), ("currents", "positions", "µm", 0.7)):
            with self.subTest(box):
                x, y = self.place(page, box, share)
                page.call("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y)
                page.until(f"!{at[other][0]}.hidden && {at[other][0]}.textContent.includes({unit!r})")
                # While the run goes on: one time and one place in both, within half a pixel.
                page.until(f"Math.abs({at[box][1]} - {at[other][1]}) < 0.5 && {at[box][2]} == {at[other][2]}"
                           f" && Math.abs({at[other][1]} - {x}) < 2")  # whole pixels, of a box between pixels
        self.press(page, "#hold")
        page.until("document.body.classList.contains('held')")
        self.later(page, 0.5)  # what was to be drawn is drawn
        page.value("""(() => { window.cleared = 0; const was = CanvasRenderingContext2D.prototype.clearRect;
            CanvasRenderingContext2D.prototype.clearRect = function (...place) {
              if (this.canvas.closest('#positions, #currents')) ++window.cleared;
              return was.apply(this, place); }; })()""")
        for share in (0.2, 0.3, 0.5):
            x, y = self.place(page, "positions", share)
            page.call("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y)
            page.until(f"Math.abs({at['currents'][1]} - {x}) < 2")
        self.assertEqual(page.value("window.cleared"), 0)
        page.call("Input.dispatchMouseEvent", type="mouseMoved", x=1, y=1)
        page.until(f"{at['positions'][0]}.hidden && {at['currents'][0]}.hidden")
        self.assertEqual(page.problems(), [])

    def test_keeps_each_traces_colour_where_envelopes_lie_over_each_other(self):
        _, page = self.rig_and_page()
        self.levitate(page)
        # The newest five seconds alone: from here on all four envelopes overlap.
        page.value("(() => { const w = document.getElementById('window'); w.value = '5';"
                   " w.dispatchEvent(new Event('change')); })()")
        self.later(page, 6)
        self.press(page, "#hold")
        self.later(page, 0.5)  # what was to be drawn is drawn
        share = page.value("""(async () => {
          const { lineColour, lineTint } = await import('/colours.js');
          const c = document.querySelector('#currents canvas');
          const bytes = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
          const count = new Map();
          for (let i = 0; i < bytes.length; i += 4) {
            const one = bytes.subarray(i, i + 4).join();
            count.set(one, (count.get(one) ?? 0) + 1);
          }
          const probe = document.createElement('canvas').getContext('2d');
          const bytesOf = (colour) => {
            probe.fillStyle = colour;
            probe.fillRect(0, 0, 1, 1);
            return [...probe.getImageData(0, 0, 1, 1).data].join();
          };
          const pixels = (colour) => (count.get(bytesOf(colour)) ?? 0) / (c.width * c.height);
          const most = [...count].filter(([one, n]) => !one.endsWith(',0') && n > 0.02 * c.width * c.height);
          const tints = [0, 1, 2, 3].map((i) => bytesOf(lineTint(i)));
          return { lines: [0, 1, 2, 3].map((i) => pixels(lineColour(i))),
                   filled: most.map(([one]) => one), tints };
        })()""")
        # Every channel's own colour is in the picture: a line of a hundred pixels is a tenth of a percent.
        for channel, lines in enumerate(share["lines"]):
            self.assertGreater(lines, 0.001, f"channel {channel}")
        # What fills a fiftieth of the picture is a channel's tint and no mixture.
        self.assertGreater(len(share["filled"]), 0)
        self.assertLessEqual(set(share["filled"]), set(share["tints"]))
        self.assertEqual(page.problems(), [])

    def test_switches_channels_off_and_on(self):
        _, page = self.rig_and_page()
        self.later(page, 1)
        self.press(page, "#hold")
        self.later(page, 1)  # what was to be drawn is drawn
        name = "[...document.querySelectorAll('.positions .names button')].find((b) => b.textContent == 'nde_y')"
        before = page.value(PICTURE % "positions")
        page.value(f"{name}.click()")
        page.until(f"{name}.getAttribute('aria-pressed') == 'false' && {PICTURE % 'positions'} != {before!r}")
        page.value(f"{name}.click()")
        page.until(f"{name}.getAttribute('aria-pressed') == 'true' && {PICTURE % 'positions'} == {before!r}")

    def test_spectra_reach_as_far_as_one_viewer_asks_for_all(self):
        rig, page = self.rig_and_page()
        other = self.open(rig)
        choice = "document.getElementById('spectrum-range')"
        other.until(f"{choice}.value == '500'")
        page.until(f"[...{choice}.options].some((one) => one.text == '±1000 Hz, amplifiers')")  # 720 Hz
        page.value(f"{choice}.value = '1000', {choice}.dispatchEvent(new Event('change'))")
        other.until(f"{choice}.value == '1000'")
        wide = told(rig.url, lambda name, data: name == "spectrum" and data["highest_hz"] > 900)
        self.assertLessEqual(len(wide["amplitude_dnm"][0]), 421)  # as light as before

    # Rotation

    def test_shows_the_key_phasor_in_the_orbits_and_the_first_order_over_speed(self):
        rig, page = self.rig_and_page()
        still = told(rig.url, lambda name, data: name == "tick" and "orbit_key" in data)
        self.assertEqual(still["orbit_key"], [])
        self.spin(page)
        told(rig.url, lambda name, data: name == "tick" and data.get("speed_rpm", 0) > 1000
             and data.get("orbit_key"))
        self.press(page, "[data-view=over-speed]")
        page.until("/rpm: .* µm ∠ .*°/.test(document.getElementById('first-now').textContent)")
        page.until("!document.getElementById('over-speed').hidden")
        drawn = page.value(PICTURE % "first-amplitude")
        page.until(f"{PICTURE % 'first-amplitude'} != {drawn!r}")  # the run-up goes on
        x, y = self.place(page, "first-amplitude", 0.1)
        page.call("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y)
        page.until(f"{CURSOR % 'first-amplitude'}.textContent.includes('rpm')")
        self.assertEqual(page.problems(), [])

    # Records

    def test_records_a_stretch_with_its_markers_into_a_file(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        _, page = self.rig_and_page()
        self.browser.call("Browser.setDownloadBehavior", behavior="allow", downloadPath=folder.name)
        self.later(page, 0.5)
        self.press(page, "#record")
        page.until("document.getElementById('record').textContent.includes('Save')")
        page.value("document.getElementById('marker-text').value = 'a \"knock\"'")
        self.press(page, "#marker [type=submit]")
        page.until("document.getElementById('events').textContent.includes('a \"knock\"')")
        page.until("document.getElementById('events').textContent.includes('command mark (cycle ')")
        self.later(page, 1)
        self.press(page, "#record")

        def saved():
            """What the browser has written, once it has come to the end of a line."""
            texts = [file.read_text(encoding="utf-8", errors="replace")
                     for file in Path(folder.name).glob("flexible_rotor_*.csv")]
            return texts[0] if texts and texts[0].endswith("\n") else ""

        text = until(saved, "the file", lambda: str(list(Path(folder.name).iterdir())))
        rows = list(csv.DictReader(io.StringIO(text)))
        times = [float(row["time_s"]) for row in rows]
        self.assertGreater(len(rows), 20)
        self.assertEqual(times, sorted(times))
        self.assertEqual([row["marker"] for row in rows if row["marker"]], ['a "knock"'])
        for row in rows:
            least, most = (float(row[f"position_de_y_{side}_m"]) for side in ("least", "most"))
            self.assertLess(least, most)
            self.assertLess(abs(least), 1e-3)  # metres: the rotor lies in its touchdown bearing
        self.assertEqual(page.problems(), [])

if __name__ == "__main__":
    if find() is None:
        print("not run: no Chromium here (Debian package chromium)")
        sys.exit(SKIPPED)
    os.environ.setdefault("XDG_CONFIG_HOME", "/tmp")
    run()

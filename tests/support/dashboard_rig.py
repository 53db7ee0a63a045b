"""A controller that waits for commands, its rig, and amb dash before them; a client of the page."""

import json
import re
import tempfile
import time
import urllib.error
import urllib.request

from lcm_network import Process, plant
from waiting import LIMIT_S


class Rig:
    """Starts the three programs in a folder of their own; ends them with the test."""

    def __init__(self, test, *dash_arguments, controller="flexible_rotor",
                 controller_arguments=()):
        self.test = test
        folder = tempfile.TemporaryDirectory()
        test.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.plant = self.started(plant(self.folder))
        self.controller = self.started(Process(
            self.folder, "amb-controller", "--rig", "flexible_rotor", "--controller", controller,
            "--trip-folder", self.folder, *controller_arguments))
        self.controller.says("rig found")
        self.dash = self.start_dash(*dash_arguments)

    def started(self, process):
        self.test.addCleanup(process.kill)
        return process

    def start_dash(self, *arguments):
        patience = [] if "--answer-within" in arguments else ["--answer-within", "50"]
        dash = self.started(Process(self.folder, "amb", "dash", *patience, *arguments))
        self.url = dash.says(re.compile(r"page: \S+(?=\s)")).rsplit("page: ", 1)[1]
        return dash

    def post(self, body, headers=None, url=None, path="api/command"):
        """(HTTP status, answer) of a command, or of another path's request."""
        data = body if isinstance(body, bytes) else json.dumps(body).encode()
        request = urllib.request.Request((url or self.url) + path, data=data,
                                         headers={"X-Levitas": "1"} if headers is None else headers)
        return answer_of(request)

    def command(self, name, **more):
        status, answer = self.post({"command": name, **more})
        return status, answer["outcome"]


def answer_of(request):
    try:
        with urllib.request.urlopen(request, timeout=LIMIT_S) as answer:
            return answer.status, json.loads(answer.read())
    except urllib.error.HTTPError as refused:
        return refused.code, json.loads(refused.read() or b"null")


def messages(stream):
    """(event, data) of a stream of server-sent events, as they come."""
    name = None
    for line in stream:
        if line.startswith(b"event: "):
            name = line[7:].strip().decode()
        elif line.startswith(b"data: "):
            yield name, json.loads(line[6:])


def until(url, wanted):
    """The first message for which wanted(event, data) holds."""
    end, last = time.monotonic() + LIMIT_S, {}
    with urllib.request.urlopen(url + "events", timeout=LIMIT_S) as stream:
        for name, data in messages(stream):
            if wanted(name, data):
                return data
            last[name] = data
            if time.monotonic() > end:
                break
    raise AssertionError(f"the message never came; the last of each kind: {last}")


# What a hand or an eye needs and does not get: beyond the window or its panel, under another one, or
# a picture smaller than can be read. Panels that scroll on purpose are asked for their width alone.
UNREADABLE = """(() => {
  const name = (e) => (e.id || e.dataset.command || e.dataset.view || e.className || e.textContent);
  const seen = (e) => e.getClientRects().length > 0;
  const parts = [...document.querySelectorAll('button, select, input, output, dd, .connection, .mode')]
    .filter(seen).map((e) => ({ e, r: e.getBoundingClientRect(), panel: e.closest('.panel, header') }));
  const wrong = [];
  for (const { e, r, panel } of parts) {
    const p = panel.getBoundingClientRect();
    const below = getComputedStyle(panel).overflowY !== 'auto' && r.bottom > p.bottom + 1;
    if (r.left < p.left - 1 || r.right > p.right + 1 || below) wrong.push(name(e) + ' leaves its panel');
    if (r.right > innerWidth || r.left < 0) wrong.push(name(e) + ' leaves the window');
  }
  parts.forEach((a, i) => parts.slice(i + 1).forEach((b) => {
    const wide = Math.min(a.r.right, b.r.right) - Math.max(a.r.left, b.r.left);
    const high = Math.min(a.r.bottom, b.r.bottom) - Math.max(a.r.top, b.r.top);
    if (wide > 1 && high > 1) wrong.push(name(a.e) + ' covers ' + name(b.e));
  }));
  for (const box of [...document.querySelectorAll('.plot, canvas#waterfall, canvas#timing')].filter(seen)) {
    if (box.clientWidth < 180 || box.clientHeight < 80) {
      wrong.push(`${box.id} has ${box.clientWidth} x ${box.clientHeight}`);
    }
  }
  return wrong;
})()"""


def fits_screens(test, page_of):
    """The page fits small screens without scrolling and a phone's width; stop is always in view.

    page_of(width=, height=, phone=) opens it and has waited until everything is there.
    """
    for width, height, phone in ((1280, 720, False), (1024, 768, False), (390, 844, True)):
        with test.subTest(width=width):
            page = page_of(width=width, height=height, phone=phone)
            test.assertLessEqual(page.value("document.documentElement.scrollWidth"), width)
            if not phone:
                test.assertLessEqual(page.value("document.documentElement.scrollHeight"), height)
                test.assertEqual(page.value(UNREADABLE), [])
            page.value("window.scrollTo(0, document.body.scrollHeight)")
            top, bottom, wide = page.value("(() => { const b = document.getElementById('stop')"
                                           ".getBoundingClientRect();"
                                           " return [b.top, b.bottom, b.width]; })()")
            test.assertGreaterEqual(top, 0)
            test.assertLessEqual(bottom, height)
            test.assertGreater(wide, 100)


def in_mode(mode):
    return lambda name, data: name == "tick" and data.get("mode") == mode

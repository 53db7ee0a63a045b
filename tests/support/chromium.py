"""A headless Chromium driven through its debugging pipe, with the standard library alone.

Messages are JSON, each ended by a zero byte, on descriptors 3 (to the browser) and 4 (from it), as
the DevTools protocol defines them. find() is None where no Chromium is installed.
"""

import base64
import json
import os
import select
import shutil
import subprocess
import tempfile

from waiting import LIMIT_S, until


def find():
    return shutil.which("chromium") or shutil.which("chromium-browser")


class LoadedAgain(AssertionError):
    """The page was loaded anew while it was asked."""


class Browser:
    def __init__(self, width=1280, height=720):
        self.profile = tempfile.TemporaryDirectory()
        to_read, self.to_write = os.pipe()
        self.from_read, from_write = os.pipe()

        def descriptors():
            # Out of the way first: either pipe may already lie on 3 or 4.
            read, write = os.dup(to_read), os.dup(from_write)
            os.dup2(read, 3)
            os.dup2(write, 4)

        self.child = subprocess.Popen(
            [find(), "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
             "--hide-scrollbars", "--no-first-run", "--disable-background-networking",
             "--disable-component-update", "--disable-sync", "--disable-quic",
             f"--user-data-dir={self.profile.name}",
             # Else it puts a folder into the cache of whoever runs the tests, and leaves it there.
             f"--disk-cache-dir={self.profile.name}/cache", f"--window-size={width},{height}",
             "--remote-debugging-pipe", "about:blank"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, preexec_fn=descriptors,
            close_fds=False)
        os.close(to_read)
        os.close(from_write)
        self.number = 0
        self.buffer = b""
        self.problems = []  # (session, text): console errors and uncaught exceptions

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.child.terminate()
        try:
            self.child.wait(LIMIT_S)
        except subprocess.TimeoutExpired:
            self.child.kill()
            self.child.wait()
        os.close(self.to_write)
        os.close(self.from_read)
        shutil.rmtree(self.profile.name, ignore_errors=True)

    def _message(self):
        while b"\0" not in self.buffer:
            if not select.select([self.from_read], [], [], LIMIT_S)[0]:
                raise AssertionError(f"Chromium said nothing for {LIMIT_S} s")
            part = os.read(self.from_read, 1 << 20)
            if not part:
                raise AssertionError("Chromium ended")
            self.buffer += part
        text, _, self.buffer = self.buffer.partition(b"\0")
        return json.loads(text)

    def call(self, method, session=None, **parameters):
        self.number += 1
        request = {"id": self.number, "method": method, "params": parameters}
        if session:
            request["sessionId"] = session
        os.write(self.to_write, json.dumps(request).encode() + b"\0")
        while True:
            message = self._message()
            if message.get("id") == self.number:
                if "navigated" in message.get("error", {}).get("message", ""):
                    raise LoadedAgain(method)
                if "error" in message:
                    raise AssertionError(f"{method}: {message['error']}")
                return message["result"]
            self._note(message)

    def _note(self, message):
        what = message.get("params", {})
        session = message.get("sessionId")
        if message.get("method") == "Runtime.exceptionThrown":
            self.problems.append((session, json.dumps(what["exceptionDetails"])[:500]))
        elif message.get("method") == "Runtime.consoleAPICalled" and what["type"] == "error":
            self.problems.append((session, json.dumps(what["args"])[:500]))
        elif message.get("method") == "Log.entryAdded" and what["entry"]["level"] == "error":
            self.problems.append((session, what["entry"]["text"] + " " + what["entry"].get("url", "")))

    def blank(self):
        """A new page that shows nothing yet; its handle."""
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        page = Page(self, session, target)
        for domain in ("Page", "Runtime", "Log"):
            page.call(f"{domain}.enable")
        return page

    def open(self, url, width=1280, height=720, phone=False, before=None):
        """A new page; its handle. The script `before` runs in it before its own."""
        page = self.blank()
        page.call("Emulation.setDeviceMetricsOverride", width=width, height=height,
                  deviceScaleFactor=1, mobile=phone)
        if before:
            page.call("Page.addScriptToEvaluateOnNewDocument", source=before)
        page.call("Page.navigate", url=url)
        page.until("location.href != 'about:blank' && document.readyState == 'complete'")
        return page


class Page:
    def __init__(self, browser, session, target):
        self.browser = browser
        self.session = session
        self.target = target

    def problems(self):
        """Errors of this page so far.

        A stream of events that broke off is none: a browser that is too slow is dropped on purpose
        and comes back by itself.
        """
        return [text for session, text in self.browser.problems if session == self.session
                and not ("net::ERR_" in text and "/events" in text)]

    def refuse(self, *urls):
        """Requests for these addresses (* stands for any text) fail from now on; no others."""
        self.call("Network.enable")
        self.call("Network.setBlockedURLs", urls=list(urls))

    def close(self):
        self.browser.call("Target.closeTarget", targetId=self.target)

    def call(self, method, **parameters):
        return self.browser.call(method, self.session, **parameters)

    def value(self, expression):
        result = self.call("Runtime.evaluate", expression=expression, returnByValue=True,
                           awaitPromise=True)
        if "exceptionDetails" in result:
            raise AssertionError(f"{expression}: {result['exceptionDetails']}")
        return result["result"].get("value")

    def until(self, expression):
        """Waits until the expression is true; a time-out is a failure."""
        def holds():
            try:
                return self.value(expression)
            except LoadedAgain:
                return False

        def shown():
            try:
                return self.value("document.body.innerText")
            except LoadedAgain:
                return "(it is being loaded again)"

        until(holds, expression, lambda: "\n".join([shown(), *self.problems()]))

    def press(self, key):
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=key, code=key)

    def picture(self, path):
        data = self.call("Page.captureScreenshot", format="png")["data"]
        with open(path, "wb") as file:
            file.write(base64.b64decode(data))

"""amb dash between a client and a real controller: figures, commands, access, restart."""

import http.client
import json
import signal
import socket
import subprocess
import sys
import threading
import unittest
import urllib.parse
import urllib.request
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from dashboard_rig import Rig, answer_of, in_mode, messages, until  # noqa: E402
from lcm_network import BINARIES, run  # noqa: E402
from waiting import LIMIT_S, pause  # noqa: E402


class Figures(unittest.TestCase):
    def test_move_with_the_run(self):
        rig = Rig(self)
        cycles = []
        seen = set()
        with urllib.request.urlopen(rig.url + "events", timeout=LIMIT_S) as stream:
            for name, data in messages(stream):
                seen.add(name)
                if name == "rig" and data["run"] > 0:
                    self.assertEqual(data["channels"], ["de_x", "de_y", "nde_x", "nde_y"])
                if name == "tick" and "cycle" in data:
                    cycles.append(data["cycle"])
                if len(cycles) > 20 and {"rig", "tick", "spectrum", "timing"} <= seen:
                    break
        self.assertEqual(cycles, sorted(cycles))
        self.assertGreater(cycles[-1], cycles[0])

    def test_begin_with_the_present_however_long_nobody_looked(self):
        rig = Rig(self)
        tick = until(rig.url, lambda name, data: name == "tick" and "cycle" in data)
        self.assertFalse(tick["silent"])
        rig.controller.kill()
        pause(3, "silence is one second or longer; what was told before nobody looked knew of none")
        self.assertTrue(until(rig.url, lambda name, data: name == "tick")["silent"])

    def test_say_when_the_controller_is_gone(self):
        rig = Rig(self)
        until(rig.url, in_mode("off"))
        rig.controller.kill()
        until(rig.url, lambda name, data: name == "tick" and data["silent"])


class Commands(unittest.TestCase):
    def test_are_confirmed_by_the_controller_and_trip_it(self):
        rig = Rig(self)
        self.assertEqual(rig.command("land"), (409, "refused"))  # nothing to land
        self.assertEqual(rig.command("lift"), (200, "accepted"))
        until(rig.url, in_mode("levitating"))
        self.assertEqual(rig.command("spin", speed_rpm=300, acceleration_rpm_per_s=600),
                         (200, "accepted"))
        self.assertEqual(rig.command("spin", speed_rpm=1e6, acceleration_rpm_per_s=600),
                         (409, "refused"))  # beyond the rated speed
        self.assertEqual(rig.command("emergency_stop"), (200, "accepted"))
        tick = until(rig.url, in_mode("tripped"))
        self.assertEqual(tick["fault"], "emergency_stop")
        rig.controller.says("emergency_stop")

    def test_are_not_taken_for_done_when_nobody_answers(self):
        rig = Rig(self)
        rig.start_dash("--answer-within", "0.5")
        rig.controller.kill()
        self.assertEqual(rig.command("emergency_stop"), (504, "unanswered"))


class TestSignals(unittest.TestCase):
    CHIRP = {"hold_s": 0.5, "orbit_limit_um": 57, "excitation": [
        {"channel": "de_x", "signal": "chirp", "amplitude_a": 0.3, "from_hz": 10, "to_hz": 400,
         "repeat_s": 0.5}]}

    def test_are_recorded_and_replay_bit_for_bit(self):
        rig = Rig(self, controller_arguments=("--record", "run.lcm"))
        self.assertEqual(rig.command("lift"), (200, "accepted"))
        until(rig.url, in_mode("levitating"))
        until(rig.url, lambda name, data: name == "rig" and data["run"] > 0)
        status, answer = rig.post(self.CHIRP, path="api/excitation")
        self.assertEqual((status, answer["outcome"]), (200, "accepted"), answer)
        until(rig.url, lambda name, data: name == "log" and "end_excitation" in data["text"])
        rig.controller.terminate()
        self.assertEqual(rig.controller.status(), 0, rig.controller.text)
        done = subprocess.run([BINARIES / "amb", "replay", "run.lcm"], cwd=rig.folder, text=True,
                              capture_output=True, timeout=LIMIT_S, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("every output bit", done.stdout)


class Access(unittest.TestCase):
    def test_is_refused_to_other_pages_and_other_names(self):
        rig = Rig(self)
        lift = {"command": "lift"}
        self.assertEqual(rig.post(lift, headers={})[0], 403)  # what a foreign form can send
        self.assertEqual(rig.post(lift, headers={"X-Levitas": "1", "Host": "evil.example"})[0], 403)
        # Permission for foreign scripts is asked with OPTIONS; the answer must not give it.
        host = urllib.parse.urlsplit(rig.url).netloc
        ask = http.client.HTTPConnection(host, timeout=LIMIT_S)
        ask.request("OPTIONS", "/api/command", headers={"Origin": "http://evil.example"})
        self.assertIsNone(ask.getresponse().getheader("Access-Control-Allow-Origin"))
        ask.close()
        self.assertEqual(until(rig.url, lambda name, data: name == "tick")["mode"], "off")

    def test_needs_the_token_where_a_token_is_asked_for(self):
        secret = "0123456789abcdef"
        rig = Rig(self, "--token", secret)
        base, _, token = rig.url.partition("?")
        self.assertEqual(token, "token=" + secret)
        rig.dash.says("--token-file")  # the warning
        lift = {"command": "lift"}
        self.assertEqual(rig.post(lift, url=base)[0], 403)
        self.assertEqual(rig.post(lift, {"X-Levitas": "1", "X-Levitas-Token": secret.upper()}, base)[0], 403)
        with self.assertRaises(urllib.error.HTTPError):
            urllib.request.urlopen(base + "events", timeout=LIMIT_S)
        self.assertEqual(rig.post(lift, {"X-Levitas": "1", "X-Levitas-Token": secret}, base)[0], 200)

    def test_takes_the_token_from_a_file_that_is_the_users_alone(self):
        rig = Rig(self)
        path = Path(rig.folder) / "token"
        path.write_text("fedcba9876543210\n")
        path.chmod(0o600)
        secret = "fedcba9876543210"
        page = Path(rig.folder) / "page.json"
        page.write_text("{}")
        page.chmod(0o644)
        dash = rig.start_dash("--token-file", str(path), "--json", str(page))
        dash.says("behind it goes ?token= and the first line of")
        dash.says("with the same --port")
        self.assertNotIn("?", rig.url)
        self.assertEqual(rig.post({"command": "lift"})[0], 403)
        self.assertEqual(
            rig.post({"command": "lift"}, {"X-Levitas": "1", "X-Levitas-Token": secret})[0], 200)
        dash.child.send_signal(signal.SIGINT)
        self.assertEqual(dash.status(), 0)
        self.assertNotIn(secret, dash.text)
        # The file holds the whole address, and nobody else may read it, whoever could before.
        self.assertEqual(json.loads(page.read_text())["page"], rig.url + "?token=" + secret)
        self.assertEqual(page.stat().st_mode & 0o777, 0o600)
        for text, mode, arguments, status, said in (
                ("fedcba9876543210\n", 0o644, ("--token-file", path), 3, "chmod 600"),
                ("short\n", 0o600, ("--token-file", path), 2, "16"),
                ("", 0o600, ("--token", "short"), 2, "16"),
                ("fedcba9876543210\n", 0o600, ("--token-file", path, "--token", "x" * 16), 2, "--token")):
            path.write_text(text)
            path.chmod(mode)
            done = subprocess.run([BINARIES / "amb", "dash", *arguments], text=True,
                                  capture_output=True, timeout=LIMIT_S, check=False)
            self.assertEqual(done.returncode, status, done.stderr)
            self.assertIn(said, done.stderr)

    def test_is_not_given_to_the_network_by_accident(self):
        done = subprocess.run([BINARIES / "amb", "dash", "--listen", "0.0.0.0"], text=True,
                              capture_output=True, timeout=LIMIT_S, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("--allow-network", done.stderr)

    def test_of_nonsense_harms_nothing(self):
        rig = Rig(self)
        until(rig.url, lambda name, data: name == "rig" and data["run"] > 0)
        for path in ("api/command", "api/excitation", "api/scope"):
            for body in (b"", b"\xff\x00", b"{" * 5000, b"[" * 5000, b"{}", b"7", b'{"do": 1}'):
                status, answer = rig.post(body, path=path)
                self.assertEqual(status, 400, (path, body[:10]))
                self.assertTrue(answer["text"])
            self.assertEqual(rig.post(b"x" * 100_000, path=path)[0], 413)
            self.assertEqual(rig.post(b"{}", headers={}, path=path)[0], 403)
        request = urllib.request.Request(rig.url + "no/such/file")
        with self.assertRaises(urllib.error.HTTPError) as refused:
            urllib.request.urlopen(request, timeout=LIMIT_S)
        self.assertEqual(refused.exception.code, 404)
        self.assertEqual(rig.command("lift"), (200, "accepted"))


class Floods(unittest.TestCase):
    """A client that sends without end, or never ends its request."""

    HEAD = b"Host: localhost\r\nX-Levitas: 1\r\n"
    MEGABYTE = 1 << 20
    # Room for threads and buffers [MB]; what was sent is 400 MB each.
    MOST_GROWTH_MB = 40

    def connected(self, rig):
        where = urllib.parse.urlsplit(rig.url)
        sock = socket.create_connection((where.hostname, where.port), timeout=LIMIT_S)
        self.addCleanup(sock.close)
        return sock

    @staticmethod
    def resident_mb(process):
        status = Path(f"/proc/{process.child.pid}/status").read_text()
        return int(status.split("VmRSS:")[1].split()[0]) / 1024

    def test_of_four_hundred_megabytes_are_not_kept(self):
        rig = Rig(self)
        before = self.resident_mb(rig.dash)
        much = b"a" * self.MEGABYTE
        post = b"POST /api/command HTTP/1.1\r\n" + self.HEAD
        headers = b"".join(b"X%07d: %s\r\n" % (i, b"y" * 100) for i in range(9000))
        for name, begin, more in (
                ("chunked", post + b"Transfer-Encoding: chunked\r\n\r\n",
                 b"100000\r\n" + much + b"\r\n"),
                ("without a length", post + b"\r\n", much),
                ("many headers", b"GET / HTTP/1.1\r\n" + self.HEAD, headers),
                ("a long header", b"GET / HTTP/1.1\r\n" + self.HEAD + b"X: ", much),
                ("a long address", b"GET /", much)):
            with self.subTest(name):
                sock = self.connected(rig)
                sock.sendall(begin)
                sent = 0
                try:
                    while sent < 400 * self.MEGABYTE:
                        sock.sendall(more)
                        sent += len(more)
                except OSError:
                    pass
                self.assertLess(sent, 400 * self.MEGABYTE)
                self.assertLess(self.resident_mb(rig.dash) - before, self.MOST_GROWTH_MB)
        self.assertEqual(rig.command("emergency_stop"), (200, "accepted"))

    def test_of_slow_clients_do_not_hold_back_the_emergency_stop(self):
        rig = Rig(self)
        ended = threading.Event()
        self.addCleanup(ended.set)
        begin = b"POST /api/command HTTP/1.1\r\n" + self.HEAD
        clients = [self.connected(rig) for _ in range(120)]
        for i, sock in enumerate(clients):
            sock.sendall((b"", begin + b"X-A: ", begin + b"Content-Length: 60000\r\n\r\n")[i % 3])

        def drip():
            while not ended.wait(0.5):
                for i, sock in enumerate(clients):
                    try:
                        if i % 3:
                            sock.sendall(b"a")
                    except OSError:
                        clients[i] = self.connected(rig)  # thrown out: there it is again
                        clients[i].sendall(begin + b"X-A: ")

        threading.Thread(target=drip, daemon=True).start()
        # They never let go: only who is answered beside them is answered.
        self.assertEqual(rig.command("emergency_stop"), (200, "accepted"))


def drain(stream):
    try:
        while stream.read1():
            pass
    except (OSError, ValueError, http.client.HTTPException, AttributeError):
        pass  # closed under our hands at the end of the test


class Viewers(unittest.TestCase):
    def test_that_take_nothing_hinder_no_other(self):
        rig = Rig(self)
        where = urllib.parse.urlsplit(rig.url)
        slow = []
        for _ in range(3):
            sock = socket.create_connection((where.hostname, where.port))
            self.addCleanup(sock.close)
            sock.sendall(f"GET /events HTTP/1.1\r\nHost: {where.netloc}\r\n\r\n".encode())
            slow.append(sock)
        pause(1, "they fill up meanwhile, or not: the others must not notice either way")
        self.assertEqual(rig.command("lift"), (200, "accepted"))
        until(rig.url, in_mode("levitating"))

    def test_beyond_the_limit_are_told_so(self):
        rig = Rig(self)
        streams = [urllib.request.urlopen(rig.url + "events", timeout=LIMIT_S) for _ in range(16)]
        for stream in streams:
            self.addCleanup(stream.close)
            # Somebody reads: a viewer that takes nothing would make room for the next.
            threading.Thread(target=drain, args=(stream,), daemon=True).start()
        status, answer = answer_of(urllib.request.Request(rig.url + "events"))
        self.assertEqual(status, 503)
        self.assertIn("too many viewers", answer["text"])
        self.assertEqual(rig.command("emergency_stop"), (200, "accepted"))  # always a place for this


class TheServer(unittest.TestCase):
    def test_takes_the_next_port_unless_one_was_asked_for(self):
        rig = Rig(self)
        first = urllib.parse.urlsplit(rig.url).port
        rig.start_dash()
        self.assertNotEqual(urllib.parse.urlsplit(rig.url).port, first)
        done = subprocess.run([BINARIES / "amb", "dash", "--http-port", str(first)], text=True,
                              capture_output=True, timeout=LIMIT_S, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn(str(first), done.stderr)

    def test_ends_at_once_with_viewers_connected(self):
        rig = Rig(self)
        stream = urllib.request.urlopen(rig.url + "events", timeout=LIMIT_S)
        self.addCleanup(stream.close)
        next(messages(stream))
        rig.dash.child.send_signal(signal.SIGINT)
        self.assertEqual(rig.dash.status(), 0)

    def test_serves_the_page_without_letting_others_frame_it(self):
        rig = Rig(self)
        with urllib.request.urlopen(rig.url, timeout=LIMIT_S) as page:
            self.assertIn("EMERGENCY STOP", page.read().decode())
            self.assertIn("frame-ancestors 'none'", page.headers["Content-Security-Policy"])
        with urllib.request.urlopen(rig.url + "third_party/uPlot.iife.min.js", timeout=LIMIT_S) as script:
            self.assertIn("javascript", script.headers["Content-Type"])
            self.assertTrue(b"leeoniya/uPlot" in script.read())


if __name__ == "__main__":
    run()

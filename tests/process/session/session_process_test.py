"""Sessions of the real processes: recorded, killed, damaged, replayed, exported, published again."""

import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from lcm_network import (BINARIES, COMMAND, CURRENT, SENSOR, TELEMETRY, Bus,  # noqa: E402
                         controller, log_events, plant, run)
from waiting import LIMIT_S, pause, until  # noqa: E402

LIFT, STOP = 1, 5
DONE, OTHER, USAGE, BAD_INPUT = 0, 1, 2, 3


def amb(folder, *arguments):
    return subprocess.run([str(BINARIES / "amb"), *map(str, arguments)], cwd=folder, text=True,
                          capture_output=True, timeout=LIMIT_S, check=False)


class Collector:
    """Counts the messages on the ports of the live processes by channel."""

    def __init__(self, *ports):
        self.counts = {}
        self.buses = [Bus(port) for port in ports]
        self.threads = [threading.Thread(target=self.listen, args=(bus,), daemon=True)
                        for bus in self.buses]
        self.stop = False
        for thread in self.threads:
            thread.start()

    def listen(self, bus):
        while not self.stop:
            for channel, _ in bus.messages(0.3):
                self.counts[channel] = self.counts.get(channel, 0) + 1

    def end(self, **least):
        """The counts, once those of the named channels are there."""
        until(lambda: all(self.counts.get(channel, 0) >= count for channel, count in least.items()),
              f"{least} on the network", lambda: self.counts)
        self.stop = True
        for thread in self.threads:
            thread.join()
        for bus in self.buses:
            bus.close()
        return self.counts


class Sessions(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        """One recorded run for all: lift, 5 s, land."""
        cls.shared = tempfile.TemporaryDirectory()
        cls.whole = Path(cls.shared.name) / "whole.lcmlog"
        with plant(cls.shared.name) as rig, controller(cls.shared.name, "--scenario", "levitate",
                                                       "--record", cls.whole) as control:
            assert control.status() == 0, control.text
            rig.status()

    @classmethod
    def tearDownClass(cls):
        cls.shared.cleanup()

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def replay(self, session, *arguments):
        """(process, the JSON it wrote)"""
        report = self.folder / "replay.json"
        done = amb(self.folder, "replay", session, "--json", report, *arguments)
        return done, json.loads(report.read_text()) if report.exists() else None

    def command(self, number):
        from levitas_msg.operator_command_t import operator_command_t
        message = operator_command_t()
        message.sequence, message.command = number, number
        bus = Bus(COMMAND)
        bus.publish("LEVITAS_COMMAND", message)
        bus.close()

    def test_recorded_run_is_reproduced_bit_for_bit(self):
        done, report = self.replay(self.whole)
        self.assertEqual(done.returncode, DONE, done.stdout + done.stderr)
        self.assertTrue(report["identical"])
        self.assertGreater(report["cycles_reproduced"], 50_000)
        cycles = sum(channel == "LEVITAS_CYCLE" for channel, _ in log_events(self.whole))
        self.assertEqual(report["cycles_reproduced"], cycles)
        self.assertGreater(report["events"], 4)  # commands and modes
        self.assertIn(f"{cycles} cycles reproduced", done.stdout)

    def killed(self, name):
        """The session of a controller that was killed is reproduced as far as it goes."""
        session = self.folder / name
        draw = random.Random(20261121)
        with plant(self.folder), controller(self.folder, "--scenario", "default", "--record",
                                            session) as control:
            control.says("levitating")
            pause(0.3 * draw.random(), "the record is whole whenever the kill comes")
            control.child.send_signal(signal.SIGKILL)
            control.child.wait()
        done, report = self.replay(session)
        self.assertEqual(done.returncode, DONE, done.stdout + done.stderr)
        self.assertGreater(report["cycles_reproduced"], 5_000)
        self.assertEqual(report["damage"]["missing_cycles"], 0)

    def test_killed_controller_leaves_a_session_that_is_reproduced(self):
        self.killed("killed.lcmlog")

    def test_killed_controller_leaves_a_packed_session_that_is_reproduced_and_says_where_it_ends(self):
        self.killed("killed.lcm.zst")
        # Whether the kill fell into a block or between two is chance: a byte less, and it is inside one.
        packed = self.folder / "killed.lcm.zst"
        packed.write_bytes(packed.read_bytes()[:-1])
        done, report = self.replay(packed)
        self.assertEqual(done.returncode, DONE, done.stdout + done.stderr)
        self.assertGreater(report["cycles_reproduced"], 5_000)
        self.assertIn("read up to its last complete one", done.stdout)

    def test_packed_recording_is_an_lcm_log_behind_zstd_and_is_reproduced_bit_for_bit(self):
        with plant(self.folder) as rig, controller(self.folder, "--scenario", "levitate", "--record",
                                                   self.folder / "run.lcm.zst") as control:
            self.assertEqual(control.status(), 0, control.text)
            rig.status()
        done, report = self.replay("run.lcm.zst")
        self.assertEqual(done.returncode, DONE, done.stdout + done.stderr)
        self.assertTrue(report["identical"])
        self.assertEqual(report["damage"]["corrupt_blocks"], 0)
        self.assertNotIn("Not everything", done.stdout)
        packed = self.folder / "run.lcm.zst"
        exported = amb(self.folder, "export", packed, "--lcm", "run.lcm", "--csv", "packed.csv")
        self.assertEqual(exported.returncode, DONE, exported.stderr)
        plain = (self.folder / "run.lcm").read_bytes()
        self.assertGreater(len(plain), 3 * packed.stat().st_size)
        # A program that nobody here wrote unpacks the same bytes.
        if shutil.which("zstd"):
            by_zstd = subprocess.run(["zstd", "-dcq", packed], capture_output=True, check=True).stdout
            self.assertTrue(by_zstd == plain)
        cycles = sum(channel == "LEVITAS_CYCLE" for channel, _ in log_events(self.folder / "run.lcm"))
        self.assertEqual(cycles, report["cycles_reproduced"])
        self.assertEqual(amb(self.folder, "export", "run.lcm", "--csv", "plain.csv").returncode, DONE)
        self.assertEqual((self.folder / "packed.csv").read_bytes(), (self.folder / "plain.csv").read_bytes())

    def test_every_command_on_a_record_takes_a_packed_one(self):
        packed = self.folder / "whole.lcm.zst"
        self.assertEqual(amb(self.folder, "export", self.whole, "--lcm", packed).returncode, DONE)
        for words in (("report", packed, "--out", "p.html"), ("simulate", packed),
                      ("export", packed, "--mat", "p.mat", "--mcap", "p.mcap"),
                      ("sessions", "add", packed, "--catalogue", "own.db")):
            done = amb(self.folder, *words)
            self.assertEqual(done.returncode, DONE, (words, done.stderr))

    def test_damage_in_the_middle_ends_the_replay_and_is_told(self):
        data = bytearray(self.whole.read_bytes())
        middle = len(data) // 2
        data[middle:middle + 4096] = bytes(4096)
        damaged = self.folder / "damaged.lcmlog"
        damaged.write_bytes(data)
        done, report = self.replay(damaged)
        self.assertEqual(done.returncode, OTHER)
        self.assertFalse(report["identical"])
        self.assertGreater(report["cycles_reproduced"], 20_000)
        self.assertGreater(report["gap"]["records_behind"], 20_000)
        self.assertIn("is missing: the replay ends before it", done.stdout)
        self.assertIn("Not everything could be read", done.stdout)
        exported = amb(self.folder, "export", damaged, "--csv", "damaged.csv")
        self.assertEqual(exported.returncode, DONE)
        rows = (self.folder / "damaged.csv").read_text().count("\n") - 1
        self.assertEqual(rows, report["cycles_reproduced"] + report["gap"]["records_behind"])

    def test_trip_file_is_for_looking_not_for_replay(self):
        session = self.folder / "tripped.lcmlog"
        with plant(self.folder), controller(self.folder, "--record", session) as control:
            control.says("rig found")
            self.command(LIFT)
            control.says("-> levitating")
            self.command(STOP)
            control.says("TRIP")
            control.terminate()  # perhaps within the 0.5 s after the trip
            self.assertEqual(control.status(), 4, control.text)
        self.assertIn("reset", control.text)
        trips = list(self.folder.glob("trip-*-emergency_stop.lcmlog"))
        self.assertEqual(len(trips), 1)
        done, _ = self.replay(trips[0])
        self.assertEqual(done.returncode, BAD_INPUT)
        self.assertIn(str(session), done.stderr)
        self.assertEqual(amb(self.folder, "export", trips[0], "--csv", "t.csv").returncode, DONE)
        rows = (self.folder / "t.csv").read_text().count("\n") - 1
        self.assertGreater(rows, 5_000)  # 0.5 s before, the trip, and some of what follows
        self.assertLessEqual(rows, 10_001)
        done, report = self.replay(session)
        self.assertEqual(done.returncode, DONE, done.stdout + done.stderr)
        self.assertTrue(report["identical"])

    def test_csv_goes_out_in_and_out_with_the_same_bytes(self):
        for step in (("export", self.whole, "--csv", "a.csv"),
                     ("import", "a.csv", "--rig", "flexible_rotor", "--out", "b.lcmlog"),
                     ("export", "b.lcmlog", "--csv", "b.csv")):
            done = amb(self.folder, *step)
            self.assertEqual(done.returncode, DONE, done.stderr)
        # Data of elsewhere know no modes: an import levitates, whatever the column says.
        columns = [(self.folder / name).read_text().splitlines() for name in ("a.csv", "b.csv")]
        first, second = ([row.rsplit(",", 1)[0] for row in rows] for rows in columns)
        self.assertTrue(columns[0][0].endswith(",mode"), columns[0][0])
        self.assertEqual(first, second)

    def test_another_controller_is_compared(self):
        done, report = self.replay(self.whole, "--controller", "flexible_rotor_commissioned",
                                   "--csv", "both.csv")
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.assertGreater(report["compared"], 50_000)
        lines = (self.folder / "both.csv").read_text().splitlines()
        self.assertEqual(len(lines), report["compared"] + 1)
        self.assertTrue(lines[0].startswith("time_s,recorded_de_x_a,"))
        self.assertTrue(lines[0].endswith(",other_nde_y_a"))

    def test_published_session_is_seen_on_the_live_channels(self):
        bus = Collector(SENSOR, CURRENT, TELEMETRY)
        done, report = self.replay(self.whole, "--publish", "--speed", 4)
        # A listener in Python may be too slow for all of them; what is proven is where they go.
        bus.end(LEVITAS_SENSOR=1000, LEVITAS_CURRENT=1000, LEVITAS_STATE=100, LEVITAS_EVENT=4)
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.assertEqual(report["failed"], 0)
        self.assertGreater(report["cycles"], 50_000)

    @unittest.skipUnless(shutil.which("lcm-logplayer"), "lcm-logplayer is not installed")
    def test_lcm_logplayer_plays_the_session(self):
        bus = Collector(SENSOR)
        environment = dict(os.environ, LCM_DEFAULT_URL="udpm://239.255.76.67:7667?ttl=0")
        played = subprocess.run(["lcm-logplayer", "--speed=4", str(self.whole)],
                                env=environment, capture_output=True, timeout=LIMIT_S, check=False)
        self.assertEqual(played.returncode, 0, played.stderr)
        bus.end(LEVITAS_CYCLE=1001, LEVITAS_EVENT=4)

    def test_exit_statuses_follow_the_contract(self):
        text = self.folder / "text.csv"
        text.write_text("time_s,position_de_x_m\n0,oops\n")
        for status, words, arguments in (
                (USAGE, "SESSION is required", ("replay",)),
                (USAGE, "--csv", ("export", self.whole)),
                (USAGE, "--controller", ("replay", self.whole, "--csv", "x.csv")),
                (BAD_INPUT, "No such file", ("replay", "absent.lcmlog")),
                (BAD_INPUT, "not a session", ("export", text, "--csv", "x.csv")),
                (BAD_INPUT, "columns missing", ("import", text, "--rig", "flexible_rotor", "--out",
                                                "x.lcmlog")),
                (BAD_INPUT, "cannot be", ("import", text, "--rig", "no_such_rig", "--out", "x")),
        ):
            done = amb(self.folder, *arguments)
            self.assertEqual(done.returncode, status, (arguments, done.stdout, done.stderr))
            if words != "cannot be":
                self.assertIn(words, done.stderr + done.stdout)


if __name__ == "__main__":
    run()

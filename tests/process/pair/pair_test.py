"""amb-controller and amb-plant as two processes on one LCM network."""

import json
import random
import sys
import tempfile
import threading
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from lcm_network import (COMMAND, CURRENT, SENSOR, Bus, controller, log_events,  # noqa: E402
                         plant, run, short_message)


class Pair(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def levitate(self, seed=1, session="session.lcmlog"):
        """Lift, five seconds, land; returns the cycle records and the controller's statistics."""
        with plant(self.folder, "--seed", seed, "--json", "plant.json") as rig, \
                controller(self.folder, "--scenario", "levitate", "--record", session, "--seed",
                           seed, "--json", "controller.json") as control:
            self.assertEqual(control.status(), 0, control.text)
            self.assertEqual(rig.status(), 0, rig.text)
        records = [data for channel, data in log_events(self.folder / session)
                   if channel == "LEVITAS_CYCLE"]
        return records, json.loads((self.folder / "controller.json").read_text())

    def test_lifts_and_lands_in_lockstep(self):
        records, statistics = self.levitate()
        self.assertEqual(len(records), statistics["cycles"])
        self.assertGreater(statistics["cycles"], 50_000)  # the scenario levitates for 5 s
        for count in ("messages_lost", "records_lost", "missing_frames", "skipped_periods",
                      "frames_rejected", "trips"):
            self.assertEqual(statistics[count], 0, count)
        rig = json.loads((self.folder / "plant.json").read_text())
        self.assertEqual(rig["messages_lost"], 0)
        # Where the last current and the goodbye wait together, on a busy machine, the rig takes the
        # newer of them: the goodbye, and counts the other as skipped.
        last = min(rig["currents_skipped"], 1)
        self.assertIn(statistics["cycles"] - rig["cycles"], {0, last})

    def test_same_seed_gives_the_same_bits_and_another_seed_does_not(self):
        first, _ = self.levitate(seed=7, session="first.lcmlog")
        second, _ = self.levitate(seed=7, session="second.lcmlog")
        other, _ = self.levitate(seed=8, session="other.lcmlog")
        self.assertEqual(first, second)
        self.assertNotEqual(first, other)

    def test_rubbish_on_the_bus_changes_nothing(self):
        clean, _ = self.levitate(session="clean.lcmlog")
        stop = threading.Event()

        def pollute():
            draw = random.Random(20261121)
            buses = [Bus(port) for port in (SENSOR, CURRENT, COMMAND)]
            while not stop.wait(0.001):
                noise = draw.randbytes(draw.randrange(200))
                kind = draw.randrange(5)
                data = (noise, b"LC03" + noise, short_message("LEVITAS_SENSOR", noise),
                        short_message("LEVITAS_CURRENT", noise),
                        short_message("LEVITAS_COMMAND", noise))[kind]
                draw.choice(buses).send(data)
            for bus in buses:
                bus.close()

        thread = threading.Thread(target=pollute)
        thread.start()
        try:
            polluted, statistics = self.levitate(session="polluted.lcmlog")
        finally:
            stop.set()
            thread.join()
        self.assertGreater(statistics["frames_rejected"], 0)
        self.assertEqual(clean, polluted)

    def test_either_may_be_started_first(self):
        with controller(self.folder, "--scenario", "levitate") as control:
            control.says("no sensor frames at udpm://239.255.76.67:7667?ttl=0")
            with plant(self.folder) as rig:
                self.assertEqual(control.status(), 0, control.text)
                self.assertEqual(rig.status(), 0, rig.text)
        with plant(self.folder) as rig:
            rig.says("no controller answers at udpm://239.255.76.67:7668?ttl=0")
            with controller(self.folder, "--scenario", "levitate") as control:
                self.assertEqual(control.status(), 0, control.text)
                self.assertEqual(rig.status(), 0, rig.text)

    def test_real_time_ends_by_itself_and_accounts_for_every_period(self):
        with plant(self.folder, "--pace", "realtime") as rig, \
                controller(self.folder, "--pace", "realtime", "--duration", 1, "--json",
                           "controller.json") as control:
            # A machine too busy for real time may trip (4), but must say so and end.
            self.assertIn(control.status(), (0, 4), control.text)
            self.assertEqual(rig.status(), 0, rig.text)
        statistics = json.loads((self.folder / "controller.json").read_text())
        blamed = statistics["timing"]["blamed"]
        self.assertEqual(sum(blamed.values()), statistics["overruns"])
        self.assertGreaterEqual(statistics["skipped_periods"], statistics["overruns"])
        self.assertEqual(statistics["timing"]["wakeup"]["count"], statistics["cycles"])


if __name__ == "__main__":
    run()

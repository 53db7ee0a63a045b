"""LCM's own logger and log player, at work on a pair of our programs."""

import shutil
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from lcm_network import (SENSOR, SKIPPED, TELEMETRY, Bus, Process, controller,  # noqa: E402
                         listens, log_events, plant, run, short_message)
from waiting import until  # noqa: E402

LOGGER, PLAYER = shutil.which("lcm-logger"), shutil.which("lcm-logplayer")


def url(port):
    return f"--lcm-url=udpm://239.255.76.67:{port}?ttl=0"


class LcmTools(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def record_with_logger(self):
        """One run with lcm-logger on the sensor and the telemetry port."""
        loggers = [Process(self.folder, LOGGER, url(port), f"{port}.log")
                   for port in (SENSOR, TELEMETRY)]
        for logger, port in zip(loggers, (SENSOR, TELEMETRY)):
            self.addCleanup(logger.kill)
            until(lambda port=port: listens(port), f"lcm-logger on port {port}",
                  lambda logger=logger: logger.said_so_far)
        with plant(self.folder) as rig, controller(self.folder, "--scenario", "levitate",
                                                   "--record", "session.lcmlog") as control:
            self.assertEqual(control.status(), 0, control.text)
            self.assertEqual(rig.status(), 0, rig.text)
        # What was sent may still lie in the logger's socket, or in its buffer until the next message
        # comes. Messages keep their order: once it has written a last one of ours, it has written
        # all that it took.
        bus = Bus(TELEMETRY)
        self.addCleanup(bus.close)
        written = self.folder / f"{TELEMETRY}.log"

        def marked():
            bus.send(short_message("END_OF_RUN", b""))
            return written.exists() and b"END_OF_RUN" in written.read_bytes()

        until(marked, f"a last message in {written}")
        for logger in loggers:
            logger.terminate()
            logger.status()

    def session_records(self):
        from levitas_msg.cycle_record_t import cycle_record_t
        records = (cycle_record_t.decode(data)
                   for channel, data in log_events(self.folder / "session.lcmlog")
                   if channel == "LEVITAS_CYCLE")
        return {record.cycle: record for record in records}

    def test_logger_records_what_our_programs_sent_and_the_types_read_it(self):
        from levitas_msg.controller_state_t import controller_state_t
        from levitas_msg.event_t import event_t
        from levitas_msg.loop_timing_t import loop_timing_t
        from levitas_msg.sensor_frame_t import sensor_frame_t
        self.record_with_logger()
        session = self.session_records()
        telemetry = list(log_events(self.folder / f"{TELEMETRY}.log"))
        states = [controller_state_t.decode(d) for c, d in telemetry if c == "LEVITAS_STATE"]
        self.assertGreater(len(states), 100)
        for state in states:
            record = session[state.cycle]
            self.assertEqual(state.time_ns, record.sample_time_ns)
            self.assertEqual(state.mode, record.mode)
            self.assertEqual(tuple(state.position_m), tuple(record.position_m))
            self.assertEqual(tuple(state.control_current_a), tuple(record.control_current_a))
        timing = [loop_timing_t.decode(d) for c, d in telemetry if c == "LEVITAS_TIMING"]
        self.assertEqual([t.cycle for t in timing], [10_000 * (n + 1) for n in range(len(timing))])
        events = [event_t.decode(d).text for c, d in telemetry if c == "LEVITAS_EVENT"]
        self.assertTrue(any("lift -> levitating" in text for text in events), events)
        # At this rate lcm-logger loses messages without a word; what it keeps must be right.
        frames = [sensor_frame_t.decode(d)
                  for c, d in log_events(self.folder / f"{SENSOR}.log") if c == "LEVITAS_SENSOR"]
        self.assertGreater(len(frames), 1000)
        # The very last frame is answered by the goodbye, so no cycle knows it.
        for frame in (f for f in frames if f.cycle in session):
            self.assertEqual(tuple(frame.position_m), tuple(session[frame.cycle].position_m))

    def test_log_player_plays_the_log_back_byte_for_byte(self):
        self.record_with_logger()
        log = [(c, d) for c, d in log_events(self.folder / f"{TELEMETRY}.log")]
        bus = Bus(TELEMETRY + 1000)
        self.addCleanup(bus.close)
        player = Process(self.folder, PLAYER, url(bus.port), f"{TELEMETRY}.log")
        self.addCleanup(player.kill)
        played = []
        for message in bus.messages():
            played.append(message)
            if len(played) == len(log):
                break
        self.assertEqual(played, log)

    def test_log_player_plays_a_session_of_ours(self):
        with plant(self.folder) as rig, controller(self.folder, "--duration", 0.2, "--record",
                                                   "session.lcmlog") as control:
            self.assertEqual(control.status(), 0, control.text)
            self.assertEqual(rig.status(), 0, rig.text)
        cycles = [d for c, d in log_events(self.folder / "session.lcmlog") if c == "LEVITAS_CYCLE"]
        bus = Bus(TELEMETRY + 1000)
        self.addCleanup(bus.close)
        player = Process(self.folder, PLAYER, url(bus.port), "session.lcmlog")
        self.addCleanup(player.kill)
        channels = {}
        for channel, payload in bus.messages():
            channels.setdefault(channel, []).append(payload)
            if len(channels.get("LEVITAS_CYCLE", [])) == len(cycles):
                break
        self.assertEqual(channels["LEVITAS_CYCLE"], cycles)
        self.assertIn("LEVITAS_HEADER", channels)


if __name__ == "__main__":
    if LOGGER is None or PLAYER is None:
        print("not run: lcm-logger and lcm-logplayer are not installed (package liblcm-bin)")
        sys.exit(SKIPPED)
    run()

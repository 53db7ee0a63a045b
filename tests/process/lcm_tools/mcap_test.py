"""amb export --mcap, read by the format's own library.

Not run (status 77) where that library, PyPI mcap, is neither here nor to be had.
"""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from lcm_network import BINARIES, BUILD, controller, plant, run  # noqa: E402
from python_lcm_test import provide_package  # noqa: E402
from waiting import LIMIT_S  # noqa: E402

VENV = BUILD / "python-mcap"
PACKAGES = ("mcap==1.6.0", "mcap-protobuf-support==0.6.0", "protobuf==7.36.2")


class Mcap(unittest.TestCase):
    def exported(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        folder = Path(folder.name)
        with plant(folder) as rig, controller(folder, "--scenario", "levitate", "--record",
                                              "session.lcm") as control:
            self.assertEqual(control.status(), 0, control.text)
            self.assertEqual(rig.status(), 0, rig.text)
        done = subprocess.run([BINARIES / "amb", "export", "session.lcm", "--mcap", "s.mcap",
                               "--json", "s.json"], cwd=folder, capture_output=True, text=True,
                              timeout=LIMIT_S, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return folder / "s.mcap", json.loads((folder / "s.json").read_text())

    def test_is_whole_and_says_what_it_holds(self):
        from mcap.reader import make_reader

        path, report = self.exported()
        with path.open("rb") as file:
            reader = make_reader(file, validate_crcs=True)
            summary = reader.get_summary()
            topics = {channel.topic: number for number, channel in summary.channels.items()}
            counts = summary.statistics.channel_message_counts
            self.assertEqual(counts[topics["/levitas/cycle"]], report["rows"])
            self.assertGreater(counts[topics["/levitas/event"]], 3)
            messages = list(reader.iter_messages())
            self.assertEqual(len(messages), summary.statistics.message_count)
            times = [message.log_time for _, _, message in messages]
            self.assertEqual(times, sorted(times))
            self.assertIn("flexible_rotor", next(reader.iter_metadata()).metadata["rig"])

    def test_decodes_with_the_types_that_it_carries(self):
        from mcap.reader import make_reader
        from mcap_protobuf.decoder import DecoderFactory

        path, report = self.exported()
        with path.open("rb") as file:
            reader = make_reader(file, decoder_factories=[DecoderFactory()])
            rows = [row for _, _, _, row in reader.iter_decoded_messages(["/levitas/cycle"])]
            file.seek(0)
            texts = [event.text for _, _, _, event in
                     make_reader(file, decoder_factories=[DecoderFactory()])
                     .iter_decoded_messages(["/levitas/event"])]
        self.assertEqual(len(rows), report["rows"])
        # 10 kHz: a tenth of a millisecond apart, to rounding.
        self.assertAlmostEqual(rows[1].time_s - rows[0].time_s, 1e-4, places=12)
        self.assertGreater(abs(rows[0].position_de_x_m), 1e-6)  # it rests on its touchdown bearings
        self.assertTrue(any("levitating" in text for text in texts))


if __name__ == "__main__":
    if not os.environ.get("LEVITAS_TEST_NAMESPACE"):
        package_python = provide_package(VENV, "mcap_protobuf", PACKAGES)
        if Path(sys.prefix) != VENV.resolve():
            os.execv(package_python, [str(package_python), "-B", *sys.argv])
    run()

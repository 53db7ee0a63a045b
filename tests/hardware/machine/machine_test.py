"""What the hardware tests rely on in the place they run in (CONTRIBUTING.md)."""

import os
import pathlib
import socket
import struct
import subprocess
import sys
import time
import unittest

sys.path.insert(0, os.environ["LEVITAS_SOURCE"] + "/tests/support")
from waiting import LIMIT_S  # noqa: E402

VIRTUAL = os.environ["LEVITAS_TEST_MACHINE"] == "virtual"
GPIO_SIM = pathlib.Path("/sys/kernel/config/gpio-sim")
FRAME = struct.Struct("=IB3x8s")


def ip(*words):
    subprocess.run(["ip", *words], check=True)


class Bus(unittest.TestCase):
    def test_a_frame_written_to_vcan_is_read_by_another_socket(self):
        ip("link", "add", "dev", "machine0", "type", "vcan")
        self.addCleanup(ip, "link", "del", "machine0")
        ip("link", "set", "machine0", "up")
        with socket.socket(socket.PF_CAN, socket.SOCK_RAW, socket.CAN_RAW) as writer, \
                socket.socket(socket.PF_CAN, socket.SOCK_RAW, socket.CAN_RAW) as reader:
            writer.bind(("machine0",))
            reader.bind(("machine0",))
            reader.settimeout(LIMIT_S)
            writer.send(FRAME.pack(0x123, 3, b"abc"))
            identifier, length, data = FRAME.unpack(reader.recv(FRAME.size))
        self.assertEqual((identifier, data[:length]), (0x123, b"abc"))

    def test_multicast_has_a_route(self):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            self.assertEqual(sender.sendto(b"x", ("239.255.76.67", 7667)), 1)


class Lines(unittest.TestCase):
    def test_a_simulated_chip_follows_its_pulls(self):
        bank = GPIO_SIM / "machine_test" / "bank0"
        bank.mkdir(parents=True)
        self.addCleanup(bank.parent.rmdir)
        self.addCleanup(bank.rmdir)
        live = bank.parent / "live"
        (bank / "num_lines").write_text("4")
        live.write_text("1")
        self.addCleanup(live.write_text, "0")
        device = pathlib.Path("/sys/devices/platform") / (bank.parent / "dev_name").read_text().strip()
        line = device / (bank / "chip_name").read_text().strip() / "sim_gpio2"
        for pull, value in (("pull-up", "1"), ("pull-down", "0")):
            (line / "pull").write_text(pull)
            self.assertEqual((line / "value").read_text().strip(), value)


@unittest.skipUnless(VIRTUAL, "this kernel's time is real")
class VirtualTime(unittest.TestCase):
    def test_an_hour_of_sleep_takes_an_hour_of_its_own_clock_and_none_of_ours(self):
        start_s = time.monotonic()
        time.sleep(3600)
        # 1 ms: some hundred readings of the clock at 0.26 us, the interpreter's between them.
        self.assertAlmostEqual(time.monotonic() - start_s, 3600, delta=1e-3)

    def test_a_busy_program_does_not_see_time_pass(self):
        start_s = time.monotonic()
        for _ in range(1_000_000):
            pass
        self.assertLess(time.monotonic() - start_s, 1e-3)

    def test_temporary_files_are_kept_in_memory(self):
        mounts = dict(line.split()[1:3] for line in pathlib.Path("/proc/mounts").read_text().splitlines())
        self.assertEqual((mounts["/tmp"], mounts["/dev/shm"]), ("tmpfs", "tmpfs"))


if __name__ == "__main__":
    unittest.main(verbosity=2)

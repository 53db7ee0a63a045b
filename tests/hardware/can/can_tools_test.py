"""Programs nobody here wrote on the bus: candump, canplayer, cantools, python-can.

candump and canplayer are Debian's can-utils; cantools and python-can come from PyPI (versions in
tests/support/python_tools.py). What is not installed is not run, by name.
"""

import json
import os
import pathlib
import shutil
import socket
import struct
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["LEVITAS_SOURCE"])
sys.path.insert(0, str(SOURCE / "tests/support"))
import python_tools  # noqa: E402 -- found through the line above
from lcm_network import BINARIES, Process  # noqa: E402
from waiting import LIMIT_S, until  # noqa: E402

TOOLS = python_tools.find()
LAST = 0x7FE  # an identifier of nobody
SCENARIO = """kind: scenario
name: lift
steps:
  - {do: lift, until: levitating, timeout_s: 5}
  - {do: land, until: off, timeout_s: 5}
"""


def hears(interface, programs):
    """Waits until so many sockets listen to a CAN interface (receive lists of the kernel)."""
    def count():
        table = pathlib.Path("/proc/net/can")
        return sum(line.split()[:1] == [interface] for name in ("rcvlist_all", "rcvlist_fil", "rcvlist_sff")
                   for line in (table / name).read_text(encoding="utf-8").splitlines())
    until(lambda: count() >= programs, f"a listener on {interface}",
          lambda: (pathlib.Path("/proc/net/can/rcvlist_all")).read_text(encoding="utf-8"))


@unittest.skipUnless(shutil.which("candump"), "can-utils is not installed")
class RecordedWithCandump(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        subprocess.run("ip link add dev vcan0 type vcan; ip link set vcan0 mtu 72 up", shell=True,
                       check=True)
        cls.folder = pathlib.Path(tempfile.mkdtemp())
        cls.scenario = cls.folder / "lift.yaml"
        cls.scenario.write_text(SCENARIO, encoding="utf-8")
        cls.session = cls.folder / "run.lcm"
        dump = Process(cls.folder, shutil.which("candump"), "-L", "-r", "8000000", "vcan0")
        hears("vcan0", 1)
        rig = Process(cls.folder, "amb-rig", "--rig", "flexible_rotor", "--port", "can:vcan0")
        control = cls.controller("--record", cls.session)
        assert control.status() == 0, control.text
        rig.status()
        # Frames of a bus keep their order: behind one of ours candump has heard all of theirs.
        with socket.socket(socket.PF_CAN, socket.SOCK_RAW, socket.CAN_RAW) as ours:
            ours.bind(("vcan0",))
            ours.send(struct.pack("=IB3x8s", LAST, 0, b""))
        heard = dump.says(f"{LAST:03X}#")
        dump.terminate()
        dump.status()
        cls.log = cls.folder / "run.log"
        cls.log.write_text(heard[:heard.rindex("\n") + 1], encoding="utf-8")

    @classmethod
    def controller(cls, *more):
        return Process(cls.folder, "amb-controller", "--rig", "flexible_rotor", "--controller",
                       "flexible_rotor_commissioned", "--scenario", cls.scenario, "--port",
                       "can:vcan0", "--trip-folder", cls.folder, *more)

    def amb(self, *words):
        result = subprocess.run([BINARIES / "amb", *map(str, words)], capture_output=True, text=True,
                                check=False)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return result.stdout

    def csv(self, session):
        table = self.folder / "table.csv"
        self.amb("export", session, "--csv", table)
        return table.read_text(encoding="utf-8").splitlines()

    def test_the_log_imports_as_the_session_that_the_controller_recorded(self):
        imported = self.folder / "imported.lcm"
        facts = self.folder / "import.json"
        self.amb("import", self.log, "--rig", "flexible_rotor", "--out", imported, "--json", facts)
        facts = json.loads(facts.read_text(encoding="utf-8"))
        self.assertEqual((facts["missing_samples"], facts["damaged"]), (0, 0))
        ours, theirs = self.csv(self.session), self.csv(imported)
        self.assertEqual(ours[0], theirs[0])
        self.assertLessEqual(abs(len(ours) - len(theirs)), 1)
        places = [at for at, name in enumerate(ours[0].split(",")) if name.startswith("position_")]
        for mine, other in zip(ours[1:], theirs[1:]):
            mine, other = mine.split(","), other.split(",")
            self.assertEqual([mine[at] for at in places], [other[at] for at in places])

    @unittest.skipUnless(TOOLS, "cantools is not installed")
    def test_cantools_decodes_every_signal_as_we_do(self):
        sys.path.insert(0, str(TOOLS))
        import cantools
        dbc = self.folder / "rig.dbc"
        self.amb("can-dbc", "--rig", "flexible_rotor", "--out", dbc)
        database = cantools.database.load_file(dbc)
        rows = self.csv(self.session)
        names = rows[0].split(",")
        table = {}
        decoded = 0
        for line in self.log.read_text(encoding="utf-8").splitlines():
            identifier, _, data = line.split()[2].partition("##")
            if identifier != "110" or decoded >= 2000:
                continue
            values = database.decode_message(0x110, bytes.fromhex(data[1:]))
            if values["cycle"] not in table:
                table[values["cycle"]] = values
            decoded += 1
        units = {"m": 1.0, "um": 1e6, "mm": 1e3}
        for cycle in range(min(1000, len(rows) - 1)):
            row = dict(zip(names, rows[cycle + 1].split(",")))
            for name, text in row.items():
                if not name.startswith("position_"):
                    continue
                signal, unit = name.rsplit("_", 1)
                # The text of our export has 9 digits or more.
                self.assertAlmostEqual(float(text), table[cycle][signal] * units[unit],
                                       delta=1e-6 * units[unit] * 1e-3)
        self.assertGreater(decoded, 1000)

    @unittest.skipUnless(shutil.which("canplayer"), "can-utils is not installed")
    def test_canplayer_feeds_a_listening_controller_that_answers_as_before(self):
        again = self.folder / "again.lcm"
        # What the rig said, without the answers: those the controller gives anew. canplayer looks at
        # its clock once a millisecond and sends in bursts what is due, so frames are put 2 ms apart.
        spoken = self.folder / "rig_only.log"
        said = [line.split() for line in self.log.read_text(encoding="utf-8").splitlines()]
        said = [words for words in said if words[2].startswith("110#")]
        spoken.write_text("".join(f"({1.0 + 0.002 * i:.6f}) {words[1]} {words[2]}\n"
                                  for i, words in enumerate(said)), encoding="utf-8")
        listener = self.controller("--record", again, "--partner-timeout", "3")
        hears("vcan0", 1)
        subprocess.run(["canplayer", "-I", spoken, "-g", "1"], check=True, timeout=LIMIT_S)
        listener.status()
        first, second = self.csv(self.session), self.csv(again)
        same = 0
        for mine, other in zip(first[1:], second[1:]):
            if mine != other:
                break
            same += 1
        print(f"canplayer: {same} of {len(first) - 1} answers equal")
        self.assertGreater(same, 0.99 * (len(first) - 1))

    @unittest.skipUnless(TOOLS, "python-can is not installed")
    def test_python_can_is_a_rig_for_our_controller(self):
        sys.path.insert(0, str(TOOLS))
        import can
        import cantools
        dbc = self.folder / "rig.dbc"
        self.amb("can-dbc", "--rig", "flexible_rotor", "--out", dbc)
        database = cantools.database.load_file(dbc)
        listener = self.controller("--partner-timeout", "2")
        bus = can.Bus("vcan0", interface="socketcan", fd=True)
        hears("vcan0", 2)
        answers = []
        for cycle in range(50):
            data = bytearray(database.encode_message(0x110, {
                "checksum": 0, "alive_counter": cycle % 15, "cycle": cycle, "session": 1, "speed": 0,
                "angle": 0, "emergency_stop": 0, "amplifier_fault": 0, "current_held": 0,
                "amplifiers_off": 1, **{f"position_{axis}": (cycle % 7 - 3) * 2e-8 - 1.3e-4
                                        for axis in ("de_x", "de_y", "nde_x", "nde_y")}}))
            data[0] = python_tools.crc8(bytes([0x10, 0x01]) + bytes(data[1:]))
            bus.send(can.Message(arbitration_id=0x110, data=data, is_fd=True,
                                 is_extended_id=False))
            while (message := bus.recv(2)) is not None:
                if message.arbitration_id == 0x100:
                    answers.append(database.decode_message(0x100, bytes(message.data)))
                    break
        bus.shutdown()
        listener.status()
        self.assertEqual([answer["cycle"] for answer in answers], list(range(50)))
        self.assertEqual([answer["alive_counter"] for answer in answers],
                         [cycle % 15 for cycle in range(50)])


if __name__ == "__main__":
    unittest.main(verbosity=2)

"""The Python package: what it reads of a run is what `amb export` writes, and its functions are the programs'.

Not run (status 77) where no interpreter has numpy, which the package needs.
"""

import lzma
import os
import subprocess
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path

SOURCE = Path(os.environ["LEVITAS_SOURCE"])
sys.path.insert(0, str(SOURCE / "tests/support"))
sys.path.insert(0, str(SOURCE / "python"))
from interpreter import go_on_with  # noqa: E402

go_on_with("numpy")

from lcm_network import BINARIES  # noqa: E402
from waiting import LIMIT_S  # noqa: E402

import backend  # noqa: E402
import numpy  # noqa: E402

SHORT = """kind: scenario
name: short
steps:
  - {do: lift, until: levitating, timeout_s: 5, hold_s: 0.6}
  - {do: spin, speed_rpm: 600, acceleration_rpm_per_s: 1000, until: speed_reached, timeout_s: 6, hold_s: 0.2}
  - {do: spin, speed_rpm: 0, acceleration_rpm_per_s: 1000, until: standstill, timeout_s: 6, hold_s: 0.3}
  - {do: land, until: off, timeout_s: 5}
"""


def installed(folder):
    """The wheel as it would be installed: nothing of the clone is imported."""
    name = backend.build_wheel(folder)
    with zipfile.ZipFile(Path(folder) / name) as wheel:
        assert wheel.testzip() is None
        wheel.extractall(Path(folder) / "site")
    sys.path.insert(0, str(Path(folder) / "site"))
    import levitas
    assert Path(levitas.__file__).is_relative_to(folder), levitas.__file__
    return levitas


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.scratch.cleanup)
        cls.folder = Path(cls.scratch.name)
        os.environ["LEVITAS_AMB"] = str(BINARIES / "amb")
        cls.levitas = installed(cls.folder)
        (cls.folder / "short.yaml").write_text(SHORT, encoding="utf-8")
        cls.verdict = cls.levitas.run(check=False, scenario=cls.folder / "short.yaml", rig="flexible_rotor",
                                      controller="flexible_rotor_commissioned", record=cls.folder / "run.lcm")
        for kind, name in (("--csv", "run.csv"), ("--mcap", "run.mcap")):
            subprocess.run([BINARIES / "amb", "export", "run.lcm", kind, name], cwd=cls.folder, check=True,
                           capture_output=True, timeout=LIMIT_S)
        (cls.folder / "run.csv.xz").write_bytes(lzma.compress((cls.folder / "run.csv").read_bytes(), preset=0))
        cls.run_ = cls.levitas.load(cls.folder / "run.lcm")

    def test_a_session_has_the_columns_and_the_bits_of_its_export(self):
        for name in ("run.csv", "run.csv.xz", "run.mcap"):
            exported = self.levitas.load(self.folder / name)
            for column in exported.names:
                with self.subTest(f"{name} {column}"):
                    # A CSV file has twelve digits of the one, an MCAP file another rounding of both.
                    if column == "speed_rpm" or (column, name) == ("time_s", "run.mcap"):
                        numpy.testing.assert_allclose(exported[column], self.run_[column], rtol=1e-11, atol=1e-9)
                    else:
                        numpy.testing.assert_array_equal(exported[column], self.run_[column])

    def packed(self, name):
        """The same run packed, as a recorder would have left it."""
        path = self.folder / name
        subprocess.run([BINARIES / "amb", "export", "run.lcm", "--lcm", name], cwd=self.folder, check=True,
                       capture_output=True, timeout=LIMIT_S)
        return path

    def test_a_packed_session_is_the_same_session(self):
        session = self.levitas.load(self.packed("run.lcm.zst"))
        numpy.testing.assert_array_equal(session.records, self.run_.records)
        self.assertEqual(session.events, self.run_.events)

    def test_a_packed_session_that_is_cut_off_is_read_up_to_there_and_says_so(self):
        path = self.packed("cut.lcm.zst")
        whole = path.read_bytes()
        path.write_bytes(whole[:len(whole) // 2])
        with self.assertWarnsRegex(UserWarning, "cut off or damaged"):
            session = self.levitas.load(path)
        self.assertGreater(len(session), len(self.run_) // 3)
        self.assertLess(len(session), len(self.run_))
        numpy.testing.assert_array_equal(session.records, self.run_.records[:len(session.records)])

    def test_a_session_says_what_ran(self):
        self.assertEqual(self.run_.channels, ["de_x", "de_y", "nde_x", "nde_y"])
        self.assertEqual(self.run_.pace, "lockstep")
        self.assertEqual(self.run_.period_s, 1e-4)
        self.assertIn("flexible_rotor", self.run_.rig_yaml)
        self.assertIn("kind: controller", self.run_.controller_yaml)
        self.assertEqual(self.run_.damaged, 0)
        self.assertIn("off -> self_test", [text.split(" (")[0] for _, text in self.run_.events])
        spinning = self.run_["speed_rpm"][self.run_.modes == "spinning"]
        self.assertGreater(spinning.max(), 500.0)
        self.assertEqual(self.run_.records.dtype["position_m"].shape, (4,))

    def test_a_stretch_holds_its_rows_and_what_ran(self):
        part = self.run_.between(1.0, 1.1)
        self.assertEqual(len(part), 1001)
        self.assertEqual((part.time_s[0], part.time_s[-1]), (1.0, 1.1))
        self.assertEqual(part.rig_yaml, self.run_.rig_yaml)

    def test_a_damaged_record_is_left_out_and_counted(self):
        data = bytearray((self.folder / "run.lcm").read_bytes())
        data[len(data) // 2] ^= 0x10
        (self.folder / "bad.lcm").write_bytes(data)
        damaged = self.levitas.load(self.folder / "bad.lcm")
        self.assertLess(len(damaged), len(self.run_))
        self.assertGreater(len(damaged), len(self.run_) - 5)

    def test_a_damaged_event_costs_itself_alone(self):
        data = bytearray((self.folder / "run.lcm").read_bytes())
        text = data.index(b"off -> self_test")
        data[text - 4:text] = b"\x7f\xff\xff\xff"  # the length that stands before it
        (self.folder / "event.lcm").write_bytes(data)
        damaged = self.levitas.load(self.folder / "event.lcm")
        self.assertEqual(damaged.damaged, 1)
        self.assertEqual(len(damaged.events), len(self.run_.events) - 1)
        self.assertEqual(len(damaged), len(self.run_))

    def test_what_is_no_run_is_refused_with_the_reason(self):
        for name, data, said in (("a.bin", b"nothing", "neither a session"), ("a.csv", b"a,b\n1,2\n", "no column 'time_s'"),
                                 ("a.lcm", b"\xed\xa1\xda\x01" + bytes(40), "without a header")):
            (self.folder / name).write_bytes(data)
            with self.subTest(name), self.assertRaisesRegex(self.levitas.Unreadable, said):
                self.levitas.load(self.folder / name)
        with self.assertRaisesRegex(KeyError, "no column 'speed'; there are: time_s"):
            self.run_["speed"]

    def test_functions_return_the_json_of_the_programs(self):
        self.assertEqual(self.verdict["schema"].split("_")[0], "levitas")
        found = self.levitas.margins(rig="flexible_rotor", controller="flexible_rotor_commissioned", speeds="0")
        self.assertEqual([axis["channel"] for axis in found["speeds"][0]["axes"]], self.run_.channels)
        self.assertLess(found["speeds"][0]["axes"][0]["sensitivity_peak"], 3.0)

    def test_a_command_that_fails_raises_with_its_status_and_words(self):
        with self.assertRaises(self.levitas.Failed) as failed:
            self.levitas.margins(rig="absent")
        self.assertEqual(failed.exception.status, 3)
        self.assertIn("absent", failed.exception.stderr)

    def test_the_wheel_is_the_same_twice(self):
        other = self.folder / "again"
        other.mkdir()
        name = backend.build_wheel(other)
        self.assertEqual((other / name).read_bytes(), (self.folder / name).read_bytes())

    def test_pip_installs_it_without_a_network(self):
        if subprocess.run([sys.executable, "-m", "pip", "--version"], capture_output=True, check=False).returncode:
            self.skipTest("no pip")
        done = subprocess.run([sys.executable, "-m", "pip", "install", "--no-index", "--no-deps", "--quiet",
                               "--target", self.folder / "pip", SOURCE / "python"],
                              capture_output=True, text=True, check=False, timeout=LIMIT_S,
                              env={**os.environ, "PIP_DISABLE_PIP_VERSION_CHECK": "1"})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue((self.folder / "pip/levitas/session.py").exists())


if __name__ == "__main__":
    unittest.main()

"""amb diagnose on a run of the very model it is given: lift, flight and landing, nothing wrong.

Whole runs as a newcomer records them. Contact, amplifiers that are off and the zeros of a rotor that
lies in its touchdown bearings are in them and must not be taken for a cause.
"""

import json
import os
import subprocess
import unittest
from pathlib import Path
from tempfile import TemporaryDirectory

BINARIES = Path(os.environ["LEVITAS_BINARIES"])


def amb(folder, *arguments):
    done = subprocess.run([str(BINARIES / "amb"), *map(str, arguments)], cwd=folder, text=True,
                          capture_output=True, timeout=500, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


class DiagnoseOwnModel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.shared = TemporaryDirectory()
        amb(cls.shared.name, "run", "--record", "run.lcm")
        amb(cls.shared.name, "export", "run.lcm", "--csv", "run.csv")

    @classmethod
    def tearDownClass(cls):
        cls.shared.cleanup()

    def diagnose(self, data):
        out = Path(self.shared.name) / ("answer_" + data.replace(".", "_"))
        printed = amb(self.shared.name, "diagnose", "--quick", "--rig", "flexible_rotor", data,
                      "--out", out)
        return printed, json.loads((out / "diagnosis.json").read_text())

    def test_a_session_of_the_model_itself_has_no_cause(self):
        printed, answer = self.diagnose("run.lcm")
        self.assertEqual(answer["verdict"], "none", printed)
        self.assertEqual(answer["all_causes"], [], printed)

    def test_a_csv_of_the_same_run_lift_to_landing_has_no_cause(self):
        printed, answer = self.diagnose("run.csv")
        self.assertEqual(answer["verdict"], "none", printed)


if __name__ == "__main__":
    unittest.main()

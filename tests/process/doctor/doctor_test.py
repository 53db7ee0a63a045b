"""amb doctor on this machine, and in a network of its own: its remedies for that network work."""

import json
import os
import shlex
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

AMB = Path(os.environ["LEVITAS_BINARIES"]) / "amb"
SKIP_STATUS = 77
OWN_NETWORK = ["unshare", "--net"] if os.geteuid() == 0 else ["unshare", "--map-root-user", "--net"]


def doctor(before=""):
    """Status, printed text and JSON of `amb doctor` in a fresh network namespace, after `before`."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "doctor.json"
        script = f"{before} exec {shlex.quote(str(AMB))} doctor --json {shlex.quote(str(out))}"
        done = subprocess.run([*OWN_NETWORK, "sh", "-c", script], capture_output=True, text=True,
                              check=False, cwd=folder)
        return done.returncode, done.stdout, json.loads(out.read_text())


class Doctor(unittest.TestCase):
    def test_without_loopback_says_so_and_returns_one(self):
        status, printed, result = doctor()
        self.assertEqual(status, 1, printed)
        self.assertFalse(result["fit"]["lockstep"])
        self.assertIn("0 of", printed)

    def test_its_own_remedies_make_lockstep_possible_and_the_route_good(self):
        _, _, sick = doctor()
        remedies = {f["check"]: f["remedy"].split("#")[0].replace("sudo ", "")
                    for f in sick["findings"]}
        status, printed, cured = doctor(remedies["loopback"] + " &&")
        self.assertEqual(status, 0, printed)
        self.assertTrue(cured["fit"]["lockstep"])
        _, _, routed = doctor(f"{remedies['loopback']} && {remedies['route']} &&")
        states = {f["check"]: f["state"] for f in routed["findings"]}
        self.assertEqual((states["loopback"], states["route"]), ("ok", "ok"))

    def test_prints_every_finding_and_a_verdict_for_every_use(self):
        _, printed, result = doctor()
        for finding in result["findings"]:
            self.assertIn(finding["found"], printed)
            self.assertIn(finding["state"], ("ok", "degraded", "missing"))
        for use in ("lockstep", "real time at 10 kHz", "LCM between programs", "CAN bus", "GPIO"):
            self.assertIn(use, printed.split("This machine")[1])

    def test_an_unknown_option_is_a_usage_error(self):
        done = subprocess.run([AMB, "doctor", "--cure"], capture_output=True, check=False)
        self.assertEqual(done.returncode, 2)


if __name__ == "__main__":
    if subprocess.run([*OWN_NETWORK, "true"], capture_output=True, check=False).returncode != 0:
        print("a network namespace is not permitted here; nothing was checked")
        sys.exit(SKIP_STATUS)
    unittest.main()

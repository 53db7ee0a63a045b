"""Two runs of the same seed at the real-time pace, each in a machine of its own: the same records.

Every byte of every record is compared, the instants included: in virtual time they repeat too.
Runs outside of the machine and boots it.
"""

import os
import subprocess
import sys
import unittest
from pathlib import Path

SOURCE = Path(os.environ["LEVITAS_SOURCE"])
MACHINE = SOURCE / "scripts/test_machine.sh"
NOT_RUN = 77
RUN = r"""
cd /tmp
printf 'kind: scenario\nname: short\nsteps:\n' >scenario.yaml
printf '  - {do: lift, until: levitating, timeout_s: 5, hold_s: 0.05}\n' >>scenario.yaml
printf '  - {do: land, until: off, timeout_s: 5}\n' >>scenario.yaml
"$LEVITAS_BINARIES/amb-plant" --rig flexible_rotor --pace realtime --seed 3 2>/dev/null &
"$LEVITAS_BINARIES/amb-controller" --rig flexible_rotor --controller flexible_rotor_commissioned \
  --scenario scenario.yaml --pace realtime --record run.lcm --seed 3 2>/dev/null || exit
exec python3 -B - <<'END'
import hashlib, os, sys
sys.path.insert(0, os.environ["LEVITAS_SOURCE"] + "/tests/support")
from lcm_network import log_events
records = [data for channel, data in log_events("run.lcm") if channel == "LEVITAS_CYCLE"]
print(len(records), hashlib.sha256(b"".join(records)).hexdigest())
END
"""


class Repeat(unittest.TestCase):
    def test_two_runs_of_the_same_seed_have_the_same_hash(self):
        outputs = []
        for _ in range(2):
            done = subprocess.run([MACHINE, "run", "bash", "-c", RUN], capture_output=True,
                                  text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            outputs.append(done.stdout.strip())
        print(*outputs, sep="\n")
        # Lift of 0.9 s and landing of 0.5 s at the least.
        self.assertGreater(int(outputs[0].split()[0]), 14_000)
        self.assertEqual(*outputs)


if __name__ == "__main__":
    if subprocess.run([MACHINE, "kernel"], capture_output=True, check=False).returncode != 0:
        print("not run: the kernel of the test machine is not built")
        sys.exit(NOT_RUN)
    unittest.main(verbosity=2)

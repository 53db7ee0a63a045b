"""LCM's Python package with the generated types, live on the network of our programs.

The package comes from PyPI into a virtual environment below the build tree, made once. Without it
and without a way to get it the test is reported as not run (status 77), never as passed.
"""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from lcm_network import (BUILD, COMMAND, SKIPPED, TELEMETRY, controller, log_events,  # noqa: E402
                         plant, run)
from waiting import until  # noqa: E402

VENV = BUILD / "python-lcm"
WANTED = 50  # states whose values are compared with the record


def provide_package(venv=VENV, module="lcm", packages=("lcm==1.5.3",)):
    """Path of the virtual environment's Python; ends the test as not run when there is none."""
    python = venv / "bin/python3"
    if subprocess.run([python, "-c", f"import {module}"], capture_output=True,
                      check=False).returncode == 0 if python.exists() else False:
        return python
    for step in ([sys.executable, "-m", "venv", str(venv)],
                 [str(venv / "bin/pip"), "install", "--quiet", "--disable-pip-version-check",
                  "--retries", "1", "--timeout", "15", *packages]):
        done = subprocess.run(step, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            reason = (done.stderr or done.stdout).strip().splitlines() or ["no reason given"]
            print(f"not run: the Python package {module} is not here and not to be had: {reason[-1]}")
            sys.exit(SKIPPED)
    return python


class PythonLcm(unittest.TestCase):
    def test_lifts_the_rotor_and_reads_the_values_the_controller_sent(self):
        import lcm
        from levitas_msg.controller_state_t import controller_state_t
        from levitas_msg.cycle_record_t import cycle_record_t
        from levitas_msg.operator_command_t import operator_command_t
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        states = []
        listener = lcm.LCM(f"udpm://239.255.76.67:{TELEMETRY}?ttl=0")
        listener.subscribe("LEVITAS_STATE",
                           lambda _, data: states.append(controller_state_t.decode(data)))
        speaker = lcm.LCM(f"udpm://239.255.76.67:{COMMAND}?ttl=0")
        lift = operator_command_t()
        lift.sequence, lift.command = 1, 1

        with plant(folder.name), controller(folder.name, "--record", "session.lcmlog") as control:
            control.says("rig found")
            speaker.publish("LEVITAS_COMMAND", lift.encode())
            until(lambda: listener.handle_timeout(100) and states[-1].mode == 3
                  and len(states) > WANTED,
                  f"levitating after {WANTED} states", lambda: control.said_so_far)
            control.terminate()
            self.assertEqual(control.status(), 0, control.text)

        wanted = {state.cycle: state for state in states}
        compared = 0
        for channel, data in log_events(Path(folder.name) / "session.lcmlog"):
            if channel != "LEVITAS_CYCLE":
                continue
            record = cycle_record_t.decode(data)
            if record.cycle in wanted:
                state = wanted[record.cycle]
                self.assertEqual(tuple(state.position_m), tuple(record.position_m))
                self.assertEqual(tuple(state.reference_m), tuple(record.reference_m))
                self.assertEqual(state.mode, record.mode)
                compared += 1
        self.assertEqual(compared, len(wanted))
        self.assertGreater(compared, WANTED)


if __name__ == "__main__":
    if not os.environ.get("LEVITAS_TEST_NAMESPACE"):
        package_python = provide_package()  # outside the namespace, which has no way out
        if Path(sys.prefix) != VENV.resolve():
            os.execv(package_python, [str(package_python), "-B", *sys.argv])
    run()

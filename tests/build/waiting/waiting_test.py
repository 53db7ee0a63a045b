"""No test depends on how busy the machine is: what caused it is refused in the sources of the tests.

Each rule of waiting_rules.py refuses its seeded violation; an exception is reasoned, and is one only as
long as it is needed.
"""

import functools
import os
import re
import unittest
from pathlib import Path

from waiting_rules import RULES, findings

SOURCE = Path(os.environ["LEVITAS_SOURCE"])
HERE = "tests/build/waiting/"
# (file, part of the line, reason)
EXCEPTIONS = (
    ("tests/support/waiting.py", "time.sleep(PAUSE_S)", "between two looks of the helper itself"),
    ("tests/support/waiting.py", "time.sleep(seconds)", "the pause that has to give its reason"),
    ("tests/support/waiting.hpp", "sleep_for(", "as the two above, in C++"),
    ("tests/support/lcm_network.py", "subprocess.Popen(", "the helper itself"),
    ("tests/support/lcm_network.py", "self.log.read_text(", "the helper itself"),
    ("tests/support/chromium.py", "subprocess.Popen(", "answers through descriptors of its own"),
    ("tests/support/two_machines.py", "subprocess.Popen(", "says nothing: it holds a network"),
    ("tests/support/two_machines.py", "time.sleep(0.002)", "the pace of a sender, judged by nobody"),
    ("tests/build/launcher/launcher_test.py", "subprocess.Popen(",
     "two ./amb at once: both are read to their end by communicate()"),
    ("tests/unit/session/log/kill_test.cpp", "sleep_until(", "the pace of the child that records"),
    ("tests/unit/run/supervise_test.cpp", "sleep_for(", "the pace of invented telemetry"),
    ("tests/unit/run/child_process_test.cpp", "WaitFor(milliseconds(20))",
     "a child that does not end is not waited for"),
    ("tests/hardware/gpio/line_guard_test.cpp", "clock_nanosleep(", "the pace of a control cycle"),
    ("tests/hardware/can/socket_test.cpp", "EXPECT_GE(rt::MonotonicNowNs(), deadline_ns)",
     "waiting ends at its deadline or later, never before"),
    ("tests/hardware/can/can_tools_test.py", "self.log.read_text(", "written by the test itself"),
    ("tests/hardware/machine/machine_test.py", "time.sleep(3600)", "virtual time is what it tests"),
    ("tests/hardware/machine/machine_test.py", "time.monotonic() - start_s", "as above"),
)
# One line per rule; each must be refused for it.
SEEDED = (
    ("process.py", "line = child.stdout.readline()", "read so far"),
    ("process.py", 'self.assertIn("--token-file", rig.dash.said_so_far)', "read so far"),
    ("process.py", 'text = (folder / "rig.log").read_text(encoding="utf-8")', "read so far"),
    ("process.py", "control = subprocess.Popen([amb, 'run'])", "started past the helper"),
    ("process.py", "child.communicate(timeout=5)", "a limit of its own"),
    ("process.py", "self.assertEqual(control.status(20), 0)", "a limit of its own"),
    ("process.py", 'control.says("TRIP", 30)', "a limit of its own"),
    ("CMakeLists.txt", "levitas_script_test(pair pair_test.py LABEL process TIMEOUT 300)",
     "a limit of its own"),
    ("unit.cpp", "condition.wait_for(lock, seconds(2));", "a limit of its own"),
    ("process.py", "        time.sleep(0.5)", "sleep as synchronisation"),
    ("unit.cpp", "  std::this_thread::sleep_for(milliseconds(50));", "sleep as synchronisation"),
    ("process.py", "self.assertLess(time.monotonic() - begin, 2)", "a judgement of time"),
    ("unit.cpp", "EXPECT_LT(Clock::now() - begin, seconds(1));", "a judgement of time"),
    ("process.py", 'dash = Process(folder, "amb", "dash", "--http-port", "8970")', "a fixed port"),
    ("process.py", 'socket.create_connection(("127.0.0.1", 8970))', "a fixed port"),
    ("unit.cpp", "network.base_port = 7667;", "a fixed port"),
)
CLEAN = (
    ("process.py", 'control.says("rig found"); self.assertEqual(control.status(), 0, control.text)'),
    ("process.py", 'pause(0.6, "this or longer does not count as one request")'),
    ("process.py", 'rig.start_dash("--http-port", port); rig.start_dash("--http-port", "0")'),
    ("process.py", "while not ended.wait(0.05):"),
    ("process.py", 'self.fail(f"not reached:\\n{control.said_so_far}")'),
    ("unit.cpp", "ASSERT_TRUE(child.WaitFor(test::kLimit));"),
    ("CMakeLists.txt", "levitas_script_test(pair pair_test.py LABEL process)"),
)


def virtual_tests():
    """Scripts and programs that only ever run where time stands still while programs compute."""
    for path in sorted((SOURCE / "tests/hardware").glob("*/CMakeLists.txt")):
        for words in re.findall(r"^levitas_hardware_\w+\(([^)]*\bVIRTUAL\b[^)]*)\)",
                                path.read_text(encoding="utf-8"), re.M):
            for name in re.findall(r"\b\w+\.(?:py|cpp)\b", words):
                yield f"{path.parent.relative_to(SOURCE)}/{name}"


@functools.cache
def all_findings():
    """(file, number, line, what, remedy) of the tests, without this folder's own."""
    virtual, found = set(virtual_tests()), []
    for path in sorted((SOURCE / "tests").rglob("*")):
        name = str(path.relative_to(SOURCE))
        if name.startswith((HERE, "tests/fuzz/")) or not path.is_file():
            continue
        if path.suffix not in (".py", ".cpp", ".hpp") and path.name != "CMakeLists.txt":
            continue
        for number, line, what, remedy in findings(name, path.read_text(encoding="utf-8")):
            # A second of virtual time takes as long as the programs need.
            if not (name in virtual and what != "read so far"):
                found.append((name, number, line, what, remedy))
    return found


class Waiting(unittest.TestCase):
    maxDiff = None

    def test_no_test_depends_on_how_busy_the_machine_is(self):
        refused = [f"{name}:{number}: {what}: {line}\n    {remedy}"
                   for name, number, line, what, remedy in all_findings()
                   if not any(name == file and part in line for file, part, _ in EXCEPTIONS)]
        self.assertFalse(refused, "\n" + "\n".join(refused))

    def test_every_exception_is_needed_and_has_its_reason(self):
        found = all_findings()
        for file, part, reason in EXCEPTIONS:
            with self.subTest(file=file, part=part):
                self.assertTrue(any(name == file and part in line for name, _, line, _, _ in found),
                                "nothing is refused there any more: remove the exception")
                self.assertTrue(reason)

    def test_each_rule_refuses_its_seeded_violation(self):
        for name, line, what in SEEDED:
            with self.subTest(line):
                self.assertEqual([found[2] for found in findings(name, "\n" + line + "\n")], [what])
                self.assertEqual(findings(name, "\n" + line + "\n")[0][0], 2)

    def test_every_rule_is_seeded(self):
        kinds = {(what, suffix) for what, suffixes, _, _ in RULES for suffix in suffixes}
        seeded = {(what, Path(name).suffix if name != "CMakeLists.txt" else name)
                  for name, _, what in SEEDED}
        self.assertEqual({kind for kind in kinds if kind[1] != ".hpp"}, seeded)

    def test_what_waits_is_accepted(self):
        for name, line in CLEAN:
            with self.subTest(line):
                self.assertEqual(findings(name, line + "\n"), [])


if __name__ == "__main__":
    unittest.main()

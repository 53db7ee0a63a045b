"""What makes a test depend on how busy the machine is, by line; each finding says what to do instead."""

import re
from pathlib import Path

HELPER = "tests/support/waiting.py"
# (name, suffixes, pattern, remedy)
RULES = (
    ("read so far", (".py",),
     re.compile(r"\.(?:stdout|stderr)\.read(?:line|lines|1)?\(|\.log[\"')]*\.read_text\("
                r"|assert(?:In|NotIn|Regex)\([^,\n]+,[^,\n]*(?:said_so_far|\blog\(\))"
                r"|\bin [\w.]+\.said_so_far"),
     "what a process has said so far may be less than it says: Process.says() waits for the words, "
     "Process.text is for one that has ended"),
    ("started past the helper", (".py",), re.compile(r"\bsubprocess\.Popen\("),
     "lcm_network.Process starts what runs beside a test: it keeps what is said and waits for it"),
    ("a limit of its own", (".py",),
     re.compile(r"\btimeout=\d|\.(?:wait|status|settimeout|messages|join)\([1-9]\d*\)"
                r"|\bsays\([^()]*,\s*\d+\)|\blimit_s=\d"),
     f"one generous limit for all: LIMIT_S of {HELPER}"),
    ("a limit of its own", ("CMakeLists.txt",), re.compile(r"^levitas_\w+\([^#\n]*\bTIMEOUT\b", re.M),
     "the limit of ctest is levitas_test_limit of tests/CMakeLists.txt"),
    ("sleep as synchronisation", (".py",), re.compile(r"\btime\.sleep\("),
     f"wait for what is judged: until() of {HELPER}, Process.says(), Bus.messages()"),
    ("sleep as synchronisation", (".cpp", ".hpp"),
     re.compile(r"\bsleep_(?:for|until)\(|\b(?:u|nano|clock_nano)sleep\("),
     "wait for what is judged: Eventually() of tests/support/waiting.hpp, or a condition variable"),
    ("a limit of its own", (".cpp", ".hpp"),
     re.compile(r"\b(?:wait_for|wait_until|WaitFor)\([^;]*\d"),
     "one generous limit for all: kLimit of tests/support/waiting.hpp"),
    ("a judgement of time", (".py",),
     re.compile(r"assert\w*\([^\n]*\b(?:monotonic|perf_counter|time\.time)\b"),
     "no test judges wall-clock time; instants are judged in virtual time (CONTRIBUTING.md)"),
    ("a judgement of time", (".cpp", ".hpp"),
     re.compile(r"(?:EXPECT|ASSERT)_(?:LT|LE|GT|GE|NEAR)\([^;]*(?:\bnow\(\)|MonotonicNowNs\(\))"),
     "no test judges wall-clock time; instants are judged in virtual time (CONTRIBUTING.md)"),
    ("a fixed port", (".py",),
     re.compile(r"--http-port[\"',\s]+[1-9]|(?:127\.0\.0\.1|localhost|0\.0\.0\.0)[\"',:\s]+[1-9]\d{3,4}\b"),
     "another program may have that port: let the program choose, and read which"),
    ("a fixed port", (".cpp", ".hpp"),
     re.compile(r"base_port\s*=\s*\d|\bsin_port\s*=\s*htons\(\s*[1-9]|\bListen\(\s*[1-9]\d{3}"),
     "another program may have that port: 0 lets the kernel choose, or one drawn from the process"),
)


def findings(name, text):
    """(line number, line, what, remedy) of a file by its name within the repository."""
    path = Path(name)
    lines = text.splitlines()
    return [(number, line.strip(), what, remedy)
            for what, suffixes, pattern, remedy in RULES
            if (path.suffix in suffixes or path.name in suffixes) and pattern.search(text)
            for number, line in enumerate(lines, 1) if pattern.search(line)]

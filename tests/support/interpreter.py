"""An interpreter that has the packages a test needs: the one that runs it, or the system's.

Where a machine's `python3` is not Debian's, packages that were installed as Debian's are with the other one.
"""

import os
import subprocess
import sys

SKIP_STATUS = 77
SYSTEM = "/usr/bin/python3"


def having(*packages):
    """Its path; None where neither has all of them."""
    for name in dict.fromkeys((sys.executable, SYSTEM)):
        if os.access(name, os.X_OK) and subprocess.run([name, "-c", "import " + ", ".join(packages)], check=False,
                                                       capture_output=True).returncode == 0:
            return name
    return None


def go_on_with(*packages):
    """Begins the running script anew under the interpreter that has them; skips the test where none has."""
    name = having(*packages)
    if name is None:
        print(f"no interpreter here has {' and '.join(packages)} (packages-ci.txt)")
        sys.exit(SKIP_STATUS)
    if name != sys.executable:
        os.execv(name, [name, "-B", *sys.argv])

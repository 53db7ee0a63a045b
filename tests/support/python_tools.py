"""Python packages that only tests use and Debian does not have: found, or fetched once from PyPI.

They lie beside the test machine's kernel, outside the repository. `python3 python_tools.py` fetches
them (network needed, once); a test that does not find them is not run.
"""

import os
import pathlib
import pwd
import subprocess
import sys

PACKAGES = ("cantools==45.1.0", "python-can==4.6.1")


def folder():
    # Of the user, not of $HOME: the test machine has one of its own, on the same files.
    home = pathlib.Path(pwd.getpwuid(os.getuid()).pw_dir)
    cache = pathlib.Path(os.environ.get("XDG_CACHE_HOME") or home / ".cache") / "levitas"
    return cache / "-".join(["python", *(name.replace("==", "-") for name in PACKAGES)])


def find():
    """The folder to put on sys.path; None when the packages are not there."""
    return folder() if (folder() / "cantools").is_dir() else None


def crc8(data):
    """CRC-8 with the polynomial 0x1D from 0: the checksum of E2E profile 11, written anew."""
    crc = 0
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = ((crc << 1) ^ 0x1D) & 0xFF if crc & 0x80 else (crc << 1) & 0xFF
    return crc


if __name__ == "__main__":
    if find() is None:
        subprocess.run([sys.executable, "-m", "pip", "install", "--quiet", "--target", folder(),
                        *PACKAGES], check=True)
    print(find())

"""A session packed by zstd (.lcm.zst) as the bytes of its LCM log.

Unpacked by the program `zstd` (Debian: zstd), else by `amb export --lcm`, which also goes on behind
damage. What is cut off or damaged is left out, with a warning that says so.
"""

import shutil
import subprocess
import tempfile
import warnings
from pathlib import Path

from . import programs

MAGIC = b"\x28\xb5\x2f\xfd"


def is_packed(start):
    """Of the first bytes of a file; frames that unpackers skip may come first."""
    return start[:4] == MAGIC or (start[1:4] == b"\x2a\x4d\x18" and start[0] & 0xF0 == 0x50)


def unpacked(path):
    """The log; whole, or what could be read of it."""
    log, lost = b"", "the program `zstd` is not installed"
    if shutil.which("zstd"):
        done = subprocess.run(["zstd", "-dcq", "--", str(path)], capture_output=True, check=False)
        if done.returncode == 0:
            return done.stdout
        log, lost = done.stdout, done.stderr.decode(errors="replace").strip()
    by_amb = _by_amb(path)
    if by_amb is None and not log:
        raise ValueError(f"cannot be unpacked: {lost}, and there is no program `amb`")
    log = log if by_amb is None else by_amb
    if shutil.which("zstd"):
        warnings.warn(f"{path}: cut off or damaged, so not everything could be read; what stands in its complete "
                      f"blocks was ({lost})", stacklevel=3)
    return log


def _by_amb(path):
    try:
        amb = programs.program()
    except FileNotFoundError:
        return None
    with tempfile.TemporaryDirectory() as folder:
        plain = Path(folder) / "plain.lcm"
        done = subprocess.run([amb, "export", str(path), "--lcm", str(plain)], capture_output=True, text=True,
                              check=False)
        if done.returncode != 0:
            raise ValueError(f"cannot be unpacked: {done.stderr.strip()}")
        return plain.read_bytes()

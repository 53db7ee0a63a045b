"""Makes the wheel of this folder with the standard library alone: `pip install ./python` needs no network.

A wheel is a zip file (PEP 427); pip asks for it through build_wheel (PEP 517). The types of the
messages are those of lcmtypes/, so that there is one definition of a record.
"""

import base64
import hashlib
import re
import zipfile
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
ROOT = FOLDER.parent
MESSAGES = ("command_answer_t", "controller_state_t", "cycle_record_t", "event_t", "operator_command_t",
            "session_header_t")


def version():
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"project\(levitas VERSION ([\d.]+)", text)[1]


def contents():
    """{name in the wheel: bytes}"""
    files = {f"levitas/{path.name}": path.read_bytes() for path in sorted((FOLDER / "levitas").glob("*.py"))}
    for name in MESSAGES:
        files[f"levitas/{name}.lcm"] = (ROOT / "lcmtypes" / f"{name}.lcm").read_bytes()
    return files


def metadata():
    return ("Metadata-Version: 2.1\n"
            f"Name: levitas\nVersion: {version()}\n"
            "Summary: Sessions of Levitas, a controller for active magnetic bearings, as arrays; its programs as functions\n"
            "License: MIT\nRequires-Python: >=3.10\nRequires-Dist: numpy\n"
            'Provides-Extra: frame\nRequires-Dist: pandas; extra == "frame"\n').encode()


def digest(data):
    return "sha256=" + base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    info = f"levitas-{version()}.dist-info"
    files = contents() | {
        f"{info}/METADATA": metadata(),
        f"{info}/WHEEL": b"Wheel-Version: 1.0\nGenerator: levitas\nRoot-Is-Purelib: true\nTag: py3-none-any\n",
        f"{info}/LICENSE": (ROOT / "LICENSE").read_bytes(),
    }
    record = "".join(f"{name},{digest(data)},{len(data)}\n" for name, data in files.items())
    files[f"{info}/RECORD"] = (record + f"{info}/RECORD,,\n").encode()
    name = f"levitas-{version()}-py3-none-any.whl"
    with zipfile.ZipFile(Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, data in files.items():
            # A fixed date: the same sources give the same bytes.
            wheel.writestr(zipfile.ZipInfo(path, (1980, 1, 1, 0, 0, 0)), data)
    return name

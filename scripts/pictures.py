#!/usr/bin/env python3
"""Draws the pictures of docs/ anew, each by the command that a reader would type.

    scripts/pictures.py [NAME...]        run, report, identify, effects, notch,
                                         dashboard; default: all

The programs are those of build/release. The dashboard's pictures are screenshots of a headless
Chromium before a real run; without Chromium (Debian package chromium) they are left as they are.
"""

import os
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PICTURES = ROOT / "docs/pictures"
os.environ.setdefault("LEVITAS_BINARIES", str(ROOT / "build/release/bin"))
os.environ.setdefault("LEVITAS_BUILD", str(ROOT / "build/release"))
os.environ["LEVITAS_CATALOGUE"] = ""  # these runs are nobody's records
os.environ.setdefault("XDG_CONFIG_HOME", tempfile.gettempdir())
sys.path.insert(0, str(ROOT / "tests/support"))
from chromium import Browser, find  # noqa: E402
from dashboard_rig import Rig, in_mode, until  # noqa: E402
from lcm_network import run as run_in_namespace  # noqa: E402

# Of a report, those that the documents show.
OF_A_REPORT = ("bode_de", "waterfall_de")


def amb(folder, *arguments, status=0):
    command = [os.environ["LEVITAS_BINARIES"] + "/amb", *map(str, arguments)]
    print("  amb", " ".join(map(str, arguments)), flush=True)
    done = subprocess.run(command, cwd=folder, check=False, capture_output=True, text=True)
    if done.returncode != status:
        sys.exit(f"{' '.join(command)}: status {done.returncode}\n{done.stdout}{done.stderr}")


def draw_run(folder):
    amb(folder, "run", "--record", "run.lcm")
    amb(folder, "export", "run.lcm", "--csv", "run.csv")
    subprocess.run([sys.executable, ROOT / "scripts/run_picture.py", folder / "run.csv",
                    PICTURES / "run.svg"], check=True)


def draw_report(folder):
    amb(folder, "run", "--scenario", "run_up_6000", "--record", "up.lcm")
    amb(folder, "report", "up.lcm", "--out", "up.html", "--pictures", "up")
    (PICTURES / "report").mkdir(exist_ok=True)
    for name in OF_A_REPORT:
        shutil.copy(folder / f"up/{name}.svg", PICTURES / "report" / f"{name}.svg")


def draw_identify(folder):
    amb(folder, "run", "--scenario", "identify", "--record", "id.lcm")
    amb(folder, "identify", "frf", "id.lcm", "--orbit-um", "75", "--svg", "frf.svg")
    # As a picture of pixels: the drawing of every line of every response is ten times as large.
    subprocess.run(["rsvg-convert", "--width", "1100", "--background-color", "white", "--output",
                    PICTURES / "identify_frf.png", folder / "frf.svg"], check=True)


def draw_rig(folder):
    amb(folder, "modes", "--svg", PICTURES / "modes.svg")
    amb(folder, "margins", "--controller", "flexible_rotor_commissioned", "--speeds", "6000", "--svg",
        PICTURES / "margins.svg")


def draw_effects(folder):
    amb(folder, "effects", "--document", ROOT / "docs/effects.md", "--pictures",
        PICTURES / "effects")


def draw_notch(folder):
    for target in ("current", "vibration"):  # refused at some speeds, which is what is shown
        amb(folder, "design", "notch", "--controller", "flexible_rotor_commissioned",
            "--without-rotor", "--from-rpm", "700", "--target", target, "--json", f"{target}.json",
            status=1)
    subprocess.run([sys.executable, ROOT / "scripts/notch_picture.py", folder / "current.json",
                    folder / "vibration.json", PICTURES / "force_free.svg"], check=True)


class Dashboard(unittest.TestCase):
    """Screenshots, taken inside a network of their own."""

    def press(self, page, what):
        page.value(f"document.querySelector({what!r}).click()")

    def fill(self, page, form, **values):
        for name, value in values.items():
            page.value(f"document.getElementById({form!r}).elements[{name!r}].value = {str(value)!r}")

    def test_pictures(self):
        rig = Rig(self, controller="flexible_rotor_commissioned")
        with Browser() as browser:
            page = browser.open(rig.url)
            until(rig.url, in_mode("off"))
            self.press(page, "[data-command=lift]")
            until(rig.url, in_mode("levitating"))
            self.press(page, "[data-view=bench]")
            page.until("document.querySelector('#scope [name=channel]').options.length == 4")
            self.fill(page, "scope", level=15, length_ms=100)
            self.press(page, "#scope [type=submit]")
            page.until("document.getElementById('scope-answer').textContent.includes('armed')")
            self.fill(page, "excitation", amplitude=0.4)
            self.press(page, "#excitation [type=submit]")
            page.until("!document.getElementById('capture-tools').hidden")
            time.sleep(2)
            page.picture(PICTURES / "dashboard_bench.png")
            self.press(page, "#excitation-end")
            self.press(page, "[data-view=overview]")
            self.press(page, "#spin [type=submit]")
            until(rig.url, lambda name, data: name == "tick" and data.get("speed_rpm", 0) > 1490)
            phone = browser.open(rig.url, width=390, height=844, phone=True)
            time.sleep(10)
            page.picture(PICTURES / "dashboard.png")
            phone.picture(PICTURES / "dashboard_phone.png")


DRAW = {"run": draw_run, "report": draw_report, "identify": draw_identify, "rig": draw_rig,
        "effects": draw_effects, "notch": draw_notch}


def main():
    if os.environ.get("LEVITAS_TEST_NAMESPACE"):
        sys.argv[1:] = []
        run_in_namespace()
    chosen = sys.argv[1:] or [*DRAW, "dashboard"]
    unknown = set(chosen) - {*DRAW, "dashboard"}
    if unknown:
        sys.exit(f"no picture {', '.join(sorted(unknown))}\n{__doc__}")
    for name in chosen:
        if name == "dashboard":
            continue
        print(name)
        with tempfile.TemporaryDirectory() as folder:
            DRAW[name](Path(folder))
    if "dashboard" in chosen and find() is not None:
        run_in_namespace()  # last: it becomes another process


if __name__ == "__main__":
    main()

"""A chip of the kernel's gpio-sim for one test, and the lines section of a rig file that names it."""

from pathlib import Path

LINES = """
lines:
  emergency_stop: {{chip: {chip}, offset: 0}}
  amplifier_enable: {{chip: {chip}, offset: 1}}
  amplifier_fault: {{chip: {chip}, offset: 2, active: low}}
  heartbeat: {{chip: {chip}, offset: 3}}
"""
KEY_PHASOR = """  key_phasor: {{chip: {chip}, offset: 4, max_acceleration_rpm_per_s: 20000}}
"""
STOP, ENABLE, FAULT, HEARTBEAT = range(4)


class Chip:
    def __init__(self, name="levitas_script", lines=8):
        self.folder = Path("/sys/kernel/config/gpio-sim") / name
        (self.folder / "bank0").mkdir(parents=True)
        (self.folder / "bank0/num_lines").write_text(str(lines))
        (self.folder / "live").write_text("1")
        self.name = (self.folder / "bank0/chip_name").read_text().strip()
        self.device = Path("/sys/bus/gpio/devices") / self.name
        # A rig at rest: chain closed (high), no fault (its active level is low).
        self.pull(STOP, True)
        self.pull(FAULT, True)

    def close(self):
        (self.folder / "live").write_text("0")
        (self.folder / "bank0").rmdir()
        self.folder.rmdir()

    def pull(self, line, up):
        (self.device / f"sim_gpio{line}/pull").write_text("pull-up" if up else "pull-down")

    def level(self, line):
        return (self.device / f"sim_gpio{line}/value").read_text().strip() == "1"

    def rig(self, source, folder):
        """The shipped rig with lines; returns the path of its file."""
        text = (Path(source) / "config/rigs/flexible_rotor.yaml").read_text(encoding="utf-8")
        path = Path(folder) / "rig_with_lines.yaml"
        path.write_text(text + LINES.format(chip=self.name), encoding="utf-8")
        return path

#!/usr/bin/env python3
"""Draws what synchronous control without the rotor in its T does over speed, as SVG.

    amb design notch --controller flexible_rotor_commissioned --without-rotor --from-rpm 700 \\
        --json current.json
    amb design notch --controller flexible_rotor_commissioned --without-rotor --from-rpm 700 \\
        --target vibration --json vibration.json
    scripts/notch_picture.py current.json vibration.json docs/pictures/force_free.svg

Above: how fast the blocks decay. Below: the orbit of the rig file's unbalance. Both calls may end
with status 1, speeds being refused: the numbers are written all the same.
"""

import json
import math
import sys

INK, MUTED, GRID, PAPER = "#1f2430", "#5d6675", "#d9dee6", "#ffffff"
BLUE, ORANGE, GREEN = "#1769aa", "#c2571a", "#2c7a4b"
WIDTH, LEFT, RIGHT, HEIGHT, GAP, TOP = 960, 80, 24, 190, 66, 40
LINES_UM = ((36.0, "objective"), (190.0, "clearance"))


class Panel:
    """A plot area over rpm with a logarithmic axis."""

    def __init__(self, top, rpm, low, high, title):
        self.top, self.rpm, self.low, self.high = top, rpm, low, high
        self.out = [text(LEFT, top - 10, title, INK)]
        for exponent in range(math.ceil(math.log10(low)), math.floor(math.log10(high)) + 1):
            y = self.y(10.0**exponent)
            self.out.append(line(LEFT, y, WIDTH - RIGHT, y, GRID))
            self.out.append(text(LEFT - 8, y + 4, f"{10.0 ** exponent:g}", MUTED, "end"))
        for at in range(math.ceil(rpm[0] / 1000) * 1000, int(rpm[1]) + 1, 1000):
            self.out.append(line(self.x(at), top, self.x(at), top + HEIGHT, GRID))
            self.out.append(text(self.x(at), top + HEIGHT + 18, f"{at}", MUTED, "middle"))

    def x(self, rpm):
        return LEFT + (rpm - self.rpm[0]) / (self.rpm[1] - self.rpm[0]) * (WIDTH - LEFT - RIGHT)

    def y(self, value):
        share = math.log(max(value, self.low) / self.low) / math.log(self.high / self.low)
        return self.top + HEIGHT * (1.0 - min(share, 1.0))

    def curve(self, points, colour, name, where):
        """`where`: rpm at which the name stands, and pixels above the curve there."""
        path = " ".join(f"{'ML'[i > 0]}{self.x(r):.1f},{self.y(v):.1f}" for i, (r, v) in enumerate(points))
        self.out.append(f'<path d="{path}" fill="none" stroke="{colour}" stroke-width="2"/>')
        rpm, above = where
        value = min(points, key=lambda point: abs(point[0] - rpm))[1]
        self.out.append(text(self.x(rpm), self.y(value) - above, name, colour, "middle"))

    def level(self, value, name):
        y = self.y(value)
        self.out.append(f'<line x1="{LEFT}" y1="{y:.1f}" x2="{WIDTH - RIGHT}" y2="{y:.1f}" '
                        f'stroke="{MUTED}" stroke-dasharray="5 4"/>')
        self.out.append(text(LEFT + 6, y - 5, name, MUTED))


def line(x1, y1, x2, y2, colour):
    return f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{colour}"/>'


def text(x, y, words, colour, anchor="start"):
    return f'<text x="{x:.1f}" y="{y:.1f}" fill="{colour}" text-anchor="{anchor}">{words}</text>'


def read(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)["speeds"]


def series(speeds, key, scale=1.0):
    return [(at["speed_rpm"], scale * at[key]) for at in speeds]


def draw(current, vibration):
    rpm = (current[0]["speed_rpm"], current[-1]["speed_rpm"])
    decay = Panel(TOP, rpm, 1e-3, 10.0, "decay of the slowest amplitude; 1: as the time constant says")
    decay.curve(series(current, "slowest_decay"), BLUE, "target current", (1500, -24))
    decay.curve(series(vibration, "slowest_decay"), ORANGE, "target vibration", (5500, 14))
    orbit = Panel(TOP + HEIGHT + GAP, rpm, 1.0, 2000.0, "orbit of the unbalance at the sensors [um]")
    for value, name in LINES_UM:
        orbit.level(value, f"{name} {value:g} um")
    orbit.curve(series(current, "orbit_alone_m", 1e6), GREEN, "law alone", (1500, 14))
    orbit.curve(series(current, "orbit_m", 1e6), BLUE, "no synchronous current", (3300, -24))
    height = TOP + 2 * HEIGHT + GAP + 46
    axis = text(WIDTH / 2, height - 8, "speed [rpm]", MUTED, "middle")
    return "\n".join([f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" '
                      f'font-family="sans-serif" font-size="13">',
                      f'<rect width="{WIDTH}" height="{height}" fill="{PAPER}"/>',
                      *decay.out, *orbit.out, axis, "</svg>", ""])


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    with open(sys.argv[3], "w", encoding="utf-8") as file:
        file.write(draw(read(sys.argv[1]), read(sys.argv[2])))


if __name__ == "__main__":
    main()

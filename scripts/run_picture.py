#!/usr/bin/env python3
"""Draws a recorded run as SVG: lift, run up, landing over time, and the orbits at speed.

    ./amb run --record run.lcm && ./amb export run.lcm --csv run.csv
    scripts/run_picture.py run.csv docs/pictures/run.svg

The clearance circle is that of the rig flexible_rotor (190 um at the actuator planes); the
positions are those of the sensor planes, which lie 20 mm further out.
"""

import csv
import math
import sys

CLEARANCE_UM = 190.0
INK, MUTED, GRID, PAPER = "#1f2430", "#5d6675", "#d9dee6", "#ffffff"
COLOURS = {"de": "#1769aa", "nde": "#c2571a"}
NAMES = {"de": "drive end", "nde": "non-drive end"}
WIDTH, HEIGHT = 960, 500
COLUMNS = 420  # one column of the time trace spans about 30 ms of the default run


def read(path):
    """Columns of the CSV that are drawn, in micrometres, seconds and rpm."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = csv.DictReader(file)
        data = {"time": [], "rpm": [], "de": [], "nde": []}
        angles = []
        for row in rows:
            data["time"].append(float(row["time_s"]))
            if row.get("speed_rpm"):
                data["rpm"].append(float(row["speed_rpm"]))
            else:
                angles.append(float(row["rotor_angle_rad"]))
            for end in ("de", "nde"):
                data[end].append(tuple(1e6 * float(row[f"position_{end}_{axis}_m"]) for axis in "xy"))
    if angles:
        data["rpm"] = speeds(data["time"], angles)
    data["rpm"] = [abs(rpm) for rpm in data["rpm"]]  # either direction of rotation
    return data


def speeds(times, angles, half_width=50):
    """Speed [rpm] from the rotor angle over 100 samples; the angle may wrap."""
    total, unwrapped = 0.0, [0.0]
    for before, after in zip(angles, angles[1:]):
        total += math.remainder(after - before, 2 * math.pi)
        unwrapped.append(total)
    last = len(times) - 1
    result = []
    for i in range(len(times)):
        low, high = max(0, i - half_width), min(last, i + half_width)
        result.append((unwrapped[high] - unwrapped[low]) / (times[high] - times[low]) * 30 / math.pi)
    return result


class Axes:
    """A plot area: data limits to pixels, with grid lines and labels."""

    def __init__(self, x, y, width, height, x_limits, y_limits):
        self.box = (x, y, width, height)
        self.x_limits, self.y_limits = x_limits, y_limits
        self.out = []

    def at(self, u, v):
        x, y, width, height = self.box
        return (x + width * (u - self.x_limits[0]) / (self.x_limits[1] - self.x_limits[0]),
                y + height * (1 - (v - self.y_limits[0]) / (self.y_limits[1] - self.y_limits[0])))

    def grid(self, x_ticks, y_ticks):
        for u in x_ticks:
            (x, bottom), (_, top) = self.at(u, self.y_limits[0]), self.at(u, self.y_limits[1])
            self.out.append(line(x, bottom, x, top, GRID))
            self.out.append(text(x, bottom + 16, f"{u:g}", anchor="middle"))
        for v in y_ticks:
            (left, y), (right, _) = self.at(self.x_limits[0], v), self.at(self.x_limits[1], v)
            self.out.append(line(left, y, right, y, GRID))
            self.out.append(text(left - 8, y + 4, f"{v:g}", anchor="end"))

    def path(self, points, colour, width=1.2, fill="none", opacity=1.0):
        d = "M" + "L".join("{:.1f},{:.1f}".format(*self.at(u, v)) for u, v in points)
        self.out.append(f'<path d="{d}" fill="{fill}" stroke="{colour}" stroke-width="{width}" '
                        f'stroke-linejoin="round" opacity="{opacity}"/>')


def line(x1, y1, x2, y2, colour):
    return f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{colour}"/>'


def text(x, y, words, anchor="start", colour=MUTED, size=12, weight="normal"):
    return (f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{colour}" '
            f'font-size="{size}" font-weight="{weight}">{words}</text>')


def envelope(data, end):
    """Distance from the centre, largest in each of COLUMNS stretches of time."""
    size = max(1, len(data["time"]) // COLUMNS)
    return [(data["time"][i], max(math.hypot(*p) for p in data[end][i:i + size]))
            for i in range(0, len(data["time"]) - size + 1, size)]


def time_axes(data):
    end_s = data["time"][-1]
    axes = Axes(64, 76, 500, 190, (0, end_s), (0, 200))
    axes.grid(range(0, int(end_s) + 1, 2), (0, 50, 100, 150, 200))
    axes.path([(0, CLEARANCE_UM), (end_s, CLEARANCE_UM)], MUTED)
    axes.out.append(text(axes.at(end_s, 0)[0] - 70, axes.at(0, CLEARANCE_UM)[1] + 15,
                         "touchdown bearing", anchor="end"))
    for end in ("nde", "de"):
        axes.path(envelope(data, end), COLOURS[end], 1.5)
    axes.out.append(text(64, 64, "Distance from the centre, largest in 30 ms (µm)", colour=INK,
                         size=13, weight="600"))
    return axes


def speed_axes(data):
    end_s = data["time"][-1]
    top = max(1000.0, 1000.0 * math.ceil(max(data["rpm"]) / 1000.0))
    axes = Axes(64, 336, 500, 110, (0, end_s), (0, top))
    axes.grid(range(0, int(end_s) + 1, 2), [top * i / 3 for i in range(4)])
    step = max(1, len(data["time"]) // COLUMNS)
    axes.path(list(zip(data["time"][::step], data["rpm"][::step])), INK, 1.5)
    axes.out.append(text(64, 324, "Speed (rpm)", colour=INK, size=13, weight="600"))
    axes.out.append(text(314, 484, "time (s)", anchor="middle"))
    return axes


def orbit_axes(data):
    """Five revolutions at the highest speed, or 40 ms when the rotor never turned."""
    top_rpm = max(data["rpm"])
    middle = max(i for i, rpm in enumerate(data["rpm"]) if rpm >= 0.98 * top_rpm)
    period_s = data["time"][1] - data["time"][0]
    length = int((5 * 60 / top_rpm if top_rpm > 100 else 0.04) / period_s)
    begin = max(0, middle - 2 * length)
    limit = 50
    axes = Axes(640, 76, 280, 280, (-limit, limit), (-limit, limit))
    axes.grid((-40, -20, 0, 20, 40), (-40, -20, 0, 20, 40))
    for radius, label in ((36.0, "objective 36 µm"),):
        circle = [(radius * math.cos(a), radius * math.sin(a))
                  for a in (2 * math.pi * i / 180 for i in range(181))]
        axes.path(circle, MUTED)
        axes.out.append(text(axes.at(0, radius)[0], axes.at(0, radius)[1] - 5, label, anchor="middle"))
    for end in ("de", "nde"):
        axes.path(data[end][begin:begin + length], COLOURS[end], 1.0, opacity=0.9)
    axes.out.append(text(640, 64, f"Orbits at {top_rpm:.0f} rpm, five revolutions (µm)", colour=INK,
                         size=13, weight="600"))
    for row, end in enumerate(("de", "nde")):
        y = 404 + 20 * row
        axes.out.append(f'<rect x="640" y="{y - 9}" width="18" height="4" fill="{COLOURS[end]}"/>')
        axes.out.append(text(666, y - 2, NAMES[end], colour=INK))
    axes.out.append(text(640, 446, "as the sensors measure it, noise included"))
    return axes


def main():
    if len(sys.argv) != 3:
        print(__doc__, file=sys.stderr)
        return 2
    data = read(sys.argv[1])
    parts = [part for axes in (time_axes(data), speed_axes(data), orbit_axes(data)) for part in axes.out]
    heading = text(64, 32, "amb run: lift, levitate, run up, run down, land", colour=INK, size=17,
                   weight="600")
    with open(sys.argv[2], "w", encoding="utf-8") as out:
        out.write(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" '
                  f'font-family="DejaVu Sans, Helvetica, Arial, sans-serif">\n'
                  f'<rect width="{WIDTH}" height="{HEIGHT}" fill="{PAPER}"/>\n{heading}\n')
        out.write("\n".join(parts) + "\n</svg>\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())

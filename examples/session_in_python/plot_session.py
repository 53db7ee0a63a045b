#!/usr/bin/env python3
"""Reads a recorded session and plots it: distance from the centre over time, and the levitated orbits.

    amb run --record run.lcm
    python3 plot_session.py run.lcm run.svg

Needs the program `amb` (on the PATH, or named in LEVITAS_AMB), which turns the session into columns;
nothing of Python but the standard library. Where matplotlib is installed it draws, and then run.png or
run.pdf will do as well. Arrays of numpy instead of lists: the package `levitas` (docs/formats.md).
"""

import csv
import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

LEVITATED = ("3", "4", "5")  # levitating, spinning, coast-down: column `mode`, docs/formats.md
COLOURS = ("#1769aa", "#c2571a", "#3a7d44", "#7a4fa0")


def read(session, every=10):
    """Times [s], whether levitated, and {bearing: [(x, y) in um]} of every tenth cycle."""
    with tempfile.TemporaryDirectory() as folder:
        table = Path(folder) / "run.csv"
        done = subprocess.run([os.environ.get("LEVITAS_AMB", "amb"), "export", session, "--csv", table,
                               "--every", str(every)], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(done.stderr.strip())
        with table.open(newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
    names = [name[len("position_"):-len("_x_m")] for name in rows[0]
             if name.startswith("position_") and name.endswith("_x_m")]
    times_s = [float(row["time_s"]) for row in rows]
    levitated = [row["mode"] in LEVITATED for row in rows]
    bearings = {name: [(1e6 * float(row[f"position_{name}_x_m"]), 1e6 * float(row[f"position_{name}_y_m"]))
                       for row in rows] for name in names}
    return times_s, levitated, bearings


def with_matplotlib(plot, picture, times_s, levitated, bearings):
    figure, (over_time, orbits) = plot.subplots(1, 2, figsize=(11, 5))
    for name, points in bearings.items():
        over_time.plot(times_s, [math.hypot(x, y) for x, y in points], linewidth=0.8, label=name)
        free = [point for point, there in zip(points, levitated) if there]
        orbits.plot([x for x, _ in free], [y for _, y in free], linewidth=0.5, label=name)
    over_time.set(xlabel="time [s]", ylabel="distance from the centre [um]")
    orbits.set(xlabel="x [um]", ylabel="y [um]", aspect="equal", title="levitated")
    over_time.legend()
    figure.savefig(picture)


def line(points, box, limits, colour):
    """An SVG line through `points`, from the limits (x0, x1, y0, y1) into the box (left, top, width, height)."""
    (left, top, width, height), (x0, x1, y0, y1) = box, limits
    at = " ".join(f"{left + width * (x - x0) / (x1 - x0):.1f},{top + height * (y1 - y) / (y1 - y0):.1f}"
                  for x, y in points)
    return f'<polyline points="{at}" fill="none" stroke="{colour}" stroke-width="0.8"/>'


def axes(box, limits, title):
    (left, top, width, height), (x0, x1, y0, y1) = box, limits
    under, beside = top + height + 16, left - 6
    return (f'<rect x="{left}" y="{top}" width="{width}" height="{height}" fill="none" stroke="#888"/>'
            f'<text x="{left}" y="{top - 8}">{title}</text>'
            f'<text x="{left}" y="{under}">{x0:.3g}</text>'
            f'<text x="{left + width}" y="{under}" text-anchor="end">{x1:.3g}</text>'
            f'<text x="{beside}" y="{top + height}" text-anchor="end">{y0:.3g}</text>'
            f'<text x="{beside}" y="{top + 10}" text-anchor="end">{y1:.3g}</text>')


def without(picture, times_s, levitated, bearings):
    """The same as an SVG file, written by hand."""
    left, right = (60, 40, 420, 360), (560, 40, 360, 360)
    distances = {name: [math.hypot(x, y) for x, y in points] for name, points in bearings.items()}
    highest = max(map(max, distances.values()))
    free = {name: [point for point, there in zip(points, levitated) if there]
            for name, points in bearings.items()}
    reach = max((abs(number) for points in free.values() for point in points for number in point), default=1.0)
    time_limits, orbit_limits = (times_s[0], times_s[-1], 0.0, highest), (-reach, reach, -reach, reach)
    parts = ['<svg xmlns="http://www.w3.org/2000/svg" width="960" height="440" font-family="sans-serif"'
             ' font-size="12">', '<rect width="960" height="440" fill="#fff"/>',
             axes(left, time_limits, "distance from the centre [um] over time [s]"),
             axes(right, orbit_limits, "levitated: y over x [um]")]
    for colour, name in zip(COLOURS, bearings):
        parts.append(line(zip(times_s, distances[name]), left, time_limits, colour))
        parts.append(line(free[name], right, orbit_limits, colour))
        parts.append(f'<text x="{70 + 60 * COLOURS.index(colour)}" y="60" fill="{colour}">{name}</text>')
    Path(picture).write_text("\n".join(parts) + "\n</svg>\n", encoding="utf-8")


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    session, picture = sys.argv[1:]
    times_s, levitated, bearings = read(session)
    for name, points in bearings.items():
        free = [math.hypot(x, y) for (x, y), there in zip(points, levitated) if there]
        print(f"{name}: largest orbit {max(free):.1f} um" if free else f"{name}: never levitated")
    try:
        import matplotlib
    except ImportError:
        if not picture.endswith(".svg"):
            sys.exit(f"{picture}: without matplotlib an SVG file is all that can be drawn; name it run.svg")
        without(picture, times_s, levitated, bearings)
        return
    matplotlib.use("Agg")
    from matplotlib import pyplot
    with_matplotlib(pyplot, picture, times_s, levitated, bearings)


if __name__ == "__main__":
    main()

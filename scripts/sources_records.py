"""Figures that a row needs of whole files: of the rows that `amb export --csv` writes, of the
response of an identified linear model, of a text that a command wrote. Lengths in m, as in the files.
"""

import cmath
import csv
import functools
import math
import re

STEADY = 0.005  # a row counts as at a speed within this share of it: what a scenario calls reached


@functools.lru_cache(maxsize=4)
def columns(path):
    """name -> values of a column of a CSV file."""
    with open(path, encoding="utf-8", newline="") as file:
        reader = csv.reader(file)
        names = next(reader)
        return dict(zip(names, zip(*([float(cell) for cell in row] for row in reader))))


@functools.lru_cache(maxsize=32)
def at_speed(path, bearing, speed_rpm):
    """(turns of the rotor from the first row on, x + jy) of the rows at a speed."""
    table, found, turns, last = columns(path), [], 0.0, None
    for angle, speed, x, y in zip(table["rotor_angle_rad"], table["speed_rpm"],
                                  table[f"position_{bearing}_x_m"],
                                  table[f"position_{bearing}_y_m"]):
        if abs(speed - speed_rpm) <= STEADY * speed_rpm:
            turns += 0.0 if last is None else (angle - last) / math.tau % 1.0
            last = angle
            found.append((turns, complex(x, y)))
    return found


def vibration(path, bearings, speed_rpm):
    """rms of the radius about its mean at a speed; of several bearings the root of the sum."""
    total = 0.0
    for bearing in bearings:
        radii = [radius for _, radius in at_speed(path, bearing, speed_rpm)]
        mean = sum(radii) / len(radii)
        total += sum(abs(radius - mean) ** 2 for radius in radii) / len(radii)
    return math.sqrt(total)


def line(path, bearing, speed_rpm, order):
    """Amplitude of the line at `order` times the rotor's speed; negative: backward.

    Of whole pairs of turns, in which a wheel at half the speed turns a whole number of times.
    """
    rows = at_speed(path, bearing, speed_rpm)
    end = 2 * (rows[-1][0] // 2)
    values = [radius * cmath.exp(-1j * math.tau * order * turns)
              for turns, radius in rows if turns < end]
    return abs(sum(values)) / len(values)


def largest(path, column):
    """Largest magnitude in a column."""
    return max(map(abs, columns(path)[column]))


def excited(path, column):
    """The rows of a column from the first to the last that is not zero."""
    values = columns(path)[column]
    at = [index for index, value in enumerate(values) if value]
    return values[at[0]:at[-1] + 1]


def rows_excited(path, column):
    return len(excited(path, column))


def largest_correlation(path, names, rows_per_bit, lags=50):
    """Largest |correlation coefficient| of two of the columns, a value a bit, within `lags` bits."""
    bits = [excited(path, name)[rows_per_bit // 2::rows_per_bit] for name in names]
    scale = [math.sqrt(sum(value * value for value in row)) for row in bits]
    found = 0.0
    for first, one in enumerate(bits):
        for second in range(first):
            other = bits[second]
            for lag in range(-lags, lags + 1):
                pairs = zip(one[max(lag, 0):], other[max(-lag, 0):])
                found = max(found, abs(sum(a * b for a, b in pairs)) / scale[first] / scale[second])
    return found


def polynomial(terms, signal):
    """Coefficients of z^0, z^-1, ... of a signal in an identified linear difference equation."""
    found = {}
    for term in terms:
        match = re.fullmatch(rf"{signal}\(k(?:-(\d+))?\)", term["term"])
        if match:
            found[int(match[1] or 0)] = term["coefficient"]
    return [found.get(lag, 0.0) for lag in range(max(found) + 1)]


def least_gain_hz(terms, signal, period_s, low_hz, high_hz):
    """Where between two frequencies the gain from the signal to the output is least, to 0.5 Hz."""
    above, below = polynomial(terms, signal), polynomial(terms, "y1")

    def gain(hz):
        back = cmath.exp(-2j * math.pi * hz * period_s)
        return abs(sum(b * back ** lag for lag, b in enumerate(above)) /
                   (1 - sum(a * back ** lag for lag, a in enumerate(below))))

    return min((low_hz + 0.5 * step for step in range(int(2 * (high_hz - low_hz)) + 1)), key=gain)


def written(path, pattern):
    """The number that the pattern's first group finds in a file."""
    return float(re.search(pattern, path.read_text(encoding="utf-8"), re.S)[1])


def occurrences(path, pattern):
    return len(re.findall(pattern, path.read_text(encoding="utf-8")))


# What an expression may use; each takes a path in the folder of the commands first.
MEASURES = {"largest": largest, "vibration": vibration, "line": line, "rows_excited": rows_excited,
            "largest_correlation": largest_correlation, "written": written,
            "occurrences": occurrences}

#!/usr/bin/env python3
"""Reads a session with LCM's own Python package: how far the rotor came from the centre, per mode.

    pip install lcm
    ./amb run --record run.lcm
    PYTHONPATH=build/release/lcmtypes/python scripts/read_session.py run.lcm

An example to start from: everything of a cycle is a field of its record (lcmtypes/cycle_record_t.lcm).
Positions are as the sensors read them: a rig with inverted probes says so in its header.
"""

import math
import sys

import lcm
from levitas_msg.cycle_record_t import cycle_record_t
from levitas_msg.session_header_t import session_header_t

MODES = ("off", "self_test", "lift", "levitating", "spinning", "coast_down", "landing", "tripped")


def largest_distances(path):
    """{mode: [largest distance in metres, per bearing]} and the channels' names."""
    channels, largest = [], {}
    for event in lcm.EventLog(path, "r"):
        if event.channel == "LEVITAS_HEADER":
            channels = list(session_header_t.decode(event.data).channel)
        elif event.channel == "LEVITAS_CYCLE":
            record = cycle_record_t.decode(event.data)
            if not record.frame_present:
                continue
            at = record.position_m
            pairs = [math.hypot(*at[i:i + 2]) for i in range(0, len(at), 2)]
            best = largest.setdefault(MODES[record.mode], pairs)
            largest[MODES[record.mode]] = [max(a, b) for a, b in zip(best, pairs)]
    return largest, channels


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    largest, channels = largest_distances(sys.argv[1])
    for mode, distances_m in largest.items():
        for bearing, distance_m in enumerate(distances_m):
            print(f"{mode} {channels[2 * bearing]}: {1e6 * distance_m:.2f} um")


if __name__ == "__main__":
    main()

"""What became of a turning rotor: a scenario that turns it, and how a record says that it ended."""

import math

from lcm_network import log_events

SPEED_RPM = 3000
STANDSTILL_RPM = 5  # of the shipped controllers: below it the rotor counts as standing
SPIN = f"""kind: scenario
name: spin
steps:
  - {{do: lift, until: levitating, timeout_s: 5, hold_s: 0.1}}
  - {{do: spin, speed_rpm: {SPEED_RPM}, acceleration_rpm_per_s: 2000, until: speed_reached, timeout_s: 8, hold_s: %s}}
  - {{do: spin, speed_rpm: 0, acceleration_rpm_per_s: 2000, until: standstill, timeout_s: 5}}
  - {{do: land, until: off, timeout_s: 5}}
"""


def records(path):
    from levitas_msg import cycle_record_t
    return [cycle_record_t.decode(data) for channel, data in log_events(path)
            if channel == "LEVITAS_CYCLE"]


def rpm(record):
    return record.speed_rad_per_s * 30 / math.pi


class Fate:
    """Of the rotor in a record: how fast it has turned, and how fast when its magnets let go."""

    def __init__(self, path):
        held, self.released_rpm, self.top_rpm = False, None, 0.0
        for record in records(path):
            self.top_rpm = max(self.top_rpm, rpm(record))
            if held and not record.amplifiers_enabled:
                self.released_rpm = rpm(record)
            held = record.amplifiers_enabled
        self.held_at_the_end = held

    @property
    def landed(self):
        """It had turned at full speed, and stood when the magnets were switched off."""
        return (self.top_rpm > 0.99 * SPEED_RPM and not self.held_at_the_end and
                self.released_rpm is not None and abs(self.released_rpm) <= STANDSTILL_RPM)

    def __str__(self):
        if self.held_at_the_end:
            return f"turned at {self.top_rpm:.0f} rpm; the record ends with the magnets on"
        return f"turned at {self.top_rpm:.0f} rpm, let go at {self.released_rpm:.1f} rpm"

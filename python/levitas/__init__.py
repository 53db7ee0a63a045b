"""Sessions of Levitas as arrays, and its programs as functions.

    import levitas
    run = levitas.run(scenario="run_up_6000", record="run.lcm")
    session = levitas.load("run.lcm")
    session["position_de_x_m"], session.time_s, session.rig_yaml

load() reads sessions, trip files, and the CSV and MCAP files that `amb export` writes. run(),
margins(), identify(), diagnose() and amb() start the program `amb` and return its JSON. Controller
commands a controller that runs on this machine.
"""

from .controller import Controller, NoAnswer, Refused
from .programs import Failed, amb, diagnose, identify, margins, poles, run
from .session import Session, Unreadable, load

__all__ = ["Controller", "Failed", "NoAnswer", "Refused", "Session", "Unreadable", "amb", "diagnose",
           "identify", "load", "margins", "poles", "run"]

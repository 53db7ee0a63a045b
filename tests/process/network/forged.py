"""Every message that moves a rig or ends a run, as somebody else would make it."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from lcm_network import COMMAND, CURRENT, SENSOR, TELEMETRY, short_message  # noqa: E402

LIFT, LAND, STOP = 1, 4, 5
FAR_AHEAD = 1 << 40  # a cycle number that no run reaches


def command(number, sequence=1):
    from levitas_msg.operator_command_t import operator_command_t
    message = operator_command_t()
    message.sequence, message.command = sequence, number
    return COMMAND, short_message("LEVITAS_COMMAND", message.encode(), sequence)


def excitation(sequence=1):
    from levitas_msg.excitation_request_t import excitation_request_t
    message = excitation_request_t()
    message.sequence, message.step_yaml = sequence, "hold_s: 1"
    return COMMAND, short_message("LEVITAS_EXCITATION", message.encode(), sequence)


def sensor_frame(cycle=FAR_AHEAD, session=1):
    from levitas_msg.sensor_frame_t import sensor_frame_t
    message = sensor_frame_t()
    message.cycle, message.rig_session, message.axes = cycle, session, 4
    message.position_m = [1e-3] * 4
    return SENSOR, short_message("LEVITAS_SENSOR", message.encode())


def current_frame(channel="LEVITAS_CURRENT"):
    from levitas_msg.current_frame_t import current_frame_t
    message = current_frame_t()
    message.cycle, message.axes, message.control_current_a = FAR_AHEAD, 4, [3.0] * 4
    message.amplifiers_enabled = True
    return CURRENT, short_message(channel, message.encode())


def goodbye():
    return current_frame("LEVITAS_GOODBYE")


def event(text):
    from levitas_msg.event_t import event_t
    message = event_t()
    message.text = text
    return TELEMETRY, short_message("LEVITAS_EVENT", message.encode())


def everything():
    return [command(LIFT, 1), command(LAND, 2), excitation(3), command(STOP, 4), sensor_frame(),
            current_frame(), goodbye(), event("command emergency_stop")]

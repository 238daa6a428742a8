"""Inputs that many mechanisms have."""

from __future__ import annotations

from ..ports import Input


def shaft_inputs(speed: float, angle: float = 0.0, shaft: str = "drive shaft") -> tuple[Input, Input]:
    """Speed and angle of the driven end of the `CompliantShaft` "shaft": drive_speed and drive_angle.

    Args:
        speed: before the first value arrives [rad/s].
        angle: before the first value arrives [rad].
        shaft: what it is called in the descriptions.
    """
    end = f"of the driven end of the {shaft} (it acts when"
    return (
        Input("drive_speed", "shaft.speed", speed, f"Speed {end} drive_damping > 0)", "rad/s", -1e6, 1e6, "rpm"),
        Input("drive_angle", "shaft.angle", angle, f"Angle {end} drive_stiffness > 0)", "rad", -1e6, 1e6, "deg"),
    )


def torque_input(force: str, body: str, start: float = 0.0) -> Input:
    """The torque [N.m] of a `Torque` on a body: <force>_torque.

    Args:
        force: name of the `Torque`, e.g. "drive".
        body: on which it acts, for the description.
        start: before the first value arrives [N.m].
    """
    return _torque(force, f"Torque on the {body}", start)


def load_torque_input(body: str, start: float = 0.0) -> Input:
    """The torque [N.m] of what a body drives, by the `Torque` "load": load_torque.

    Args:
        body: on which it acts, for the description.
        start: before the first value arrives [N.m].
    """
    return _torque("load", f"External torque on the {body}", start)


def _torque(force: str, what: str, start: float) -> Input:
    description = f"{what}, counter-clockwise positive"
    return Input(f"{force}_torque", f"{force}.torque", start, description, "N.m", -1e6, 1e6)

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


def torque_input(force: str, body: str, start: float = 0.0, what: str = "Torque") -> Input:
    """The torque [N.m] of a `Torque` on a body: <force>_torque.

    Args:
        force: name of the `Torque`, e.g. "drive" or "load".
        body: on which it acts, for the description.
        start: before the first value arrives [N.m].
        what: first words of the description, e.g. "External torque".
    """
    description = f"{what} on the {body}, counter-clockwise positive"
    return Input(f"{force}_torque", f"{force}.torque", start, description, "N.m", -1e6, 1e6)

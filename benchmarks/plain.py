"""The plain ratchet under the names of the FMU."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .ratchet import Parameters, Ratchet, Vector, build
from .reference import CRANK_ANGLE, PAWL_ANGLE, WHEEL_ANGLE, State

_ANGLES = [WHEEL_ANGLE, CRANK_ANGLE, PAWL_ANGLE]

#: What both ratchets show, in this order.
OUTPUTS = ("wheel_angle", "crank_angle", "pawl_angle", "wheel_speed", "crank_speed", "pawl_speed")

#: Inputs with their start values [N m].
INPUTS = {name: getattr(Parameters, name) for name in ("drive_torque", "spring_preload", "load_torque")}


def at_rest() -> tuple[Ratchet, State]:
    """The ratchet of the paper's base case, and its start."""
    ratchet = build(Parameters())
    return ratchet, State(0.0, ratchet.start, np.zeros(9))


def driven(ratchet: Ratchet, drive_torque: float, spring_preload: float, load_torque: float) -> Ratchet:
    """The ratchet with other inputs [N m]."""
    p = ratchet.parameters
    p = replace(p, drive_torque=drive_torque, spring_preload=spring_preload, load_torque=load_torque)
    return replace(ratchet, parameters=p)


def outputs(state: State) -> Vector:
    """Values of `OUTPUTS` [rad, rad/s], shape (6,)."""
    return np.concatenate([state.q[_ANGLES], state.qd[_ANGLES]])

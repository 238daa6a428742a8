"""A rotor with an arm against radial stops: with constant torque, or a spring, every instant has a closed form.

The centre of mass is on the hinge, so that the angle alone moves; the gap to a stop is arm * sin(angle to go).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from mechanism_fmu.model import (
    GROUND,
    Body,
    Input,
    Mechanism,
    PointLineContact,
    Revolute,
    Settings,
    Torque,
    TorsionSpring,
)

INERTIA = 0.5
ARM = 0.4


class Stop(NamedTuple):
    """A radial line at `angle` [rad] that stops rotation in the direction `sign`."""

    angle: float
    sign: int = 1
    restitution: float = 0.0
    closed: bool = False


def rotor(
    stops: Sequence[Stop] = (),
    *,
    angle: float = 0.0,
    speed: float = 0.0,
    acceleration: float = 0.0,
    frequency: float = 0.0,
    outputs: Any = (),
    tolerance: float = 1e-9,
) -> Mechanism:
    """A rotor that a torque accelerates [rad/s2] and a spring, relaxed at 0, makes swing at `frequency` [rad/s]."""
    return Mechanism(
        bodies=(Body("rotor", 1.0, INERTIA, (0.0, 0.0, angle), (0.0, 0.0, speed)),),
        joints=(Revolute("hinge", "rotor", (0.0, 0.0), GROUND, (0.0, 0.0)),),
        forces=(
            Torque("drive", "rotor"),
            TorsionSpring("spring", "rotor", stiffness=INERTIA * frequency**2),
        ),
        contacts=tuple(_contact(f"stop{k}", stop) for k, stop in enumerate(stops)),
        inputs=(
            Input("torque", "drive.torque", INERTIA * acceleration, "Torque on the rotor", "N.m"),
            Input("preload", "spring.preload", 0.0, "Preload of the spring", "N.m"),
        ),
        outputs=outputs,
        settings=Settings(relative_tolerance=tolerance),
    )


def _contact(name: str, stop: Stop) -> PointLineContact:
    normal = (stop.sign * math.sin(stop.angle), -stop.sign * math.cos(stop.angle))
    return PointLineContact(
        name,
        "rotor",
        (ARM, 0.0),
        GROUND,
        (0.0, 0.0),
        normal,
        closed=stop.closed,
        restitution=stop.restitution,
        guided=True,
    )

"""A swinging plate that carries a lighter one on a closed contact: the contact's force has a closed form."""

from __future__ import annotations

import math

from mechanism_fmu.model import (
    GROUND,
    Body,
    Input,
    Mechanism,
    Output,
    PointLineContact,
    Revolute,
    Settings,
    Torque,
    TorsionSpring,
)

CARRIER_INERTIA = 0.3
RIDER_INERTIA = 0.2
ARM = 0.25
FREQUENCY = 2.0
AMPLITUDE = 0.5
#: Torque that the rider's swing needs at its ends [N m].
LARGEST = RIDER_INERTIA * AMPLITUDE * FREQUENCY**2


def carried(press: float, *, tolerance: float = 1e-9) -> Mechanism:
    """Both turn about the origin; a spring makes them swing with angle -AMPLITUDE cos(FREQUENCY t).

    A torque between the two, `press` times LARGEST, presses the rider clockwise on its seat; the motion does not
    depend on it.
    """
    inertia = CARRIER_INERTIA + RIDER_INERTIA
    start = (0.0, 0.0, -AMPLITUDE)
    return Mechanism(
        bodies=(Body("carrier", 1.0, CARRIER_INERTIA, start), Body("rider", 1.0, RIDER_INERTIA, start)),
        joints=(
            Revolute("carrier_hinge", "carrier", (0.0, 0.0), GROUND, (0.0, 0.0)),
            Revolute("rider_hinge", "rider", (0.0, 0.0), GROUND, (0.0, 0.0)),
        ),
        forces=(
            Torque("press", "rider", reaction="carrier"),
            TorsionSpring("spring", "carrier", stiffness=inertia * FREQUENCY**2),
        ),
        # the open side is counter-clockwise of the radial line on the carrier
        contacts=(
            PointLineContact("seat", "rider", (ARM, 0.0), "carrier", (0.0, 0.0), (0.0, 1.0), closed=True, guided=True),
        ),
        inputs=(Input("torque", "press.torque", -press * LARGEST, "", "N.m"),),
        outputs=(Output("force", "seat.force", "", "N", feedthrough=("torque",)), Output("gap", "seat.gap", "", "m")),
        settings=Settings(relative_tolerance=tolerance),
    )


def seat_force(time: float, press: float) -> float:
    """Force of the seat on the rider [N]: ARM force - press LARGEST is its inertia times its acceleration."""
    return (press + math.cos(FREQUENCY * time)) * LARGEST / ARM

"""Rigid bodies."""

from __future__ import annotations

from dataclasses import dataclass

from .functions import Number

#: The name of the fixed frame: use it wherever a body is asked for.
GROUND = "ground"

#: A point or a vector (x, y) [m] in the frame of a body, from its centre of mass, or in the global frame.
Point = tuple[Number, Number]


@dataclass(frozen=True)
class Body:
    """A rigid body of the plane; its coordinates are (x, y) of the centre of mass and the angle phi.

    Attributes:
        name: unique within the mechanism.
        mass: [kg], > 0.
        inertia: about the centre of mass [kg m2], > 0.
        start: guess of (x [m], y [m], phi [rad]) that `assemble` closes.
        start_rate: (xd [m/s], yd [m/s], phid [rad/s]) at the start. They must agree with the joints; where there are
            held coordinates, their rates are kept and the others follow.
        tooth_length: length l of its teeth as beams [m], > 0, if it has any. Every impact that changes its speed then
            has the impact velocity of the stress recovery, v_I = l (phid after - phid before). Only one body of a
            mechanism that reports v_I has teeth.
    """

    name: str
    mass: Number
    inertia: Number
    start: tuple[Number, Number, Number] = (0.0, 0.0, 0.0)
    start_rate: tuple[Number, Number, Number] = (0.0, 0.0, 0.0)
    tooth_length: Number | None = None

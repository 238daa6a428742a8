"""Springs whose force follows from a function of the user's own, or from a table."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from ..curves import Curve
from ..laws import Law
from .base import PointElement, TorqueElement, angle_quantities, length_quantities


@dataclass(frozen=True, init=False)
class NonlinearSpring(PointElement):
    """A force between two points by a law: of their distance and its rate, as a function or a table.

    A table (`characteristic`, or any `Curve` of polynomials up to the fourth degree) gives the force over the length;
    its energy counts as spring energy, 0 at the table's first point. A function `def law(length, rate): ...` may depend
    on both; what it takes and gives counts as work done on the mechanism. Where the points meet or rest together, it is
    as of a `SpringDamper`.

    Attributes:
        name: unique within the mechanism.
        body, reaction: names of the two bodies (or `GROUND`).
        point, reaction_point: the points, in the frame of each body [m].
        law: force [N] that pulls the points together, over their distance [m] and its rate [m/s].

    Source: the user's own law: docs/decisions/039-laws-of-the-users-own.md; docs/elements/nonlinear_spring.md.
    """

    row: ClassVar = "nonlinear_spring"
    quantities: ClassVar = length_quantities()

    law: Law | Curve = field(kw_only=True)


@dataclass(frozen=True, init=False)
class NonlinearTorsionSpring(TorqueElement):
    """A torque between two bodies by a law: of their relative angle and its rate, as a function or a table.

    The torque on `body` is -law, as that of a `TorsionSpring`: a law that grows with the angle drives back. Tables,
    functions and energy as of `NonlinearSpring`.

    Attributes:
        name: unique within the mechanism.
        body, reaction: names of the two bodies.
        law: torque [N m] against the angle, over phi - phi_reaction [rad] and its rate [rad/s].

    Source: the user's own law: docs/decisions/039-laws-of-the-users-own.md; docs/elements/nonlinear_spring.md.
    """

    row: ClassVar = "nonlinear_torsion_spring"
    quantities: ClassVar = angle_quantities()

    law: Law | Curve = field(kw_only=True)

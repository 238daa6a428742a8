"""Translational joint."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ..body import Point
from ..conditions import length
from ..curves import Curve
from ..functions import Number
from .base import Effort, JointFacts


@dataclass(frozen=True)
class Translational(JointFacts):
    """A slider: the bodies keep their relative angle and slide along a common axis (ME451, translational).

    1. Allows: sliding along the axis; one degree of freedom remains of three.
    2. Phi = ((R v_i).d, (R v_i).v_j), two rows [m2, m2], with d = r_j^P - r_i^P and v the axes, turned with the bodies.
    3. Phi_q = [-n, -v_i.d - n.R a, n, n.R b] and [0, -v_i.v_j, 0, v_i.v_j] with n = R v_i, a = A_i s_i, b = A_j s_j.
    4. nu = 0.
    5. gamma = n.d phi_i'^2 + 2 v_i.d' phi_i' - n.(a phi_i'^2 - b phi_j'^2) and n.v_j (phi_i' - phi_j')^2.

    Outputs: `force` [N], across the axis, on body j: positive along R v_i, to the left of the axis.

    Traps: the rows do not know which way along the axis is forward, so that a slider may come to stand turned by 180
    degrees: the start guess decides.

    Attributes:
        name: unique within the mechanism.
        body_i, body_j: names of the two bodies (or `GROUND`).
        point_i, point_j: a point of the axis in the frame of each body [m].
        axis_i, axis_j: direction of the axis in the frame of each body (any length > 0).
        friction: coefficient of friction; friction force = it times the force across the axis.
    """

    row: ClassVar = "translational"
    efforts: ClassVar = {"force": Effort(0, "axis_length")}
    axes: ClassVar = ("axis_i", "axis_j")
    rows: ClassVar = 2
    motion: ClassVar[Curve | None] = None

    name: str
    body_i: str
    point_i: Point
    axis_i: Point
    body_j: str
    point_j: Point
    axis_j: Point
    friction: Number = 0.0

    def data(self) -> tuple[Number, ...]:
        """The joint's row of the table `joint_data`: point_i, point_j, axis_i, axis_j."""
        return (*self.point_i, *self.point_j, *self.axis_i, *self.axis_j)

    @property
    def axis_length(self) -> Number:
        """Of `axis_i`, by which the multiplier must be taken to be a force."""
        return length(self.axis_i)

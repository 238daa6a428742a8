"""Revolute joint."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ..body import Point
from ..curves import Curve
from ..functions import Number
from .base import Effort, JointFacts


@dataclass(frozen=True)
class Revolute(JointFacts):
    """A pin: point P of `body_i` and point P of `body_j` coincide (ME451, revolute).

    1. Allows: both bodies turn freely about P; one degree of freedom remains of three.
    2. Phi = r_i^P - r_j^P, two rows [m].
    3. Phi_q = [1, R a, -1, -R b] with a = A_i s_i and b = A_j s_j.
    4. nu = 0.
    5. gamma = a phi_i'^2 - b phi_j'^2.

    Outputs: `force_x` and `force_y` [N], the force on body i, along the global axes.

    Attributes:
        name: unique within the mechanism.
        body_i, body_j: names of the two bodies (or `GROUND`).
        point_i, point_j: P in the frame of each body [m].
        friction_radius: coefficient of friction times radius of the pin [m]; friction torque = it times the pin force.
    """

    row: ClassVar = "revolute"
    efforts: ClassVar = {"force_x": Effort(0), "force_y": Effort(1)}
    friction_name: ClassVar = "friction_radius"
    rows: ClassVar = 2
    motion: ClassVar[Curve | None] = None

    name: str
    body_i: str
    point_i: Point
    body_j: str
    point_j: Point
    friction_radius: Number = 0.0

    @property
    def friction(self) -> Number:
        """The joint's entry in the table `joint_friction`."""
        return self.friction_radius

    def data(self) -> tuple[Number, ...]:
        """The joint's row of the table `joint_data`: point_i, point_j."""
        return (*self.point_i, *self.point_j)

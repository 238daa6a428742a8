"""Translational joint."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ... import codes
from ..body import Point
from ..curves import Curve
from ..functions import Number


@dataclass(frozen=True)
class Translational:
    """A slider: the bodies keep their relative angle and slide along a common axis (ME451, translational).

    Attributes:
        name: unique within the mechanism.
        body_i, body_j: names of the two bodies (or `GROUND`).
        point_i, point_j: a point of the axis in the frame of each body [m].
        axis_i, axis_j: direction of the axis in the frame of each body (any length > 0).
        friction: coefficient of friction; friction force = it times the force across the axis.
    """

    kind: ClassVar[int] = codes.TRANSLATIONAL
    rows: ClassVar[int] = 2
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

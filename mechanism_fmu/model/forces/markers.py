"""Points of bodies that are read: an element without a force."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ..attached import Slot
from ..body import GROUND, NamedPoint, Point
from .base import Element, Quantity


@dataclass(frozen=True, init=False)
class Marker(Element, NamedPoint):
    """A point of a body whose place and velocity are read: the pen of a pantograph, the end of a coupler.

    Default outputs have them, and default drawings show the point and its path.

    Attributes:
        name: unique within the mechanism.
        body: name of the body.
        point: in the frame of the body [m].

    Source: kinematics of a point of a rigid body, r = x + A(phi) s.
    """

    row: ClassVar = "marker"
    quantities: ClassVar = {
        "x": Quantity("m", "x of the point"),
        "y": Quantity("m", "y of the point"),
        "x_rate": Quantity("m/s", "Velocity of the point along x"),
        "y_rate": Quantity("m/s", "Velocity of the point along y"),
    }
    acts: ClassVar = "nowhere"
    reaction: ClassVar[str] = GROUND
    slots: ClassVar = (Slot("body", "point"),)

    name: str
    body: str
    point: Point

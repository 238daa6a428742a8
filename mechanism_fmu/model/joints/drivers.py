"""Drivers: a coordinate, an angle or a distance follows a curve over time."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from ..attached import Slot
from ..body import GROUND, Point
from ..curves import Curve
from ..curves.check_curves import least_value
from ..findings import Finding, positive, refuse_unless
from ..functions import Number
from .base import Effort, JointFacts, unit_vector

# What drivers between two points have in common.


@dataclass(frozen=True, init=False)
class PointDriver(JointFacts):
    """A driver of point P of body j against point P of body i.

    Attributes:
        name: unique within the mechanism.
        body_j, point_j: body, and P in its frame [m], that are driven.
        motion: C(t) [m], with two derivatives.
        body_i, point_i: what they are driven against: the ground at its origin unless given.
    """

    slots: ClassVar = (Slot("body_j", "point_j"), Slot("body_i", "point_i"))

    name: str
    body_j: str
    point_j: Point
    motion: Curve
    body_i: str = GROUND
    point_i: Point = (0.0, 0.0)

    def data(self) -> tuple[Number, ...]:
        """The joint's row of the table `joint_data`: point_i, point_j."""
        return (*self.point_i, *self.point_j)


# Driver of x.


@dataclass(frozen=True, init=False)
class XDriver(PointDriver):
    """Point P_j moves in x as a function of time prescribes (ME451, absolute and relative x driver).

    1. Allows: any motion in y, and any angles; prescribes one degree of freedom.
    2. Phi = x_j^P - x_i^P - C(t), one row [m].
    3. Phi_q = [-1, 0, (A_i s_i)_y, 1, 0, -(A_j s_j)_y].
    4. nu = C'.
    5. gamma = -(A_i s_i)_x phi_i'^2 + (A_j s_j)_x phi_j'^2 + C''.

    Outputs: `force` [N], of the driver on body j along x.

    Attributes:
        name: unique within the mechanism.
        body_j: body that is driven.
        point_j: P in its frame [m].
        motion: C(t) [m], with two derivatives.
        body_i: what it is driven against: the ground unless given.
        point_i: P in its frame [m]: the origin unless given.
    """

    row: ClassVar = "x_driver"
    efforts: ClassVar = {"force": Effort(0)}


# Driver of y.


@dataclass(frozen=True, init=False)
class YDriver(PointDriver):
    """Point P_j moves in y as a function of time prescribes (ME451, absolute and relative y driver).

    1. Allows: any motion in x, and any angles; prescribes one degree of freedom.
    2. Phi = y_j^P - y_i^P - C(t), one row [m].
    3. Phi_q = [0, -1, -(A_i s_i)_x, 0, 1, (A_j s_j)_x].
    4. nu = C'.
    5. gamma = -(A_i s_i)_y phi_i'^2 + (A_j s_j)_y phi_j'^2 + C''.

    Outputs: `force` [N], of the driver on body j along y.

    Attributes:
        name, body_j, point_j, motion, body_i, point_i: as of `XDriver`.
    """

    row: ClassVar = "y_driver"
    efforts: ClassVar = {"force": Effort(0)}


# Driver of an angle.


@dataclass(frozen=True, init=False)
class AngleDriver(JointFacts):
    """A body turns as a function of time prescribes (ME451, absolute and relative angle driver).

    1. Allows: any motion of the points; prescribes one degree of freedom.
    2. Phi = phi_j - phi_i - C(t), one row [rad]; angles count turns.
    3. Phi_q = [0, 0, -1, 0, 0, 1].
    4. nu = C'.
    5. gamma = C''.

    Outputs: `torque` [N m], of the driver on body j.

    Attributes:
        name: unique within the mechanism.
        body_j: the body that is driven.
        motion: C(t) [rad], with two derivatives.
        body_i: what it is driven against: the ground unless given.
    """

    row: ClassVar = "angle_driver"
    unit: ClassVar = "rad"
    efforts: ClassVar = {"torque": Effort(0, unit="N.m")}
    slots: ClassVar = (Slot("body_j"), Slot("body_i"))

    name: str
    body_j: str
    motion: Curve
    body_i: str = GROUND

    def data(self) -> tuple[Number, ...]:
        """The joint's row of the table `joint_data`: nothing."""
        return ()


# Driver of a distance.


@dataclass(frozen=True, init=False)
class DistanceDriver(PointDriver):
    """Two points keep the distance that a function of time prescribes (ME451, absolute and relative distance driver).

    1. Allows: P_j moves on a circle about P_i whose radius is prescribed, and the bodies turn.
    2. Phi = d.d - C(t)^2 with d = r_j^P - r_i^P, one row [m2]. C must not pass 0, where the row has no gradient.
    3. Phi_q = 2 [-d, -d.R a, d, d.R b] with a = A_i s_i and b = A_j s_j.
    4. nu = 2 C C'.
    5. gamma = -2 d'.d' - 2 d.(a phi_i'^2 - b phi_j'^2) + 2 (C'^2 + C C'').

    Attributes:
        name: unique within the mechanism.
        body_j: body that is driven.
        point_j: P in its frame [m].
        motion: C(t) [m], > 0, with two derivatives.
        body_i: what it is driven against: the ground unless given.
        point_i: P in its frame [m]: the origin unless given.
    """

    row: ClassVar = "distance_driver"

    def findings(self) -> Iterator[Finding]:
        """That the distance comes to nothing."""
        if not self.motion.pieces:
            return
        least = least_value(self.motion)
        text = (
            f"{self.label}: its motion comes to a distance of {{:.6g}} m, but it must stay above 0: where the two "
            "points meet, nothing says in which direction they part. Give another motion."
        )
        yield refuse_unless(positive(least), text, least)


# Driver along an axis.


@dataclass(frozen=True, init=False)
class TranslationalDriver(JointFacts):
    """Point P_j moves along an axis of body i as a function of time prescribes (ME451, translational driver).

    1. Allows: any motion across the axis, and any angles; prescribes one degree of freedom.
    2. Phi = u_i.d - C(t) with d = r_j^P - r_i^P, one row [m].
    3. Phi_q = [-u, (R u).d - u.R a, u, u.R b] with u = A_i u_i, a = A_i s_i, b = A_j s_j.
    4. nu = C'.
    5. gamma = u.d phi_i'^2 - 2 (R u).d' phi_i' - u.(a phi_i'^2 - b phi_j'^2) + C''.

    Outputs: `force` [N], of the driver on body j along u_i.

    Attributes:
        name: unique within the mechanism.
        body_j, point_j: body, and P in its frame [m], that are driven.
        axis_i: direction of the axis in the frame of body i (any length > 0; u_i is its unit vector).
        motion: C(t) [m], with two derivatives.
        body_i, point_i: what they are driven against: the ground at its origin unless given.
    """

    row: ClassVar = "translational_driver"
    efforts: ClassVar = {"force": Effort(0)}
    axes: ClassVar = ("axis_i",)
    slots: ClassVar = (Slot("body_j", "point_j"), Slot("body_i", "point_i", "axis_i"))

    name: str
    body_j: str
    point_j: Point
    axis_i: Point
    motion: Curve
    body_i: str = GROUND
    point_i: Point = (0.0, 0.0)

    def data(self) -> tuple[Number, ...]:
        """The joint's row of the table `joint_data`: point_i, point_j, u_i."""
        return (*self.point_i, *self.point_j, *unit_vector(self.axis_i))

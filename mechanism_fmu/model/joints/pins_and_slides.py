"""Pins, slides, rods between two pins, and pins in guides."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from ..attached import Slot
from ..body import Point
from ..findings import length
from ..functions import Number
from .base import Effort, UndrivenJoint, unit_vector

# What pins and rods have in common, and what slides and guides have.


@dataclass(frozen=True, init=False)
class _OfPoints(UndrivenJoint):
    """A joint of two points."""

    slots: ClassVar = (Slot("body_i", "point_i"), Slot("body_j", "point_j"))

    name: str
    body_i: str
    point_i: Point
    body_j: str
    point_j: Point


@dataclass(frozen=True, init=False)
class _OfGuide(UndrivenJoint):
    """A joint whose body i has a line."""

    axes: ClassVar[tuple[str, ...]] = ("axis_i",)
    slots: ClassVar = (Slot("body_i", "point_i", "axis_i"), Slot("body_j", "point_j"))

    name: str
    body_i: str
    point_i: Point
    axis_i: Point
    body_j: str
    point_j: Point


# Revolute joint.


@dataclass(frozen=True, init=False)
class Revolute(_OfPoints):
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
        friction_static: the same while it sticks [m], at least as large; None: as large.
    """

    row: ClassVar = "revolute"
    efforts: ClassVar = {"force_x": Effort(0), "force_y": Effort(1)}
    friction_name: ClassVar = "friction_radius"
    rows: ClassVar = 2
    units: ClassVar = {"friction_radius": "m"}

    friction_radius: Number = 0.0
    friction_static: Number | None = field(default=None, kw_only=True)

    @property
    def friction(self) -> Number:
        """The joint's entry in the table `joint_friction`."""
        return self.friction_radius

    def data(self) -> tuple[Number, ...]:
        """The joint's row of the table `joint_data`: point_i, point_j."""
        return (*self.point_i, *self.point_j)


# Translational joint.


@dataclass(frozen=True, init=False)
class Translational(_OfGuide):
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
        friction: coefficient of friction [1], >= 0; friction force = it times the force across the axis.
        friction_static: the same while it sticks [1], at least as large; None: as large.
    """

    row: ClassVar = "translational"
    efforts: ClassVar = {"force": Effort(0, "axis_length")}
    axes: ClassVar = ("axis_i", "axis_j")
    rows: ClassVar = 2
    slots: ClassVar = (Slot("body_i", "point_i", "axis_i"), Slot("body_j", "point_j", "axis_j"))

    axis_j: Point
    friction: Number = 0.0
    friction_static: Number | None = field(default=None, kw_only=True)

    def data(self) -> tuple[Number, ...]:
        """The joint's row of the table `joint_data`: point_i, point_j, axis_i, axis_j."""
        return (*self.point_i, *self.point_j, *self.axis_i, *self.axis_j)

    @property
    def axis_length(self) -> Number:
        """Of `axis_i`, by which the multiplier must be taken to be a force."""
        return length(self.axis_i)


# Revolute-revolute composite joint.


@dataclass(frozen=True, init=False)
class Distance(_OfPoints):
    """A massless rod with a pin at either end (ME451, revolute-revolute composite).

    1. Allows: both bodies turn freely and point P_j moves on a circle about P_i; two degrees of freedom remain.
    2. Phi = d.d - C^2 with d = r_j^P - r_i^P, one row [m2]. C > 0: at C = 0 the row has no gradient (that is a pin).
    3. Phi_q = 2 [-d, -d.R a, d, d.R b] with a = A_i s_i and b = A_j s_j.
    4. nu = 0.
    5. gamma = -2 d'.d' - 2 d.(a phi_i'^2 - b phi_j'^2).

    Outputs: `force` [N], the tension of the rod: positive when it pulls.

    Attributes:
        name: unique within the mechanism.
        body_i, body_j: names of the two bodies (or `GROUND`).
        point_i, point_j: P in the frame of each body [m].
        distance: C [m], > 0.
    """

    row: ClassVar = "distance"
    efforts: ClassVar = {"force": Effort(0, "effort_factor")}
    sizes: ClassVar = ("distance",)
    units: ClassVar = {"distance": "m"}

    distance: Number

    def data(self) -> tuple[Number, ...]:
        """The joint's row of the table `joint_data`: point_i, point_j, C."""
        return (*self.point_i, *self.point_j, self.distance)

    @property
    def effort_factor(self) -> Number:
        """From the multiplier [N/m] to the tension: |Phi_q| is twice the distance."""
        return -2 * self.distance


# Revolute-translational composite joint.


@dataclass(frozen=True, init=False)
class RevoluteTranslational(_OfGuide):
    """A pin of `body_j` in a straight guide of `body_i`, with a massless slider between (ME451, of that name).

    1. Allows: point P_j slides along a line fixed in body i, and body j turns; two degrees of freedom remain.
    2. Phi = (R u_i).d - c with d = r_j^P - r_i^P, one row [m]: P_j is c to the left of the line through P_i along u_i.
    3. Phi_q = [-n, -u.d - n.R a, n, n.R b] with u = A_i u_i, n = R u, a = A_i s_i, b = A_j s_j.
    4. nu = 0.
    5. gamma = n.d phi_i'^2 + 2 u.d' phi_i' - n.(a phi_i'^2 - b phi_j'^2).

    Outputs: `force` [N], of the guide on the pin (body j): positive along R u_i, to the left of the guide.

    Attributes:
        name: unique within the mechanism.
        body_i, body_j: names of the two bodies (or `GROUND`); the guide is on body i.
        point_i: a point of the guide in the frame of body i [m].
        axis_i: direction of the guide in the frame of body i (any length > 0; u_i is its unit vector).
        point_j: P in the frame of body j [m].
        distance: c [m], of any sign.
    """

    row: ClassVar = "revolute_translational"
    efforts: ClassVar = {"force": Effort(0)}
    units: ClassVar = {"distance": "m"}

    distance: Number = 0.0

    def data(self) -> tuple[Number, ...]:
        """The joint's row of the table `joint_data`: point_i, point_j, R u_i, c."""
        x, y = unit_vector(self.axis_i)
        return (*self.point_i, *self.point_j, -y, x, self.distance)

"""Poses of the rigid bodies in all configurations, and constraints of joints on small displacements there."""

from __future__ import annotations

from dataclasses import dataclass
from typing import get_args

import numpy as np

from ...kinematics import KinematicMotion
from ...model import (
    GROUND,
    AngleDriver,
    Distance,
    DistanceDriver,
    Mechanism,
    Revolute,
    RevoluteTranslational,
    Translational,
    TranslationalDriver,
    XDriver,
    YDriver,
)
from ...model.body import Point
from ...model.findings import length
from ...model.joints import Joint
from ..elements import FloatArray, LinkageError


@dataclass(frozen=True)
class Pose:
    """Coordinates q, rates and accelerations of the bodies of a mechanism; the ground comes last, and rests.

    Attributes:
        bodies: names of the bodies, and `GROUND`.
        time: shape (times,) [s].
        position, velocity, acceleration: (x, y, phi) of each body, shape (times, bodies + 1, 3) [m, rad and by s, s2].
        cosine, sine: of phi, shape (times, bodies + 1).
    """

    bodies: tuple[str, ...]
    time: FloatArray
    position: FloatArray
    velocity: FloatArray
    acceleration: FloatArray
    cosine: FloatArray
    sine: FloatArray

    def turned(self, body: str, vector: Point) -> FloatArray:
        """A vector of a body's frame in the global one, A s, shape (times, 2)."""
        k = self.bodies.index(body)
        x, y = vector
        turned = np.empty((len(self.time), 2))
        turned[:, 0] = self.cosine[:, k] * x - self.sine[:, k] * y
        turned[:, 1] = self.sine[:, k] * x + self.cosine[:, k] * y
        return turned

    def place(self, body: str, point: Point) -> FloatArray:
        """Where a point of a body of a body is, r + A s, shape (times, 2) [m]."""
        return self.position[:, self.bodies.index(body), :2] + self.turned(body, point)

    def velocity_of(self, body: str, point: Point) -> FloatArray:
        """(v_x, v_y, phi') of a point of a body, shape (times, 3) [m/s, rad/s]."""
        rate = self.velocity[:, self.bodies.index(body)]
        return np.column_stack([rate[:, :2] + rate[:, 2:] * left(self.turned(body, point)), rate[:, 2]])

    def acceleration_of(self, body: str, point: Point) -> FloatArray:
        """(a_x, a_y, phi'') of a point of a body, shape (times, 3) [m/s2, rad/s2]: r'' + phi'' R A s - phi'^2 A s."""
        k = self.bodies.index(body)
        arm, given, rate = self.turned(body, point), self.acceleration[:, k], self.velocity[:, k, 2:]
        return np.column_stack([given[:, :2] + given[:, 2:] * left(arm) - rate**2 * arm, given[:, 2]])


def left(vectors: FloatArray) -> FloatArray:
    """R v: vectors, shape (..., 2), turned by +90 deg."""
    turned = np.empty_like(vectors)
    turned[..., 0], turned[..., 1] = -vectors[..., 1], vectors[..., 0]
    return turned


def dot(first: FloatArray, second: FloatArray) -> FloatArray:
    """Products of vectors of shape (times, 2), shape (times,)."""
    return first[:, 0] * second[:, 0] + first[:, 1] * second[:, 1]


def pose_of(mechanism: Mechanism, motion: KinematicMotion) -> Pose:
    """The bodies of a mechanism in a motion of it.

    Raises:
        LinkageError: the motion is another mechanism's, or not finite.
    """
    names = tuple(f"{body.name}.{c}" for body in mechanism.bodies for c in ("x", "y", "angle"))
    if motion.coordinates[: len(names)] != names:
        raise LinkageError(
            f"The motion has the coordinates {', '.join(motion.coordinates)}, but the mechanism has "
            f"{', '.join(names)}; analyse the same mechanism."
        )
    tables = []
    for table in (motion.position, motion.velocity, motion.acceleration):
        if not np.all(np.isfinite(table)):
            raise LinkageError("The motion holds numbers that are not finite; give a motion that can be.")
        rest = np.zeros((len(table), 3))
        tables.append(np.hstack([table[:, : len(names)], rest]).reshape(len(table), -1, 3))
    angle = tables[0][:, :, 2]
    bodies = (*(body.name for body in mechanism.bodies), GROUND)
    position, velocity, acceleration = tables
    return Pose(bodies, motion.time, position, velocity, acceleration, np.cos(angle), np.sin(angle))


# What each joint asks of small displacements of the two frames that it joins, in all configurations at once.
#
# A row holds for (u_i, theta_i, u_j, theta_j): displacements of the points P_i and P_j and rotations of the frames
# around them. They are the Jacobians of `mechanism_fmu.model.joints`, with the points themselves in place of the
# centres.

#: Joints with the vector d between their points in their rows.
Pair = Distance | DistanceDriver | Translational | RevoluteTranslational | TranslationalDriver

_X, _Y = np.array([1.0, 0.0]), np.array([0.0, 1.0])


def translation_rows(joint: Joint, pose: Pose) -> list[FloatArray]:
    """The rows of a joint but those that make two rotations the same, each of shape (times, 6).

    Raises:
        LinkageError: the flexibility approach does not know this kind of joint.
    """
    if isinstance(joint, AngleDriver):
        return []
    if isinstance(joint, (Revolute, XDriver, YDriver)):
        axes = (_X, _Y) if isinstance(joint, Revolute) else (_X,) if isinstance(joint, XDriver) else (_Y,)
        sign = -1.0 if isinstance(joint, Revolute) else 1.0  # phi = r_i - r_j of a pin, r_j - r_i of drivers
        return [_row(pose, sign * axis, 0.0) for axis in axes]
    if isinstance(joint, (Translational, RevoluteTranslational, TranslationalDriver)):
        along = pose.turned(joint.body_i, _unit(joint.axis_i))
        if isinstance(joint, TranslationalDriver):
            return [_row(pose, along, dot(left(along), _between(joint, pose)))]
        return [_row(pose, left(along), -dot(along, _between(joint, pose)))]
    if isinstance(joint, (Distance, DistanceDriver)):
        d = _between(joint, pose)
        return [_row(pose, d / np.hypot(d[:, 0], d[:, 1])[:, None], 0.0)]
    raise _unknown(joint)


def require_known(mechanism: Mechanism) -> None:
    """Refuse a mechanism with joints of other kinds than the flexibility approach knows.

    Raises:
        LinkageError: with the name of the first one.
    """
    for joint in mechanism.joints:
        if not isinstance(joint, (Revolute, AngleDriver, XDriver, YDriver, *get_args(Pair))):
            raise _unknown(joint)


def _unknown(joint: Joint) -> LinkageError:
    return LinkageError(
        f"{type(joint).__name__} {joint.name!r}: the flexibility approach knows pins, sliders, guides, rods and "
        "drivers; of other pairs, leave them out and give their forces as loads."
    )


def rotation_rows(joint: Joint, pose: Pose) -> list[FloatArray]:
    """The rows of a joint that make two rotations the same: theta_j - theta_i, each of shape (times, 6)."""
    if not isinstance(joint, (AngleDriver, Translational)):
        return []
    row = np.zeros((len(pose.time), 6))
    row[:, 2], row[:, 5] = -1.0, 1.0
    return [row]


def guide_axis(joint: Translational | RevoluteTranslational, pose: Pose) -> FloatArray:
    """The unit vector along a guide, shape (times, 2)."""
    return pose.turned(joint.body_i, _unit(joint.axis_i))


def _row(pose: Pose, direction: FloatArray, turn: FloatArray | float) -> FloatArray:
    """The row of direction . (u_j - u_i) + turn theta_i; direction of shape (times, 2), or (2,) if always the same."""
    row = np.zeros((len(pose.time), 6))
    row[:, 0:2], row[:, 2], row[:, 3:5] = -direction, turn, direction
    return row


def _between(joint: Pair, pose: Pose) -> FloatArray:
    """The vector d = r_j^P - r_i^P, shape (times, 2) [m]."""
    return pose.place(joint.body_j, joint.point_j) - pose.place(joint.body_i, joint.point_i)


def _unit(axis: Point) -> Point:
    size = length(axis)
    return axis[0] / size, axis[1] / size

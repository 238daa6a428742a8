"""What each joint asks of small displacements of the two frames that it joins, in all configurations at once.

A row holds for (u_i, theta_i, u_j, theta_j): displacements of the points P_i and P_j and rotations of the frames around
them. They are the Jacobians of `mechanism_fmu.model.joints`, with the points themselves in place of the centres.
"""

from __future__ import annotations

from typing import get_args

import numpy as np

from ..model import (
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
from ..model.body import Point
from ..model.conditions import length
from ..model.joints import Joint
from .elements import FloatArray
from .errors import LinkageError
from .pose import Pose, dot, left

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
        return [_row(pose, sign * np.broadcast_to(axis, (len(pose.time), 2)), 0.0) for axis in axes]
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
    """The row of direction . (u_j - u_i) + turn theta_i."""
    row = np.zeros((len(pose.time), 6))
    row[:, 0:2], row[:, 2], row[:, 3:5] = -direction, turn, direction
    return row


def _between(joint: Pair, pose: Pose) -> FloatArray:
    """The vector d = r_j^P - r_i^P, shape (times, 2) [m]."""
    return pose.place(joint.body_j, joint.point_j) - pose.place(joint.body_i, joint.point_i)


def _unit(axis: Point) -> Point:
    size = length(axis)
    return axis[0] / size, axis[1] / size

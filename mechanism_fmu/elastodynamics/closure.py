"""A mechanism at given angles of its crank: Phi(q) = 0 by Newton's method, without the compiled engine."""

from __future__ import annotations

import math

import numpy as np

from ..kinematics import KinematicMotion
from ..model import Distance, Mechanism, RevoluteTranslational, Translational
from .elements import FloatArray
from .errors import LinkageError
from .pose import Pose, dot, left, pose_of
from .rigid_rows import rigid_rows
from .rows import translation_rows

#: Rows are closed to this [m, rad], of a mechanism of the size 1 m; more rounds than these are not going to help.
_CLOSED, _ROUNDS = 1e-13, 12
#: From one of these to the next [rad] the motion is followed one by one; all others are found from them at once.
_STRIDE = math.radians(5)


def closed_at(mechanism: Mechanism, angles: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Coordinates q and their derivatives q' by the crank's angle, both of shape (angles, 3 bodies).

    Args:
        mechanism: its last joint is the driver of the crank's angle; its start guess closes at the first angle.
        angles: of the crank [rad], increasing.

    Raises:
        LinkageError: there is a position that the mechanism does not reach, or where it could go on in several ways.
    """
    count = max(2, math.ceil((angles[-1] - angles[0]) / _STRIDE) + 1)
    stations = np.linspace(angles[0], angles[-1], count)
    q = np.array([[x for body in mechanism.bodies for x in body.start]], dtype=float)
    found, rate = [], np.zeros_like(q)
    for angle, before in zip(stations, [stations[0], *stations[:-1]], strict=True):
        q, rate = _closed(mechanism, q + (angle - before) * rate, np.array([angle]))
        found.append(q[0])
    guess = np.array([np.interp(angles, stations, column) for column in np.transpose(found)]).T
    return _closed(mechanism, guess, angles)


def _closed(mechanism: Mechanism, q: FloatArray, angles: FloatArray) -> tuple[FloatArray, FloatArray]:
    size = max(1.0, float(np.abs(q[:, [k for k in range(q.shape[1]) if k % 3 != 2]]).max()))
    for _ in range(_ROUNDS):
        pose = _pose(mechanism, q)
        rows, _owners = rigid_rows(mechanism, pose)
        if rows.shape[1] != rows.shape[2]:
            raise LinkageError(
                f"{len(mechanism.joints)} joints, the crank's driver among them, give {rows.shape[1]} rows, but "
                f"{len(mechanism.bodies)} bodies have {rows.shape[2]} coordinates; leave out joints that repeat each "
                "other, or add those that are missing."
            )
        left_open = _residual(mechanism, pose, angles)
        worst = int(np.argmax(np.abs(left_open).max(axis=1)))
        try:
            change = np.linalg.solve(rows, -left_open[:, :, None])[:, :, 0]
            unit = np.zeros((rows.shape[1], 1))
            unit[-1] = 1.0
            rate = np.linalg.solve(rows, np.broadcast_to(unit, (len(q), *unit.shape)))[:, :, 0]
        except np.linalg.LinAlgError:
            break
        if np.abs(left_open).max() <= _CLOSED * size:
            return q, rate
        q = q + change
    raise LinkageError(
        f"The crank cannot turn fully: near {math.degrees(angles[worst]):.6g} deg the joints cannot be "
        "closed, or do not say how the mechanism goes on. Choose lengths with which it turns, or another crank."
    )


def _pose(mechanism: Mechanism, q: FloatArray) -> Pose:
    names = tuple(f"{body.name}.{c}" for body in mechanism.bodies for c in ("x", "y", "angle"))
    rest = np.zeros_like(q)
    return pose_of(mechanism, KinematicMotion(names, np.zeros(len(q)), q, rest, rest))


def _residual(mechanism: Mechanism, pose: Pose, angles: FloatArray) -> FloatArray:
    """Phi in the order and with the scale of `rigid_rows`, shape (angles, rows)."""
    found = []
    for joint in mechanism.joints[:-1]:
        between = pose.place(joint.body_j, getattr(joint, "point_j", (0.0, 0.0))) - pose.place(
            joint.body_i, getattr(joint, "point_i", (0.0, 0.0))
        )
        for row in translation_rows(joint, pose):
            found.append(dot(row[:, 3:5], between))
        if isinstance(joint, (Distance, RevoluteTranslational)):
            found[-1] = found[-1] - joint.distance
        if isinstance(joint, Translational):
            along_i, along_j = pose.turned(joint.body_i, joint.axis_i), pose.turned(joint.body_j, joint.axis_j)
            found.append(np.arctan(dot(left(along_i), along_j) / dot(along_i, along_j)))
    crank = pose.bodies.index(mechanism.joints[-1].body_j)
    return np.column_stack([*found, pose.position[:, crank, 2] - angles])

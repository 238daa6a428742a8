"""Phi of every joint and contact, stated independently of the engine, and its rows by differentiation.

A frame is (x, y, phi) of a body; `data` are the part's numbers in the order of the engine's tables.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from jet import Jet, cos, sin

Array = np.ndarray[Any, Any]
Frame = list[Jet]
Vector = tuple[Any, Any]


class Rows(NamedTuple):
    """Phi, Phi' and gamma, shape (rows,); Phi_q, shape (rows, coordinates)."""

    phi: Array
    rate: Array
    gamma: Array
    jacobian: Array


def revolute(i: Frame, j: Frame, data: Array) -> Vector:
    """The points coincide."""
    return _difference(_point(i, data[0:2]), _point(j, data[2:4]))


def translational(i: Frame, j: Frame, data: Array) -> Vector:
    """Both the line between the points and the axis of j are normal to the normal of i's axis."""
    normal = _quarter_turn(_turned(i[2], data[4:6]))
    line = _difference(_point(j, data[2:4]), _point(i, data[0:2]))
    return _dot(normal, line), _dot(normal, _turned(j[2], data[6:8]))


def point_line(i: Frame, j: Frame, data: Array) -> tuple[Jet]:
    """Distance of the point along the normal from the line's point."""
    return (_dot(_turned(j[2], data[4:6]), _difference(_point(i, data[0:2]), _point(j, data[2:4]))),)


def along_line(i: Frame, j: Frame, data: Array) -> tuple[Jet]:
    """Distance of the point from the line's point along the line, to the right of the normal."""
    normal = _turned(j[2], data[4:6])
    return (_dot((normal[1], normal[0] * -1.0), _difference(_point(i, data[0:2]), _point(j, data[2:4]))),)


def angle(i: Frame, j: Frame, data: Array) -> tuple[Jet]:
    """Relative angle beyond a given one."""
    return (i[2] - j[2] - data[0],)


STATEMENTS: dict[str, Any] = {
    "revolute": revolute,
    "translational": translational,
    "point_line": point_line,
    "along_line": along_line,
    "angle": angle,
}


def differentiated_rows(kind: str, data: Array, frames: tuple[int, int], q: Array, qd: Array) -> Rows:
    """Rows of a part between two of the bodies in q; the body behind the last one is the ground.

    gamma = -(Phi_q qd)_q qd is minus the second derivative of Phi along qd.
    """

    def along(direction: Array) -> list[Jet]:
        jets = [Jet(value, first) for value, first in zip(q, direction, strict=True)]
        bodies = [jets[k : k + 3] for k in range(0, len(q), 3)] + [[Jet(0.0)] * 3]
        return list(STATEMENTS[kind](bodies[frames[0]], bodies[frames[1]], data))

    motion = along(qd)
    return Rows(
        np.array([phi.value for phi in motion]),
        np.array([phi.first for phi in motion]),
        np.array([-phi.second for phi in motion]),
        np.transpose([[phi.first for phi in along(direction)] for direction in np.eye(len(q))]),
    )


def _turned(angle: Jet, v: Any) -> Vector:
    c, s = cos(angle), sin(angle)
    return c * v[0] - s * v[1], s * v[0] + c * v[1]


def _point(frame: Frame, local: Any) -> Vector:
    x, y = _turned(frame[2], local)
    return frame[0] + x, frame[1] + y


def _difference(u: Vector, v: Vector) -> Vector:
    return u[0] - v[0], u[1] - v[1]


def _quarter_turn(v: Vector) -> Vector:
    return v[1] * -1.0, v[0]


def _dot(u: Vector, v: Vector) -> Any:
    return u[0] * v[0] + u[1] * v[1]

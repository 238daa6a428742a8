"""Phi of every joint and contact, stated independently of the engine, and its rows by differentiation.

A frame is (x, y, phi) of a body; `data` are the part's numbers in the order of the engine's tables.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from jet import Jet, cos, sin

Array = np.ndarray[Any, Any]
Frame = list[Jet]
Vector = tuple[Any, Any]


class Rows(NamedTuple):
    """Phi, Phi', gamma and nu, shape (rows,); Phi_q, shape (rows, coordinates)."""

    phi: Array
    rate: Array
    gamma: Array
    nu: Array
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


def distance(i: Frame, j: Frame, data: Array) -> tuple[Jet]:
    """The points are C apart."""
    return (_square(_line(i, j, data)) - data[4] * data[4],)


def revolute_translational(i: Frame, j: Frame, data: Array) -> tuple[Jet]:
    """The point of j is c away from i's line; the table holds the line's normal."""
    return (_dot(_turned(i[2], data[4:6]), _line(i, j, data)) - data[6],)


def gears(i: Frame, j: Frame, data: Array) -> tuple[Jet]:
    """The line of centres has the direction in which equal arcs of both pitch circles have met."""
    arcs = data[4] * (i[2] + data[5]) + data[6] * (j[2] + data[7] - math.pi)
    return (_dot(_quarter_turn(_turned(arcs * (1 / (data[4] + data[6])), (1.0, 0.0))), _line(i, j, data)),)


def internal_gears(i: Frame, j: Frame, data: Array) -> tuple[Jet]:
    """As `gears`, for a ring i."""
    arcs = data[4] * (i[2] + data[5]) - data[6] * (j[2] + data[7])
    return (_dot(_quarter_turn(_turned(arcs * (1 / (data[4] - data[6])), (1.0, 0.0))), _line(i, j, data)),)


def rack_and_pinion(i: Frame, j: Frame, data: Array) -> Vector:
    """The pinion's centre is one radius beside the rack, and as far along as it has rolled."""
    along = _turned(i[2] + data[4], (1.0, 0.0))
    centre = _point(j, data[5:7])
    rolled = data[7] * (j[2] + data[8] - i[2] - data[4] + math.pi / 2)
    return (
        _dot(_quarter_turn(along), _difference(centre, _point(i, data[0:2]))) - data[7],
        _dot(along, _difference(centre, _point(i, data[2:4]))) + rolled,
    )


def x_driver(i: Frame, j: Frame, data: Array, motion: Jet) -> tuple[Jet]:
    """The points are C(t) apart in x."""
    return (_line(i, j, data)[0] - motion,)


def y_driver(i: Frame, j: Frame, data: Array, motion: Jet) -> tuple[Jet]:
    """The points are C(t) apart in y."""
    return (_line(i, j, data)[1] - motion,)


def angle_driver(i: Frame, j: Frame, _data: Array, motion: Jet) -> tuple[Jet]:
    """Body j has turned C(t) further than body i."""
    return (j[2] - i[2] - motion,)


def distance_driver(i: Frame, j: Frame, data: Array, motion: Jet) -> tuple[Jet]:
    """The points are C(t) apart."""
    return (_square(_line(i, j, data)) - motion * motion,)


def translational_driver(i: Frame, j: Frame, data: Array, motion: Jet) -> tuple[Jet]:
    """The points are C(t) apart along an axis of i."""
    return (_dot(_turned(i[2], data[4:6]), _line(i, j, data)) - motion,)


def cam_follower(i: Frame, j: Frame, data: Array, alphas: list[Jet], curves: Array) -> tuple[Jet, Jet, Jet]:
    """The points on both profiles coincide, and the profiles have one tangent there."""
    apart = _difference(
        _profile_point(i, data[0:2], alphas[0], curves[0]), _profile_point(j, data[2:4], alphas[1], curves[1])
    )
    tangent = _dot(_quarter_turn(_profile_tangent(i, alphas[0], curves[0])), _profile_tangent(j, alphas[1], curves[1]))
    return *apart, tangent


def cam_flat_follower(i: Frame, j: Frame, data: Array, alphas: list[Jet], curves: Array) -> Vector:
    """The point on the profile is on the face, and the profile is parallel to the face there."""
    normal = _quarter_turn(_turned(j[2], data[4:6]))
    apart = _difference(_profile_point(i, data[0:2], alphas[0], curves[0]), _point(j, data[2:4]))
    return _dot(normal, apart), _dot(normal, _profile_tangent(i, alphas[0], curves[0]))


def point_follower(i: Frame, j: Frame, data: Array, alphas: list[Jet], curves: Array) -> Vector:
    """The point and the point on the profile coincide."""
    return _difference(_point(i, data[0:2]), _profile_point(j, data[2:4], alphas[0], curves[0]))


JOINTS: dict[str, Any] = {
    "revolute": revolute,
    "translational": translational,
    "distance": distance,
    "revolute_translational": revolute_translational,
    "gears": gears,
    "internal_gears": internal_gears,
    "rack_and_pinion": rack_and_pinion,
}
DRIVERS: dict[str, Any] = {
    "x_driver": x_driver,
    "y_driver": y_driver,
    "angle_driver": angle_driver,
    "distance_driver": distance_driver,
    "translational_driver": translational_driver,
}
CONTACTS: dict[str, Any] = {"point_line": point_line, "along_line": along_line, "angle": angle}
PAIRS: dict[str, Any] = {
    "cam_follower": cam_follower,
    "cam_flat_follower": cam_flat_follower,
    "point_follower": point_follower,
}
STATEMENTS = JOINTS | DRIVERS | CONTACTS | PAIRS


class State(NamedTuple):
    """Coordinates and rates: bodies, shape (6,), then contact coordinates, shape (0,) to (2,); time."""

    q: Array
    qd: Array
    time: float


def differentiated_rows(kind: str, data: Array, curves: Array, frames: tuple[int, int], state: State) -> Rows:
    """Rows of a part between two of the two bodies and the ground, which is frame 2.

    `curves`, shape (n, 9): polynomial of the fifth degree, and amplitude, frequency and phase of a sine. Along the
    motion Phi' = Phi_q qd - nu and Phi'' = Phi_q qdd - gamma; along time alone Phi' = -nu.
    """

    def along(direction: Array, flow: float) -> list[Jet]:
        jets = [Jet(value, first) for value, first in zip(state.q, direction, strict=True)]
        i, j = ([jets[0:3], jets[3:6], [Jet(0.0)] * 3][frame] for frame in frames)
        if kind in DRIVERS:
            return list(DRIVERS[kind](i, j, data, _value(curves[0], Jet(state.time, flow))))
        if kind in PAIRS:
            return list(PAIRS[kind](i, j, data, jets[6:], curves))
        return list(STATEMENTS[kind](i, j, data))

    motion = along(state.qd, 1.0)
    still = np.zeros(len(state.q))
    return Rows(
        np.array([phi.value for phi in motion]),
        np.array([phi.first for phi in motion]),
        np.array([-phi.second for phi in motion]),
        np.array([-phi.first for phi in along(still, 1.0)]),
        np.transpose([[phi.first for phi in along(direction, 0.0)] for direction in np.eye(len(state.q))]),
    )


def _value(curve: Array, x: Jet) -> Jet:
    """The curve at x."""
    return _polynomial(curve[:6], x) + curve[6] * sin(curve[7] * x + curve[8])


def _slope(curve: Array, x: Jet) -> Jet:
    """The curve's derivative at x."""
    return _polynomial(curve[1:6] * range(1, 6), x) + curve[6] * curve[7] * cos(curve[7] * x + curve[8])


def _polynomial(coefficients: Array, x: Jet) -> Jet:
    total = Jet(0.0)
    for coefficient in coefficients[::-1]:
        total = total * x + float(coefficient)
    return total


def _profile_point(frame: Frame, centre: Any, alpha: Jet, curve: Array) -> Vector:
    """The point at the angle alpha on a profile."""
    rho = _value(curve, alpha)
    return _point(frame, (centre[0] + rho * cos(alpha), centre[1] + rho * sin(alpha)))


def _profile_tangent(frame: Frame, alpha: Jet, curve: Array) -> Vector:
    """How that point moves with alpha."""
    rho, slope = _value(curve, alpha), _slope(curve, alpha)
    local = slope * cos(alpha) - rho * sin(alpha), slope * sin(alpha) + rho * cos(alpha)
    return _turned(frame[2], local)


def _line(i: Frame, j: Frame, data: Array) -> Vector:
    """From the point of i to the point of j."""
    return _difference(_point(j, data[2:4]), _point(i, data[0:2]))


def _square(v: Vector) -> Any:
    return _dot(v, v)


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

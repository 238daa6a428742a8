"""Two bodies placed by hand as each joint of the ME451 slides says, so that its Phi must vanish there.

Each function takes numbers at will, as many as degrees of freedom remain, and returns the coordinates of both bodies
(and contact angles), from geometry alone: distances, arcs and tangents by differences, without any constraint row.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from .bench import FloatArray

A, B = np.array([0.3, -0.2]), np.array([-0.25, 0.4])
#: Distances, radii, marks and directions of the parts, as in `me451_joints.PARTS`.
ROD, OFFSET, ROLLER = 1.1, 0.7, 0.25
GEARS, RING, RACK = (0.5, 0.3, 0.9, 3.3), (1.9, 0.3, 0.6, 0.4), (0.2, 0.5, 1.1)
RACK_ORIGIN = A + 0.6 * np.array([math.cos(0.2), math.sin(0.2)])
AXIS_I, AXIS_J, GUIDE, FACE = (1.0, 0.4), (1.0, 0.3), (0.2, 1.0), (0.3, -1.0)

Free = Sequence[float]


def egg(alpha: float) -> float:
    """Radius of the profile without any symmetry [m]."""
    return 1.0 + 0.1 * math.cos(alpha) + 0.05 * math.cos(2 * alpha) + 0.02 * math.sin(alpha)


def turned(vector: Sequence[float] | FloatArray, angle: float) -> FloatArray:
    """A vector turned by an angle."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]])


def _direction(vector: Sequence[float] | FloatArray) -> float:
    return math.atan2(float(vector[1]), float(vector[0]))


def _unit(angle: float) -> FloatArray:
    return np.array([math.cos(angle), math.sin(angle)])


def _placed(free: Free, point: FloatArray, phi_j: float, on_j: FloatArray, *alphas: float) -> FloatArray:
    """Body i at free[:3], body j turned by phi_j with its point `on_j` at `point`."""
    return np.array([*free[:3], *(point - turned(on_j, phi_j)), phi_j, *alphas])


def _on_i(free: Free, point: Sequence[float] | FloatArray) -> FloatArray:
    return np.array(free[:2]) + turned(point, free[2])


def _revolute(free: Free) -> FloatArray:
    return _placed(free, _on_i(free, A), free[3], B)


def _translational(free: Free) -> FloatArray:
    """Both axes on one line, at any distance along it."""
    axis = free[2] + _direction(AXIS_I)
    return _placed(free, _on_i(free, A) + free[3] * _unit(axis), axis - _direction(AXIS_J), B)


def _distance(free: Free) -> FloatArray:
    return _placed(free, _on_i(free, A) + ROD * _unit(free[3]), free[4], B)


def _revolute_translational(free: Free) -> FloatArray:
    """P_j at c from the axis, any way along it."""
    axis = free[2] + _direction(GUIDE)
    return _placed(free, _on_i(free, A) + free[3] * _unit(axis) + OFFSET * _unit(axis + math.pi / 2), free[4], B)


def _gears(free: Free) -> FloatArray:
    """Centres R_i + R_j apart; the arcs from the marks to the point of contact are equal."""
    ri, mark_i, rj, mark_j = GEARS
    line = free[3]
    arc = ri * (line - (free[2] + mark_i))
    # the contact is on the other side of gear j, and it turns the other way
    phi_j = line + math.pi + arc / rj - mark_j
    return _placed(free, _on_i(free, A) + (ri + rj) * _unit(line), phi_j, B)


def _ring(free: Free) -> FloatArray:
    """Centres R_i - R_j apart; both marks are on the same side, and both arcs run the same way."""
    ri, mark_i, rj, mark_j = RING
    line = free[3]
    phi_j = line - ri * (line - (free[2] + mark_i)) / rj - mark_j
    return _placed(free, _on_i(free, A) + (ri - rj) * _unit(line), phi_j, B)


def _rack(free: Free) -> FloatArray:
    """The centre R_j to the left of the pitch line; Q_iD is as long as the arc Q_jD."""
    own, rj, mark = RACK
    along, way = free[2] + own, free[3]
    centre = _on_i(free, RACK_ORIGIN) + way * _unit(along) + rj * _unit(along + math.pi / 2)
    # rolling forward turns the pinion clockwise; at way 0 its mark points at the rack
    return _placed(free, centre, along - math.pi / 2 - way / rj - mark, B)


def _boundary(alpha: float) -> tuple[FloatArray, float]:
    """Place and direction of the egg's tangent [rad], the latter by differences."""
    h = 1e-3
    place = [egg(alpha + k * h) * _unit(alpha + k * h) for k in (-2, -1, 0, 1, 2)]
    return place[2], _direction(place[0] - 8 * place[1] + 8 * place[3] - place[4])


def _cam(free: Free) -> FloatArray:
    """A circle that touches the egg from outside."""
    place, tangent = _boundary(free[3])
    contact, outward = _on_i(free, A + place), free[2] + tangent - math.pi / 2
    centre = contact + ROLLER * _unit(outward)
    return _placed(free, centre, free[4], B, free[3], outward + math.pi - free[4])


def _flat(free: Free) -> FloatArray:
    """The face along the tangent of the egg, the point of contact anywhere on it."""
    place, tangent = _boundary(free[3])
    along = free[2] + tangent
    return _placed(free, _on_i(free, A + place) + free[4] * _unit(along), along - _direction(FACE), B, free[3])


def _point(free: Free) -> FloatArray:
    """The pin of body i anywhere on the egg of body j."""
    alpha, phi_j = free[3], free[4]
    return _placed(free, _on_i(free, A), phi_j, B + egg(alpha) * _unit(alpha), alpha)


#: By the keys of `me451_joints.PARTS`, with how many numbers are free.
PLACED: dict[str, tuple[Callable[[Free], FloatArray], int]] = {
    "revolute": (_revolute, 4),
    "translational": (_translational, 4),
    "distance": (_distance, 5),
    "revolute-translational": (_revolute_translational, 5),
    "gears": (_gears, 4),
    "internal-gears": (_ring, 4),
    "rack": (_rack, 4),
    "cam": (_cam, 5),
    "flat": (_flat, 5),
    "point": (_point, 5),
}

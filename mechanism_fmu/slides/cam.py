"""The cam example of the ME451 slides: the tangents g_1 of the cam and g_2 of its roller.

A profile has the points rho e, e = (cos alpha, sin alpha), in the frame of its body; its tangent is the derivative of
the point by alpha, turned with the body: g = A (rho' e + rho R e).
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import numpy.typing as npt

from ..kinematics.equations import Equations
from ..model import GROUND, Body, CamFollower, Mechanism, Revolute, Translational
from ..model.curves import constant, cosine
from ..model.profiles import circle, piecewise_profile

FloatArray = npt.NDArray[np.float64]

#: Where the nose of the cam ends and its base circle begins [rad].
_JOIN = 2 * math.pi / 3
#: The radius of the roller, rho_2 [m].
_ROLLER_RADIUS = 0.25
#: Profile of the slides' cam: rho_1 = 5/4 - 1/4 cos 3 alpha on [0, 2 pi/3), and 1 elsewhere [m].
CAM = piecewise_profile((0.0, (constant(1.25), cosine(-0.25, 3.0))), (_JOIN, (constant(1.0),)))
#: Profile of its roller: rho_2 = 1/4 [m].
ROLLER = circle(_ROLLER_RADIUS)


def cam_tangent(alpha: float, phi: float = 0.0) -> FloatArray:
    """Tangent g_1, shape (2,) [m], at the contact coordinate alpha [rad] of a cam that is turned by phi [rad].

    On [0, 2 pi/3) rho' = 3/4 sin 3 alpha, elsewhere the cam is a circle and rho' = 0.
    """
    if alpha % (2 * math.pi) < _JOIN:
        return _tangent(alpha, phi, 1.25 - 0.25 * math.cos(3 * alpha), 0.75 * math.sin(3 * alpha))
    return _tangent(alpha, phi, 1.0, 0.0)


def roller_tangent(alpha: float, phi: float = 0.0) -> FloatArray:
    """Tangent g_2, shape (2,) [m]; as `cam_tangent`, with rho_2' = 0."""
    return _tangent(alpha, phi, _ROLLER_RADIUS, 0.0)


def tangents_of_the_rows(
    alpha_1: float, alpha_2: float, phi_1: float = 0.0, phi_2: float = 0.0
) -> tuple[FloatArray, FloatArray]:
    """A_1 g_1 and A_2 g_2, each of shape (2,) [m], as the rows of `CamFollower` have them.

    They are the columns of the contact coordinates in Phi_q of r_1^C - r_2^C: [.., A_1 g_1, -A_2 g_2].
    """
    equations = _equations()
    q = equations.start.copy()
    names = ("pair.alpha_i", "pair.alpha_j", "cam.angle", "roller.angle")
    columns = [equations.coordinates.index(name) for name in names]
    q[columns] = alpha_1, alpha_2, phi_1, phi_2
    points = [equations.rows.index(row) for row in ("pair[1]", "pair[2]")]
    jacobian = equations.at(q, 0.0).jacobian[points]
    return jacobian[:, columns[0]], -jacobian[:, columns[1]]


def _tangent(alpha: float, phi: float, rho: float, slope: float) -> FloatArray:
    c, s = math.cos(alpha), math.sin(alpha)
    along = np.array([slope * c - rho * s, slope * s + rho * c])
    turned = np.array([[math.cos(phi), -math.sin(phi)], [math.sin(phi), math.cos(phi)]])
    return np.asarray(turned @ along)


@cache
def _equations() -> Equations:
    """Of the cam on a hinge under its roller on a slider; the rows need not be closed where they are evaluated."""
    zero, up = (0.0, 0.0), (0.0, 1.0)
    mechanism = Mechanism(
        bodies=(Body("cam", 1.0, 1.0), Body("roller", 1.0, 1.0, (0.0, 1.6, 0.0))),
        joints=(
            Revolute("hinge", "cam", zero, GROUND, zero),
            Translational("guide", "roller", zero, up, GROUND, zero, up),
        ),
        contacts=(CamFollower("pair", "cam", CAM, "roller", ROLLER),),
        held=("cam.angle",),
    )
    return Equations(mechanism, 0.0)

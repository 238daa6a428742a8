"""The two numerical examples of the ME451 slides on gears and cams, worked with the joints of this project."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
import numpy.typing as npt
from scipy.interpolate import CubicHermiteSpline

from .kinematics import analyse
from .kinematics.equations import Equations
from .model import (
    GROUND,
    AngleDriver,
    Body,
    CamFollower,
    Distance,
    Force,
    Gears,
    Mechanism,
    Output,
    Revolute,
    Settings,
    Translational,
    polynomial_motion,
)
from .model.curves import constant, cosine
from .model.curves.profiles import circle, piecewise_profile
from .simulation import Simulation

# Example 3.4.1 of the ME451 slides: gear 2 falls around gear 1, which is fixed to the ground.
#
# The slides give phi_1 = 0, theta_1 = pi/6, theta_2 = 7 pi/6, R_1 = 1, R_2 = 2 and ask for phi_2 when the line of
# centres, the carrier, stands vertically. They give neither mass nor time: `carried_gear` needs none, `falling_gear`
# takes a disc.

FloatArray = npt.NDArray[np.float64]

#: Radius of the pitch circle of gear 1, R_1 [m].
RADIUS_1 = 1.0
#: Radius of the pitch circle of gear 2, R_2 [m].
RADIUS_2 = 2.0
#: The mark theta_1 of gear 1, where both met when they were assembled [rad].
MARK_1 = math.pi / 6
#: The mark theta_2 of gear 2 [rad].
MARK_2 = 7 * math.pi / 6
#: Distance of the centres [m].
CARRIER = RADIUS_1 + RADIUS_2

_ORIGIN = (0.0, 0.0)
#: Of the fall, whose angles do not depend on it: mass [kg], and gravity [m/s2].
_MASS, _GRAVITY = 1.0, 9.81
#: The fall is looked at in steps of this [s]; a cubic between two of them is off by 1e-9 m.
_STEP = 0.01
#: Gear 2 is at the bottom well before this time [s].
_LONG_ENOUGH = 3.0


@dataclass(frozen=True)
class Fall:
    """Gear 2 falls from rest, its carrier at 30 deg, and passes the bottom.

    Attributes:
        time: of the motion until it rests again on the other side, and beyond, shape (times,) [s].
        carrier: angle of the line of centres, shape (times,) [rad].
        gear: angle phi_2 of gear 2, shape (times,) [rad].
        bottom_time: when the carrier is vertical for the first time [s].
        bottom_gear: phi_2 there, the number that the slides ask for [rad].
        bottom_speed: speed of the carrier there [rad/s].
    """

    time: FloatArray
    carrier: FloatArray
    gear: FloatArray
    bottom_time: float
    bottom_gear: float
    bottom_speed: float


def rolled_angle(carrier: float) -> float:
    """Phi_2 [rad] of a carrier's angle theta, by hand: the slides' eq (1) with phi_1 = 0, solved for phi_2.

    Args:
        carrier: its angle theta [rad].

    Source: ME451 slides on gears, eq (1), for example 3.4.1.
    """
    return (CARRIER * carrier - RADIUS_1 * MARK_1) / RADIUS_2 - MARK_2 + math.pi


def carried_gear(to: float, steps: int = 60) -> tuple[FloatArray, FloatArray]:
    """Angles of carrier and gear 2, each of shape (steps + 1,) [rad], when a driver turns the carrier from 30 deg on.

    Args:
        to: angle of the carrier at the end [rad].
        steps: even ones of the carrier.

    Source: ME451 slides on gears, example 3.4.1, by the rows of `Gears` and `analyse`.
    """
    rate = to - MARK_1
    middle = (CARRIER / 2 * math.cos(MARK_1), CARRIER / 2 * math.sin(MARK_1), MARK_1)
    mechanism = Mechanism(
        bodies=(Body("carrier", 1.0, 1.0, middle), _gear_2()),
        joints=(
            Revolute("axle_1", "carrier", (-CARRIER / 2, 0.0), GROUND, _ORIGIN),
            Revolute("axle_2", "gear_2", _ORIGIN, "carrier", (CARRIER / 2, 0.0)),
            _mesh(),
            AngleDriver("drive", "carrier", polynomial_motion(MARK_1, rate)),
        ),
    )
    motion = analyse(mechanism, np.linspace(0.0, 1.0, steps + 1))
    return motion.of("carrier.angle")[0], motion.of("gear_2.angle")[0]


def falling_gear(times: Sequence[float] | FloatArray | None = None) -> Fall:
    """Gear 2, a disc of 1 kg on a massless carrier, falls under its weight; its motion is that of the engine.

    Args:
        times: that increase from 0 on [s]; by default 3 s in steps of 10 ms, which hold the bottom.

    Raises:
        ValueError: the gear does not come to the bottom within these times.

    Source: ME451 slides on gears, example 3.4.1; they give neither mass nor time, the disc is this project's.
    """
    grid = np.arange(0.0, _LONG_ENOUGH + _STEP / 2, _STEP) if times is None else np.asarray(times, dtype=np.float64)
    mechanism = Mechanism(
        bodies=(_gear_2(),),
        joints=(Distance("carrier", GROUND, _ORIGIN, "gear_2", _ORIGIN, CARRIER), _mesh()),
        forces=(Force("weight", "gear_2", (0.0, -_MASS * _GRAVITY)),),
        outputs=tuple(Output(name, f"gear_2.{name}", "") for name in ("x", "y", "angle", "x_rate", "y_rate", "speed")),
        settings=Settings(relative_tolerance=1e-11),
        held=("gear_2.angle",),
    )
    simulation = Simulation(mechanism)
    rows = []
    for time in grid.tolist():
        simulation.advance(time)
        rows.append(simulation.read())
    x, y, angle, x_rate, speed = (np.array([row[n] for row in rows]) for n in ("x", "y", "angle", "x_rate", "speed"))
    across = CubicHermiteSpline(grid, x, x_rate)
    roots = [root for root in across.roots(extrapolate=False).tolist() if grid[0] < root]
    if not roots:
        raise ValueError(f"Gear 2 is not at the bottom by {grid[-1]:g} s; give times up to about 1.5 s at least.")
    bottom = roots[0]
    return Fall(
        time=grid,
        carrier=np.unwrap(np.arctan2(y, x)),
        gear=angle,
        bottom_time=bottom,
        bottom_gear=float(CubicHermiteSpline(grid, angle, speed)(bottom)),
        bottom_speed=float(across(bottom, 1)) / CARRIER,
    )


def _gear_2() -> Body:
    """A homogeneous disc where the slides let it go, with phi_2 = 0."""
    start = (CARRIER * math.cos(MARK_1), CARRIER * math.sin(MARK_1), 0.0)
    return Body("gear_2", _MASS, _MASS * RADIUS_2**2 / 2, start)


def _mesh() -> Gears:
    return Gears("mesh", GROUND, RADIUS_1, MARK_1, "gear_2", RADIUS_2, MARK_2)


# The cam example of the ME451 slides: the tangents g_1 of the cam and g_2 of its roller.
#
# A profile has the points rho e, e = (cos alpha, sin alpha), in the frame of its body; its tangent is the derivative of
# the point by alpha, turned with the body: g = A (rho' e + rho R e).

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

    Args:
        alpha: contact coordinate [rad].
        phi: angle of the cam [rad].

    Source: ME451 slides on cams: the tangent g of a boundary, for the example's cam.
    """
    if alpha % (2 * math.pi) < _JOIN:
        return _tangent(alpha, phi, 1.25 - 0.25 * math.cos(3 * alpha), 0.75 * math.sin(3 * alpha))
    return _tangent(alpha, phi, 1.0, 0.0)


def roller_tangent(alpha: float, phi: float = 0.0) -> FloatArray:
    """Tangent g_2, shape (2,) [m]; as `cam_tangent`, with rho_2' = 0.

    Args:
        alpha: contact coordinate [rad].
        phi: angle of the roller [rad].

    Source: ME451 slides on cams: the tangent g of a boundary, for the example's roller.
    """
    return _tangent(alpha, phi, _ROLLER_RADIUS, 0.0)


def tangents_of_the_rows(
    alpha_1: float, alpha_2: float, phi_1: float = 0.0, phi_2: float = 0.0
) -> tuple[FloatArray, FloatArray]:
    """A_1 g_1 and A_2 g_2, each of shape (2,) [m], as the rows of `CamFollower` have them.

    They are the columns of the contact coordinates in Phi_q of r_1^C - r_2^C: [.., A_1 g_1, -A_2 g_2].

    Args:
        alpha_1: contact coordinate of the cam [rad].
        alpha_2: contact coordinate of the roller [rad].
        phi_1: angle of the cam [rad].
        phi_2: angle of the roller [rad].

    Source: ME451 slides on cams: the rows of the cam-follower joint; see `CamFollower`.
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

"""Example 3.4.1 of the ME451 slides: gear 2 falls around gear 1, which is fixed to the ground.

The slides give phi_1 = 0, theta_1 = pi/6, theta_2 = 7 pi/6, R_1 = 1, R_2 = 2 and ask for phi_2 when the line of
centres, the carrier, stands vertically. They give neither mass nor time: `carried_gear` needs none, `falling_gear`
takes a disc.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.interpolate import CubicHermiteSpline

from ..kinematics import analyse
from ..model import (
    GROUND,
    AngleDriver,
    Body,
    Distance,
    Force,
    Gears,
    Mechanism,
    Output,
    Revolute,
    Settings,
    polynomial_motion,
)
from ..simulation import Simulation

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
    """Phi_2 [rad] of a carrier's angle theta [rad], by hand: eq (1) of the slides with phi_1 = 0, solved for phi_2."""
    return (CARRIER * carrier - RADIUS_1 * MARK_1) / RADIUS_2 - MARK_2 + math.pi


def carried_gear(to: float, steps: int = 60) -> tuple[FloatArray, FloatArray]:
    """Angles of carrier and gear 2, each of shape (steps + 1,) [rad], when a driver turns the carrier from 30 deg on.

    Args:
        to: angle of the carrier at the end [rad].
        steps: even ones of the carrier.
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
        times: that increase from 0 on [s]; unless told, 3 s in steps of 10 ms, which hold the bottom.

    Raises:
        ValueError: the gear does not come to the bottom within these times.
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

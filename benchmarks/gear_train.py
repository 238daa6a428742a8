"""A pair of external gears in closed form: ME451 (after Haug), dynamics of a gear pair.

Independent of the library. With a force F between the pitch circles and the same speed there,

    J1 w1' = T1 - d1 w1 + F R1        J2 w2' = T2 - d2 w2 + F R2        R1 w1 + R2 w2 = 0

so that the pinion's speed obeys J w1' = T - d w1 with J = J1 + i^2 J2, T = T1 + i T2, d = d1 + i^2 d2, i = -R1/R2.

    python -m benchmarks.gear_train > models/gear_train/reference.csv
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from .curve_file import print_curve

#: Time between two rows of the reference, and its end [s].
STEP, STOP = 0.01, 1.0


class Pair(NamedTuple):
    """Inertias [kg m2], pitch radii [m], constant torques [N m] and dampings [N m s/rad] of pinion and wheel."""

    J1: float = 0.02
    J2: float = 0.11
    R1: float = 0.05
    R2: float = 0.12
    T1: float = 1.5
    T2: float = -0.7
    d1: float = 0.0
    d2: float = 0.0


class Motion(NamedTuple):
    """Pinion and wheel: angles [rad], speeds [rad/s], accelerations [rad/s2]; mesh force F [N]."""

    angles: tuple[float, float]
    speeds: tuple[float, float]
    accelerations: tuple[float, float]
    force: float


def motion(pair: Pair, time: float, angle: float = 0.0, speed: float = 0.0) -> Motion:
    """The motion from an angle [rad] and a speed [rad/s] of the pinion at time 0."""
    i = -pair.R1 / pair.R2
    J, T, d = pair.J1 + i * i * pair.J2, pair.T1 + i * pair.T2, pair.d1 + i * i * pair.d2
    if d == 0.0:
        a = T / J
        w = speed + a * time
        turned = speed * time + a * time * time / 2
    else:
        fades = -math.expm1(-d * time / J)  # of what separates the speed from its last value
        w = speed + (T / d - speed) * fades
        a = (T - d * w) / J
        turned = T / d * time + (speed - T / d) * J / d * fades
    force = (pair.J1 * a + pair.d1 * w - pair.T1) / pair.R1
    return Motion((angle + turned, i * (angle + turned)), (w, i * w), (a, i * a), force)


def curve() -> Iterator[tuple[float, ...]]:
    """Rows of the reference: time [s], angles [rad], speeds [rad/s], mesh force [N]; the slides' pair from rest."""
    for k in range(round(STOP / STEP) + 1):
        at = motion(Pair(), k * STEP)
        yield k * STEP, *at.angles, *at.speeds, at.force


def main() -> None:
    """Print the reference curve as CSV."""
    print_curve("time,pinion_angle,wheel_angle,pinion_speed,wheel_speed,mesh_force", curve())


if __name__ == "__main__":
    main()

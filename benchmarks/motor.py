"""A direct-current motor with a PI controller and limited voltage, by matrix exponentials.

Independent of the library. With x = (phi, w, i, z), e = w* - w and v = kp e + ki z, u = v within +-U,

    J w' = K i - b w + T        L i' = u - R i - K w        z' = e + g (u - v)

    python -m benchmarks.motor > models/motor/reference.csv
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from .curve_file import print_curve
from .limited_linear import Array, LimitedSystem

#: Time between two rows of the reference, and its end [s].
STEP, STOP = 0.002, 0.5


class Drive(NamedTuple):
    """Constants in SI units, as in the equations."""

    K: float = 0.25
    R: float = 2.0
    L: float = 4e-3
    J: float = 1e-3
    b: float = 1e-4
    U: float = 24.0
    kp: float = 0.5
    ki: float = 10.0
    g: float = 20.0
    wanted: float = 50.0
    T: float = 0.0


def system(drive: Drive) -> LimitedSystem:
    """The motor's equations for x = (phi, w, i, z)."""
    K, R, L, J, b, U, kp, ki, g, wanted, T = drive
    A = np.array(
        [
            [0.0, 1.0, 0.0, 0.0],
            [0.0, -b / J, K / J, 0.0],
            [0.0, -K / L, -R / L, 0.0],
            [0.0, -1.0 + g * kp, 0.0, -g * ki],
        ]
    )
    return LimitedSystem(
        A=A,
        b=np.array([0.0, T / J, 0.0, wanted * (1.0 - g * kp)]),
        s=np.array([0.0, 0.0, 1.0 / L, g]),
        c=np.array([0.0, -kp, 0.0, ki]),
        d=kp * wanted,
        limit=U,
    )


def motion(drive: Drive, times: list[float], start: Array | None = None) -> list[tuple[float, ...]]:
    """Angle [rad], speed [rad/s], current [A], voltage [V], integral [rad] at `times`, from rest or from x."""
    equations = system(drive)
    begin = np.zeros(4) if start is None else start
    return [(x[0], x[1], x[2], equations.limited(x), x[3]) for x in equations.at(times, begin)]


def curve() -> Iterator[tuple[float, ...]]:
    """Rows of the reference: time [s], angle [rad], speed [rad/s], current [A], voltage [V]; from rest."""
    times = [k * STEP for k in range(round(STOP / STEP) + 1)]
    for time, found in zip(times, motion(Drive(), times), strict=True):
        yield time, *found[:4]


def main() -> None:
    """Print the reference curve as CSV."""
    print_curve("time,rotor_angle,rotor_speed,current,voltage", curve())


if __name__ == "__main__":
    main()

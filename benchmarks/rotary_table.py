"""A rotary table with a friction brake on a compliant shaft, by matrix exponentials.

Independent of the library. With x = (theta, w, s): shaft k, c from a driven end at alpha, alpha'; brake k_b, c_b that
holds up to M, with the twist s:

    J w' = k (alpha - theta) + c (alpha' - w) - d w + T + F
    F = k_b s - c_b w, within +-M        s' = (F - k_b s) / c_b

    python -m benchmarks.rotary_table > models/rotary_table/reference.csv
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from .curve_file import print_curve
from .limited_linear import Array, LimitedSystem

#: Time between two rows of the reference, and its end [s].
STEP, STOP = 0.02, 4.0


class Table(NamedTuple):
    """Constants in SI units, as in the equations."""

    J: float = 0.02
    d: float = 0.0
    k: float = 2.0
    c: float = 0.02
    k_b: float = 200.0
    c_b: float = 1.0
    M: float = 0.2
    alpha: float = 0.3
    rate: float = 0.0
    T: float = 0.0


def system(table: Table) -> LimitedSystem:
    """The table's equations for x = (theta, w, s), with a driven end at rest at alpha."""
    J, d, k, c, k_b, c_b, M, alpha, rate, T = table
    return LimitedSystem(
        A=np.array([[0.0, 1.0, 0.0], [-k / J, -(c + d) / J, 0.0], [0.0, 0.0, -k_b / c_b]]),
        b=np.array([0.0, (k * alpha + c * rate + T) / J, 0.0]),
        s=np.array([0.0, 1.0 / J, 1.0 / c_b]),
        c=np.array([0.0, -c_b, k_b]),
        d=0.0,
        limit=M,
    )


def motion(table: Table, times: list[float], start: Array | None = None) -> list[tuple[float, ...]]:
    """Angle [rad], speed [rad/s], torque of the brake [N m], its twist [rad] at `times`, from rest or from x."""
    equations = system(table)
    begin = np.zeros(3) if start is None else start
    return [(x[0], x[1], equations.limited(x), x[2]) for x in equations.at(times, begin)]


def curve() -> Iterator[tuple[float, ...]]:
    """Rows of the reference: time [s], angle [rad], speed [rad/s], torque of the brake [N m]; from rest."""
    times = [k * STEP for k in range(round(STOP / STEP) + 1)]
    for time, found in zip(times, motion(Table(), times), strict=True):
        yield time, *found[:3]


def main() -> None:
    """Print the reference curve as CSV."""
    print_curve("time,table_angle,table_speed,friction_torque", curve())


if __name__ == "__main__":
    main()

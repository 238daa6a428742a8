"""A rotary table with a friction brake on a compliant shaft, from one stop to the next in closed form.

Independent of the library. With the angle theta and the speed w, the shaft k, c from a driven end at alpha, alpha', and
a brake that holds up to M:

    J w' = k (alpha - theta) + c (alpha' - w) - d w + T + F        F = -M sign(w), within +-M where w = 0

While it slips one way this is linear: J w'' + (c + d) w' + k w = 0, whose first zero is known, and (theta, w) by a
matrix exponential. There it stops for good when |k (alpha - theta) + c alpha' + T| <= M, and else slips that way.

    python -m benchmarks.rotary_table > models/rotary_table/reference.csv
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from scipy.linalg import expm

from .curve_file import print_curve

#: Time between two rows of the reference, and its end [s].
STEP, STOP = 0.02, 4.0


class Table(NamedTuple):
    """Constants in SI units, as in the equations."""

    J: float = 0.02
    d: float = 0.0
    k: float = 2.0
    c: float = 0.02
    M: float = 0.2
    alpha: float = 0.3
    rate: float = 0.0
    T: float = 0.0

    def load(self, angle: float) -> float:
        """The torque on the table without its brake, at rest [N m]."""
        return self.k * (self.alpha - angle) + self.c * self.rate + self.T


class State(NamedTuple):
    """Where the table is [rad], how fast [rad/s], and whether it slips forwards (1), backwards (-1) or sticks (0)."""

    angle: float
    speed: float
    side: int

    def friction(self, table: Table) -> float:
        """The torque of the brake [N m]."""
        return -self.side * table.M if self.side else -table.load(self.angle)


def begin(table: Table, angle: float = 0.0, speed: float = 0.0) -> State:
    """The table at the start or at a stop, with what follows: stick, or slip by its speed, or else by its load."""
    load = table.load(angle)
    if speed == 0.0 and abs(load) <= table.M:
        return State(angle, 0.0, 0)
    return State(angle, speed, int(math.copysign(1, speed or load)))


def motion(table: Table, times: list[float], start: State | None = None) -> list[State]:
    """The states at rising `times` [s], from `start` at the first of them, or from rest at 0."""
    found = [start or begin(table)]
    for earlier, later in pairwise(times):
        state, left = found[-1], later - earlier
        while state.side and (until := _stop(table, state)) <= left:
            state, left = begin(table, _slip(table, state, until).angle), left - until
        found.append(_slip(table, state, left) if state.side else state)
    return found


def _stop(table: Table, state: State) -> float:
    """When a slip ends [s]: the first zero after 0 of w'' + 2 a w' + w0^2 w = 0; infinite if it has none."""
    damping, square = (table.c + table.d) / (2 * table.J), table.k / table.J
    w = state.speed
    wanted = (table.load(state.angle) - (table.c + table.d) * w - state.side * table.M) / table.J + damping * w
    if square > damping * damping:  # w = exp(-a t) r sin(W t + phase)
        frequency = math.sqrt(square - damping * damping)
        return ((-math.atan2(w, wanted / frequency)) % math.pi or math.pi) / frequency
    if square == damping * damping:  # w = exp(-a t) (w + wanted t)
        return -w / wanted if w * wanted < 0 else math.inf
    rate = math.sqrt(damping * damping - square)  # w = exp(-a t) (w cosh + wanted / rate sinh)
    return math.atanh(-w * rate / wanted) / rate if 0 < -w * rate * wanted < wanted * wanted else math.inf


def _slip(table: Table, state: State, time: float) -> State:
    """The table after a time [s] in which it slips one way."""
    J, damping = table.J, table.c + table.d
    push = table.load(0.0) - state.side * table.M
    flow = np.array([[0.0, 1.0, 0.0], [-table.k / J, -damping / J, push / J], [0.0, 0.0, 0.0]])
    angle, speed, _ = expm(flow * time) @ (state.angle, state.speed, 1.0)
    return State(float(angle), float(speed), state.side)


def curve() -> Iterator[tuple[float, ...]]:
    """Rows of the reference: time [s], angle [rad], speed [rad/s], torque of the brake [N m], sticks; from rest."""
    times = [k * STEP for k in range(round(STOP / STEP) + 1)]
    for time, state in zip(times, motion(Table(), times), strict=True):
        yield time, state.angle, state.speed, state.friction(Table()), not state.side


def main() -> None:
    """Print the reference curve as CSV."""
    print_curve("time,table_angle,table_speed,friction_torque,brake_sticks", curve())


if __name__ == "__main__":
    main()

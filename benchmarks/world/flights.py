"""A second formulation of mechanisms with gaps: coordinates without joints, flights by scipy, Newton's law by hand.

What moves gives the accelerations of flight and the inverse of its mass matrix; each gap with the derivatives by the
coordinates and the row of friction. No contact stays closed: restitution is above zero, and hops are counted.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, Protocol

import numpy as np
import numpy.typing as npt
from scipy.integrate import solve_ivp

Vector = npt.NDArray[np.float64]
#: Relative and absolute tolerance of flights.
_TOLERANCES = (3e-14, 1e-15)


class Gapped(Protocol):
    """What moves: a state y is n coordinates and their n rates."""

    start: Vector

    def free(self, y: Vector) -> tuple[Vector, Vector]:
        """Accelerations of flight (n,), and the inverse of the mass matrix (n, n)."""

    def gaps(self, y: Vector) -> Sequence[float]:
        """All gaps [m]."""

    def rows(self, y: Vector, number: int) -> tuple[Vector, Vector]:
        """Derivatives of a gap by the coordinates (n,), and those of the way that its contact slips (n,)."""


class Struck(NamedTuple):
    """An impact: its time [s], the number of the gap, the closing speed [m/s]."""

    time: float
    number: int
    speed: float


def impacts(what: Gapped, restitution: float, count: int, friction: float = 0.0) -> list[Struck]:
    """So many impacts by Newton's law, with friction against a slip that no impact turns.

    Args:
        what: that moves.
        restitution: of all gaps, above 0.
        count: of impacts.
        friction: Coulomb's coefficient, of impacts.

    Raises:
        ValueError: friction would end or turn a slip, or nothing strikes within a second.
    """
    n = len(what.start) // 2
    numbers = range(len(what.gaps(what.start)))

    def flight(_time: float, y: Vector) -> Vector:
        return np.concatenate([y[n:], what.free(y)[0]])

    def event(number: int) -> object:
        def gap(_time: float, y: Vector) -> float:
            return what.gaps(y)[number]

        gap.terminal, gap.direction = True, -1  # type: ignore[attr-defined]
        return gap

    events = [event(number) for number in numbers]
    time, y, found = 0.0, what.start, list[Struck]()
    rtol, atol = _TOLERANCES
    while len(found) < count:
        flown = solve_ivp(flight, (time, time + 1.0), y, "DOP853", events=events, rtol=rtol, atol=atol, first_step=1e-8)
        if flown.status != 1:
            raise ValueError(f"Nothing strikes within a second of {time:g} s.")
        time, y = float(flown.t[-1]), flown.y[:, -1]
        number = min(numbers, key=lambda k: abs(what.gaps(y)[k]) if len(flown.t_events[k]) else np.inf)
        # the event is as near as its interpolation: a step of Newton's brings it onto the gap
        late = what.gaps(y)[number] / float(what.rows(y, number)[0] @ y[n:])
        time, y = time - late, y - late * flight(time, y)
        normal, along = what.rows(y, number)
        inverse = what.free(y)[1]
        opening, slip = float(normal @ y[n:]), float(along @ y[n:])
        push = inverse @ (normal - np.sign(slip) * friction * along)
        impulse = -(1 + restitution) * opening / float(normal @ push)
        y = np.concatenate([y[:n], y[n:] + push * impulse])
        if friction and slip * float(along @ y[n:]) <= 0:
            raise ValueError(f"At {time:g} s friction ends a slip.")
        found.append(Struck(time, number, -opening))
    return found

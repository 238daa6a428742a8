"""Integration of an FMU for Model Exchange: steps of scipy's Runge-Kutta methods, with events located inside them.

The importer owns time here: it evaluates derivatives at trial states, finds where an event indicator changes its sign
on the dense output of a step, and lets the FMU's events happen there. Steps reach ahead of communication points, as the
engine's own do, so that what is integrated does not depend on how often somebody looks.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from ...errors import UsageError

Numbers = npt.NDArray[np.float64]
METHODS = ("DOP853", "RK45")

#: Where an indicator changes its sign is found to this [s], and to as many roundings of the time.
_CLOSE, _ROUNDINGS = 1e-15, 4
#: Behind all communication points [s].
_FOR_EVER = 1e100
#: So many events in a row at one instant are no motion any more.
_MOST_AT_ONCE = 1000


@dataclass(frozen=True)
class Integrator:
    """How a component for Model Exchange is integrated.

    Attributes:
        method: of scipy: DOP853, of order 8, or RK45, of order 5.
        relative_tolerance: of each step; absolute ones are this times the nominal of each state.
    """

    method: str = "DOP853"
    relative_tolerance: float = 1e-9

    def __post_init__(self) -> None:
        """Refuse what cannot be."""
        if self.method not in METHODS:
            raise UsageError(f"There is no integrator '{self.method}'; take {' or '.join(METHODS)}.")
        if not 1e-13 <= self.relative_tolerance < 1.0:
            raise UsageError(f"The integrator's tolerance is {self.relative_tolerance:g}; give one from 1e-13 to 1.")


class Equations(Protocol):
    """What an FMU for Model Exchange calculates; who calls it is in continuous-time mode."""

    def nominals(self) -> Numbers:
        """Typical magnitudes of the states."""

    def derivatives(self, time: float, states: Numbers) -> Numbers:
        """Derivatives of the states; not numbers where there are none."""

    def indicators(self, time: float, states: Numbers) -> Numbers:
        """Event indicators."""

    def completed(self, time: float, states: Numbers) -> bool:
        """A step is accepted; whether the FMU wants event mode."""

    def happen(self) -> tuple[Numbers, float]:
        """Let events happen at what was completed last; the states behind them, and when the next is by time [s]."""


class Integration:
    """The motion of one FMU, from event to event.

    Attributes:
        time: up to which it has been brought [s].
        states: at that time.
        events: how many have happened.
        most_at_once: how many at one instant.
    """

    def __init__(self, equations: Equations, integrator: Integrator) -> None:
        self._of = equations
        self._integrator = integrator
        self._solver: Any = None
        self._dense: Callable[[float], Numbers] | None = None
        self._due: tuple[float, Numbers] | None = None
        self._signs: npt.NDArray[np.bool_] | None = None
        self._next = math.inf
        self.time, self.states = 0.0, np.zeros(0)
        self.events = self.most_at_once = 0

    def begin(self, time: float, states: Numbers, next_time: float) -> None:
        """Go on from here: nothing that was calculated ahead counts any more."""
        self.time, self.states, self._next = time, states, next_time
        self._solver = self._dense = self._due = self._signs = None

    def advance(self, target: float) -> None:
        """Go on to `target` [s], with all events on the way.

        Raises:
            UsageError: the steps shrink to nothing, or events follow each other without end.
        """
        at_once, instant = 0, -math.inf
        while self.time < target or self._event_is_due():
            if self._event_is_due():
                at_once = at_once + 1 if self.time == instant else 1
                instant = self.time
                self.most_at_once = max(self.most_at_once, at_once)
                if at_once > _MOST_AT_ONCE:
                    raise UsageError(f"At t = {self.time:.9g} s, {_MOST_AT_ONCE} events follow each other without end.")
                self.begin(self.time, *self._of.happen())
                self.events += 1
            elif self._next <= self.time:
                self._due = (self.time, self.states)
            elif len(self.states) == 0:  # nothing is integrated, and events come by time only
                self.time = min(self._next, target)
                if self._of.completed(self.time, self.states) or self.time >= self._next:
                    self._due = (self.time, self.states)
            elif self._solver is None or self._solver.t <= self.time:
                self._step()
            else:
                self._move(target)

    def _event_is_due(self) -> bool:
        return self._due is not None and self._due[0] <= self.time

    def _move(self, target: float) -> None:
        """Come to the end of the step, to the event in it, or to `target`, whichever is first."""
        end = self._solver.t if self._due is None else self._due[0]
        if target < end:
            assert self._dense is not None
            self.time, self.states = target, self._dense(target)
            return
        self.time, self.states = end, self._solver.y if self._due is None else self._due[1]
        if self._of.completed(self.time, self.states) and self._due is None:
            self._due = (self.time, self.states)
        if self._due is None and self.time >= self._next:
            self._due = (self.time, self.states)

    def _step(self) -> None:
        """Take a step from here, and look for the first event in it."""
        if self._solver is None or self._solver.status != "running":
            self._start()
        said = self._solver.step()
        if self._solver.status == "failed":
            raise UsageError(
                f"At t = {self.time:.9g} s, the steps of {self._integrator.method} shrink to nothing: {said}"
            )
        self._dense = dense = self._solver.dense_output()
        signs = self._of.indicators(self._solver.t, self._solver.y) > 0.0
        fired = np.flatnonzero(signs != self._signs)
        if len(fired):
            at = min(self._root(dense, int(number)) for number in fired)
            self._due = (at, dense(at))
        self._signs = signs

    def _start(self) -> None:
        from scipy.integrate import DOP853, RK45

        tolerance = self._integrator.relative_tolerance
        kind = {"DOP853": DOP853, "RK45": RK45}[self._integrator.method]
        absolute = tolerance * self._of.nominals()
        self._solver = kind(
            self._of.derivatives, self.time, self.states, min(self._next, _FOR_EVER), rtol=tolerance, atol=absolute
        )
        self._signs = self._of.indicators(self.time, self.states) > 0.0

    def _root(self, dense: Callable[[float], Numbers], number: int) -> float:
        """Where on a step an indicator changes its sign: right behind that."""
        from scipy.optimize import brentq

        begin, end = self._solver.t_old, self._solver.t
        assert self._signs is not None
        before = self._signs[number]

        def value(time: float) -> float:
            return float(self._of.indicators(time, dense(time))[number])

        if (value(begin) > 0.0) != before:  # rounding: it is there already
            return float(begin)
        if (value(end) > 0.0) == before:  # and here not yet
            return float(end)
        found = float(brentq(value, begin, end, xtol=_CLOSE, rtol=_ROUNDINGS * np.finfo(float).eps))
        beyond = _ROUNDINGS * math.ulp(max(abs(found), 1e-3))
        while found < end and (value(found) > 0.0) == before:
            found, beyond = min(found + beyond, end), 2.0 * beyond
        return found

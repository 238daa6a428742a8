"""One component of a machine with what is connected to it, and how it fared."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from time import perf_counter_ns
from typing import Any

from ..clock import SECOND, nanoseconds
from ..errors import FmuError
from .component import Component
from .signals import Signals


@dataclass(slots=True)
class Statistics:
    """How a part fared.

    Attributes:
        steps: completed, those that were taken back among them.
        rollbacks: how often it was put back.
        spent: in the component's own calls of steps, saving and restoring [ns].
        least, most: size of its steps [ns]; 0 before the first.
    """

    steps: int = 0
    rollbacks: int = 0
    spent: int = 0
    least: int = 0
    most: int = 0


class Part:
    """A component with its connected outputs and inputs.

    Attributes:
        component: it.
        outputs: those that somebody follows.
        inputs, slopes: those that follow somebody, and how they go on.
        statistics: of the run so far.
        can_restore: whether its state can be saved.
        feeds_through: places, among the targets, of inputs that a connected output follows at once.
    """

    def __init__(
        self,
        component: Component,
        sources: Sequence[str],
        rates: Sequence[str],
        targets: Sequence[str],
        scales: Sequence[float] = (),
    ) -> None:
        description = component.description
        self.component = component
        self.outputs = Signals(component, sources, rates, scales)
        self.targets = tuple(targets)
        self.inputs = component.reals(targets)
        self.statistics = Statistics()
        self.can_restore = description.saves_state
        self.takes_slopes = description.takes_slopes and bool(targets)
        follows = [description.variables[name].depends_on for name in sources]
        self.feeds_through = [
            place for place, target in enumerate(targets) if any(known is None or target in known for known in follows)
        ]
        self.slopes = component.reals(targets)
        self._state: Any = None
        self._advance = component.advance
        self._span = 0

    def go_by(self, component: Component) -> None:
        """Take steps by way of another component, which leads to the same one: one with watchers."""
        self.component = component
        self._advance = component.advance

    def advance(self, begin: int, end: int) -> int:
        """Take a step; the time reached [ns], earlier than `end` when the component returned early."""
        statistics = self.statistics
        time = begin / SECOND  # as `begin_and_size`, without the call
        goal = end / SECOND
        start = perf_counter_ns()
        reached = self._advance(time, goal - time)
        statistics.spent += perf_counter_ns() - start
        statistics.steps += 1
        done = end if reached == time + (goal - time) else min(max(nanoseconds(reached, "time reached"), begin), end)
        if done - begin != self._span:
            self._span = done - begin
            statistics.most = max(statistics.most, self._span)
            statistics.least = min(statistics.least or self._span, self._span)
        return done

    def step(self, begin: int, end: int) -> None:
        """Take a whole step [ns], going on where the component returns early."""
        while begin < end:
            begin = self.advance(begin, end)

    def save(self) -> None:
        """Take a snapshot, in the place of the one before."""
        start = perf_counter_ns()
        self._state = self.component.save(self._state)
        self.statistics.spent += perf_counter_ns() - start

    def restore(self) -> None:
        """Be as at the last snapshot."""
        start = perf_counter_ns()
        self.component.restore(self._state)
        self.statistics.spent += perf_counter_ns() - start
        self.statistics.rollbacks += 1

    def forget(self) -> None:
        """Release the snapshot; a component that has failed may refuse that, too, and nobody needs to know."""
        if self._state is not None:
            state, self._state = self._state, None
            with suppress(FmuError):
                self.component.free_state(state)

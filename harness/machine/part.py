"""Component in a machine: its connected outputs, extrapolated inputs, states saved and restored, statistics."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from enum import StrEnum
from time import perf_counter_ns
from typing import Any

from ..errors import FmuError
from ..fmu.interface import Component
from ..run.master import SECOND, nanoseconds

# Connected outputs of one part: what they are, what they were, and how fast they change.


@dataclass(frozen=True)
class Memory:
    """What `Signals` know at one moment."""

    time: int
    values: tuple[float, ...]
    before: tuple[int, Sequence[float]] | None
    first: tuple[int, Sequence[float]] | None
    known_before: Mapping[int, float] | None


class Signals:
    """Outputs that others follow.

    Attributes:
        names: of the outputs.
        values: at the last communication point.
        bends: how fast the last `derivatives` change, as far as that is known [unit/s2].
        refresh: read them, and keep nothing of what they were: for those who never ask for slopes.
        remembers: whether they will be asked for differences; if not, nobody need keep what they were before.
    """

    def __init__(
        self, component: Component, names: Sequence[str], rates: Sequence[str], scales: Sequence[float] = ()
    ) -> None:
        """Bind outputs.

        Args:
            component: whose they are.
            names: of the outputs.
            rates: for each its derivative among the outputs, "" where none is known.
            scales: for each the factor from the rate's unit to that of the output, per second; none: 1 for all.
        """
        self.names = tuple(names)
        self._component = component
        reals = component.reals(names)
        self.values, self.refresh = reals.values, reals.read
        self._now = component.reals(names)
        # A rate that others follow, too, is among the values already.
        self._scales = tuple(scales) or (1.0,) * len(self.names)
        self._followed = [(k, names.index(rate)) for k, rate in enumerate(rates) if rate in names]
        self._rates = [k for k, rate in enumerate(rates) if rate and rate not in names]
        self._rate = component.reals([rates[k] for k in self._rates])
        self._returned: list[int] | None = None
        self._slope = component.reals(())
        self._time = 0
        self._before: tuple[int, Sequence[float]] | None = None
        self._first: tuple[int, Sequence[float]] | None = None
        self._known: Mapping[int, float] | None = None
        self._known_before: Mapping[int, float] | None = None
        self._started = False
        self.bends = [0.0] * len(names)
        self.remembers = True

    def read(self, time: int) -> None:
        """Read them at `time` [ns]; those of the last other time become what they were before."""
        if not self.names:
            return
        if time != self._time and self.remembers and self._started:
            self._first, self._before = self._before, (self._time, self.values[:])
            self._known_before, self._known = self._known, None
        self._time, self._started = time, True
        self.refresh()

    def peek(self) -> list[float]:
        """What they are now, which counts as no communication point yet."""
        self._now.read()
        return list(self._now.values)

    def jumped(self) -> None:
        """What they were before says nothing about how they go on."""
        self._before = self._first = self._known_before = None

    def memory(self) -> Memory:
        """Everything, for `remember`."""
        return Memory(self._time, tuple(self.values), self._before, self._first, self._known_before)

    def remember(self, memory: Memory) -> None:
        """Be as at the time of `memory`."""
        self._time, self._before, self._first = memory.time, memory.before, memory.first
        self._known, self._known_before = None, memory.known_before
        self.values[:] = memory.values

    def differences(self) -> list[float]:
        """Mean slopes since the communication point before [unit/s]; 0 where there is none."""
        if self._before is None:
            return [0.0] * len(self.names)
        time, before = self._before
        span = (self._time - time) / SECOND
        return [(now - then) / span for now, then in zip(self.values, before, strict=True)]

    def derivatives(self) -> list[float]:
        """Slopes of now [unit/s]: rates that are outputs, else what the component returns, else from earlier values."""
        slopes = self.differences()
        self._known = self.rates(self.values)
        for k, rate in self._known.items():
            slopes[k] = rate
        self._bend(slopes)
        return slopes

    def rates(self, values: Sequence[float]) -> dict[int, float]:
        """Derivatives of now [unit/s], by the output's place: those that are outputs, or that the component returns.

        Args:
            values: of all outputs now, as of `peek`.
        """
        found = {k: self._scales[k] * values[rate] for k, rate in self._followed}
        if self._rates:
            self._rate.read()
            for k, rate in zip(self._rates, self._rate.values, strict=True):
                found[k] = self._scales[k] * rate
        if self._returned is None:
            self._returned = [
                k for k in range(len(self.names)) if k not in found and self._returns_slope(self.names[k])
            ]
            self._slope = self._component.reals([self.names[k] for k in self._returned])
        if self._returned and self._slope.read_slopes():
            found |= zip(self._returned, self._slope.values, strict=True)
        return found

    def _bend(self, slopes: list[float]) -> None:
        """Find `bends`, from slopes now and before, or from three values, which mend the slope as well."""
        self.bends = bends = [0.0] * len(slopes)
        if self._before is None:
            return
        since = (self._time - self._before[0]) / SECOND
        for k, slope in enumerate(slopes):
            if self._known is not None and k in self._known:
                if self._known_before is not None:
                    bends[k] = (slope - self._known_before[k]) / since
            elif self._first is not None:
                earlier = (self._before[1][k] - self._first[1][k]) * SECOND / (self._before[0] - self._first[0])
                bends[k] = 2 * (slope - earlier) * SECOND / (self._time - self._first[0])
                slopes[k] += bends[k] * since / 2

    def _returns_slope(self, name: str) -> bool:
        """Whether the component knows an output's derivative; not where it follows an input, whose slope is to come."""
        description = self._component.description
        if not description.gives_slopes or description.variables[name].depends_on != frozenset():
            return False
        return self._component.reals([name]).read_slopes()


# How inputs go on between communication points.


class Extrapolation(StrEnum):
    """What is known of an output decides what the inputs that follow it do during the next step."""

    #: They are held: an error of first order in the step.
    CONSTANT = "constant"
    #: They go on as from the communication point before: of second order; held for a step after an impact.
    LINEAR = "linear"
    #: They go on with the output's derivative, and with the mean of how that changes: of third order. What has no
    #: derivative is held in the first step and in the one after an impact, which leaves an error of second order.
    DERIVATIVES = "derivatives"

    def slopes(self, signals: Signals) -> list[float]:
        """Slopes of outputs in the next step [unit/s].

        Args:
            signals: outputs with their history.
        """
        if self is Extrapolation.CONSTANT:
            return [0.0] * len(signals.names)
        return signals.differences() if self is Extrapolation.LINEAR else signals.derivatives()

    @property
    def order(self) -> int:
        """Of the error that a step leaves behind in the long run."""
        return 1 if self is Extrapolation.CONSTANT else 2


# One component of a machine with what is connected to it, and how it fared.


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
        feedthrough: places, among the targets, of inputs that a connected output follows at once.
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
        self.feedthrough = [
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

"""The way from the beginning of a cycle to its end: after a period that is given, or where an output passes a value."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Literal

from .. import codes
from ..moving import Event
from ..simulation import Simulation

#: Which way an output passes the value of a section.
Direction = Literal["rising", "falling"]

#: The instant of a passage is found to this share of itself [1]: rounding of the clock.
_INSTANT = 4e-16
#: What is left of the output at that instant, over its change in the step [1]; more is a jump of an impact.
_JUMP = 1e-6
_TRIALS = 100


class CycleError(ValueError):
    """No periodic motion is found, or none that has multipliers; the message says why and what to do."""


@dataclass(frozen=True)
class Section:
    """Where a cycle ends whose period is not known: an output passes a value continuously.

    A jump of an impact over the value is no passage, and neither is the first step of the motion, which begins there.

    Attributes:
        output: its name, or that of a coordinate or rate, "balance.angle".
        value: that it passes [its unit].
        direction: which way.
        passages: how many such there are in a cycle.
        longest: a cycle that takes longer is none [s].
        advance: by how much the value grows with each passage [its unit], as that of a shaft that turns.

    Source: R. Seydel, Practical Bifurcation and Stability Analysis, 3rd ed. (2010), sections 7.4 and 7.5.
    """

    output: str
    value: float = 0.0
    direction: Direction = "rising"
    passages: int = 1
    longest: float = 10.0
    advance: float = 0.0

    def after(self, cycles: int) -> Section:
        """The section where so many cycles have gone by.

        Args:
            cycles: number of them.
        """
        return replace(self, value=self.value + cycles * self.passages * self.advance)


@dataclass(frozen=True)
class Passage:
    """The end of a cycle.

    Attributes:
        time: since the beginning of the first cycle [s].
        values: all outputs, coordinates and rates, by name [SI units].
        events: all so far.
        closing: closing speed of events that are impacts, by time [m/s; rad/s].
        closed: names of contacts that are closed.
    """

    time: float
    values: Mapping[str, float]
    events: tuple[Event, ...]
    closing: Mapping[float, float]
    closed: tuple[str, ...]

    @property
    def sequence(self) -> tuple[str, ...]:
        """Names of the events so far, in their order."""
        return tuple(event.guard for event in self.events)


def passages(begin: Callable[[], Simulation], end: Section | float, cycles: int = 1) -> tuple[Passage, ...]:
    """The ends of the first cycles, oldest first.

    Args:
        begin: makes the mechanism at the beginning of the first cycle, at time 0.
        end: the section, or the period [s].
        cycles: how many.

    Raises:
        CycleError: the section is not passed in time.
        SimulationError: the motion cannot go on.
        MechanismError: the mechanism cannot begin.
    """
    return _by_section(begin, end, cycles) if isinstance(end, Section) else _by_period(begin(), end, cycles)


class _Records:
    """A motion with all its events and impacts: the engine keeps those of a step, of which there is one a stop."""

    def __init__(self, simulation: Simulation) -> None:
        self.simulation = simulation
        self.events: list[Event] = []
        self.closing: dict[float, float] = {}

    def go_on(self, target: float) -> None:
        """Go on to the end of the engine's next step, or of its part up to an event, but not beyond the target [s]."""
        self.simulation.begin_step()
        self.simulation.go_on(target, codes.STOP_AT_STEP | codes.STOP_AT_EVENT)
        self.events += self.simulation.events_in_step()
        for impact in self.simulation.impacts_in_step():
            self.closing[impact.time] = max(impact.closing_speed, self.closing.get(impact.time, 0.0))

    def passage(self, state: Simulation) -> Passage:
        """The passage at a state of the same motion, not after the present one."""
        before = tuple(event for event in self.events if event.time <= state.time)
        return Passage(state.time, state.read(), before, dict(self.closing), state.mode())


def _by_period(simulation: Simulation, period: float, cycles: int) -> tuple[Passage, ...]:
    records = _Records(simulation)
    found: list[Passage] = []
    for cycle in range(1, cycles + 1):
        while simulation.time < cycle * period:
            records.go_on(cycle * period)
        found.append(records.passage(simulation))
    return tuple(found)


def _by_section(begin: Callable[[], Simulation], section: Section, cycles: int) -> tuple[Passage, ...]:
    sign = 1.0 if section.direction == "rising" else -1.0

    records, count = _Records(begin()), 0

    def height(simulation: Simulation) -> float:
        value = section.value + (count + 1) * section.advance
        return sign * (simulation.read()[section.output] - value)

    found: list[Passage] = []
    simulation, trial = records.simulation, begin()
    limit = cycles * section.longest
    before, low = 0.0, -1.0  # the motion begins on the section: its first step does not count
    while len(found) < cycles:
        if simulation.time >= limit:
            raise CycleError(_not_passed(section, limit, count))
        records.go_on(limit)
        after, high = simulation.time, height(simulation)
        if low < 0.0 <= high and before > 0.0:
            is_passage = _instant(trial, height, (before, low), (after, high))
            if is_passage:
                count += 1
                if count % section.passages == 0:
                    found.append(records.passage(trial))
                high = -math.inf if section.advance else high
        before, low = after, high
    return tuple(found)


def _instant(
    simulation: Simulation,
    height: Callable[[Simulation], float],
    low: tuple[float, float],
    high: tuple[float, float],
) -> bool:
    """Bring the motion to the instant of a passage within a step, by regula falsi (Illinois); False if it is a jump.

    The motion is begun anew for each trial: it is the same each time, to the last bit.

    Source: M. Dowell, P. Jarratt, A modified regula falsi method, BIT 11 (1971).
    """
    (a, f_a), (b, f_b) = low, high
    change, side = abs(f_b - f_a), 0
    f = f_b
    for _ in range(_TRIALS):
        t = b - f_b * (b - a) / (f_b - f_a)
        if not a < t < b:
            t = 0.5 * (a + b)
        simulation.begin(0.0)
        simulation.advance(t)
        f = height(simulation)
        if f == 0.0 or b - a <= _INSTANT * max(abs(b), 1e-3):
            break
        if f < 0.0:
            a, f_a = t, f
            f_b *= 0.5 if side < 0 else 1.0
            side = -1
        else:
            b, f_b = t, f
            f_a *= 0.5 if side > 0 else 1.0
            side = 1
        if abs(f) <= 1e-15 * change:
            break
    return abs(f) <= _JUMP * change


def _not_passed(section: Section, limit: float, count: int) -> str:
    return (
        f"{section.output} passes {section.value:g} {section.direction} {count} times within {limit:g} s, which is no "
        f"whole cycle; give another section, the other --direction, fewer --passages (now {section.passages}), or a "
        "greater --longest."
    )

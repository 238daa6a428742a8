"""Observation of every step of a component, those that are taken back, too; and statistics of its steps.

An observer sees a machine at communication points only. But an algorithm may take several steps in between, and what
an FMU says of its last step is then gone; or it may take steps back, and what was seen in them never happened.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from time import perf_counter_ns
from typing import Any, Protocol

from ...fmu.description import Value
from ...fmu.interface import Component, Reals, whole_step
from ...run.master import SECOND
from ..event_iteration import EventMode, event_mode_of
from ..machine import Machine
from ..part import Part

#: The number of impacts in the last step.
IMPACTS = ("impacts_in_step",)


class Watcher(Protocol):
    """Looks on at the steps of one component."""

    def begins(self, time: float) -> None:
        """A step is about to be taken from `time` [s]; its inputs are set."""

    def ended(self, time: float) -> None:
        """It was taken, and has come to `time` [s]."""

    def memory(self) -> Any:
        """What it knows now, for `remember`: the component's state is being saved."""

    def remember(self, memory: Any) -> None:
        """What happened since then has not happened."""


def watched(machine: Machine, name: str) -> Watched:
    """A part of a machine, to whose watchers one may be added before its first step."""
    part = machine.parts[name]
    if isinstance(part.component, Watched):
        return part.component
    component = Watched(part.component)
    part.go_by(component)
    return component


class Watched:
    """A component with watchers (an `interface.Component`).

    Attributes:
        component: it.
        watchers: who looks on.
        spent: time of the watchers [ns].
    """

    def __init__(self, component: Component) -> None:
        self.component = component
        self.description = component.description
        self.name = component.name
        self.watchers: list[Watcher] = []
        self.spent = 0
        self._impacts: list[Value] | None = None

    @property
    def event_mode(self) -> EventMode | None:
        """The component's own."""
        return event_mode_of(self.component)

    def advance(self, time: float, size: float) -> float:
        """Take a step before the eyes of the watchers."""
        began = perf_counter_ns()
        for watcher in self.watchers:
            watcher.begins(time)
        ready = perf_counter_ns()
        reached = self.component.advance(time, size)
        self._impacts = None
        done = perf_counter_ns()
        for watcher in self.watchers:
            watcher.ended(reached)
        self.spent += perf_counter_ns() - done + ready - began
        return reached

    def step(self, time: float, size: float) -> None:
        """Advance by `size` [s] from `time`, however often the component returns early."""
        whole_step(self.advance, time, size)

    def save(self, state: Any = None) -> tuple[Any, list[Any]]:
        """A snapshot of the component and of what the watchers know."""
        saved = self.component.save(None if state is None else state[0])
        return saved, self.memories()

    def restore(self, state: tuple[Any, list[Any]]) -> None:
        """Be again as when the snapshot was taken."""
        self.component.restore(state[0])
        self._impacts = None
        self.recall(state[1])

    def memories(self) -> list[Any]:
        """What the watchers know."""
        return [watcher.memory() for watcher in self.watchers]

    def recall(self, memories: Sequence[Any]) -> None:
        """Let the watchers know what they knew then."""
        for watcher, memory in zip(self.watchers, memories, strict=True):
            watcher.remember(memory)

    def free_state(self, state: tuple[Any, list[Any]]) -> None:
        """Release a snapshot."""
        self.component.free_state(state[0])

    def set(self, values: Mapping[str, Value]) -> None:
        """Set variables by name."""
        self.component.set(values)

    def get(self, names: Sequence[str]) -> list[Value]:
        """Values of variables, in the order of `names`; how many impacts a step had is asked by many, so it is kept."""
        if names != IMPACTS:
            return self.component.get(names)
        if self._impacts is None:
            self._impacts = self.component.get(names)
        return self._impacts

    def reals(self, names: Sequence[str]) -> Reals:
        """Bind Real variables."""
        return self.component.reals(names)

    def initialize(self, start_time: float, stop_time: float) -> None:
        """Find a consistent state."""
        self.component.initialize(start_time, stop_time)

    def enter_initialization(self, start_time: float, stop_time: float) -> None:
        """The first half of it."""
        self.component.enter_initialization(start_time, stop_time)

    def exit_initialization(self) -> None:
        """The other half."""
        self.component.exit_initialization()

    def terminate(self) -> None:
        """End the run."""
        self.component.terminate()


# How the components of a machine fared: steps, steps taken back, time spent.

#: Units of the numbers of `statistics`.
STATISTICS_UNITS = {
    "steps": "1",
    "rollbacks": "1",
    "time_spent": "s",
    "time_per_step": "s",
    "shortest_step": "s",
    "longest_step": "s",
}

#: The columns of `statistics_rows`.
HEADINGS = (
    "component",
    "steps [1]",
    "rollbacks [1]",
    "time spent [s]",
    "a step takes [us]",
    "shortest step [s]",
    "longest step [s]",
)

#: What is none of the components: exchange of signals, observers.
REST = "(the rest)"


def statistics(machine: Machine) -> dict[str, dict[str, float]]:
    """By component, in the order in which they take their steps, ready for JSON; in `STATISTICS_UNITS`.

    The time is that of the component's own steps, saving and restoring, without what those who watch it do.
    """
    return {name: _of(part) for name, part in machine.parts.items()}


def statistics_rows(machine: Machine, wall_time: float) -> list[list[str]]:
    """The cells below `HEADINGS`, for `terminal.show_table`, with a last one for the master and the observers.

    Args:
        machine: after its run.
        wall_time: of the run [s].
    """
    rows, rest = [], wall_time
    for name, one in statistics(machine).items():
        rest -= one["time_spent"]
        rows.append(
            [
                name,
                f"{one['steps']:d}",
                f"{one['rollbacks']:d}",
                f"{one['time_spent']:.3g}",
                f"{one['time_per_step'] * 1e6:.3g}",
                f"{one['shortest_step']:.9g}",
                f"{one['longest_step']:.9g}",
            ]
        )
    return [*rows, [REST, "", "", f"{rest:.3g}", "", "", ""]]


def _of(part: Part) -> dict[str, Any]:
    own, component = part.statistics, part.component
    spent = (own.spent - (component.spent if isinstance(component, Watched) else 0)) / SECOND
    return {
        "steps": own.steps,
        "rollbacks": own.rollbacks,
        "time_spent": spent,
        "time_per_step": spent / own.steps if own.steps else 0.0,
        "shortest_step": own.least / SECOND,
        "longest_step": own.most / SECOND,
    }

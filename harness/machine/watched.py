"""Looking on at every step of a component, those within a step of the machine and those that are taken back, too.

An observer sees a machine at communication points only. But an algorithm may take several steps in between, and what
an FMU says of its last step is then gone; or it may take steps back, and what was seen in them never happened.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from time import perf_counter_ns
from typing import Any, Protocol

from ..description import Value
from ..slave import whole_step
from .component import Component, Reals
from .events import EventMode, event_mode_of
from .machine import Machine

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
    """A component with watchers (a `component.Component`).

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

"""Events of components that share time: one event iteration for all of them (FMI 3.0, section 4.2.1).

Components of FMI 3.0 whose event mode is in use enter it together when one of them has an event. There, inputs go
round, output clocks are read and input clocks set, and the discrete states are updated, until none asks for more. All
others, of FMI 2.0 or without event mode, take part with their inputs and outputs as at any communication point.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Protocol

from ..errors import FmuError
from ..fmu.description import Value
from ..fmu.instances.fmi3 import MOST_UPDATES
from ..fmu.interface import Component
from .connection import Link, own_of, part_of
from .part import Part


class EventMode(Protocol):
    """The event mode of a component."""

    @property
    def pending(self) -> bool:
        """Whether there is an event that is not yet handled."""

    def share(self) -> None:
        """Leave events to the machine."""

    def enter(self) -> None:
        """Enter it, if the component is not in it."""

    def update(self) -> bool:
        """Update the discrete states; whether one more update is needed."""

    def leave(self) -> None:
        """Go back to the step mode."""

    def active(self, clocks: Sequence[str]) -> list[str]:
        """Which of some output clocks tick now."""

    def activate(self, clocks: Sequence[str]) -> None:
        """Let input clocks tick."""


def event_mode_of(component: Component) -> EventMode | None:
    """The event mode of a component; None where it is not in use."""
    mode: EventMode | None = getattr(component, "event_mode", None)
    return mode


class Events:
    """The events of a machine.

    Attributes:
        names: of the parts whose event mode is in use.
    """

    def __init__(self, parts: Mapping[str, Part], links: Sequence[Link]) -> None:
        """Take over the events of parts.

        Args:
            parts: by name.
            links: connections that count in event mode only: of clocks, and of what ticks by them; each behind those
                that its source follows at once.
        """
        modes = {name: event_mode_of(part.component) for name, part in parts.items()}
        self._modes = {name: mode for name, mode in modes.items() if mode is not None}
        for mode in self._modes.values():
            mode.share()
        self.names = tuple(self._modes)
        self._ticks = [link for link in links if link.type == "Clock"]
        self._values = [link for link in links if link.type != "Clock"]
        self._parts = parts
        watched = dict.fromkeys(link.source for link in self._ticks)  # in this order, not in that of hashes
        for link in self._values:
            name, source = part_of(link.source), parts[part_of(link.source)].component.description
            clocks = source.variable(own_of(link.source)).clocks
            watched |= dict.fromkeys(
                f"{name}.{clock}" for clock in clocks if source.variable(clock).causality == "output"
            )
        self._watched = {name: [own_of(clock) for clock in watched if part_of(clock) == name] for name in self._modes}

    def due(self) -> bool:
        """Whether a part has an event."""
        for mode in self._modes.values():  # noqa: SIM110 any() takes twice as long
            if mode.pending:
                return True
        return False

    def handle(self, pass_on: Callable[[], bool]) -> None:
        """The event iteration, after which all parts are in step mode again.

        Args:
            pass_on: lets inputs be what they follow; whether one has changed that may need an update.

        Raises:
            FmuError: a component refuses or fails, or there is no end to it.
        """
        for mode in self._modes.values():
            mode.enter()
        again = True
        for _ in range(MOST_UPDATES):
            changed, ticked = pass_on(), self._tick()
            if not (again or changed or ticked):
                break
            wishes = [mode.update() for mode in self._modes.values()]
            again = any(wishes)
        else:
            raise FmuError(
                f"The discrete states of {', '.join(self._modes)} do not settle in {MOST_UPDATES} updates: each update "
                "of one makes another one need it. Break the circle of their connections, or let one of them wait."
            )
        for mode in self._modes.values():
            mode.leave()

    def _tick(self) -> bool:
        """Pass on what ticks now, once a clock, with what a tick brings; whether anything did."""
        active: set[str] = set()
        passed: set[str] = set()
        while True:
            new = {
                f"{name}.{clock}"
                for name, clocks in self._watched.items()
                for clock in self._modes[name].active([one for one in clocks if f"{name}.{one}" not in active])
            }
            followers = [link.target for link in self._ticks if link.source in new]
            for name in dict.fromkeys(map(part_of, followers)):
                self._modes[name].activate([own_of(clock) for clock in followers if part_of(clock) == name])
            active |= new | set(followers)
            due = [link for link in self._values if link.target not in passed and self._is_there(link, active)]
            for link in due:
                self._pass(link)
            passed |= {link.target for link in due}
            if not new and not due:
                return bool(active)

    def _is_there(self, link: Link, active: set[str]) -> bool:
        """Whether both ends of a connection have a value at the ticks of now."""
        return all(self._ticks_now(end, active) for end in (link.source, link.target))

    def _ticks_now(self, name: str, active: set[str]) -> bool:
        part = part_of(name)
        clocks = self._parts[part].component.description.variable(own_of(name)).clocks
        return not clocks or any(f"{part}.{clock}" in active for clock in clocks)

    def _pass(self, link: Link) -> None:
        value: Value = self._parts[part_of(link.source)].component.get([own_of(link.source)])[0]
        self._parts[part_of(link.target)].component.set({own_of(link.target): link.of(value)})

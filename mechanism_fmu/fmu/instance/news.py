"""Log messages of impacts, events and pulling contacts, as an instance writes them to the FMI logger while it runs."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from pythonfmu.enums import Fmi2Status

from ... import codes
from ...advice import named
from ...moving import MovingMechanism


class Message(NamedTuple):
    """A line of the log: text, FMI status, category."""

    text: str
    status: Fmi2Status
    category: str


class News:
    """Keeps count of what has been logged.

    Args:
        simulation: all that has happened to it so far counts as logged.
    """

    def __init__(self, simulation: MovingMechanism | None = None) -> None:
        self._impacts = 0 if simulation is None else simulation.counters.item(codes.COUNT_IMPACTS)
        self._events = 0 if simulation is None else simulation.counters.item(codes.COUNT_EVENTS)
        self._lost = 0 if simulation is None else simulation.counters.item(codes.COUNT_LOST)
        self._passed = 0 if simulation is None else simulation.passed_configurations()[0]
        self._pulls = set[str]() if simulation is None else set(simulation.pulling_contacts())

    def since_last(self, simulation: MovingMechanism) -> Iterator[Message]:
        """Impacts and events of the step, those that the buffers lost, what was passed, and what has begun to pull."""
        counters = simulation.counters
        if counters.item(codes.COUNT_IMPACTS) != self._impacts:
            new = counters.item(codes.COUNT_IMPACTS) - self._impacts
            self._impacts += new
            yield from _impacts(simulation, new)
        if counters.item(codes.COUNT_EVENTS) != self._events:
            new = counters.item(codes.COUNT_EVENTS) - self._events
            self._events += new
            yield from _events(simulation, new)
        if counters.item(codes.COUNT_LOST) != self._lost:
            lost = counters.item(codes.COUNT_LOST) - self._lost
            self._lost += lost
            yield Message(
                f"{lost} impacts of the step to t = {simulation.time:.9g} s did not fit into "
                f"impacts[1..{len(simulation.field('impacts'))}] and are lost to the outside (the motion is right); "
                "use a shorter communication step.",
                Fmi2Status.warning,
                "logStatusWarning",
            )
        passed, last = simulation.passed_configurations()
        if passed != self._passed:
            new, self._passed = passed - self._passed, passed
            known = "" if math.isnan(last) else f", the last one at t = {last:.12g} s"
            yield Message(
                f"Singular configurations passed along the smooth branch in the step to t = {simulation.time:.9g} s: "
                f"{new}{known}.",
                Fmi2Status.ok,
                "logEvents",
            )
        if counters.item(codes.COUNT_PULLS) > len(self._pulls):
            for contact, time in simulation.pulling_contacts().items():
                if contact not in self._pulls:
                    self._pulls.add(contact)
                    yield pulls(contact, time)


def _impacts(simulation: MovingMechanism, new: int) -> Iterator[Message]:
    for impact in simulation.impacts_in_step(new):
        yield Message(
            f"Impact on {impact.contact} at t = {impact.time:.12g} s: closing speed {impact.closing_speed:.6g} m/s, "
            f"impulse {impact.impulse:.6g} N.s.",
            Fmi2Status.ok,
            "logEvents",
        )


def _events(simulation: MovingMechanism, new: int) -> Iterator[Message]:
    """What is known of the `new` events; of a step with many, the last ones."""
    known = simulation.events_in_step()
    if new > len(known):
        yield Message(
            f"{new - len(known)} events of the step to t = {simulation.time:.9g} s are not listed one by one; the last "
            f"{len(known)} follow.",
            Fmi2Status.ok,
            "logEvents",
        )
    for event in known[-new:]:  # of the first step, those of the start are logged
        change = ""  # of friction, and of teeth, there is often none
        if event.old_mode != event.new_mode or event.impulse != 0.0:
            modes = f"{_mode(event.old_mode)} -> {_mode(event.new_mode)}"
            change = f": {modes}, total impulse {event.impulse:.6g} N.s"
        yield Message(f"Event {event.guard} at t = {event.time:.12g} s{change}.", Fmi2Status.ok, "logEvents")


def _mode(closed: tuple[str, ...]) -> str:
    return named(closed, "+") or "all open"


def pulls(contact: str, time: float) -> Message:
    """A guided contact has pulled from a time [s] on."""
    return Message(
        f"From t = {time:.6g} s the guided contact {contact} pulls: it holds the bodies together where a real contact "
        "would open. The motion from here on is the guided model's, as in the paper.",
        Fmi2Status.warning,
        "logStatusWarning",
    )

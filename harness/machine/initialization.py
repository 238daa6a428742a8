"""What parts tell each other before the first step, so that each finds its start with the inputs that it will have."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from ..description import Value
from ..errors import FmuError
from ..messages import Status
from .component import Component
from .connection import Link
from .names import own_of, part_of
from .part import Part


def initialize(
    parts: Mapping[str, Part],
    links: Sequence[Link],
    groups: Sequence[Sequence[str]],
    start_time: float,
    stop_time: float,
) -> None:
    """Initialize parts, group by group, so that their order within a group does not matter.

    A part that follows others is told what they have come to. The parts of a cycle all enter the initialization mode,
    and exchange there until nothing changes, but not more often than connections lie behind each other. An output that
    a component does not tell there counts as its declared start; without one, what follows it keeps its own.

    Args:
        parts: by name.
        links: their connections.
        groups: names, each group behind those that it follows; more than one, or one with itself, is a cycle.
        start_time: of the run [s].
        stop_time: of the run [s].

    Raises:
        FmuError: a component refuses or fails.
    """
    known: dict[str, Value] = {}
    for group in groups:
        to = [link for link in links if part_of(link.target) in group]
        within = [link.source for link in to if part_of(link.source) in group]
        known |= _declared(parts, within)
        for name in group:
            parts[name].component.enter_initialization(start_time, stop_time)
        told: dict[str, Value] = {}
        for _ in range(len(within) + 1):
            for name in group:
                known |= _told_early(parts[name].component, name, within)
            now = {link.target: link.of(known[link.source]) for link in to if link.source in known}
            changed = {target: value for target, value in now.items() if told.get(target) != value}
            if not changed:
                break
            _tell(parts, changed)
            told = now
        for name in group:
            parts[name].component.exit_initialization()
        for name in group:
            known |= _outputs(parts[name].component, name, [link.source for link in links])


def _declared(parts: Mapping[str, Part], sources: Sequence[str]) -> dict[str, Value]:
    """What the descriptions say that outputs start with."""
    variables = {source: parts[part_of(source)].component.description.variables[own_of(source)] for source in sources}
    return {source: start for source, variable in variables.items() if (start := variable.start_value) is not None}


def _told_early(component: Component, name: str, sources: Sequence[str]) -> dict[str, Value]:
    """Outputs in the initialization mode, where a component may refuse to tell them; an end is an end there, too."""
    try:
        return _outputs(component, name, sources)
    except FmuError as error:
        if error.status is Status.FATAL:
            raise
        return {}


def _outputs(component: Component, name: str, sources: Sequence[str]) -> dict[str, Value]:
    own = [source for source in dict.fromkeys(sources) if part_of(source) == name]
    if not own:
        return {}
    values = zip(own, component.get([own_of(source) for source in own]), strict=True)
    return {source: value for source, value in values if not (isinstance(value, float) and not math.isfinite(value))}


def _tell(parts: Mapping[str, Part], values: Mapping[str, Value]) -> None:
    for name, part in parts.items():
        own = {own_of(target): value for target, value in values.items() if part_of(target) == name}
        if own:
            part.component.set(own)

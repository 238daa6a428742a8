"""Initialization of coupled components, discrete signals that are held, and inputs from a table."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import lru_cache

from ..errors import FmuError, Status
from ..fmu.description import Value
from ..fmu.interface import Component
from ..run.inputs import InputSignals
from ..run.master import SECOND, seconds
from .connection import Link, own_of, part_of
from .part import Part

# Inputs of a machine that a table drives: set with each exchange, and gone on with during a step.


class Driven:
    """Inputs of parts that follow a table.

    Attributes:
        parts: names of the parts that have some.
    """

    def __init__(self, parts: Mapping[str, Part], signals: InputSignals, start: int) -> None:
        """Bind inputs, which have their values at `start` [ns] already."""
        self._at = lru_cache(maxsize=4)(lambda time: signals.at(seconds(time)))
        names = [variable.name for variable in signals.variables]
        self.parts = tuple(part for part in parts if any(part_of(name) == part for name in names))
        self._driven = {
            part: _Inputs(parts[part], [name for name in names if part_of(name) == part]) for part in self.parts
        }
        for inputs in self._driven.values():
            inputs.knows(self._at(start))

    def exchange(self, time: int) -> None:
        """Let the inputs be what they are at `time` [ns]."""
        values = self._at(time)
        for inputs in self._driven.values():
            inputs.write(values)

    def give(self, name: str, begin: int, end: int) -> None:
        """Let a part's inputs go on from `begin` to `end` [ns], or be held at the mean of both."""
        if name in self._driven:
            self._driven[name].go_on(self._at(begin), self._at(end), (end - begin) / SECOND)

    def restored(self, name: str) -> None:
        """A part was put back: what its inputs are is not known any more."""
        if name in self._driven:
            self._driven[name].knows({})


class _Inputs:
    """Those of one part; Real ones go on, others change at communication points."""

    def __init__(self, part: Part, names: Sequence[str]) -> None:
        description = part.component.description
        self._component = part.component
        variables = {name: description.variables[own_of(name)] for name in names}
        # In FMI 3.0, what is not continuous changes in the event mode only.
        reals = {n: v for n, v in variables.items() if v.type == "Real" and (v.continuous or description.fmi < 3)}
        self._real_names = tuple(reals)
        own = [variable.name for variable in reals.values()]
        self._reals = part.component.reals(own)
        self._slopes = part.component.reals(own) if description.takes_slopes and own else None
        self._others = {name: variable.name for name, variable in variables.items() if name not in reals}
        self._known: Mapping[str, Value] = {}

    def knows(self, values: Mapping[str, Value]) -> None:
        """The others are so."""
        self._known = values

    def write(self, values: Mapping[str, Value]) -> None:
        if self._real_names:
            self._reals.values[:] = [float(values[name]) for name in self._real_names]
            self._reals.write()
        changed = {own: values[n] for n, own in self._others.items() if self._known.get(n) != values[n]}
        if changed:
            self._component.set(changed)
        self._known = values

    def go_on(self, before: Mapping[str, Value], behind: Mapping[str, Value], span: float) -> None:
        if not self._real_names:
            return
        pairs = [(float(before[name]), float(behind[name])) for name in self._real_names]
        if self._slopes is not None:
            self._slopes.values[:] = [(end - begin) / span for begin, end in pairs]
            self._slopes.write_slopes()
        else:
            self._reals.values[:] = [(begin + end) / 2 for begin, end in pairs]
            self._reals.write()


# Signals that are held: Boolean, Integer, Enumeration, String, and Real ones that are not continuous.
#
# They are passed on at communication points, when they have changed, and neither interpolated nor extrapolated. Their
# components are asked by name: that is slower than bound numbers, but a set costs only where something has changed.


class Held:
    """Connections that are held (`Link.held`)."""

    def __init__(self, parts: Mapping[str, Part], links: Sequence[Link]) -> None:
        self._parts = parts
        self._links = tuple(links)
        sources = dict.fromkeys(link.source for link in links)
        self._sources = {
            name: [own_of(source) for source in sources if part_of(source) == name]
            for name in parts
            if any(part_of(source) == name for source in sources)
        }
        self._values: dict[str, Value] = {}
        self._given: dict[str, Value] = {}

    def __len__(self) -> int:
        return len(self._links)

    def read(self) -> None:
        """Read all outputs that others follow."""
        for name, own in self._sources.items():
            values = self._parts[name].component.get(own)
            self._values.update(zip((f"{name}.{output}" for output in own), values, strict=True))

    def write(self) -> bool:
        """Set those inputs that have changed since they were set; whether there was one."""
        changed: dict[str, dict[str, Value]] = {}
        for link in self._links:
            value = link.of(self._values[link.source])
            if link.target not in self._given or not _same(self._given[link.target], value):
                changed.setdefault(part_of(link.target), {})[own_of(link.target)] = value
                self._given[link.target] = value
        for name, values in changed.items():
            self._parts[name].component.set(values)
        return bool(changed)

    def restored(self, name: str) -> None:
        """A part was put back: what its inputs are is not known any more."""
        self._given = {target: value for target, value in self._given.items() if part_of(target) != name}


def _same(one: Value, other: Value) -> bool:
    """Whether nothing has changed; NaN is NaN, so that an event iteration comes to its end."""
    return one == other or (one != one and other != other)


# What parts exchange before the first step, so that each finds its start with the inputs that it will have.


def initialize(
    parts: Mapping[str, Part],
    links: Sequence[Link],
    groups: Sequence[Sequence[str]],
    start_time: float,
    stop_time: float,
) -> None:
    """Initialize parts, group by group, so that their order within a group does not matter.

    A part that follows others is given what they have come to. The parts of a cycle all enter the initialization mode,
    and exchange there until nothing changes, but not more often than connections lie behind each other. An output that
    a component does not return there counts as its declared start; without one, what follows it keeps its own.

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
        given: dict[str, Value] = {}
        for _ in range(len(within) + 1):
            for name in group:
                known |= _early_outputs(parts[name].component, name, within)
            now = {link.target: link.of(known[link.source]) for link in to if link.source in known}
            changed = {target: value for target, value in now.items() if given.get(target) != value}
            if not changed:
                break
            _set_inputs(parts, changed)
            given = now
        for name in group:
            parts[name].component.exit_initialization()
        for name in group:
            known |= _outputs(parts[name].component, name, [link.source for link in links])


def _declared(parts: Mapping[str, Part], sources: Sequence[str]) -> dict[str, Value]:
    """What the descriptions say that outputs start with."""
    variables = {source: parts[part_of(source)].component.description.variables[own_of(source)] for source in sources}
    return {source: start for source, variable in variables.items() if (start := variable.start_value) is not None}


def _early_outputs(component: Component, name: str, sources: Sequence[str]) -> dict[str, Value]:
    """Outputs in the initialization mode, where a component may refuse to return them; an end is an end there, too."""
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


def _set_inputs(parts: Mapping[str, Part], values: Mapping[str, Value]) -> None:
    for name, part in parts.items():
        own = {own_of(target): value for target, value in values.items() if part_of(target) == name}
        if own:
            part.component.set(own)

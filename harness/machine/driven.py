"""Inputs of a machine that a table drives: set with each exchange, and gone on with during a step."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache

from ..clock import SECOND, seconds
from ..description import Value
from ..inputs import InputSignals
from .names import own_of, part_of
from .part import Part


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

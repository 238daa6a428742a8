"""Signals that are held: Boolean, Integer, Enumeration, String, and Real ones that are not continuous.

They are passed on at communication points, when they have changed, and neither interpolated nor extrapolated. Their
components are asked by name: that is slower than bound numbers, but a set costs only where something has changed.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ..description import Value
from .connection import Link
from .names import own_of, part_of
from .part import Part


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

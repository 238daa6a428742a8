"""Units of a machine: its parts come from several tools, and may mean different things by one name."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from ..description import Variable
from ..si import BASE_UNITS, Measure, parse_unit
from ..units import UnitMismatchError, Units
from .names import part_of

#: Tools write so many digits at least.
_SAME = 1e-9
_RADIAN, _SECOND = BASE_UNITS.index("rad"), BASE_UNITS.index("s")


@dataclass(frozen=True)
class PartUnits(Units):
    """Units of all parts; where they do not agree, those of the first.

    Attributes:
        parts: units of each part, by its name.
        disputed: names by which parts mean different things.
    """

    parts: Mapping[str, Units] = field(default_factory=dict)
    disputed: frozenset[str] = frozenset()


def units_of_parts(parts: Mapping[str, Units]) -> PartUnits:
    """The units of a machine, by its parts' units; what different tools write differently in the last digits is one."""
    own = {name: replace(units, defined=_with_radians(units.defined)) for name, units in parts.items()}
    defined: dict[str, Measure] = {}
    displayed: dict[str, dict[str, tuple[float, float]]] = {}
    disputed = set()
    for units in own.values():
        for name, measure in units.defined.items():
            if not _same(defined.setdefault(name, measure), measure):
                disputed.add(name)
        for name, displays in units.displayed.items():
            if name not in disputed:
                displayed[name] = {**displays, **displayed.get(name, {})}
    return PartUnits(defined, displayed, own, frozenset(disputed))


def converted(value: float, source: Variable, target: Variable, units: Units) -> float:
    """A value of one part's variable in the unit of another one's; one without a unit has that of the other.

    Raises:
        UnitMismatchError: they do not measure the same.
    """
    if not source.unit or not target.unit:
        return value
    if not isinstance(units, PartUnits) or units.disputed.isdisjoint((source.unit, target.unit)):
        return units.convert(value, source.unit, target.unit)
    given, wanted = (units.parts[part_of(end.name)].meaning(end.unit) for end in (source, target))
    if given is None or wanted is None or given.exponents != wanted.exponents:
        raise UnitMismatchError(
            f"unit '{source.unit}', as {part_of(source.name)} defines it, does not measure the same quantity as "
            f"'{target.unit}', as {part_of(target.name)} does"
        )
    if source.unit == target.unit and _same(given, wanted):
        return value
    return (given.factor * value + given.offset - wanted.offset) / wanted.factor


def rate_factor(rate: Variable, source: Variable, units: Units) -> float | None:
    """The factor from the unit of a rate to that of its source, per second; None: they do not measure the same.

    One without a unit has the other's; radians do not count.
    """
    if not rate.unit or not source.unit:
        return 1.0
    own, of = (_meaning(end, units) for end in (rate, source))
    if own is None or of is None:
        return 1.0 if rate.unit == f"{source.unit}/s" else None
    per_second = tuple(n - (place == _SECOND) for place, n in enumerate(of.exponents))
    if _without_radians(own) != _without_radians(replace(of, exponents=per_second)):
        return None
    return own.factor / of.factor


def _meaning(variable: Variable, units: Units) -> Measure | None:
    """What the unit of a variable means to its own part."""
    own = units.parts.get(part_of(variable.name), units) if isinstance(units, PartUnits) else units
    return own.meaning(variable.unit)


def _same(one: Measure, other: Measure) -> bool:
    return (
        _without_radians(one) == _without_radians(other)
        and math.isclose(one.factor, other.factor, rel_tol=_SAME)
        and math.isclose(one.offset, other.offset, rel_tol=_SAME, abs_tol=_SAME * abs(one.factor))
    )


def _with_radians(defined: Mapping[str, Measure]) -> dict[str, Measure]:
    """Units with the radians that their names say: many tools define rad/s as 1/s."""
    found = {}
    for name, measure in defined.items():
        known = parse_unit(name)
        named = known is not None and _without_radians(known) == _without_radians(measure)
        found[name] = replace(measure, exponents=known.exponents) if known is not None and named else measure
    return found


def _without_radians(measure: Measure) -> tuple[int, ...]:
    return (*measure.exponents[:_RADIAN], *measure.exponents[_RADIAN + 1 :])

"""Connections of a machine: names and units of components, checked, with units converted."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

from ..errors import UsageError
from ..fmu.description import Description, Value, Variable
from ..fmu.units import BASE_UNITS, Measure, UnitMismatchError, Units, parse_unit
from ..fmu.values import shown

# Names of a machine's variables: "ratchet.wheel_angle" is `wheel_angle` of the part `ratchet`.


def part_of(name: str) -> str:
    """The part that a variable of a machine belongs to."""
    return name.partition(".")[0]


def own_of(name: str) -> str:
    """What the part itself calls the variable."""
    return name.partition(".")[2]


# Units of a machine: its parts come from several tools, and may mean different things by one name.

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


# What is connected to what: checked, with units converted.


@dataclass(frozen=True)
class Connection:
    """What an input follows: gain times an output, plus an offset.

    Attributes:
        source: "<part>.<output>".
        target: "<part>.<input>"; its unit must measure the same quantity, and the source is converted to it. One of
            both that has no unit is taken to have the other's.
        gain: [1], behind the conversion, not 0; of numbers that become Real ones.
        offset: in the unit of the target; likewise.
        convert: whether the target may be of another kind: Boolean, Integer, Enumeration, Real (`_converts`).
        rate: "<part>.<output>", the source's derivative, for the extrapolation by derivatives; "" leaves it to the FMU.
    """

    source: str
    target: str
    gain: float = 1.0
    offset: float = 0.0
    rate: str = ""
    convert: bool = False

    def __str__(self) -> str:
        return f"{self.source} -> {self.target}"


def changes(connection: Connection, description: Description) -> str:
    """Gain and offset of a connection among the variables of a machine, where they do something, and its conversion."""
    gain = "" if connection.gain == 1.0 else f"* {connection.gain:g}"
    offset = shown(connection.offset, connection.target, description, digits=6) if connection.offset else ""
    numbers = f"{gain} + {offset}".strip() if offset else gain
    kinds = [kind_of(description.variables[name]) for name in (connection.source, connection.target)]
    converted = f"{kinds[0]} to {kinds[1]}" if kinds[0] != kinds[1] else ""
    return ", ".join(filter(None, (converted, numbers)))


@dataclass(frozen=True)
class Link:
    """A connection whose unit conversion is worked out: target = factor * source + offset.

    Attributes:
        source, target, factor, offset: as said.
        rate: output that is the source's derivative, "" for none.
        rate_factor: from its unit to that of the source, per second.
        type: of the target, as of `Variable.type`.
        held: the signal changes at communication points only, and never in between: one of both ends is not continuous.
        ticks: it is there in event mode only: a clock, or one of both ends ticks by one.
    """

    source: str
    target: str
    factor: float
    offset: float
    rate: str = ""
    rate_factor: float = 1.0
    type: str = "Real"
    held: bool = False
    ticks: bool = False

    def of(self, value: Value) -> Value:
        """What the target gets for a value of the source."""
        if self.type == "Real":
            return self.factor * float(value) + self.offset
        return _MAKE[self.type](value)


#: How a value becomes one of a type; a Boolean is 0 or 1, and any number but 0 is true.
_MAKE: Mapping[str, Callable[[Value], Value]] = {"Boolean": bool, "Integer": int, "String": str, "Binary": str}

#: What may become what if the connection says so: nothing that would lose a part of a number.
_CONVERTS = {
    "Boolean": ("Integer", "Enumeration", "Real"),
    "Integer": ("Boolean", "Enumeration", "Real"),
    "Enumeration": ("Integer", "Boolean", "Real"),
}

#: What a conversion means, for messages.
_MEANS = {
    ("Boolean", "Integer"): "false = 0, true = 1",
    ("Boolean", "Enumeration"): "false = 0, true = 1",
    ("Boolean", "Real"): "false = 0, true = 1",
    ("Integer", "Boolean"): "0 = false, all others = true",
    ("Enumeration", "Boolean"): "0 = false, all others = true",
}


def linked(connection: Connection, description: Description) -> Link:
    """The link that a connection makes among the variables of a machine.

    Raises:
        UsageError: it cannot be; the message says which and why.
    """
    where = f"Connection from '{connection.source}' to '{connection.target}'"
    source, target = (_end(name, where, description) for name in (connection.source, connection.target))
    if source.causality != "output":
        raise UsageError(f"{where}: the source is no output, but {_what(source)}; connect an output.")
    if target.causality != "input":
        raise UsageError(f"{where}: the target is no input, but {_what(target)}; connect an input.")
    _check_kinds(connection, source, target)
    if target.type == "Clock" and target.interval != "triggered":
        raise UsageError(
            f"{where}: the target ticks by time ({target.interval or 'no intervalVariability'}); connect a clock that "
            "is triggered."
        )
    if not (math.isfinite(connection.gain) and math.isfinite(connection.offset)) or connection.gain == 0.0:
        numbers = f"gain = {connection.gain:g}, offset = {connection.offset:g}"
        raise UsageError(f"{where}: {numbers}; give finite numbers, and a gain that is not 0.")
    try:
        shift, one = (converted(x, source, target, description.units) for x in (0.0, 1.0))
    except UnitMismatchError as mismatch:
        raise UsageError(f"{where}: {mismatch}.") from None
    factor, offset = connection.gain * (one - shift), connection.gain * shift + connection.offset
    held = source.type != "Real" or not source.continuous or target.type != "Real" or _by_event(target)
    rate, scale = _rate(connection, source, where, description)
    if rate and held:
        raise UsageError(f"{where}: a signal that is held has no rate; leave rate out.")
    ticks = source.in_event_mode_only or target.in_event_mode_only
    return Link(source.name, target.name, factor, offset, rate, scale, target.type, held or ticks, ticks)


def kind_of(variable: Variable) -> str:
    """Boolean, Integer, Enumeration, Real, String, Binary or Clock."""
    return "Enumeration" if variable.fmi_type == "Enumeration" else variable.type


def _check_kinds(connection: Connection, source: Variable, target: Variable) -> None:
    """Refuse what is of two kinds, unless it is to be converted and can be.

    Raises:
        UsageError: it cannot be; the message says what it would mean, or why not.
    """
    kinds = given, wanted = kind_of(source), kind_of(target)
    if given != wanted and wanted not in _CONVERTS.get(given, ()):
        raise UsageError(
            f"connection {connection}: {given} to {wanted} cannot be converted; connect an output that is {wanted}."
        )
    if given != wanted and not connection.convert:
        means = f" ({_MEANS[kinds]})" if kinds in _MEANS else ""
        raise UsageError(f"connection {connection}: {given} to {wanted}{means}; say convert = true.")
    if target.type != "Real" and (connection.gain != 1.0 or connection.offset != 0.0):
        raise UsageError(
            f"connection {connection}: a gain or an offset goes with Real inputs only, and {target.name} is {wanted}."
        )


def _by_event(target: Variable) -> bool:
    """Whether an input is one of FMI 3.0 that changes in event mode only."""
    return target.fmi_type.startswith("Float") and not target.continuous


def _rate(connection: Connection, source: Variable, where: str, description: Description) -> tuple[str, float]:
    """The rate, and the factor from its unit to that of the source per second."""
    if not connection.rate:
        return "", 1.0
    rate = _end(connection.rate, where, description)
    if rate.causality != "output" or rate.type != "Real":
        raise UsageError(f"{where}: the rate is no Real output, but {_what(rate)}.")
    if part_of(rate.name) != part_of(source.name):
        raise UsageError(f"{where}: the rate '{rate.name}' is of another part than the source.")
    factor = rate_factor(rate, source, description.units)
    if factor is None:
        raise UsageError(
            f"{where}: the rate '{rate.name}' is in {rate.unit}, which does not measure the same as {source.unit}/s; "
            "name an output that does, or leave rate out."
        )
    return rate.name, factor


def _end(name: str, where: str, description: Description) -> Variable:
    parts = dict.fromkeys(part_of(known) for known in description.variables)
    part, dot, _ = name.partition(".")
    if not dot or part not in parts:
        raise UsageError(f"{where}: '{name}' is none of <part>.<variable>; parts: {', '.join(parts)}.")
    return description.variable(name)


def _what(variable: Variable) -> str:
    return f"of causality {variable.causality} and type {variable.type}"

"""What is connected to what: checked, with units converted."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..description import Description, Variable
from ..errors import UsageError
from ..numbers import shown
from ..units import UnitMismatchError
from .names import part_of
from .part_units import converted


@dataclass(frozen=True)
class Connection:
    """What an input follows: gain times an output, plus an offset.

    Attributes:
        source: "<part>.<output>".
        target: "<part>.<input>"; its unit must measure the same quantity, and the source is converted to it. One of
            both that has no unit is taken to have the other's.
        gain: not 0.
        offset: in the unit of the target.
        rate: "<part>.<output>", the source's derivative, for the extrapolation by derivatives; "" leaves it to the FMU.
    """

    source: str
    target: str
    gain: float = 1.0
    offset: float = 0.0
    rate: str = ""

    def __str__(self) -> str:
        return f"{self.source} -> {self.target}"


def changes(connection: Connection, description: Description) -> str:
    """Gain and offset of a connection among the variables of a machine, where they do something."""
    gain = "" if connection.gain == 1.0 else f"* {connection.gain:g}"
    offset = shown(connection.offset, connection.target, description, digits=6) if connection.offset else ""
    return f"{gain} + {offset}".strip() if offset else gain


@dataclass(frozen=True)
class Link:
    """A connection whose unit conversion is worked out: target = factor * source + offset."""

    source: str
    target: str
    factor: float
    offset: float
    rate: str = ""


def linked(connection: Connection, description: Description) -> Link:
    """The link that a connection makes among the variables of a machine.

    Raises:
        UsageError: it cannot be; the message says which and why.
    """
    where = f"Connection from '{connection.source}' to '{connection.target}'"
    source, target = (_end(name, where, description) for name in (connection.source, connection.target))
    if source.causality != "output" or source.type != "Real":
        raise UsageError(f"{where}: the source is no Real output, but {_what(source)}; connect an output.")
    if target.causality != "input" or target.type != "Real":
        raise UsageError(f"{where}: the target is no Real input, but {_what(target)}; connect an input.")
    if not (math.isfinite(connection.gain) and math.isfinite(connection.offset)) or connection.gain == 0.0:
        numbers = f"gain = {connection.gain:g}, offset = {connection.offset:g}"
        raise UsageError(f"{where}: {numbers}; give finite numbers, and a gain that is not 0.")
    try:
        shift, one = (converted(x, source, target, description.units) for x in (0.0, 1.0))
    except UnitMismatchError as mismatch:
        raise UsageError(f"{where}: {mismatch}.") from None
    factor, offset = connection.gain * (one - shift), connection.gain * shift + connection.offset
    return Link(source.name, target.name, factor, offset, _rate(connection, source, where, description))


def _rate(connection: Connection, source: Variable, where: str, description: Description) -> str:
    if not connection.rate:
        return ""
    rate = _end(connection.rate, where, description)
    if rate.causality != "output" or rate.type != "Real":
        raise UsageError(f"{where}: the rate is no Real output, but {_what(rate)}.")
    if part_of(rate.name) != part_of(source.name):
        raise UsageError(f"{where}: the rate '{rate.name}' is of another part than the source.")
    try:
        factor = description.units.convert(1.0, rate.unit, f"{source.unit}/s") if rate.unit and source.unit else 1.0
    except UnitMismatchError:
        factor = 0.0
    if not math.isclose(factor, 1.0, rel_tol=1e-9):
        raise UsageError(
            f"{where}: the rate '{rate.name}' is in {rate.unit or '1'}, not in {source.unit or '1'}/s; name an output "
            "that is, or leave rate out."
        )
    return rate.name


def _end(name: str, where: str, description: Description) -> Variable:
    parts = dict.fromkeys(part_of(known) for known in description.variables)
    part, dot, _ = name.partition(".")
    if not dot or part not in parts:
        raise UsageError(f"{where}: '{name}' is none of <part>.<variable>; parts: {', '.join(parts)}.")
    return description.variable(name)


def _what(variable: Variable) -> str:
    return f"of causality {variable.causality} and type {variable.type}"

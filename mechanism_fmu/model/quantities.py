"""Numbers with units, as they stand in a description: `mm(5)`, "5 mm"; what is kept is the number in SI units."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import Any

from ..units import FMI, UnreadableUnitError
from .errors import MechanismError
from .functions import Number

_WRITTEN = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(\S*)\s*")


def mm(value: Number) -> Number:
    """Millimetres as [m].

    Args:
        value: in units of a millimetre.

    Source: definition: SI prefix, 1 mm = 1e-3 m.
    """
    return value * 1e-3


def cm(value: Number) -> Number:
    """Centimetres as [m].

    Args:
        value: in units of a centimetre.

    Source: definition: SI prefix, 1 cm = 1e-2 m.
    """
    return value * 1e-2


def deg(value: Number) -> Number:
    """Degrees as [rad].

    Args:
        value: in units of a degree.

    Source: definition: 1 deg = pi/180 rad.
    """
    return value * (math.pi / 180)


def rpm(value: Number) -> Number:
    """Revolutions a minute as [rad/s].

    Args:
        value: in units of a revolution per minute.

    Source: definition: 1 rpm = 2 pi rad in 60 s.
    """
    return value * (math.pi / 30)


def quantity(value: Any, unit: str, what: str = "quantity") -> Number:
    """A number in an SI unit: "5 mm" with "m" is 0.005; what is no text is in that unit already, and stays as it is.

    Args:
        value: a number, which may be symbolic, or a text such as "5 mm", "20 N/mm" or "1000rpm".
        unit: SI unit, as FMI writes it.
        what: the quantity is of, for the message.

    Raises:
        MechanismError: the text is no number with a unit, or the unit is of another kind.

    Source: definition: a unit as a factor times powers of base units, as in FMI 2.0, section 2.2.2;
        `mechanism_fmu.units`.
    """
    if not isinstance(value, str):
        return value
    example = "e.g. 0.5 or '0.5'" if unit == "1" else f"e.g. 0.5, or with a unit, '0.5 {unit}'"
    written = _WRITTEN.fullmatch(value)
    if written is None:
        raise MechanismError(
            f"{what} wants {_said(unit)}, got {value!r}, which is no number with a unit; give {example}."
        )
    try:
        given = FMI.read(written[2] or "1")
    except UnreadableUnitError as error:
        raise MechanismError(f"{what} wants {_said(unit)}, got {value!r}: {error}") from error
    wanted = FMI.read(unit)
    if given.exponents != wanted.exponents:
        raise MechanismError(f"{what} wants {_said(unit)}, got {value!r}; give {example}.")
    return float(written[1]) * (given.factor / wanted.factor)


def pair(value: Any, unit: str, what: str) -> tuple[Number, Number]:
    """A point or vector (x, y), of each of whose numbers the same holds as of `quantity`.

    Args:
        value: two numbers or texts.
        unit: SI unit, as FMI writes it; "m" of points.
        what: the pair is, for the message.

    Raises:
        MechanismError: it is no pair, a text is no number with a unit, or the unit is of another kind.
    """
    try:
        numbers: tuple[Number, ...] = () if isinstance(value, str) else tuple(value)  # "ab" is no pair either
        x, y = numbers
    except (TypeError, ValueError):
        kind = "point" if unit == "m" else "vector"
        raise MechanismError(f"{what} is {value!r}, but it must be a {kind} (x, y).") from None
    return quantity(x, unit, what), quantity(y, unit, what)


def with_texts(value: Any, unit: str | Sequence[str], what: str) -> Any:
    """A number, or several of which each may be a text: without any, it stays as it is.

    Args:
        value: a number or text, or a tuple or list of such.
        unit: SI unit of it, or of each, where they differ.
        what: the quantity is of, for the message.

    Raises:
        MechanismError: as of `quantity`.
    """
    if not isinstance(value, tuple | list):
        return value if not isinstance(unit, str) else quantity(value, unit, what)
    if not any(isinstance(x, str) for x in value):
        return value
    units = [unit] * len(value) if isinstance(unit, str) else unit
    if len(units) != len(value):
        raise MechanismError(f"{what} is {value!r}, but it must be {len(units)} numbers, in {', '.join(units)}.")
    return tuple(quantity(x, one, what) for x, one in zip(value, units, strict=True))


def _said(unit: str) -> str:
    return "a plain number" if unit == "1" else unit

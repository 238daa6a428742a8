"""Units as FMI writes them: symbols with prefixes and exponents, joined by dots, with at most one slash a level.

The grammar is Modelica's (Modelica 3.6, chapter 19), which FMI 2.0 recommends: `kg.m2`, `N.m/rad`, `1/(s.rad)`,
`m.s-2`.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from ...model import MechanismError

#: Base units in the order of FMI's element `BaseUnit`; FMI counts the radian among them.
BASE_UNITS = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")

_PREFIXES = {"G": 1e9, "M": 1e6, "k": 1e3, "c": 1e-2, "m": 1e-3, "u": 1e-6, "n": 1e-9}

_TOKEN = re.compile(r"([A-Za-z]+)([+-]?\d+)?|(1)(?!\d)|[./()]")

#: Display units that a tool is offered for an SI unit, whether or not a variable asks for them.
OFFERED_DISPLAY_UNITS = {
    "rad": ("deg", "mrad"),
    "rad/s": ("deg/s", "rpm"),
    "m": ("mm",),
    "m/s": ("mm/s",),
    "s": ("ms",),
    "kg": ("g",),
    "kg.m2": ("kg.mm2",),
    "N": ("mN",),
    "N.m": ("mN.m", "N.mm"),
    "N.m/rad": ("mN.m/rad", "N.m/deg"),
    "N.s": ("mN.s",),
    "J": ("mJ",),
    "Pa": ("kPa", "MPa"),
}


class UnitError(MechanismError):
    """A unit that cannot be read, or two that do not measure the same quantity."""


@dataclass(frozen=True)
class Unit:
    """A unit as a product of base units.

    Attributes:
        factor: value of 1 unit in base units.
        exponents: of `BASE_UNITS`, in that order.
    """

    factor: float = 1.0
    exponents: tuple[int, ...] = (0,) * len(BASE_UNITS)

    def times(self, other: Unit, power: int = 1) -> Unit:
        """`self * other ** power`."""
        exponents = tuple(a + power * b for a, b in zip(self.exponents, other.exponents, strict=True))
        factor = self.factor * other.factor**power if power > 0 else self.factor / other.factor**-power
        return Unit(factor, exponents)


def _base(**exponents: int) -> tuple[int, ...]:
    return tuple(exponents.get(name, 0) for name in BASE_UNITS)


_SYMBOLS = {
    "1": Unit(),
    **{name: Unit(1.0, _base(**{name: 1})) for name in BASE_UNITS},
    "g": Unit(1e-3, _base(kg=1)),
    "N": Unit(1.0, _base(kg=1, m=1, s=-2)),
    "J": Unit(1.0, _base(kg=1, m=2, s=-2)),
    "W": Unit(1.0, _base(kg=1, m=2, s=-3)),
    "Pa": Unit(1.0, _base(kg=1, m=-1, s=-2)),
    "V": Unit(1.0, _base(kg=1, m=2, s=-3, A=-1)),
    "ohm": Unit(1.0, _base(kg=1, m=2, s=-3, A=-2)),
    "H": Unit(1.0, _base(kg=1, m=2, s=-2, A=-2)),
    "Hz": Unit(1.0, _base(s=-1)),
    "deg": Unit(math.pi / 180, _base(rad=1)),
    "rpm": Unit(math.pi / 30, _base(rad=1, s=-1)),
}


def parse_unit(text: str) -> Unit:
    """Read a unit.

    Raises:
        UnitError: the text is not in the grammar, or has an unknown symbol.
    """
    tokens, position = [], 0
    while position < len(text):
        match = _TOKEN.match(text, position)
        if match is None:
            raise UnitError(f"unit {text!r} cannot be read at {text[position:]!r}; write e.g. 'kg.m2' or 'N.m/rad'.")
        tokens.append(match)
        position = match.end()
    unit, rest = _quotient(tokens, text)
    if rest:
        raise UnitError(f"unit {text!r} cannot be read at {text[rest[0].start() :]!r}; use one '/', or brackets.")
    return unit


def _quotient(tokens: list[re.Match[str]], text: str) -> tuple[Unit, list[re.Match[str]]]:
    """Factors joined by dots, then perhaps a slash and ONE factor or bracket."""
    unit, tokens = _factor(tokens, text)
    while tokens and tokens[0][0] == ".":
        factor, tokens = _factor(tokens[1:], text)
        unit = unit.times(factor)
    if tokens and tokens[0][0] == "/":
        factor, tokens = _factor(tokens[1:], text)
        unit = unit.times(factor, -1)
    return unit, tokens


def _factor(tokens: list[re.Match[str]], text: str) -> tuple[Unit, list[re.Match[str]]]:
    if not tokens:
        raise UnitError(f"unit {text!r} ends too early; write e.g. 'kg.m2', 'N.m/rad', or '1' for no unit.")
    first, rest = tokens[0], tokens[1:]
    if first[0] == "(":
        unit, rest = _quotient(rest, text)
        if not rest or rest[0][0] != ")":
            raise UnitError(f"unit {text!r} lacks a closing bracket.")
        return unit, rest[1:]
    symbol = first[1] or first[3]
    if symbol is None:
        raise UnitError(f"unit {text!r} has {first[0]!r} where a symbol should stand.")
    return Unit().times(_symbol(symbol, text), int(first[2] or 1)), rest


def _symbol(symbol: str, text: str) -> Unit:
    if symbol in _SYMBOLS:
        return _SYMBOLS[symbol]
    prefix, rest = symbol[0], symbol[1:]
    if prefix in _PREFIXES and rest in _SYMBOLS and rest not in ("1", "kg"):
        return Unit(_PREFIXES[prefix]).times(_SYMBOLS[rest])
    raise UnitError(
        f"unit {text!r}: the symbol {symbol!r} is unknown; there are {', '.join(_SYMBOLS)}, "
        f"with the prefixes {', '.join(_PREFIXES)}; products are written with a dot, as in 'N.m'."
    )


def display_factor(unit: str, display_unit: str) -> float:
    """Factor from a value in `unit` to the value in `display_unit` (FMI's DisplayUnit/factor).

    Raises:
        UnitError: the two do not measure the same quantity.
    """
    shown, base = parse_unit(display_unit), parse_unit(unit)
    if shown.exponents != base.exponents:
        raise UnitError(f"display unit {display_unit!r} does not measure the same quantity as {unit!r}.")
    return base.factor / shown.factor

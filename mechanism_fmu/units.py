"""Units as FMI writes them: symbols with prefixes and exponents, joined by dots, with at most one slash a level.

The grammar is Modelica's (Modelica 3.6, chapter 19), which FMI 2.0 recommends: `kg.m2`, `N.m/rad`, `1/(s.rad)`,
`m.s-2`. What builds FMUs reads units by it as it stands, and the harness, behind a reader of other spellings
(`harness.fmu.units`).
"""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass

#: Base units in the order of FMI's element `BaseUnit` (FMI 2.0, section 2.2.2); FMI counts the radian among them.
BASE_UNITS = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")

PREFIXES = {"G": 1e9, "M": 1e6, "k": 1e3, "c": 1e-2, "m": 1e-3, "u": 1e-6, "n": 1e-9}

_TOKEN = re.compile(r"([A-Za-z]+)([+-]?\d+)?|(1)(?!\d)|[./()]")


class UnreadableUnitError(ValueError):
    """A text that is no unit; the message says where it breaks off, and how to write it."""


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
        return Unit(self.factor * other.factor**power, exponents)


def _base(**exponents: int) -> tuple[int, ...]:
    return tuple(exponents.get(name, 0) for name in BASE_UNITS)


#: What symbols mean; all but "1", "kg" and "d" take prefixes in an FMU.
SYMBOLS = {
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
    "d": Unit(86400.0, _base(s=1)),
    "deg": Unit(math.pi / 180, _base(rad=1)),
    "rpm": Unit(math.pi / 30, _base(rad=1, s=-1)),
}


@dataclass(frozen=True)
class Grammar:
    """Symbols, and which of them stand without a prefix."""

    symbols: Mapping[str, Unit]
    without_prefix: Collection[str]

    def read(self, text: str) -> Unit:
        """Read a unit.

        Raises:
            UnreadableUnitError: the text is not in the grammar, or has an unknown symbol.
        """
        tokens, position = [], 0
        while position < len(text):
            match = _TOKEN.match(text, position)
            if match is None:
                raise UnreadableUnitError(
                    f"unit {text!r} cannot be read at {text[position:]!r}; write e.g. 'kg.m2' or 'N.m/rad'."
                )
            tokens.append(match)
            position = match.end()
        unit, rest = self._quotient(tokens, text)
        if rest:
            where = text[rest[0].start() :]
            raise UnreadableUnitError(f"unit {text!r} cannot be read at {where!r}; use one '/', or brackets.")
        return unit

    def _quotient(self, tokens: list[re.Match[str]], text: str) -> tuple[Unit, list[re.Match[str]]]:
        """Factors joined by dots, then perhaps a slash and ONE factor or bracket."""
        unit, tokens = self._factor(tokens, text)
        while tokens and tokens[0][0] == ".":
            factor, tokens = self._factor(tokens[1:], text)
            unit = unit.times(factor)
        if tokens and tokens[0][0] == "/":
            factor, tokens = self._factor(tokens[1:], text)
            unit = unit.times(factor, -1)
        return unit, tokens

    def _factor(self, tokens: list[re.Match[str]], text: str) -> tuple[Unit, list[re.Match[str]]]:
        if not tokens:
            raise UnreadableUnitError(
                f"unit {text!r} ends too early; write e.g. 'kg.m2', 'N.m/rad', or '1' for no unit."
            )
        first, rest = tokens[0], tokens[1:]
        if first[0] == "(":
            unit, rest = self._quotient(rest, text)
            if not rest or rest[0][0] != ")":
                raise UnreadableUnitError(f"unit {text!r} lacks a closing bracket.")
            return unit, rest[1:]
        symbol = first[1] or first[3]
        if symbol is None:
            raise UnreadableUnitError(f"unit {text!r} has {first[0]!r} where a symbol should stand.")
        return Unit().times(self._symbol(symbol, text), int(first[2] or 1)), rest

    def _symbol(self, symbol: str, text: str) -> Unit:
        if symbol in self.symbols:
            return self.symbols[symbol]
        prefix, rest = symbol[0], symbol[1:]
        if prefix in PREFIXES and rest in self.symbols and rest not in self.without_prefix:
            return Unit(PREFIXES[prefix]).times(self.symbols[rest])
        raise UnreadableUnitError(
            f"unit {text!r}: the symbol {symbol!r} is unknown; there are {', '.join(self.symbols)}, "
            f"with the prefixes {', '.join(PREFIXES)}; products are written with a dot, as in 'N.m'."
        )


#: Of what FMUs declare.
FMI = Grammar(SYMBOLS, ("1", "kg", "d"))

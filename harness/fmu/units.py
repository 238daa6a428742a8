"""Units: expressions of SI symbols, and those that an FMU defines."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field

# Unit expressions made of SI symbols: "N.mm", "kg.mm2", "rad/s", "N.m/(rad/s)".

#: The base units of FMI 2.0, section 2.2.2, in this order wherever exponents are listed.
BASE_UNITS = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")


@dataclass(frozen=True)
class Measure:
    """What a unit means: value in SI base units = factor * value + offset.

    Attributes:
        exponents: of the base units, in the order of `BASE_UNITS`.
        factor: scale.
        offset: shift, as in degrees Celsius.
    """

    exponents: tuple[int, ...]
    factor: float = 1.0
    offset: float = 0.0

    def __mul__(self, other: Measure) -> Measure:
        return Measure(
            tuple(a + b for a, b in zip(self.exponents, other.exponents, strict=True)), self.factor * other.factor
        )

    def __pow__(self, power: int) -> Measure:
        return Measure(tuple(a * power for a in self.exponents), self.factor**power)


def _measure(factor: float = 1.0, **exponents: int) -> Measure:
    return Measure(tuple(exponents.get(base, 0) for base in BASE_UNITS), factor)


_PREFIXES = {"G": 1e9, "M": 1e6, "k": 1e3, "c": 1e-2, "m": 1e-3, "u": 1e-6, "µ": 1e-6, "μ": 1e-6, "n": 1e-9}

_PREFIXABLE = {
    "g": _measure(1e-3, kg=1),
    "m": _measure(m=1),
    "s": _measure(s=1),
    "A": _measure(A=1),
    "K": _measure(K=1),
    "mol": _measure(mol=1),
    "rad": _measure(rad=1),
    "N": _measure(kg=1, m=1, s=-2),
    "J": _measure(kg=1, m=2, s=-2),
    "W": _measure(kg=1, m=2, s=-3),
    "Pa": _measure(kg=1, m=-1, s=-2),
    "V": _measure(kg=1, m=2, s=-3, A=-1),
    "ohm": _measure(kg=1, m=2, s=-3, A=-2),
    "H": _measure(kg=1, m=2, s=-2, A=-2),
    "Hz": _measure(s=-1),
}

#: Never with a prefix, so that "min" is a minute and "cd" a candela.
_WHOLE = {
    "1": _measure(),
    "cd": _measure(cd=1),
    "min": _measure(60.0, s=1),
    "deg": _measure(math.pi / 180, rad=1),
    "°": _measure(math.pi / 180, rad=1),
    "rpm": _measure(math.pi / 30, rad=1, s=-1),
}

_FACTOR = re.compile(r"([^\W\d]+|°|1)(?:\^?([+-]?\d+))?")


def parse_unit(text: str) -> Measure | None:
    """What a unit expression means, or None when it is not one.

    Factors are joined by `.`, `*` or `·`; at most one `/`, with brackets around a denominator of several factors
    (the unit grammar of the Modelica language, chapter 19). Symbols take the usual prefixes from G to n.
    """
    numerator, slash, denominator = text.replace(" ", "").partition("/")
    if not slash:
        return _product(numerator)
    if denominator.startswith("(") and denominator.endswith(")"):
        below = parse_unit(denominator[1:-1])
    elif len(re.split(r"[.*·]", denominator)) == 1:
        below = _product(denominator)
    else:
        return None
    above = _product(numerator)
    return None if above is None or below is None else above * below**-1


def _product(text: str) -> Measure | None:
    product = _WHOLE["1"]
    for part in re.split(r"[.*·]", text):
        match = _FACTOR.fullmatch(part)
        symbol = None if match is None else _symbol(match[1])
        if match is None or symbol is None:
            return None
        product = product * symbol ** int(match[2] or 1)
    return product


def _symbol(name: str) -> Measure | None:
    if name in _WHOLE:
        return _WHOLE[name]
    if name in _PREFIXABLE:
        return _PREFIXABLE[name]
    prefix, rest = name[:1], name[1:]
    if prefix in _PREFIXES and rest in _PREFIXABLE:
        base = _PREFIXABLE[rest]
        return Measure(base.exponents, base.factor * _PREFIXES[prefix])
    return None


# The units of one FMU, as its modelDescription.xml defines them.


class UnitMismatchError(ValueError):
    """A unit that does not fit the variable; the message lists those that do."""


@dataclass(frozen=True)
class Units:
    """Units by name.

    Attributes:
        defined: the `Unit` elements that have a `BaseUnit`.
        displayed: by the name of a `Unit`, its `DisplayUnit` elements as (factor, offset):
            value in the display unit = factor * value in the unit + offset.
    """

    defined: Mapping[str, Measure] = field(default_factory=dict)
    displayed: Mapping[str, Mapping[str, tuple[float, float]]] = field(default_factory=dict)

    def convert(self, value: float, given: str, wanted: str) -> float:
        """`value` in the unit `given`, expressed in `wanted`, the unit of a variable.

        The FMU's own definitions come first, then SI symbols and prefixes (`parse_unit`).

        Raises:
            UnitMismatchError: `given` is unknown or measures another quantity.
        """
        if given == wanted:
            return value
        if given in self.displayed.get(wanted, {}):
            factor, offset = self.displayed[wanted][given]
            return (value - offset) / factor
        source, target = self.meaning(given), self.meaning(wanted)
        if source is None or target is None or source.exponents != target.exponents:
            raise UnitMismatchError(self._refusal(given, wanted, known=source is not None))
        return (source.factor * value + source.offset - target.offset) / target.factor

    def to_display(self, value: float, unit: str, display_unit: str) -> float | None:
        """`value` in `unit`, expressed in one of its display units; None when the FMU does not define it."""
        if display_unit not in self.displayed.get(unit, {}):
            return None
        factor, offset = self.displayed[unit][display_unit]
        return factor * value + offset

    def fitting(self, unit: str) -> list[str]:
        """Names from the FMU's definitions that measure the same quantity as `unit`, itself first."""
        meaning = self.meaning(unit)
        same = [
            name
            for name, measure in self.defined.items()
            if name != unit and meaning is not None and measure.exponents == meaning.exponents
        ]
        display = [name for owner in (unit, *same) for name in self.displayed.get(owner, {})]
        return list(dict.fromkeys([unit, *same, *display]))

    def meaning(self, name: str) -> Measure | None:
        """What a unit means; None when it is unknown."""
        if name in self.defined:
            return self.defined[name]
        for owner, names in self.displayed.items():
            if name in names and owner in self.defined:
                factor, offset = names[name]
                unit = self.defined[owner]
                return Measure(unit.exponents, unit.factor / factor, unit.offset - unit.factor * offset / factor)
        return parse_unit(name)

    def _refusal(self, given: str, wanted: str, *, known: bool) -> str:
        problem = f"unit '{given}' does not measure the same quantity" if known else f"unit '{given}' is not known"
        fitting = ", ".join(self.fitting(wanted))
        if self.meaning(wanted) is None:
            return f"{problem}; the unit must be {fitting}, or leave it out"
        return f"{problem}; these fit: {fitting}, also with SI prefixes on any symbol (m, k, ...)"

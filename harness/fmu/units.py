"""Units: expressions of SI symbols, and those that an FMU defines."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field

from mechanism_fmu.units import BASE_UNITS as BASE_UNITS, SYMBOLS, Grammar, Unit, UnreadableUnitError

# Unit expressions made of SI symbols: "N.mm", "kg.mm2", "rad/s", "N.m/(rad/s)".

#: As people write them: with minutes, and with prefixes only where they are usual, so that "min" is a minute.
_WRITTEN = Grammar(
    {**SYMBOLS, "min": Unit(60.0, SYMBOLS["s"].exponents)}, without_prefix=("1", "kg", "cd", "d", "min", "deg", "rpm")
)
_OTHER_SPELLINGS = str.maketrans({" ": "", "*": ".", "·": ".", "µ": "u", "μ": "u", "°": "deg"})


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
        product = Unit(self.factor, self.exponents).times(Unit(other.factor, other.exponents))
        return Measure(product.exponents, product.factor)


def parse_unit(text: str) -> Measure | None:
    """What a unit expression means, or None when it is not one.

    The grammar is that of `mechanism_fmu.units`; factors may also be joined by `*` or `·`, exponents stand behind `^`.
    """
    spelled = re.sub(r"(?<=[A-Za-z])\^(?=[+-]?\d)", "", text.translate(_OTHER_SPELLINGS))
    try:
        unit = _WRITTEN.read(spelled)
    except UnreadableUnitError:
        return None
    return Measure(unit.exponents, unit.factor)


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

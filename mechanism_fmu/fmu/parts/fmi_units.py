"""Units of an FMU's variables, and the display units that tools are offered for them."""

from __future__ import annotations

from ...model import MechanismError
from ...units import FMI, Unit, UnreadableUnitError

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


def parse_unit(text: str) -> Unit:
    """Read a unit.

    Raises:
        UnitError: the text is not in the grammar, or has an unknown symbol.
    """
    try:
        return FMI.read(text)
    except UnreadableUnitError as error:
        raise UnitError(str(error)) from None


def display_factor(unit: str, display_unit: str) -> float:
    """Factor from a value in `unit` to the value in `display_unit` (FMI's DisplayUnit/factor).

    Raises:
        UnitError: the two do not measure the same quantity.
    """
    shown, base = parse_unit(display_unit), parse_unit(unit)
    if shown.exponents != base.exponents:
        raise UnitError(f"display unit {display_unit!r} does not measure the same quantity as {unit!r}.")
    return base.factor / shown.factor

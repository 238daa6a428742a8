"""Numbers as an engineer reads them."""

from __future__ import annotations

import math
import re

from .description import Description, Value

_INTEGER = re.compile(r"(U?)Int(\d+)")
_PREFIXES = {-9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G"}


def engineering(value: float, unit: str, digits: int = 4) -> str:
    """A number with its unit and an SI prefix: 15547 and "Pa" give "15.55 kPa"."""
    if value == 0.0 or not math.isfinite(value):
        return f"{value:g} {unit}"
    rounded = float(f"{value:.{digits - 1}e}")
    power = min(max(3 * math.floor(math.log10(abs(rounded)) / 3), min(_PREFIXES)), max(_PREFIXES))
    scaled = rounded / 10.0**power
    decimals = max(digits - 1 - math.floor(math.log10(abs(scaled))), 0)
    return f"{scaled:.{decimals}f} {_PREFIXES[power]}{unit}"


def shown(value: Value, name: str, description: Description, digits: int = 9) -> str:
    """The value of a variable in its unit, and in its display unit when it has one."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if not isinstance(value, float):
        return str(value)
    variable = description.variable(name)
    text = f"{value:.{digits}g}" if not variable.unit else f"{value:.{digits}g} {variable.unit}"
    displayed = description.units.to_display(value, variable.unit, variable.display_unit)
    return text if displayed is None else f"{text} ({displayed:.6g} {variable.display_unit})"


def in_display_unit(value: Value, name: str, description: Description, digits: int = 9) -> tuple[str, str]:
    """The value of a variable and its unit, for a table: in its display unit when it has one; "1" for none."""
    if isinstance(value, bool):
        return "true" if value else "false", ""
    variable = description.variable(name)
    if not isinstance(value, float):
        return str(value), "" if isinstance(value, str) else variable.unit or "1"
    displayed = description.units.to_display(value, variable.unit, variable.display_unit)
    if displayed is not None:
        return f"{displayed:.{digits}g}", variable.display_unit
    return f"{value:.{digits}g}", variable.unit or "1"


def integer_range(fmi_type: str) -> tuple[int, int]:
    """The least and the greatest number of a type of FMI, as "UInt8"; Integer and Enumeration have 32 bits."""
    named = _INTEGER.fullmatch(fmi_type)
    unsigned, bits = (bool(named[1]), int(named[2])) if named else (False, 32)
    return (0, 2**bits - 1) if unsigned else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)

"""Values as an engineer reads and writes them: numbers of a few digits, and `name=value unit`."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping

from ..errors import UsageError
from .description import Description, Value, Variable, hint_at
from .units import UnitMismatchError

# Numbers as an engineer reads them.

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


def real_time_factor(simulated: float, wall: float) -> str:
    """How much faster than the clock on the wall something ran [both in s], as in "12.3 x real time"."""
    return f"{simulated / wall:.3g} x real time" if wall > 0.0 else "-"


# Settings as a user writes them: `name=value unit`.

_NUMBER = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*?)\s*")
_BARE = re.compile(r"[-+.\deE]+")
_BOOLEANS = {"true": True, "1": True, "false": False, "0": False}


def settable_variable(name: str, description: Description) -> Variable:
    """The input or parameter with this name.

    Raises:
        UsageError: unknown, or neither input nor parameter.
    """
    known = [variable.name for variable in description.of("input", "parameter")]
    if name not in description.variables:
        way_out = hint_at(name, known) or f" Its inputs and parameters: {', '.join(known)}."
        raise UsageError(f"{description.model} has no variable '{name}'.{way_out}")
    variable = description.variable(name)
    if not variable.settable:
        raise UsageError(
            f"'{name}' is a variable of causality {variable.causality} and cannot be set; "
            f"inputs and parameters can: {', '.join(known)}."
        )
    return variable


def parse_value(text: str, variable: Variable, description: Description) -> Value:
    """The value that `text` gives to `variable`, in its unit.

    Raises:
        UsageError: wrong type, wrong unit, not finite, or outside the limits.
    """
    if variable.type == "String":
        return text
    value = _PARSERS[variable.type](text.strip(), variable, description)
    _check_limits(value, text.strip(), variable, description)
    return value


def parse_time(text: str | None, option: str, description: Description) -> float | None:
    """A time [s] that an option of the command line gives, as in "0.5" or "500ms"; None where it is not given.

    Raises:
        UsageError: it is no time.
    """
    if text is None:
        return None
    return float(parse_value(text, Variable(option, -1, "Real", "parameter", unit="s"), description))


def _real(text: str, variable: Variable, description: Description) -> float:
    match = _NUMBER.fullmatch(text)
    if match is None:
        raise UsageError(f"{variable.name} = '{text}' is not a number{_with_unit(variable)}.")
    value, unit = float(match[1]), match[2]
    if unit and not variable.unit:
        raise UsageError(f"{variable.name} = '{text}': the variable has no unit; give the number alone.")
    if unit:
        try:
            value = description.units.convert(value, unit, variable.unit)
        except UnitMismatchError as mismatch:
            raise UsageError(f"{variable.name} = '{text}': {mismatch}.") from None
    if not math.isfinite(value):
        raise UsageError(f"{variable.name} = '{text}' is too large for a number; give a smaller one.")
    return value


def _integer(text: str, variable: Variable, _description: Description) -> int:
    if not re.fullmatch(r"[+-]?\d{1,30}", text):
        raise UsageError(f"{variable.name} = '{text}' is not a whole number; give one without point or unit.")
    value = int(text)
    least, most = integer_range(variable.fmi_type)
    if not least <= value <= most:
        kind = f"{variable.fmi_type or 'Integer'}, from {least} to {most}"
        raise UsageError(f"{variable.name} = '{text}' does not fit its type ({kind}); give a number within.")
    return value


def _binary(text: str, variable: Variable, _description: Description) -> str:
    try:
        return bytes.fromhex(text).hex()
    except ValueError:
        raise UsageError(
            f"{variable.name} = '{text}' is not Binary; give its bytes in hexadecimal, two digits each, as in 0aff."
        ) from None


def _boolean(text: str, variable: Variable, _description: Description) -> bool:
    if text.lower() not in _BOOLEANS:
        raise UsageError(f"{variable.name} = '{text}' is not a Boolean; give true or false.")
    return _BOOLEANS[text.lower()]


_PARSERS: Mapping[str, Callable[[str, Variable, Description], Value]] = {
    "Real": _real,
    "Integer": _integer,
    "Boolean": _boolean,
    "Binary": _binary,
}


def _check_limits(value: Value, text: str, variable: Variable, description: Description) -> None:
    if isinstance(value, str | bool):
        return
    if variable.minimum is not None and value < variable.minimum:
        passed, limit, at = "below", variable.minimum, "at least"
    elif variable.maximum is not None and value > variable.maximum:
        passed, limit, at = "above", variable.maximum, "at most"
    else:
        return
    nearest = shown(limit, variable.name, description, digits=6)
    unsaid = f" A number without a unit is in {variable.unit}." if variable.unit and _BARE.fullmatch(text) else ""
    raise UsageError(f"{variable.name} = '{text}' is {passed} its limit; give {at} {nearest}.{unsaid}")


def _with_unit(variable: Variable) -> str:
    return f", with or without a unit (e.g. '1.5 {variable.unit}')" if variable.unit else ""

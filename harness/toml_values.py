"""Values of variables as a TOML file has them: numbers, or texts with units."""

from __future__ import annotations

from .assignments import parse_value
from .description import Description, Value, Variable
from .errors import UsageError
from .toml_file import Section

#: Times of a file are parsed like variables.
_REFERENCE = -1


def parsed(section: Section, key: str, text: str, variable: Variable, description: Description) -> Value | None:
    """The value that `text` gives to `variable`; None when it cannot, which is noted at the key."""
    try:
        return parse_value(text, variable, description)
    except UsageError as error:
        section.wrong(key, str(error))
        return None


def as_text(value: object) -> str:
    """A value of TOML as it would be written behind --set."""
    if isinstance(value, bool):
        return "true" if value else "false"
    return value if isinstance(value, str) else repr(value)


def time_at(section: Section, name: str, default: float | None, description: Description) -> float | None:
    """The time at a key [s]; None when it cannot be used, which is noted."""
    given = section.take(name)
    if given is None:
        if default is None:
            section.file.wrong((*section.key, name), f"is missing; {description.model} has no default for it")
        return default
    variable = Variable(name, _REFERENCE, "Real", "parameter", unit="s", minimum=0.0)
    alone = Description(description.model, "", "", {name: variable}, description.units)
    value = parsed(section, name, as_text(given), variable, alone)
    return None if value is None else float(value)

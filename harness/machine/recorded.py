"""Which variables of a machine are recorded."""

from __future__ import annotations

import re
from collections.abc import Iterable

from ..description import Description, Variable
from ..recorder import recorded_variables

_NUMBERS = ("Real", "Integer", "Boolean")


def chosen(patterns: Iterable[str], description: Description) -> list[Variable]:
    """The variables that patterns choose, each once, in the machine's order.

    A name chooses its variable, whatever it is, if it is a number; a pattern, in which * stands for any text, chooses
    among inputs and outputs.
    """
    usual = {variable.name for variable in recorded_variables(description)}
    wanted: set[str] = set()
    for pattern in patterns:
        if pattern in description.variables:
            wanted.add(pattern)
            continue
        expression = re.compile(".*".join(re.escape(part) for part in pattern.split("*")))
        wanted |= {name for name in usual if expression.fullmatch(name)}
    known = description.variables.values()
    return [v for v in known if v.name in wanted and v.type in _NUMBERS and not v.in_event_mode_only]

"""The table of parameters and inputs: their values, and where these come from."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import StrEnum

from ..assignments import parse_value
from ..description import Description, Value, Variable
from ..designs.task import Task
from ..errors import UsageError
from ..numbers import in_display_unit
from .page import section, table


class Origin(StrEnum):
    """Where a value comes from."""

    DEFAULT = "default"
    SET = "set"
    VARIED = "varied"
    TABLE = "table of inputs"
    CALCULATED = "calculated"


@dataclass(frozen=True)
class Row:
    """A parameter or an input.

    Attributes:
        variable: it is.
        value, unit: as they are shown.
        origin: in a word or two, for the reader.
        marked: whether it is what this result is about.
    """

    variable: Variable
    value: str
    unit: str
    origin: str
    marked: bool


def parameters_section(rows: Iterable[Row], note: str) -> str:
    """The section with the table; `note` says what is marked."""
    kept = list(rows)
    lines = [(row.variable.name, row.value, row.unit, row.origin, _meaning(row)) for row in kept]
    marked = [place for place, row in enumerate(kept) if row.marked]
    headings = ["name", "value", "unit", "origin", "meaning"]
    # on a phone, the meaning stands below the rest
    drawn = f'<div class="parameters">{table(headings, lines, numeric=[1], changed=marked)}</div>'
    return section("Parameters", drawn, note=note)


def parameters_of_designs(
    task: Task, description: Description, varied: Mapping[str, tuple[str, str, str]], note: str
) -> str:
    """The section of many designs.

    Args:
        task: of the designs.
        description: of the FMU; it has the values that nobody has set.
        varied: value, unit and origin of what differs between designs, by name.
        note: what there is to say.
    """
    driven = [] if task.inputs is None else [variable.name for variable in task.inputs.variables]
    rows = []
    for variable in description.of("parameter", "input"):
        name = variable.name
        if name in varied:
            rows.append(Row(variable, *varied[name], marked=True))
        elif name in task.fixed:
            rows.append(Row(variable, *in_display_unit(task.fixed[name], name, description), Origin.SET, marked=True))
        elif name in driven:
            rows.append(Row(variable, "see Inputs", variable.unit or "1", Origin.TABLE, marked=True))
        else:
            rows.append(Row(variable, *_default(variable, description), Origin.DEFAULT, marked=False))
    return parameters_section(rows, note)


def range_shown(values: Iterable[Value], name: str, description: Description) -> tuple[str, str]:
    """The least … the largest of numbers, and the unit; one value where all are the same."""
    kept = list(dict.fromkeys(values))
    if len(kept) == 1 or isinstance(kept[0], str):
        return in_display_unit(kept[0], name, description)
    low, unit = in_display_unit(min(kept), name, description, digits=6)
    high, _ = in_display_unit(max(kept), name, description, digits=6)
    return f"{low} … {high}", unit


def _default(variable: Variable, description: Description) -> tuple[str, str]:
    """Value and unit as the FMU's description gives them."""
    try:
        value = parse_value(variable.start or "", variable, description)
    except UsageError:  # an odd text is shown as it is
        return variable.start or "", variable.unit
    return in_display_unit(value, variable.name, description)


def _meaning(row: Row) -> str:
    if row.variable.causality != "input":
        return row.variable.description
    return f"{'Input' if row.origin == Origin.TABLE else 'Input, start value'}: {row.variable.description}"

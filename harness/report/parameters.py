"""Report of parameters and inputs: where their values come from, and the signals that drove inputs."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import StrEnum

from ..designs.task import Task
from ..errors import UsageError
from ..fmu.description import Description, Value, Variable
from ..fmu.values import in_display_unit, parse_value
from ..run.inputs import InputSignals
from .page import chart, charts, section, table
from .plot import Curve, Plot, interactive
from .style import COLOURS

# The table of parameters and inputs: their values, and where these come from.


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
        description: of the FMU; it has the default values.
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


# The signals that drove inputs: where they come from, and how they look.


def inputs_section(signals: InputSignals | None, description: Description) -> str:
    """A section with a chart for each input; "" without signals."""
    if signals is None:
        return ""
    drawn = [chart(interactive(plot, height=220)) for plot in input_plots(signals, description)]
    return section("Inputs", charts(*drawn), note=table_note(signals))


def table_note(signals: InputSignals) -> str:
    """Which table it was: its name, how long it is, and its digest, in a sentence or two."""
    times = signals.times
    named = f"From the table {signals.file}" if signals.file else "From a table"
    digest = f" SHA-256 of the file: {signals.digest}" if signals.digest else ""
    return f"{named}: {len(times)} rows, from {times[0]:g} s to {times[-1]:g} s.{digest}"


def input_plots(signals: InputSignals, description: Description) -> list[Plot]:
    """A plot for each input, in its display unit; what is not Real keeps its value until the next row."""
    plots = []
    for place, variable in enumerate(signals.variables):
        x, y = signals.times, signals.values[:, place]
        known = description.units.displayed.get(variable.unit, {})
        unit = variable.display_unit if variable.display_unit in known else variable.unit
        factor, offset = known.get(unit, (1.0, 0.0))
        if variable.type != "Real":
            x, y = x.repeat(2)[1:], y.repeat(2)[:-1]
        words = variable.description or variable.name
        curve = Curve(words, x, factor * y + offset, COLOURS[place % len(COLOURS)], about=variable.name)
        plots.append(Plot(words, "time [s]", f"{variable.name} [{unit or '1'}]", [curve], legend=False))
    return plots

"""The signals that drove inputs: where they come from, and how they look."""

from __future__ import annotations

from ..description import Description
from ..inputs import InputSignals
from .interactive import interactive
from .page import chart, charts, section
from .plot import Curve, Plot
from .style import COLOURS


def inputs_section(signals: InputSignals | None, description: Description) -> str:
    """A section with a chart for each input; "" without signals."""
    if signals is None:
        return ""
    drawn = [chart(interactive(plot, height=280)) for plot in input_plots(signals, description)]
    return section("Inputs", charts(*drawn), note=table_told(signals))


def table_told(signals: InputSignals) -> str:
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
        curve = Curve(variable.name, x, factor * y + offset, COLOURS[place % len(COLOURS)])
        plots.append(Plot(variable.name, "time [s]", f"{variable.name} [{unit or '1'}]", [curve], legend=False))
    return plots

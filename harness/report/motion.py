"""Charts of a run over time: one row for each quantity, with a common time axis."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd
import plotly.graph_objects as go
from plotly.subplots import make_subplots

from ..checks import energy_residual
from ..description import Variable
from ..experiment import Run
from .modes import add_lanes, contacts
from .style import COLOURS, IMPACT_COLOUR, layout
from .thin import strongest, thin

#: What a unit measures, in the plural.
QUANTITIES = {
    "rad": "Angles",
    "rad/s": "Speeds",
    "m": "Lengths",
    "m/s": "Speeds",
    "N": "Forces",
    "N.m": "Torques",
    "J": "Energies",
    "W": "Powers",
    "V": "Voltages",
    "A": "Currents",
}

#: Heights [px]: a row of curves, a lane of a contact, between two rows, and what lies around them all.
_ROW, _LANE, _GAP, _AROUND = 168, 26, 47, 90
#: More vertical lines than this hide the curves.
_MOST_MARKS = 150


@dataclass(frozen=True)
class _Row:
    """Curves of one quantity: (name, values)."""

    title: str
    curves: list[tuple[str, pd.Series[float]]]


def motion_chart(run: Run) -> go.Figure | None:
    """All continuous outputs, the energy balance, and the inputs that vary, with every impact marked.

    Under them a band for each contact shows when it is active.

    None when there is nothing of that kind.
    """
    rows = _rows(run)
    lanes = [] if run.results.empty else contacts(run)
    heights = [_ROW] * len(rows) + ([_LANE * len(lanes)] if lanes else [])
    if not heights:
        return None
    height = sum(heights) + _GAP * (len(heights) - 1)
    figure = make_subplots(rows=len(heights), shared_xaxes=True, row_heights=heights, vertical_spacing=_GAP / height)
    time = run.results["time"].to_numpy()
    for number, row in enumerate(rows, start=1):
        legend = "legend" if number == 1 else f"legend{number}"
        for i, (name, values) in enumerate(row.curves):
            x, y = thin(time, values.to_numpy(dtype=np.float64))
            line = {"width": 1.8, "color": COLOURS[i % len(COLOURS)]}
            figure.add_trace(go.Scatter(x=x, y=y, name=name, mode="lines", line=line, legend=legend), row=number, col=1)
        top = figure.layout[f"yaxis{number if number > 1 else ''}"].domain[1]
        figure.update_layout({legend: {"x": 1.01, "y": top, "yanchor": "top", "xanchor": "left"}})
        figure.update_yaxes(title_text=row.title, exponentformat="power", title_standoff=8, row=number, col=1)
    if lanes:
        add_lanes(figure, run, row=len(heights))
    _mark_impacts(figure, run)
    figure.update_xaxes(title_text="time [s]", row=len(heights), col=1)
    figure.update_layout(layout(height=height + _AROUND, hovermode="x unified", barmode="overlay"))
    return figure


def _rows(run: Run) -> list[_Row]:
    if run.results.empty:
        return []
    outputs = [v for v in run.description.of("output") if v.continuous and _is_motion(v, run)]
    residual = energy_residual(run.results)
    rows = []
    for unit in dict.fromkeys(v.unit for v in outputs):
        rows.append(_quantity(unit, [v for v in outputs if v.unit == unit], run))
        if unit == "J" and residual is not None:
            rows.append(_Row("Balance [J]", [("kinetic + spring<br>− initial − work<br>+ lost", residual)]))
    varying = [v for v in run.description.of("input") if v.name in run.results and run.results[v.name].nunique() > 1]
    for unit in dict.fromkeys(v.unit for v in varying):
        row = _quantity(unit, [v for v in varying if v.unit == unit], run)
        rows.append(_Row(f"Input {row.title[0].lower()}{row.title[1:]}", row.curves))
    return rows


def _is_motion(variable: Variable, run: Run) -> bool:
    """Whether it belongs in the chart: fields of the last impact have their own table."""
    return variable.name in run.results and not variable.name.startswith("impact")


def _quantity(unit: str, variables: list[Variable], run: Run) -> _Row:
    """The curves of a quantity, in the display unit of its first variable.

    Angles count from their start: bodies that point in different directions would leave each other no room.
    """
    known = run.description.units.displayed.get(unit, {})
    shown = variables[0].display_unit if variables[0].display_unit in known else ""
    factor, offset = known.get(shown, (1.0, 0.0))
    curves = [(variable.name, factor * run.results[variable.name] + offset) for variable in variables]
    title = f"{QUANTITIES.get(unit, 'Values')} [{shown or unit or '1'}]"
    if unit == "rad":
        curves = [(f"{name} − {values.iloc[0]:.5g}", values - values.iloc[0]) for name, values in curves]
        title = title.replace("Angles", "Angle change")
    return _Row(title, curves)


def _mark_impacts(figure: go.Figure, run: Run) -> None:
    lines = [
        {
            "type": "line",
            "x0": instant,
            "x1": instant,
            "xref": "x",
            "y0": 0,
            "y1": 1,
            "yref": "paper",
            "line": {"color": IMPACT_COLOUR, "width": 1, "dash": "dot"},
        }
        for instant in strongest(run.impacts, _MOST_MARKS)
    ]
    figure.update_layout(shapes=lines)

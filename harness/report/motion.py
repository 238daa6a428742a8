"""Charts of a run over time: quantities, active contacts."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from html import escape
from textwrap import wrap

import numpy as np
import numpy.typing as npt
import pandas as pd
import plotly.graph_objects as go
from plotly.subplots import make_subplots

from ..fmu.description import Variable
from ..fmu.values import in_display_unit
from ..run.checks import energy_residual
from ..run.experiment import Run
from .page import COLOURS, IMPACT_COLOUR, layout
from .plot import FloatArray, frame_rows, strongest, thin

# Which contacts are active, and what sticks: Boolean outputs named `<contact>_active` or `<part>_sticks`, as bands over
# time.

#: What Boolean outputs end with that report contacts.
SUFFIX, STICKS = "_active", "_sticks"

#: Gaps shorter than this part of the run are narrower than a pixel, and are not drawn.
_INVISIBLE = 1 / 2000

#: Places along a lane that answer to the pointer.
_HOVER_POINTS = 800


@dataclass(frozen=True)
class Contact:
    """A contact that is active or not.

    Attributes:
        name: for the reader, e.g. "holding pawl".
        variable: the FMU's Boolean output, e.g. "holding_pawl_active".
        colour: the same wherever the report shows it.
    """

    name: str
    variable: str
    colour: str


def contacts(run: Run) -> list[Contact]:
    """The contacts whose activity was recorded, and what stuck, in the FMU's order."""
    recorded = [v for v in run.description.of("output") if v.name in run.results]
    return contacts_among(recorded, lambda name: bool(run.results[name].any()))


def contacts_among(outputs: Iterable[Variable], ever: Callable[[str], bool]) -> list[Contact]:
    """The contacts whose activity some outputs report; and what sticks by them, if it ever was true."""
    return contacts_named([v.name for v in outputs if v.type == "Boolean"], ever)


def contacts_named(booleans: Iterable[str], ever: Callable[[str], bool]) -> list[Contact]:
    """As `contacts_among`, by the names of Boolean outputs."""
    variables = [name for name in booleans if name.endswith(SUFFIX) or (name.endswith(STICKS) and ever(name))]
    return [
        Contact(name.removesuffix(SUFFIX).replace("_", " "), name, COLOURS[i % len(COLOURS)])
        for i, name in enumerate(variables)
    ]


def intervals(time: FloatArray, active: npt.NDArray[np.bool_]) -> FloatArray:
    """When a Boolean signal is true: from the first sample that says so to the next that does not, or the last one.

    Args:
        time: shape (samples,), increasing.
        active: shape (samples,).

    Returns:
        Shape (intervals, 2): begin and end, in the unit of `time`.
    """
    if len(time) == 0:
        return np.empty((0, 2))
    edges = np.flatnonzero(np.diff(active.astype(np.int8), prepend=0, append=0))
    return np.asarray(time[np.minimum(edges, len(time) - 1)], dtype=np.float64).reshape(-1, 2)


def joined(spans: FloatArray, shortest_gap: float) -> FloatArray:
    """Intervals with every gap below `shortest_gap` closed.

    Args:
        spans: shape (intervals, 2), in order, as of `intervals`.
        shortest_gap: the least that stays open, in the same unit.

    Returns:
        Shape (fewer, 2).
    """
    opens = spans[1:, 0] - spans[:-1, 1] >= shortest_gap
    begins = np.concatenate((spans[:1, 0], spans[1:, 0][opens]))
    ends = np.concatenate((spans[:-1, 1][opens], spans[-1:, 1]))
    return np.column_stack((begins, ends))


def add_lanes(figure: go.Figure, run: Run, row: int) -> None:
    """Draw a lane for each contact into a row of the figure, the first one on top."""
    lanes = contacts(run)
    time = run.results["time"].to_numpy(dtype=np.float64)
    begin, end = float(time[0]), float(time[-1])
    signals = [run.results[lane.variable].to_numpy(dtype=bool) for lane in lanes]
    spans = [intervals(time, signal) for signal in signals]
    for lane, own in zip(lanes, spans, strict=True):
        figure.add_trace(_band(lane, joined(own, (end - begin) * _INVISIBLE)), row=row, col=1)
    edges = np.concatenate([own.ravel() for own in spans])
    shown = edges[np.linspace(0, len(edges) - 1, min(len(edges), _HOVER_POINTS // 4)).astype(int)]
    rows = frame_rows(time, shown, _HOVER_POINTS)
    for lane, own, signal in zip(lanes, spans, signals, strict=True):
        figure.add_trace(_hover(lane, own, time[rows], signal[rows]), row=row, col=1)
    if end > begin:
        # Bars would widen the time axis that all rows share.
        figure.update_xaxes(range=[begin, end])
    # A lane that is never active keeps its place.
    names = [lane.name for lane in lanes]
    figure.update_yaxes(
        type="category",
        categoryorder="array",
        categoryarray=names,
        range=[len(names) - 0.5, -0.5],
        tickmode="array",
        tickvals=names,
        showgrid=False,
        fixedrange=True,
        row=row,
        col=1,
    )


def _band(lane: Contact, spans: FloatArray) -> go.Bar:
    return go.Bar(
        base=spans[:, 0],
        x=spans[:, 1] - spans[:, 0],
        y=[lane.name] * len(spans),
        orientation="h",
        width=0.72,
        marker={"color": lane.colour, "line": {"width": 0}},
        hoverinfo="skip",
        showlegend=False,
    )


def _hover(lane: Contact, spans: FloatArray, time: FloatArray, active: npt.NDArray[np.bool_]) -> go.Scatter:
    """What the pointer shows: bars answer for their end, wherever they are touched; unseen points for their time."""
    number = np.searchsorted(spans[:, 0], time, side="right") - 1
    texts = [
        "active {:.7g} … {:.7g} s".format(*spans[n]) if on else "not active"
        for n, on in zip(number, active, strict=True)
    ]
    return go.Scatter(
        x=time,
        y=[lane.name] * len(time),
        text=texts,
        name=lane.name,
        mode="markers",
        marker={"color": lane.colour, "opacity": 0},
        hovertemplate="%{text}",
        showlegend=False,
    )


# Charts of a run over time: one row for each quantity, with a common time axis.

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

#: Heights [px]: a row of curves at least, a line of its legend, a lane of a contact, between two rows, around them all.
_ROW, _LINE, _LANE, _GAP, _AROUND = 168, 19, 26, 47, 90
_BALANCE = "kinetic + spring<br>− initial − work<br>+ lost"
#: Letters in a line of a legend.
_LETTERS = 32
#: More vertical lines than this hide the curves.
_MOST_MARKS = 150


@dataclass(frozen=True)
class _Curve:
    """One of them: in the legend it has the FMU's description of its variable, at the pointer the variable's name."""

    variable: str
    name: str
    values: pd.Series[float]


@dataclass(frozen=True)
class _Row:
    """Curves of one quantity."""

    title: str
    curves: list[_Curve]

    @property
    def moves(self) -> bool:
        """Whether any of its curves changes: else its chart would be empty but for level lines."""
        return any(curve.values.nunique() > 1 for curve in self.curves)

    @property
    def height(self) -> int:
        """For its curves and for its legend beside them [px]."""
        return max(_ROW, _LINE * sum(1 + curve.name.count("<br>") for curve in self.curves))


def motion_chart(run: Run) -> go.Figure | None:
    """All continuous outputs, the energy balance, and the inputs that vary, with every impact marked.

    Under them a band for each contact shows when it is active.

    None when there is nothing of that kind.
    """
    rows = [row for row in _rows(run) if row.moves]
    lanes = [] if run.results.empty else contacts(run)
    heights = [row.height for row in rows] + ([_LANE * len(lanes)] if lanes else [])
    if not heights:
        return None
    height = sum(heights) + _GAP * (len(heights) - 1)
    spacing = _GAP / height if len(heights) > 1 else 0.0
    figure = make_subplots(rows=len(heights), shared_xaxes=True, row_heights=heights, vertical_spacing=spacing)
    time = run.results["time"].to_numpy()
    for number, row in enumerate(rows, start=1):
        legend = "legend" if number == 1 else f"legend{number}"
        for i, curve in enumerate(row.curves):
            x, y = thin(time, curve.values.to_numpy(dtype=np.float64))
            line = {"width": 1.8, "color": COLOURS[i % len(COLOURS)]}
            at = f"%{{y}} at %{{x}} s<extra>{curve.variable}</extra>"
            shown = go.Scatter(x=x, y=y, name=curve.name, mode="lines", line=line, legend=legend, hovertemplate=at)
            figure.add_trace(shown, row=number, col=1)
        top = figure.layout[f"yaxis{number if number > 1 else ''}"].domain[1]
        figure.update_layout({legend: {"x": 1.01, "y": top, "yanchor": "top", "xanchor": "left"}})
        figure.update_yaxes(title_text=row.title, exponentformat="power", title_standoff=8, row=number, col=1)
    if lanes:
        add_lanes(figure, run, row=len(heights))
    _mark_impacts(figure, run)
    figure.update_xaxes(title_text="time [s]", row=len(heights), col=1)
    named = {"namelength": -1}
    figure.update_layout(layout(height=height + _AROUND, hovermode="x unified", barmode="overlay", hoverlabel=named))
    return figure


def still(run: Run) -> str:
    """What has no chart because nothing of its kind changes, with values, as a sentence; "" when there is none."""
    names = [curve.variable for row in _rows(run) if not row.moves for curve in row.curves]
    values = [
        " ".join((name, *in_display_unit(float(run.results[name].iloc[0]), name, run.description, digits=6)))
        for name in names
        if name in run.results
    ]
    return f"Not drawn, for it did not change: {', '.join(values)}." if values else ""


def _rows(run: Run) -> list[_Row]:
    if run.results.empty:
        return []
    outputs = [v for v in run.description.of("output") if v.continuous and _is_motion(v, run)]
    residual = energy_residual(run.results)
    rows = []
    for unit in dict.fromkeys(v.unit for v in outputs):
        rows.append(_quantity(unit, [v for v in outputs if v.unit == unit], run))
        if unit == "J" and residual is not None:
            rows.append(_Row("Balance [J]", [_Curve("balance", _BALANCE, residual)]))
    varying = [v for v in run.description.of("input") if v.name in run.results and run.results[v.name].nunique() > 1]
    for unit in dict.fromkeys(v.unit for v in varying):
        row = _quantity(unit, [v for v in varying if v.unit == unit], run)
        rows.append(replace(row, title=f"Input {row.title[0].lower()}{row.title[1:]}"))
    return rows


def _is_motion(variable: Variable, run: Run) -> bool:
    """Whether it belongs in the chart: fields of the last impact have their own table."""
    return variable.name in run.results and not variable.name.startswith("impact")


def _quantity(unit: str, variables: list[Variable], run: Run) -> _Row:
    """The curves of a quantity, in the display unit of its first variable.

    Angles count from their start: bodies that point in different directions would leave each other no space.
    """
    known = run.description.units.displayed.get(unit, {})
    shown = variables[0].display_unit if variables[0].display_unit in known else ""
    factor, offset = known.get(shown, (1.0, 0.0))
    from_start = unit == "rad"
    curves = []
    for variable in variables:
        values, name = factor * run.results[variable.name] + offset, variable.description or variable.name
        if from_start:
            name += f", from {values.iloc[0] + 0.0:.5g} {shown or unit}"
            values = values - values.iloc[0]
        lines = wrap(name, _LETTERS, break_long_words=False, break_on_hyphens=False)
        curves.append(_Curve(variable.name, escape("\n".join(lines), quote=False).replace("\n", "<br>"), values))
    title = "Angle change" if from_start else QUANTITIES.get(unit, "Values")
    return _Row(f"{title} [{shown or unit or '1'}]", curves)


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

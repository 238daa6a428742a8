"""report.html of an optimum: how it was found, and how much each variable matters near it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import plotly.graph_objects as go
import pyarrow as pa

from ..description import Value
from ..designs.history import History
from ..designs.optimum_file import Optimum
from ..designs.search import Best
from ..designs.sensitivity import Sensitivity
from ..designs.variation import Axis
from ..numbers import shown
from ..results import write_text
from .page import cards, chart, page, section, table
from .style import COLOURS, layout
from .sweep_report import designs_table, range_of, results_charts, run_rows


def write_optimum_report(
    optimum: Optimum, best: Best, near_it: Sensitivity | None, history: History, results: pa.Table, path: Path
) -> Path:
    """Write the report of an optimum as one file that works offline.

    Raises:
        UsageError: the disk refuses.
    """
    html = optimum_report(optimum, best, near_it, history, results)
    return write_text(path, lambda file: file.write(html))


def optimum_report(
    optimum: Optimum, best: Best, near_it: Sensitivity | None, history: History, results: pa.Table
) -> str:
    """The report as HTML."""
    goal, description = optimum.goal, optimum.axes[0].description
    value = goal.value(best.result, optimum.task)
    figures = [
        (
            f"{'largest' if goal.largest else 'smallest'} {goal.objective.column}",
            _with_unit(value, goal.objective.unit),
        ),
        *((axis.name, _in_unit(axis, best.design.values[axis.name])) for axis in optimum.axes),
        ("designs", str(len(history.designs))),
    ]
    body = [
        cards(figures),
        section("Constraints", _constraints(optimum, best)),
        section(
            "Search", chart(history_chart(optimum, history)), note="Dots are designs, the line is the best so far."
        ),
    ]
    if near_it is not None:
        note = (
            f"For variables that are uniform near the optimum, the objective has the mean {near_it.mean:.6g} and the "
            f"standard deviation {near_it.spread:.6g} {goal.objective.unit or '1'}. First order: the part of its "
            "variance that a variable explains by itself; total: together with others."
        )
        body.append(section("Sensitivity", chart(sensitivity_chart(near_it)), note=note))
    body += [
        section("Designs", *results_charts(optimum.axes, optimum.task, description, results)),
        section("All designs", designs_table(optimum.axes, optimum.task, description, results)),
        section("What was run", table(["what", "value"], _set_up(optimum, near_it))),
    ]
    return page(optimum.title, f"{description.model}  ·  {optimum.method}, seed {optimum.seed}", body)


def history_chart(optimum: Optimum, history: History) -> go.Figure:
    """The objective of each design, and the best so far."""
    goal, task = optimum.goal, optimum.task
    numbers = np.array([design.number for design in history.designs])
    values = np.array([_number(goal.value(result, task)) for result in history.results])
    kept = np.array([goal.violation(result, task) == 0.0 for result in history.results])
    good = np.where(kept, -values if goal.largest else values, np.inf)
    so_far = np.minimum.accumulate(good)
    so_far = np.where(np.isfinite(so_far), -so_far if goal.largest else so_far, np.nan)
    figure = go.Figure()
    for name, which, colour in (("keeps all constraints", kept, COLOURS[0]), ("misses some", ~kept, COLOURS[6])):
        marker = {"size": 6, "color": colour, "opacity": 0.6}
        figure.add_trace(go.Scatter(x=numbers[which], y=values[which], mode="markers", name=name, marker=marker))
    line = {"color": COLOURS[1], "width": 2, "shape": "hv"}
    figure.add_trace(go.Scatter(x=numbers, y=so_far, mode="lines", name="best so far", line=line))
    figure.update_xaxes(title_text="design [1]")
    figure.update_yaxes(title_text=f"{goal.objective.column} [{goal.objective.unit or '1'}]", exponentformat="SI")
    figure.update_layout(layout(height=420, legend={"orientation": "h", "y": -0.2}))
    return figure


def sensitivity_chart(near_it: Sensitivity) -> go.Figure:
    """Sobol indices as bars."""
    figure = go.Figure()
    for name, indices, colour in (("first order", near_it.first, COLOURS[0]), ("total", near_it.total, COLOURS[4])):
        figure.add_trace(go.Bar(x=list(near_it.names), y=indices, name=name, marker={"color": colour}))
    figure.update_yaxes(title_text="Sobol index [1]", rangemode="tozero")
    figure.update_layout(layout(height=340, barmode="group", legend={"orientation": "h", "y": -0.2}))
    return figure


def _constraints(optimum: Optimum, best: Best) -> str:
    pairs = dict(zip(optimum.task.quantities, best.result.values, strict=True))
    rows = []
    for constraint in optimum.goal.constraints:
        unit, value = constraint.quantity.unit, pairs[constraint.quantity]
        limits = [_with_unit(limit, unit) for limit in (constraint.at_least, constraint.at_most)]
        kept = value is not None and constraint.violation(float(value)) == 0.0
        found = _with_unit(None if value is None else float(value), unit)
        rows.append([constraint.quantity.column, *limits, found, "yes" if kept else "no"])
    if not rows:
        return "<p>None.</p>"
    return table(["quantity", "at least", "at most", "best design", "kept"], rows, numeric=(1, 2, 3))


def _set_up(optimum: Optimum, near_it: Sensitivity | None) -> list[list[str]]:
    rows = run_rows(optimum.task, optimum.axes[0].description)
    rows += [[f"{axis.name}, free", range_of(axis)] for axis in optimum.axes]
    if near_it is not None:
        units = {axis.name: axis.unit for axis in optimum.axes}
        for name, (low, high) in zip(near_it.names, near_it.limits, strict=True):
            rows.append([f"{name}, near the optimum", f"{low:.6g} to {high:.6g} {units[name]}"])
    return rows


def _in_unit(axis: Axis, value: Value) -> str:
    """A value in the unit of the file."""
    if axis.values is not None or axis.variable.type != "Real":
        return shown(value, axis.name, axis.description, digits=6)
    return _with_unit(axis.low + axis.fraction(float(value)) * (axis.high - axis.low), axis.unit)


def _with_unit(value: float | None, unit: str) -> str:
    return "" if value is None else f"{value:.6g} {unit}".strip()


def _number(value: float | None) -> float:
    return np.nan if value is None else value

"""report.html of a sweep: what was varied, what came of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt
import plotly.graph_objects as go
import pyarrow as pa
from plotly.subplots import make_subplots

from mechanism_fmu import __version__

from ..clock import seconds
from ..description import Description
from ..designs.store import failures
from ..designs.sweep_file import Sweep
from ..designs.task import Quantity, Task
from ..designs.variation import Axis
from ..numbers import shown
from ..results import write_text
from .page import cards, chart, page, section, table, wide
from .style import COLOURS, WIDE_TOP, layout

#: More rows make a page slow; the file has all.
_MOST_ROWS = 500
#: Height of one row of charts [px].
_ROW_HEIGHT = 260


@dataclass(frozen=True)
class Column:
    """A column as charts and tables show it.

    Attributes:
        name: in the results.
        heading: with its unit.
        values: in that unit; NaN where there is none, shape (designs,).
    """

    name: str
    heading: str
    values: npt.NDArray[np.float64]


def write_sweep_report(sweep: Sweep, description: Description, results: pa.Table, path: Path) -> Path:
    """Write the report of a sweep as one file that works offline.

    Raises:
        UsageError: the disk refuses.
    """
    return write_text(path, lambda file: file.write(sweep_report(sweep, description, results)))


def sweep_report(sweep: Sweep, description: Description, results: pa.Table) -> str:
    """The report as HTML."""
    failed = failures(results)
    figures = [
        ("designs", str(len(results))),
        ("failed", str(len(failed))),
        ("way", ", ".join(sorted(set(results["way"].to_pylist())))),
    ]
    charts = results_charts(sweep.axes, sweep.task, description, results)
    body = [
        cards(figures),
        section("Results", *charts, note="Each dot is one design. Drag over an axis to zoom."),
        section("Designs", designs_table(sweep.axes, sweep.task, description, results), note=_rows_note(results)),
    ]
    if failed:
        rows = [[str(number), message] for number, message in failed[:_MOST_ROWS]]
        body.append(section("Failed designs", table(["design", "message"], rows, numeric=[0]), css_class="banner"))
    varied = [[f"{axis.name}, varied", range_of(axis)] for axis in sweep.axes]
    body.append(section("What was run", table(["what", "value"], run_rows(sweep.task, description) + varied)))
    return page(sweep.title, f"{description.model}  ·  {len(results)} designs, {sweep.method}", body)


def results_charts(axes: Sequence[Axis], task: Task, description: Description, results: pa.Table) -> list[str]:
    """What was found over what was varied."""
    varied, found = _columns(axes, task, description, results)
    return _charts(varied, found)


def designs_table(axes: Sequence[Axis], task: Task, description: Description, results: pa.Table) -> str:
    """A row for each design, as many as a page can bear."""
    varied, found = _columns(axes, task, description, results)
    return _table(varied, found, results)


def _columns(
    axes: Sequence[Axis], task: Task, description: Description, results: pa.Table
) -> tuple[list[Column], list[Column]]:
    varied = [_varied(axis, results) for axis in axes if axis.variable.type != "String"]
    return varied, [_found(quantity, description, results) for quantity in task.quantities]


def parallel_chart(columns: Sequence[Column], colour: Column) -> go.Figure:
    """Each design a line across all columns, coloured by one of them."""
    dimensions = [{"label": column.heading, "values": column.values} for column in columns]
    line = {"color": colour.values, "colorscale": "Viridis", "colorbar": {"title": {"text": _broken(colour.heading)}}}
    figure = go.Figure(go.Parcoords(dimensions=dimensions, line=line, labelangle=-20, rangefont={"size": 10}))
    figure.update_layout(layout(height=480, margin={"l": 80, "r": 60, "t": 130, "b": 30}))
    return figure


def scatter_chart(varied: Sequence[Column], found: Sequence[Column]) -> go.Figure:
    """What was found over what was varied: a row for each quantity, a column for each variable."""
    rows = len(found)
    figure = make_subplots(
        rows=rows,
        cols=len(varied),
        shared_xaxes="columns",
        shared_yaxes="rows",
        vertical_spacing=min(0.06, 0.5 / rows),
        horizontal_spacing=0.04,
    )
    for i, y in enumerate(found, start=1):
        for k, x in enumerate(varied, start=1):
            marker = {"size": 6, "color": COLOURS[(i - 1) % len(COLOURS)], "opacity": 0.75}
            dots = go.Scattergl(x=x.values, y=y.values, mode="markers", marker=marker, name=y.name, showlegend=False)
            figure.add_trace(dots, row=i, col=k)
        figure.update_yaxes(title_text=_broken(y.heading), exponentformat="SI", row=i, col=1)
    for k, x in enumerate(varied, start=1):
        figure.update_xaxes(title_text=x.heading, row=rows, col=k)
    figure.update_layout(layout(height=_ROW_HEIGHT * rows + 90, margin=WIDE_TOP))
    return figure


def _charts(varied: Sequence[Column], found: Sequence[Column]) -> list[str]:
    """Those of columns that have numbers at all."""
    some = [column for column in found if np.isfinite(column.values).any()]
    if not varied or not some:
        return ["<p>There is nothing to draw: no design gave a number.</p>"]
    whole = np.isfinite(np.column_stack([column.values for column in (*varied, *some)])).all(axis=1)
    drawn = [wide(chart(scatter_chart(varied, some)))]
    if whole.any():
        kept = [Column(column.name, column.heading, column.values[whole]) for column in (*varied, *some)]
        drawn.append(wide(chart(parallel_chart(kept, kept[len(varied)]))))
    return drawn


def _varied(axis: Axis, results: pa.Table) -> Column:
    variable, units = axis.variable, axis.description.units
    values = _numbers(results, axis.name)
    if axis.unit != variable.unit:
        zero, one = (units.convert(x, axis.unit, variable.unit) for x in (0.0, 1.0))
        values = (values - zero) / (one - zero)
    return Column(axis.name, _heading(axis.name, axis.unit), values)


def _found(quantity: Quantity, description: Description, results: pa.Table) -> Column:
    values = _numbers(results, quantity.column)
    zero, one = (description.units.to_display(x, quantity.unit, quantity.display_unit) for x in (0.0, 1.0))
    if zero is None or one is None:
        return Column(quantity.column, _heading(quantity.column, quantity.unit), values)
    return Column(quantity.column, _heading(quantity.column, quantity.display_unit), zero + (one - zero) * values)


def _numbers(results: pa.Table, name: str) -> npt.NDArray[np.float64]:
    return np.array([np.nan if value is None else float(value) for value in results[name].to_pylist()])


def _heading(name: str, unit: str) -> str:
    return f"{name} [{unit or '1'}]"


def _broken(heading: str) -> str:
    """A heading in lines that are short enough for an axis."""
    return heading.replace(".", ".<br>", 1).replace(" [", "<br>[")


def _table(varied: Sequence[Column], found: Sequence[Column], results: pa.Table) -> str:
    columns = [*varied, *found]
    numbers, status = results["design"].to_pylist(), results["status"].to_pylist()
    rows = [
        [str(numbers[row]), *(_cell(column.values[row]) for column in columns), status[row]]
        for row in range(min(len(results), _MOST_ROWS))
    ]
    failed = [row for row in range(len(rows)) if status[row] != "ok"]
    headings = ["design", *(column.heading for column in columns), "status"]
    return table(headings, rows, numeric=range(len(columns) + 1), changed=failed)


def _cell(number: float) -> str:
    return "" if np.isnan(number) else f"{number:.9g}"


def _rows_note(results: pa.Table) -> str:
    count, warned = len(results), len(results) - results["warnings"].null_count
    which = "" if count <= _MOST_ROWS else f"The first {_MOST_ROWS} of {count}. "
    said = f" To {warned} designs the FMU had something to say; it stands there, too." if warned else ""
    return f"{which}results.parquet has all, in SI units and radians, with all digits.{said}"


def run_rows(task: Task, description: Description) -> list[list[str]]:
    """What was run, with versions."""
    grid = task.grid
    return [
        ["FMU", f"{description.model} {description.guid}, made by {description.generation_tool}"],
        ["mechanism_fmu", __version__],
        ["material", f"{task.material.name}: {task.material.text}"],
        ["run", f"{seconds(grid.stop):g} s in communication steps of {seconds(grid.step):g} s"],
        *([name, shown(value, name, description)] for name, value in task.fixed.items()),
        *([quantity.column, quantity.when.meaning] for quantity in task.quantities),
    ]


def range_of(axis: Axis) -> str:
    """Between which values something is varied, with the unit."""
    if axis.values is not None:
        return ", ".join(shown(value, axis.name, axis.description) for value in axis.values)
    return f"{axis.low:g} to {axis.high:g} {axis.unit}"

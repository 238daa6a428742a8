"""report.html of a sweep: what was varied, what came of it, and one design in motion."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt
import plotly.graph_objects as go
import pyarrow as pa
from plotly.subplots import make_subplots

from mechanism_fmu.stress import beam_theory_note

from ..designs.by_fmu import InMotion
from ..designs.store import failures, numbers_of
from ..designs.sweep import Sweep, range_cells
from ..designs.task import Quantity, Task
from ..designs.variation import Axis
from ..fmu import Fmu
from ..fmu.description import Description
from ..fmu.values import in_display_unit
from ..run.master import seconds
from ..run.results import versions, write_text
from .animation import HEADING, animation
from .page import COLOURS, WIDE_TOP, cards, chart, facts, layout, page, section, table, versions_section, wide
from .parameters import Origin, inputs_section, parameters_of_designs

# The section of a sweep's or an optimum's report that shows one design in motion.


def animation_of_design(seen: InMotion | None) -> str:
    """The section, with the reason when nothing can be seen; "" when the FMU has no drawing."""
    if seen is None:
        return ""
    caption = seen.caption
    if seen.run is not None and seen.run.beam is not None:
        struck = seen.run.description.analysis.struck
        caption += f" Its {struck.name if struck else 'beam'}: {beam_theory_note(seen.run.beam)}"
    drawn = "" if seen.run is None else animation(seen.run, about=caption)
    return drawn or section(HEADING, note=caption)


#: More rows make a page slow; the file has all.
_MOST_ROWS = 500
_NUMBER = re.compile(r"-?\d+(\.\d+)?(e[-+]?\d+)?")
#: Kinds of warnings.
_MOST_KINDS = 20
#: Height of one row of charts [px].
_ROW_HEIGHT = 260
#: Beyond so many dots, SVG is slow.
_MANY_DOTS = 10_000


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

    @property
    def is_wide(self) -> bool:
        """Whether only a logarithm shows all of it: positive, over more than three decades."""
        finite = self.values[np.isfinite(self.values)]
        return bool(finite.size and finite.min() > 0.0 and finite.max() > 1e3 * finite.min())

    def in_decades(self) -> Column:
        """What is wide as its logarithm, anything else as it is."""
        return Column(self.name, f"lg {self.heading}", np.log10(self.values)) if self.is_wide else self


def write_sweep_report(sweep: Sweep, fmu: Fmu, results: pa.Table, seen: InMotion | None, path: Path) -> Path:
    """Write the report of a sweep as one file that works offline.

    Raises:
        UsageError: the disk refuses.
    """
    return write_text(path, lambda file: file.write(sweep_report(sweep, fmu, results, seen)))


def sweep_report(sweep: Sweep, fmu: Fmu, results: pa.Table, seen: InMotion | None) -> str:
    """The report as HTML; `seen` is the design that is shown in motion."""
    description = fmu.description
    failed = failures(results)
    figures = [
        ("designs", str(len(results))),
        ("failed", str(len(failed))),
        ("way", ", ".join(sorted(set(results["way"].to_pylist())))),
    ]
    charts = results_charts(sweep.axes, sweep.task, description, results)
    body = [cards(figures)]
    if failed:
        rows = [[str(number), message] for number, message in failed[:_MOST_ROWS]]
        body.append(section("Failed designs", table(["design", "message"], rows, numeric=[0]), banner=True))
    body += [
        section("Ranges", ranges_table(sweep.task, description, results)),
        section("Results", *charts, note="Each dot is one design. Drag over an axis to zoom."),
        animation_of_design(seen),
        section("Designs", designs_table(sweep.axes, sweep.task, description, results), note=_rows_note(results)),
    ]
    body.append(warnings_section(results))
    varied = {axis.name: (*limits(axis), Origin.VARIED) for axis in sweep.axes}
    note = "What was set for all designs, or varied between limits, is marked; the rest are the FMU's defaults."
    body += [
        section("What was run", facts("value", run_rows(sweep.task, description))),
        inputs_section(sweep.task.inputs, description),
        parameters_of_designs(sweep.task, description, varied, note),
        versions_section(versions(fmu.path, description)),
    ]
    subtitle = f"{description.model}  ·  {len(results)} designs, {sweep.method}"
    return page(sweep.title, subtitle, [part for part in body if part])


def results_charts(axes: Sequence[Axis], task: Task, description: Description, results: pa.Table) -> list[str]:
    """What was found over what was varied."""
    varied, found = _columns(axes, task, description, results)
    return _charts(varied, found)


def designs_table(axes: Sequence[Axis], task: Task, description: Description, results: pa.Table) -> str:
    """A row for each design, as many as a page can bear."""
    varied, found = _columns(axes, task, description, results)
    return _table(varied, found, results)


def ranges_table(task: Task, description: Description, results: pa.Table) -> str:
    """Between which values each quantity lies, and in which designs it has them."""
    numbers = results["design"].to_pylist()
    found = [_found(quantity, description, results) for quantity in task.quantities]
    rows = [[column.heading, *range_cells(column.values, numbers)] for column in found]
    return table(["quantity", "smallest", "design", "largest", "design"], rows, numeric=range(1, 5))


def warnings_section(results: pa.Table) -> str:
    """Each warning, and to how many designs it was said; nothing when there was none."""
    said = [text for text in results["warnings"].to_pylist() if text]
    if not said:
        return ""
    # numbers differ from design to design, but not what is said
    kinds = [_NUMBER.sub("…", text) for text in said]
    alike, examples = Counter(kinds), dict(zip(reversed(kinds), reversed(said), strict=True))
    rows = [[str(count), examples[kind]] for kind, count in alike.most_common(_MOST_KINDS)]
    return section("Warnings", table(["designs", "as in"], rows, numeric=[0]))


def _columns(
    axes: Sequence[Axis], task: Task, description: Description, results: pa.Table
) -> tuple[list[Column], list[Column]]:
    varied = [_varied(axis, results) for axis in axes if axis.variable.type != "String"]
    return varied, [_found(quantity, description, results) for quantity in task.quantities]


def parallel_chart(columns: Sequence[Column], colour: Column) -> go.Figure:
    """Each design a line across all columns, coloured by one of them."""
    # below, and a line further down; above, their lines would hide the ends of the ranges
    columns, colour = [column.in_decades() for column in columns], colour.in_decades()
    dimensions = [
        {"label": f"<br>{_broken(column.heading)}", "values": column.values, "tickformat": ".3~g"} for column in columns
    ]
    title = {"text": _broken(colour.heading), "font": {"size": 12}}
    line = {"color": colour.values, "colorscale": "Viridis", "colorbar": {"title": title}}
    labels = {"labelside": "bottom", "labelfont": {"size": 12}}
    figure = go.Figure(go.Parcoords(dimensions=dimensions, line=line, rangefont={"size": 10}, **labels))
    figure.update_layout(layout(height=460, margin={"l": 80, "r": 60, "t": 60, "b": 100}))
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
    # WebGL draws many dots at once, but not in every browser
    kind = go.Scatter if len(varied[0].values) * rows * len(varied) <= _MANY_DOTS else go.Scattergl
    for i, y in enumerate(found, start=1):
        for k, x in enumerate(varied, start=1):
            marker = {"size": 6, "color": COLOURS[(i - 1) % len(COLOURS)], "opacity": 0.75}
            dots = {"x": x.values, "y": y.values, "mode": "markers", "marker": marker, "name": y.name}
            figure.add_trace(kind(**dots, showlegend=False), row=i, col=k)
        exponents = {"type": "log", "exponentformat": "power"} if y.is_wide else {"exponentformat": "SI"}
        figure.update_yaxes(title_text=_broken(y.heading), **exponents, row=i, col=1)
        if y.is_wide:
            figure.update_yaxes(type="log", row=i)
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
    values = numbers_of(results, axis.name)
    if axis.unit != variable.unit:
        zero, one = (units.convert(x, axis.unit, variable.unit) for x in (0.0, 1.0))
        values = (values - zero) / (one - zero)
    return Column(axis.name, _heading(axis.name, axis.unit), values)


def _found(quantity: Quantity, description: Description, results: pa.Table) -> Column:
    values = numbers_of(results, quantity.column)
    zero, one = (description.units.to_display(x, quantity.unit, quantity.display_unit) for x in (0.0, 1.0))
    if zero is None or one is None:
        return Column(quantity.column, _heading(quantity.column, quantity.unit), values)
    return Column(quantity.column, _heading(quantity.column, quantity.display_unit), zero + (one - zero) * values)


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
    return table(headings, rows, numeric=range(len(columns) + 1), changed=failed, long=True)


def _cell(number: float) -> str:
    return "" if np.isnan(number) else f"{number:.9g}"


def _rows_note(results: pa.Table) -> str:
    count, warned = len(results), len(results) - results["warnings"].null_count
    which = "" if count <= _MOST_ROWS else f"The first {_MOST_ROWS} of {count}. "
    said = f" {warned} designs have warnings, which stand there, too." if warned else ""
    return f"{which}results.parquet has all, in SI units and radians, with all digits.{said}"


def run_rows(task: Task, description: Description) -> list[list[str]]:
    """How each design was run, and what was kept of it."""
    grid, struck = task.grid, description.analysis.struck
    name = "beam" if struck is None else struck.name
    return [
        ["material", f"{task.material.name}: {task.material.text}"],
        ["run", f"{seconds(grid.stop):g} s in communication steps of {seconds(grid.step):g} s"],
        *([quantity.column, quantity.when.meaning(name)] for quantity in task.quantities),
    ]


def limits(axis: Axis) -> tuple[str, str]:
    """Between which values something is varied, or the values, and the unit."""
    if axis.values is None:
        return f"{axis.low:g} … {axis.high:g}", axis.unit or "1"
    texts, units = zip(*(in_display_unit(value, axis.name, axis.description) for value in axis.values), strict=True)
    return ", ".join(texts), units[0]

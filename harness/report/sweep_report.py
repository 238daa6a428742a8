"""report.html of a sweep: what was varied, what came of it, and one design in motion."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pyarrow as pa

from mechanism_fmu.stress import beam_theory_note

from ..designs.by_fmu import InMotion
from ..designs.store import failures, numbers_of
from ..designs.sweep import Sweep, range_cells
from ..designs.task import Quantity, Task, When
from ..designs.variation import Axis
from ..fmu import Fmu
from ..fmu.description import Description
from ..fmu.values import in_display_unit
from ..run.master import seconds
from ..run.results import versions, write_text
from .animation import HEADING, animation
from .page import cards, chart, charts, facts, page, section, table, versions_section
from .parameters import Origin, inputs_section, parameters_of_designs
from .plot import Curve, Plot, interactive
from .style import COLOURS

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
#: Of a chart of one quantity over another [px].
_HEIGHT = 210


@dataclass(frozen=True)
class Column:
    """A column as charts and tables show it.

    Attributes:
        name: in the results.
        heading: with its unit.
        values: in that unit; NaN where there is none, shape (designs,).
        words: what it is, with its unit, in charts.
    """

    name: str
    heading: str
    values: npt.NDArray[np.float64]
    words: str = ""

    @property
    def is_wide(self) -> bool:
        """Whether only a logarithm shows all of it: positive, over more than three decades."""
        finite = self.values[np.isfinite(self.values)]
        return bool(finite.size and finite.min() > 0.0 and finite.max() > 1e3 * finite.min())


#: Of charts of many designs.
RESULTS_NOTE = (
    "Each dot is one design, and each line across the upright axes: drag along an axis to see only the designs in this "
    "range, click on it to see all. Drag over another chart to zoom, double-click to return."
)


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
    drawn = results_charts(sweep.axes, sweep.task, description, results)
    body = [cards(figures)]
    if failed:
        rows = [[str(number), message] for number, message in failed[:_MOST_ROWS]]
        body.append(section("Failed designs", table(["design", "message"], rows, numeric=[0]), banner=True))
    body += [
        section("Ranges", ranges_table(sweep.task, description, results)),
        section("Results", *drawn, note=RESULTS_NOTE),
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
    return _charts(varied, found, results["design"].to_pylist())


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


def parallel_chart(columns: Sequence[Column], colour: int, designs: Sequence[int]) -> dict[str, Any]:
    """Each design a line across all columns, coloured by that with number `colour`."""
    axes = [
        {"name": column.words or column.heading, "about": column.name, "values": column.values.tolist()}
        | ({"log": True} if column.is_wide else {})
        for column in columns
    ]
    return {"title": "Designs across all axes", "axes": axes, "colour": colour, "designs": list(designs)}


def scatter_charts(varied: Sequence[Column], found: Sequence[Column], designs: Sequence[int]) -> list[list[Plot]]:
    """For each quantity that was found a chart of it over each that was varied."""
    labels = [f"design {number}" for number in designs]
    return [
        [
            Plot(
                y.words or y.heading,
                x.words or x.heading,
                "",
                [Curve(y.name, x.values, y.values, COLOURS[i % len(COLOURS)], line=False, dots=True, labels=labels)],
                legend=False,
                log_y=y.is_wide,
            )
            for x in varied
        ]
        for i, y in enumerate(found)
    ]


def _charts(varied: Sequence[Column], found: Sequence[Column], designs: Sequence[int]) -> list[str]:
    """Those of columns that have numbers at all."""
    some = [column for column in found if np.isfinite(column.values).any()]
    if not varied or not some:
        return ["<p>There is nothing to draw: no design gave a number.</p>"]
    whole = np.isfinite(np.column_stack([column.values for column in (*varied, *some)])).all(axis=1)
    drawn = [
        charts(*(chart(interactive(plot, _HEIGHT)) for plot in plots), kind="small")
        for plots in scatter_charts(varied, some, designs)
    ]
    if whole.any():
        kept = [replace(column, values=column.values[whole]) for column in (*varied, *some)]
        drawn.append(chart(parallel_chart(kept, len(varied), np.array(designs)[whole].tolist())))
    return drawn


def _varied(axis: Axis, results: pa.Table) -> Column:
    variable, units = axis.variable, axis.description.units
    values = numbers_of(results, axis.name)
    if axis.unit != variable.unit:
        zero, one = (units.convert(x, axis.unit, variable.unit) for x in (0.0, 1.0))
        values = (values - zero) / (one - zero)
    words = _heading(variable.description or axis.name.replace("_", " "), axis.unit)
    return Column(axis.name, _heading(axis.name, axis.unit), values, words)


def _found(quantity: Quantity, description: Description, results: pa.Table) -> Column:
    values = numbers_of(results, quantity.column)
    zero, one = (description.units.to_display(x, quantity.unit, quantity.display_unit) for x in (0.0, 1.0))
    unit = quantity.unit
    if zero is not None and one is not None:
        unit, values = quantity.display_unit, zero + (one - zero) * values
    words = _heading(in_words(quantity, description), unit)
    return Column(quantity.column, _heading(quantity.column, unit), values, words)


def in_words(quantity: Quantity, description: Description) -> str:
    """What a quantity is: when it is taken, and the description of its variable, if this has one."""
    known = description.variables.get(quantity.name)
    words = known.description if known is not None and known.description else quantity.name.replace("_", " ")
    return words if quantity.when is When.PARAMETER else f"{quantity.when.replace('_', ' ')}: {words}"


def _heading(name: str, unit: str) -> str:
    return f"{name} [{unit or '1'}]"


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

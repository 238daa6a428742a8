"""report.html of an optimum: how it was found, and how much each variable matters near it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pyarrow as pa

from ..designs.by_fmu import InMotion
from ..designs.optimum_file import Optimum
from ..designs.search import Best, History
from ..designs.sensitivity import Sensitivity
from ..designs.variation import Axis
from ..fmu import Fmu
from ..fmu.description import Description, Value
from ..fmu.values import in_display_unit
from ..run.results import versions, write_text
from .page import cards, chart, facts, page, section, table, versions_section
from .parameters import inputs_section, parameters_of_designs
from .plot import Curve, Plot, interactive
from .style import COLOURS
from .sweep_report import (
    RESULTS_NOTE,
    Column,
    animation_of_design,
    designs_table,
    in_words,
    limits,
    results_charts,
    run_rows,
    warnings_section,
)


@dataclass(frozen=True)
class Found:
    """What came of a search.

    Attributes:
        best: design.
        near_it: how much each variable matters there; None when it was not asked for.
        history: of the search.
        results: of all designs, as `Store.finish` gives them.
        seen: the best design in motion.
    """

    best: Best
    near_it: Sensitivity | None
    history: History
    results: pa.Table
    seen: InMotion | None


def write_optimum_report(optimum: Optimum, found: Found, fmu: Fmu, path: Path) -> Path:
    """Write the report of an optimum as one file that works offline.

    Raises:
        UsageError: the disk refuses.
    """
    return write_text(path, lambda file: file.write(optimum_report(optimum, found, fmu)))


def optimum_report(optimum: Optimum, found: Found, fmu: Fmu) -> str:
    """The report as HTML."""
    goal, description = optimum.goal, fmu.description
    best, near_it, history, results = found.best, found.near_it, found.history, found.results
    value = goal.value(best.result, optimum.task)
    figures = [
        (
            f"{'largest' if goal.largest else 'smallest'} {goal.objective.column}",
            _with_unit(value, goal.objective.unit),
        ),
        *((axis.name, _card(*_in_unit(axis, best.design.values[axis.name]))) for axis in optimum.axes),
        ("designs", str(len(history.designs))),
    ]
    body = [
        cards(figures),
        section("Constraints", _constraints(optimum, best)),
        animation_of_design(found.seen),
        section(
            "Search",
            chart(interactive(history_plot(optimum, history, description))),
            note="Dots are designs, the line is the best so far.",
        ),
    ]
    if near_it is not None:
        note = (
            f"For variables that are uniform near the optimum, the objective has the mean {near_it.mean:.6g} and the "
            f"standard deviation {near_it.spread:.6g} {goal.objective.unit or '1'}. First order: the part of its "
            "variance that a variable explains by itself; total: together with others."
        )
        body.append(section("Sensitivity", chart(interactive(sensitivity_plot(near_it), height=260)), note=note))
    body += [
        section("Designs", *results_charts(optimum.axes, optimum.task, description, results), note=RESULTS_NOTE),
        section("All designs", designs_table(optimum.axes, optimum.task, description, results)),
        warnings_section(results),
        section("What was run", facts("value", _set_up(optimum, description, near_it))),
        inputs_section(optimum.task.inputs, description),
        _parameters(optimum, best, description),
        versions_section(versions(fmu.path, description)),
    ]
    subtitle = f"{description.model}  ·  {optimum.method}, seed {optimum.seed}"
    return page(optimum.title, subtitle, [part for part in body if part])


def history_plot(optimum: Optimum, history: History, description: Description) -> Plot:
    """The objective of each design, and the best so far."""
    goal, task = optimum.goal, optimum.task
    numbers = np.array([design.number for design in history.designs], dtype=np.float64)
    values = np.array([_number(goal.value(result, task)) for result in history.results])
    kept = np.array([goal.violation(result, task) == 0.0 for result in history.results])
    good = np.where(kept, -values if goal.largest else values, np.inf)
    so_far = np.minimum.accumulate(good)
    so_far = np.where(np.isfinite(so_far), -so_far if goal.largest else so_far, np.nan)
    curves = [
        Curve(
            name,
            numbers[which],
            values[which],
            colour,
            line=False,
            dots=True,
            labels=[f"design {number:g}" for number in numbers[which]],
        )
        for name, which, colour in (("keeps all constraints", kept, COLOURS[0]), ("misses some", ~kept, COLOURS[6]))
        if which.any()
    ]
    # level until the next design
    curves.append(Curve("best so far", numbers.repeat(2)[1:], so_far.repeat(2)[:-1], COLOURS[1]))
    return Plot(
        f"{in_words(goal.objective, description)} [{goal.objective.unit or '1'}]",
        "design [1]",
        "",
        curves,
        log_y=Column(goal.objective.column, "", values).is_wide,
    )


def sensitivity_plot(near_it: Sensitivity) -> Plot:
    """Sobol indices as bars."""
    curves = [
        Curve(name, (), indices, colour)
        for name, indices, colour in (("first order", near_it.first, COLOURS[0]), ("total", near_it.total, COLOURS[4]))
    ]
    return Plot("Sobol index [1]", "", "", curves, bars=[name.replace("_", " ") for name in near_it.names])


def _constraints(optimum: Optimum, best: Best) -> str:
    pairs = dict(zip(optimum.task.quantities, best.result.values, strict=True))
    rows = []
    for constraint in optimum.goal.constraints:
        value = pairs[constraint.quantity]
        numbers = [_cell(number) for number in (constraint.at_least, constraint.at_most, value)]
        kept = value is not None and constraint.violation(float(value)) == 0.0
        rows.append([constraint.quantity.column, constraint.quantity.unit or "1", *numbers, "yes" if kept else "no"])
    if not rows:
        return "<p>None.</p>"
    return table(["quantity", "unit", "at least", "at most", "best design", "kept"], rows, numeric=(2, 3, 4))


def _cell(value: Value | None) -> str:
    return "none" if value is None else f"{float(value):.6g}"


def _set_up(optimum: Optimum, description: Description, near_it: Sensitivity | None) -> list[list[str]]:
    rows = run_rows(optimum.task, description)
    if near_it is not None:
        units = {axis.name: axis.unit for axis in optimum.axes}
        for name, (low, high) in zip(near_it.names, near_it.limits, strict=True):
            rows.append([f"{name}, near the optimum", f"{low:.6g} to {high:.6g} {units[name]}"])
    return rows


def _parameters(optimum: Optimum, best: Best, description: Description) -> str:
    free = {}
    for axis in optimum.axes:
        value, unit = _in_unit(axis, best.design.values[axis.name])
        free[axis.name] = (value, unit, f"free: {limits(axis)[0]}")
    note = (
        "What was set for all designs, or was free between limits, is marked; what was free has the value of the best "
        "design. The rest are the FMU's defaults."
    )
    return parameters_of_designs(optimum.task, description, free, note)


def _in_unit(axis: Axis, value: Value) -> tuple[str, str]:
    """A value in the unit of the file, and this unit."""
    if axis.values is not None or axis.variable.type != "Real":
        return in_display_unit(value, axis.name, axis.description, digits=6)
    return f"{axis.low + axis.fraction(float(value)) * (axis.high - axis.low):.6g}", axis.unit or "1"


def _card(value: str, unit: str) -> str:
    return value if unit == "1" else f"{value} {unit}".strip()


def _with_unit(value: float | None, unit: str) -> str:
    return "" if value is None else f"{value:.6g} {unit}".strip()


def _number(value: float | None) -> float:
    return np.nan if value is None else value

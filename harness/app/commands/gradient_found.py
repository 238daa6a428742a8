"""What `mechanism-fmu gradient` does: derivatives of quantities by parameters and inputs, shown and written."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from rich.markup import escape

from mechanism_fmu.fmu.disk.user_cache import was_built_here

from ...designs.gradient import Free, Gradient, events_of, gradient, smooth
from ...designs.sweep import Progress
from ...designs.task import Design, Quantity, Result, Task, UnknownQuantityError, column, with_slenderness
from ...designs.variation import Source
from ...designs.workers import Executor
from ...errors import UsageError
from ...fmu import open_fmu
from ...fmu.description import Description, Value, Variable
from ...fmu.values import parse_time, settable_variable
from ...run.experiment import default_times, start_values
from ...run.master import TimeGrid, never
from ...run.results import write_json, write_text
from ..execution import require_writable
from ..output import give, note
from ..terminal import FAILED, console, show_error, show_note, show_table
from .designs_shared import DesignsBar, Runners, executor_of, fmu_file

_KINDS = (".csv", ".json")
#: Designs that a variable takes: two sides of six steps.
_FOR_EACH = 12
#: A quantity that changes by less than this part of itself for one of a variable does not depend on it [1].
_NOTHING = 1e-10
#: Nor does one whose change is less than its error, if that is less than this part of it; else it is not known [1].
_KNOWN = 1e-6


@dataclass(frozen=True)
class Asked:
    """The arguments of the command, as they were written."""

    model: str
    of: tuple[str, ...]
    by: tuple[str, ...] = ()
    settings: tuple[str, ...] = ()
    stop_time: str | None = None
    step: str | None = None
    trust: bool = False


def find(asked: Asked, output: Path | None) -> int:
    """Find the derivatives, show and write them, and return the exit code.

    Args:
        asked: the arguments.
        output: file to write, or None.

    Raises:
        UsageError: the arguments cannot be; the message says what can.
    """
    require_writable(output, _KINDS)
    is_fmu = asked.model.endswith(".fmu")
    wanted = Source(Path(asked.model)) if is_fmu else Source(model=asked.model)
    with fmu_file(wanted) as path, open_fmu(path) as fmu:
        quantities, free, task = _task(asked, fmu.description)
        runners = _runners(path, asked.trust or not is_fmu)
        with executor_of(fmu, task, runners) as executor, DesignsBar(1 + _FOR_EACH * len(free)) as bar:
            found = gradient(quantities, task.quantities, free, {}, _Runner(executor, bar))
        give(as_data(found))
        missing = _show(found, fmu.description, asked.by)
    if output is not None:
        _write(found, output)
        note("files", str(output))
        console.print(f"Written: {escape(str(output))}", soft_wrap=True)
    return FAILED if missing else 0


class _Runner:
    """Runs designs by an executor, and shows how many."""

    def __init__(self, executor: Executor, bar: DesignsBar) -> None:
        self._executor, self._bar, self._done = executor, bar, 0

    def __call__(self, points: Sequence[Mapping[str, Value]]) -> list[Result]:
        designs = [Design(number, values) for number, values in enumerate(points, start=1)]
        found = {design.number: result for pairs in self._executor(designs, never) for design, result in pairs}
        self._done += len(designs)
        self._bar.show(Progress(self._done, 0, self._done, 0))
        return [found[design.number] for design in designs]


def _runners(path: Path, trust: bool) -> Runners:
    """In one call, if the FMU has the sources for it and these may run here; else in processes, by the FMU."""
    if not trust and not was_built_here(path):
        return Runners()
    from ...designs.by_batch import require_batch

    try:
        require_batch(path)
    except UsageError:
        return Runners()
    return Runners(fast=True, trust=trust)


def _task(asked: Asked, description: Description) -> tuple[list[Quantity], list[Free], Task]:
    """What is asked for, what is moved, and what is done with each design."""
    try:
        quantities = [column(text, description) for text in dict.fromkeys(asked.of)]
    except UnknownQuantityError as error:
        raise UsageError(f"--of: {error}") from None
    for one in quantities:
        if one.type != "Real":
            raise UsageError(f"--of: '{one.column}' is {one.type}, which has no derivatives; a Real quantity has.")
    fixed = start_values(asked.settings, description)
    variables = [_moved(name, description) for name in dict.fromkeys(asked.by)] or smooth(description)
    if not variables:
        raise UsageError(f"{description.model} has no Real parameter or input by which there could be derivatives.")
    free = [Free.of(variable, float(fixed.get(variable.name, variable.start or 0.0))) for variable in variables]
    stop = parse_time(asked.stop_time, "--stop-time", description)
    step = parse_time(asked.step, "--step", description)
    recorded = dict.fromkeys([*with_slenderness(quantities, description), *events_of(quantities, description)])
    return (
        quantities,
        free,
        Task(TimeGrid.of(*default_times(description, stop, step)), fixed, None, tuple(recorded), events=True),
    )


def _moved(name: str, description: Description) -> Variable:
    variable = settable_variable(name, description)
    if variable.type != "Real":
        raise UsageError(f"--by: '{name}' is {variable.type}; there are derivatives by Real variables only.")
    return variable


def as_data(found: Gradient) -> dict[str, Any]:
    """What is found, as plain numbers and texts, in the units of the variables."""
    return {
        "quantities": {
            one.column: {"value": float(value), "unit": one.unit or "1"}
            for one, value in zip(found.quantities, found.middle, strict=True)
        },
        "variables": dict(zip(found.names, found.values.tolist(), strict=True)),
        "derivatives": _by_quantity(found, found.matrix),
        "errors": _by_quantity(found, found.errors),
        "relative": _by_quantity(found, found.relative),
        "none": {name: change for name, change in zip(found.names, found.changes, strict=True) if change},
    }


def _by_quantity(found: Gradient, matrix: np.ndarray[Any, Any]) -> dict[str, dict[str, float | None]]:
    return {
        one.column: {
            name: float(value) if math.isfinite(value) else None
            for name, value in zip(found.names, matrix[row], strict=True)
        }
        for row, one in enumerate(found.quantities)
    }


def _show(found: Gradient, description: Description, by: Sequence[str]) -> bool:
    """The tables; whether a derivative that was asked `by` name does not exist."""
    for row, one in enumerate(found.quantities):
        unit = one.unit or "1"
        depends = [k for k, change in enumerate(found.changes) if not change and _depends(found, row, k)]
        depends.sort(key=lambda k: -_relative(found, row, k))
        rows = [_cells(found, row, k, description) for k in depends]
        title = f"{one.column} = {found.middle[row]:.9g} {unit}, and how it changes with"
        headings = ["variable", "value", "unit", f"derivative [{unit} per unit]", "within", "[%/%]"]
        if rows:
            show_table(title, headings, rows, numeric=(1, 3, 4, 5))
        without = [name for k, name in enumerate(found.names) if not found.changes[k] and k not in depends]
        if without:
            show_note(f"{one.column} does not depend on {', '.join(without)}.")
    missing = False
    for k, change in enumerate(found.changes):
        if not change:
            continue
        name, unit = found.names[k], description.variable(found.names[k]).unit
        unit = "" if unit in ("", "1") else f" {unit}"
        said = (
            f"No derivatives by {name}: within {found.within[k]:.1e}{unit} of {found.values[k]:.9g}{unit} the events "
            f"change: {change}. Choose a value beside it; or, if what is asked comes first, an earlier --stop-time."
        )
        missing |= name in by
        (show_error if name in by else show_note)(said)
    return missing


def _depends(found: Gradient, row: int, k: int) -> bool:
    size, scale = abs(found.middle[row]), abs(found.values[k]) or 1.0
    change, error = abs(found.matrix[row, k]) * scale, found.errors[row, k] * scale
    return bool(change > _NOTHING * size and (change > error or error > _KNOWN * size))


def _relative(found: Gradient, row: int, k: int) -> float:
    """Change over itself for that of a variable over itself [1]; 0 of variables that are 0."""
    relative = abs(found.relative[row, k])
    return float(relative) if math.isfinite(relative) else 0.0


def _cells(found: Gradient, row: int, k: int, description: Description) -> list[str]:
    relative = found.relative[row, k]
    return [
        found.names[k],
        f"{found.values[k]:.4g}",
        description.variable(found.names[k]).unit or "1",
        f"{found.matrix[row, k]:.7g}",
        f"{found.errors[row, k]:.0e}",
        f"{relative:.2g}" if math.isfinite(relative) and relative else "",
    ]


def _write(found: Gradient, output: Path) -> None:
    """JSON has all; CSV a row for each quantity and variable."""
    if output.suffix == ".json":
        write_json(output, as_data(found))
        return
    rows = [
        (one.column, name, found.middle[row], found.values[k], found.matrix[row, k], found.errors[row, k])
        for row, one in enumerate(found.quantities)
        for k, name in enumerate(found.names)
    ]
    table = pd.DataFrame(rows, columns=["quantity", "variable", "value", "at", "derivative", "error"])
    write_text(output, lambda target: table.to_csv(target, index=False))

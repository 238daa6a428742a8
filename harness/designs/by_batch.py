"""The way of many designs in one compiled call: the FMU's numbers, without its FMI calls (docs/batch.md)."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import pandas as pd

from mechanism_fmu.batch import Batch, BatchResult, NoBatchError
from mechanism_fmu.model import MechanismError

from ..clock import TimeGrid, seconds
from ..description import Description, Value
from ..errors import FmuError
from ..fmu import Fmu
from . import by_fmu
from .of_impacts import of_impacts, tooth_parameters, typed
from .task import Design, Quantity, Result, Task, When

NAME = "batch"

#: Designs with more impacts go through the FMU.
_MOST_IMPACTS = 64


def can_run(fmu: Fmu, task: Task, design: Design) -> bool:
    """Whether designs like this one can run this way: the FMU is one of ours and carries its engine, compiled."""
    try:
        batch = _batch(fmu.path)
        if batch.library is None:  # compiling it in every process would take longer than most sweeps
            return False
        grid = task.grid
        one_step = TimeGrid(grid.start, min(grid.start + grid.step, grid.stop), grid.step)
        _found(batch, replace(task, grid=one_step), [design], fmu)
    except (NoBatchError, MechanismError, ValueError):
        return False
    return True


def run_designs(fmu: Fmu, task: Task, designs: Sequence[Design]) -> list[Result]:
    """Run designs over the processors of this machine; those with very many impacts go through the FMU."""
    found = _found(_batch(fmu.path), task, designs, fmu)
    return [
        by_fmu.run_designs(fmu, task, [design])[0]
        if found.impact_count[k] > _MOST_IMPACTS
        else _result(fmu.description, task, design, found, k)
        for k, design in enumerate(designs)
    ]


@lru_cache(maxsize=1)
def _batch(path: Path) -> Batch:
    return Batch.of_fmu(path)


def _found(batch: Batch, task: Task, designs: Sequence[Design], fmu: Fmu) -> BatchResult:
    values = [{**task.fixed, **design.values} for design in designs]
    steps = [] if task.inputs is None else [task.inputs.at(seconds(begin)) for begin, _ in task.grid]
    signals = {name: [float(step[name]) for step in steps] for name in (steps[0] if steps else ())}
    return batch.run(
        {name: [float(one[name]) for one in values] for name in values[0]},
        [seconds(task.grid.start), *(seconds(end) for _, end in task.grid)],
        _outputs(task, fmu.description),
        signals=signals,
        impacts=_MOST_IMPACTS,
        extremes=any(quantity.when in (When.MAX, When.MIN) for quantity in task.quantities),
    )


def _outputs(task: Task, description: Description) -> list[str]:
    """What is asked of the compiled call, besides impacts."""
    names = [quantity.name for quantity in task.quantities if quantity.when in (When.END, When.MAX, When.MIN)]
    names += [name for name in _read_once(task) if description.variable(name).causality == "calculatedParameter"]
    return list(dict.fromkeys(names))


def _read_once(task: Task) -> list[str]:
    tooth = tooth_parameters(task)
    return [*tooth, *(quantity.name for quantity in task.quantities if quantity.when is When.PARAMETER)]


def _result(description: Description, task: Task, design: Design, found: BatchResult, k: int) -> Result:
    if found.failures[k]:
        return Result.failed(design, NAME, task, found.failures[k])
    said = [found.warnings[k]] if found.warnings[k] else []
    if math.isfinite(found.pulled[k]):
        said.append(f"From t = {found.pulled[k]:.6g} s a guided contact pulls, where a real one would open.")
    fixed = {**task.fixed, **design.values}
    once = {name: _once(name, description, fixed, found, k) for name in _read_once(task)}
    kept = min(int(found.impact_count[k]), _MOST_IMPACTS)
    impacts = pd.DataFrame({name: column[k, :kept] for name, column in found.impacts.items()})
    try:
        struck = of_impacts(task, impacts, once)
    except FmuError as error:
        return Result.failed(design, NAME, task, str(error))
    values = tuple(
        struck[quantity.column] if quantity.when.of_impacts else _value(quantity, once, found, k)
        for quantity in task.quantities
    )
    return Result(design.number, NAME, values, None, "\n".join(said) or None)


def _once(name: str, description: Description, values: Mapping[str, Value], found: BatchResult, k: int) -> Value:
    """A parameter after the initialization."""
    if name in found.values:
        return float(found.values[name][k])
    start = description.variable(name).start
    return values[name] if name in values else float(start or 0.0)


def _value(quantity: Quantity, once: Mapping[str, Value], found: BatchResult, k: int) -> Value:
    if quantity.when is When.PARAMETER:
        return typed(float(once[quantity.name]), quantity.type)
    columns = {When.END: found.values, When.MAX: found.greatest, When.MIN: found.least}[quantity.when]
    return typed(float(columns[quantity.name][k]), quantity.type)

"""Backend `batch`: hundreds of designs in one compiled call, with the FMU's numbers but without its FMI calls."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from mechanism_fmu.batch import Batch, BatchResult, MechanismError, NoBatchError

from ..analysis.impacts import ImpactCollector
from ..errors import FmuError, UsageError
from ..fmu import Fmu
from ..fmu.description import Description, Value, Variable
from ..run.master import seconds
from . import by_fmu
from .task import Design, Impacts, Quantity, Result, Task, When, of_impacts, struck_in

NAME = "batch"
#: So many designs go together at most, and are kept together when they come.
TOGETHER = 256
#: Impacts of a design that are kept; one with more goes through the FMU.
_MOST_IMPACTS = 512
#: Events of a design that are kept, where they are asked for.
_MOST_EVENTS = 512


def require_batch(path: Path) -> None:
    """Refuse an FMU whose designs cannot run in one call.

    Raises:
        UsageError: why they cannot.
    """
    try:
        _batch(path)
    except NoBatchError as error:
        raise UsageError(f"--fast: {error}") from None


def run_designs(fmu: Fmu, task: Task, designs: Sequence[Design], threads: int | None = None) -> list[Result]:
    """Run designs together, by default in as many threads as this process may use.

    The numbers are those of `by_fmu`, to the last bit. Impacts that would not fit into the FMU's buffer of one step are
    not lost here.
    """
    try:
        found = _found(fmu, task, designs, threads)
    except MechanismError as error:  # what all of them share: a value of the input table out of its limits
        return [Result.failed(design, NAME, task, str(error)) for design in designs]
    fields = ImpactCollector(fmu.description).fields
    return [_result(fmu, task, design, found, place, fields) for place, design in enumerate(designs)]


def _found(fmu: Fmu, task: Task, designs: Sequence[Design], threads: int | None) -> BatchResult:
    driven = task.inputs.variables if task.inputs is not None else ()
    at_steps = [task.inputs.at(seconds(begin)) for begin, _ in task.grid] if task.inputs is not None else []
    return _batch(fmu.path).run(
        {name: [float({**task.fixed, **design.values}[name]) for design in designs] for name in _set(task, designs)},
        [seconds(task.grid.start), *(seconds(end) for _, end in task.grid)],
        [
            *_outputs(task, fmu.description),
            *_calculated_sizes(task, fmu.description),
        ],
        signals={variable.name: [float(values[variable.name]) for values in at_steps] for variable in driven},
        impacts=_MOST_IMPACTS if any(quantity.when.of_impacts for quantity in task.quantities) else 0,
        events=_MOST_EVENTS if task.events else 0,
        extremes=any(quantity.when in (When.MAX, When.MIN) for quantity in task.quantities),
        threads=threads,
    )


@cache
def _batch(path: Path) -> Batch:
    return Batch.of_fmu(path)


def _set(task: Task, designs: Sequence[Design]) -> list[str]:
    """Names of the variables that the task or the designs set."""
    return list(dict.fromkeys([*task.fixed, *(name for design in designs for name in design.values)]))


def _outputs(task: Task, description: Description) -> list[str]:
    """Names of the outputs and calculated parameters among the quantities; what is set is known without a run."""
    names = [quantity.name for quantity in task.quantities if not quantity.when.of_impacts]
    return [name for name in dict.fromkeys(names) if not description.variable(name).settable]


def _result(
    fmu: Fmu, task: Task, design: Design, found: BatchResult, place: int, fields: Mapping[str, Variable]
) -> Result:
    """What a design has given; `fields` of an impact are the FMU's."""
    if found.failures[place]:
        return Result.failed(design, NAME, task, found.failures[place])
    struck = int(found.impact_count[place])
    if struck > _MOST_IMPACTS and any(quantity.when.of_impacts for quantity in task.quantities):
        return by_fmu.run_designs(fmu, task, [design])[0]
    try:
        asked = of_impacts(
            task,
            _impacts(fields, found, place, struck),
            struck_in(task, fmu.description),
            {
                name: _value(fmu.description, task, design, _parameter(name), found, place)
                for name in _sizes(task, fmu.description)
            },
        )
    except FmuError as error:
        return Result.failed(design, NAME, task, str(error))
    except Exception as error:  # as by_fmu: the others are to run
        return Result.failed(design, NAME, task, f"{type(error).__name__}: {error}")
    values = tuple(
        asked[quantity.column]
        if quantity.when.of_impacts
        else _value(fmu.description, task, design, quantity, found, place)
        for quantity in task.quantities
    )
    events = found.events[place] if task.events else None
    return Result(design.number, NAME, values, None, found.warnings[place] or None, events)


def _value(
    description: Description, task: Task, design: Design, quantity: Quantity, found: BatchResult, place: int
) -> Value:
    """A quantity that is not about impacts."""
    variable = description.variable(quantity.name)
    if variable.settable:
        return _typed(_of_set(variable, task, design, quantity.when), variable)
    columns = {When.MAX: found.greatest, When.MIN: found.least}.get(quantity.when, found.values)
    return _typed(float(columns[quantity.name][place]), variable)


def _of_set(variable: Variable, task: Task, design: Design, when: When) -> float:
    """A parameter, or an input: the value that it has been given."""
    if task.inputs is not None and variable in task.inputs.variables:
        values = [float(task.inputs.at(seconds(begin))[variable.name]) for begin, _ in task.grid]
        return {When.MAX: max, When.MIN: min}.get(when, lambda held: held[-1])(values)
    given = {**task.fixed, **design.values}.get(variable.name)
    return float(_started(variable) if given is None else given)


def _started(variable: Variable) -> float:
    text = variable.start or "0"
    return float(text in ("true", "1")) if variable.type == "Boolean" else float(text)


def _impacts(fields: Mapping[str, Variable], found: BatchResult, place: int, struck: int) -> Impacts:
    """The impacts of a design, as `ImpactCollector` gives them."""
    return {name: _typed_all(found.impacts[name][place, :struck], variable) for name, variable in fields.items()}


def _sizes(task: Task, description: Description) -> tuple[str, ...]:
    """The variables that hold the sizes of what is struck."""
    struck = struck_in(task, description)
    return () if struck is None else struck.variables


def _calculated_sizes(task: Task, description: Description) -> list[str]:
    """Those of them that are known by a run only."""
    return [name for name in _sizes(task, description) if not description.variable(name).settable]


def _parameter(name: str) -> Quantity:
    return Quantity(When.PARAMETER, name, "Real", "")


def _typed(number: float, variable: Variable) -> Value:
    if variable.type == "Boolean":
        return bool(number)
    return round(number) if variable.type == "Integer" else number


def _typed_all(numbers: npt.NDArray[np.float64], variable: Variable) -> npt.NDArray[Any]:
    if variable.type == "Integer":
        return np.rint(numbers).astype(np.int64)
    return numbers.astype(np.bool_ if variable.type == "Boolean" else np.float64)

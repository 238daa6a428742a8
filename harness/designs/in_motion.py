"""One of many designs, run once more to be seen: the results of a design hold no motion."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import pyarrow as pa

from ..clock import seconds
from ..description import Value
from ..drawing import read_drawing
from ..experiment import Experiment, Run, perform
from ..master import Ending, never
from ..numbers import shown
from ..observers import Observer
from ..slave import Instances
from .task import Design, Quantity, Task

#: So many pictures move smoothly; long steps are cut into one of these numbers of parts.
_FRAMES = 200
_PARTS = (1, 2, 5, 10, 20, 50, 100, 200)


@dataclass(frozen=True)
class InMotion:
    """A design to be seen.

    Attributes:
        told: which it is, and how it was run; or why none is shown.
        run: of the design; None when none is shown.
    """

    told: str
    run: Run | None = None


def in_motion(
    fmu: Instances,
    task: Task,
    design: Design | None,
    which: str,
    observers: Sequence[Observer] = (),
    stop_requested: Callable[[], bool] = never,
) -> InMotion | None:
    """Run a design once more, with everything recorded; None when the FMU has no drawing.

    Whatever happens is told, and no error: the results that a report is about are there without it.

    Args:
        fmu: that ran the designs.
        task: of the designs.
        design: with a result; None when there is no such design.
        which: design this is among all, for people.
        observers: look on.
        stop_requested: asked before each step; what there is then is shown.
    """
    drawing = read_drawing(fmu.folder, fmu.description)
    if not drawing.shapes:
        return InMotion(drawing.objection) if drawing.objection else None
    if design is None:
        return InMotion("No design ran to its end, so there is none to be seen in motion.")
    values = [f"{name} = {shown(value, name, fmu.description, digits=6)}" for name, value in design.values.items()]
    told = f"Design {design.number}, {which}: {', '.join(values)}."
    step = _step(task)
    experiment = Experiment(seconds(task.grid.stop), step, {**task.fixed, **design.values}, material=task.material)
    try:
        run = perform(fmu, experiment, observers=observers, stop_requested=stop_requested, inputs=task.inputs)
    except Exception as error:  # a picture is not worth a report
        return InMotion(f"{told} It failed when it was run once more, to be seen here: {error}")
    if run.outcome.error is not None:
        return InMotion(f"{told} It failed when it was run once more, to be seen here: {run.outcome.error}", run)
    stopped = "" if run.outcome.ending is Ending.COMPLETED else f", and stopped at {run.outcome.final_time:g} s"
    return InMotion(f"{told} It was run once more, to be seen here, in steps of {step:g} s{stopped}.", run)


def design_with_largest(quantity: Quantity, designs: Sequence[Design], results: pa.Table) -> tuple[Design | None, str]:
    """The design with the largest value of a quantity, of equals the first, and what to say of it.

    Without any value the first design that did not fail; None when all did.
    """
    by_number = {design.number: design for design in designs}
    rows = zip(
        results["design"].to_pylist(), results["status"].to_pylist(), results[quantity.column].to_pylist(), strict=True
    )
    good = [(number, value) for number, status, value in rows if status == "ok"]
    if not good:
        return None, ""
    number, value = max(good, key=lambda pair: _rank(pair[1]))
    which = f"the one with the largest {quantity.column} of all" if _rank(value) > -math.inf else "the first"
    return by_number[number], which


def _rank(value: Value | None) -> float:
    return -math.inf if value is None or math.isnan(float(value)) else float(value)


def _step(task: Task) -> float:
    """The communication step [s] for a picture.

    Impacts are located inside a step, so a sweep's steps may be long. Signals of a table are held for a step: with
    them it stays as it is.
    """
    if task.inputs is not None:
        return seconds(task.grid.step)
    parts = next(parts for parts in _PARTS if parts * len(task.grid) >= _FRAMES)
    return seconds(max(task.grid.step // parts, 1))

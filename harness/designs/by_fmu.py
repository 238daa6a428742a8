"""Backend `fmu`: a design simulated by FMI calls; and one design run once more, to be shown in motion."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import pyarrow as pa

from ..analysis.impacts import ImpactCollector
from ..errors import FmuError
from ..fmu import Fmu
from ..fmu.description import Description, Value
from ..fmu.instances.message_log import discard_message
from ..fmu.interface import Instances, Observable
from ..fmu.values import shown
from ..run.drawing import read_drawing
from ..run.experiment import Experiment, Run, perform
from ..run.master import Ending, Observer, never, run_fixed_step, seconds
from .task import Design, Quantity, Result, Task, When, columns_of, of_impacts, struck_in

# The way of a design through the FMU, by its FMI calls.

NAME = "fmu"
#: A line of the log in which FMUs of mechanisms name an event.
_EVENT = re.compile(r"Event (.+?) at t = ")


def run_designs(fmu: Fmu, task: Task, designs: Sequence[Design]) -> list[Result]:
    """Run designs one after the other, each with a new instance of the FMU.

    A design that fails gives a result that says why. Only what the task asks for is looked at: so a design takes half
    the time that `experiment.perform` takes, and its numbers are the same.
    """
    return [_run(fmu, task, design) for design in designs]


def _run(fmu: Fmu, task: Task, design: Design) -> Result:
    reader = _Reader(task, fmu.description)
    impacts = ImpactCollector(fmu.description)
    try:
        with fmu.instantiate(fmu.description.model, discard_message) as slave:
            values = {**task.fixed, **design.values}
            outcome = run_fixed_step(slave, task.grid, values, [reader], task.inputs, collectors=[impacts])
            events = tuple(line[1] for message in slave.messages if (line := _EVENT.match(message.text)))
            said = [message.text.strip() for message in slave.messages if message.needs_attention]
        if outcome.error is not None:
            return Result.failed(design, NAME, task, str(outcome.error))
        kept = {**reader.found(), **_of_impacts(task, impacts, reader)}
    except FmuError as error:
        return Result.failed(design, NAME, task, str(error))
    except Exception as error:  # whatever a design does, the others are to run
        return Result.failed(design, NAME, task, f"{type(error).__name__}: {error}")
    found = tuple(kept[quantity.column] for quantity in task.quantities)
    warnings = "\n".join(dict.fromkeys(said)) or None
    return Result(design.number, NAME, found, None, warnings, events if task.events else None)


class _Reader:
    """An observer that keeps what the task asks for, besides impacts."""

    def __init__(self, task: Task, description: Description) -> None:
        names: dict[When, list[str]] = {when: [] for when in When}
        for quantity in task.quantities:
            names[quantity.when].append(quantity.name)
        self._names = names
        self.struck = struck_in(task, description)
        self._extremes = list(dict.fromkeys(names[When.MAX] + names[When.MIN]))
        self._largest: list[Value] = []
        self._smallest: list[Value] = []
        self._end: list[Value] = []
        self._parameters: list[Value] = []
        self.sizes: dict[str, Value] = {}

    def started(self, unit: Observable, time: float) -> None:
        self._parameters = unit.get(self._names[When.PARAMETER])
        names = self.struck.variables if self.struck is not None else ()
        self.sizes = dict(zip(names, unit.get(names), strict=True))
        self._end = unit.get(self._names[When.END])
        self._largest = self._smallest = unit.get(self._extremes)

    def stepped(self, unit: Observable, time: float) -> None:
        self._end = unit.get(self._names[When.END])
        if self._extremes:
            now = unit.get(self._extremes)
            self._largest = [max(pair) for pair in zip(self._largest, now, strict=True)]
            self._smallest = [min(pair) for pair in zip(self._smallest, now, strict=True)]

    def found(self) -> dict[str, Value | None]:
        """By column."""
        largest = dict(zip(self._extremes, self._largest, strict=True))
        smallest = dict(zip(self._extremes, self._smallest, strict=True))
        groups = {
            When.END: dict(zip(self._names[When.END], self._end, strict=True)),
            When.MAX: {name: largest[name] for name in self._names[When.MAX]},
            When.MIN: {name: smallest[name] for name in self._names[When.MIN]},
            When.PARAMETER: dict(zip(self._names[When.PARAMETER], self._parameters, strict=True)),
        }
        return {f"{when}.{name}": value for when, values in groups.items() for name, value in values.items()}


def _of_impacts(task: Task, impacts: ImpactCollector, reader: _Reader) -> dict[str, Value | None]:
    """What is asked of the impacts, by column.

    Raises:
        FmuError: impacts were lost, or the FMU reports a beam that cannot be.
    """
    if not any(quantity.when.of_impacts for quantity in task.quantities):
        return {}
    if impacts.lost:
        raise FmuError(
            f"{impacts.lost} impacts did not fit into the FMU's buffer of one communication step; choose a smaller "
            "run.step."
        )
    return of_impacts(task, columns_of(impacts.table()), reader.struck, reader.sizes)


# One of many designs, run once more to be seen: the results of a design hold no motion.

#: So many pictures move smoothly; long steps are cut into one of these numbers of parts.
_FRAMES = 200
_PARTS = (1, 2, 5, 10, 20, 50, 100, 200)


@dataclass(frozen=True)
class InMotion:
    """A design to be seen.

    Attributes:
        caption: which it is, and how it was run; or why none is shown.
        run: of the design; None when none is shown.
    """

    caption: str
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

    Whatever happens is in the caption, and no error: the results that a report is about are there without it.

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
    caption = f"Design {design.number}, {which}: {', '.join(values)}."
    step = _step(task)
    experiment = Experiment(seconds(task.grid.stop), step, {**task.fixed, **design.values}, material=task.material)
    try:
        run = perform(fmu, experiment, observers=observers, stop_requested=stop_requested, inputs=task.inputs)
    except Exception as error:  # a picture is not worth a report
        return InMotion(f"{caption} It failed when it was run once more, to be seen here: {error}")
    if run.outcome.error is not None:
        return InMotion(f"{caption} It failed when it was run once more, to be seen here: {run.outcome.error}", run)
    stopped = "" if run.outcome.ending is Ending.COMPLETED else f", and stopped at {run.outcome.final_time:g} s"
    return InMotion(f"{caption} It was run once more, to be seen here, in steps of {step:g} s{stopped}.", run)


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

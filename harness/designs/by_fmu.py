"""The way of a design through the FMU, by its FMI calls."""

from __future__ import annotations

from collections.abc import Sequence

from ..description import Description, Value
from ..errors import FmuError
from ..fmu import Fmu
from ..fmu.slave import discard_message
from ..impacts import ImpactCollector
from ..master import run_fixed_step
from ..slave import Observable
from .of_impacts import of_impacts, struck_in
from .task import Design, Result, Task, When

NAME = "fmu"


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
            outcome = run_fixed_step(slave, task.grid, values, [reader, impacts], task.inputs)
            said = [message.text.strip() for message in slave.messages if message.needs_attention]
        if outcome.error is not None:
            return Result.failed(design, NAME, task, str(outcome.error))
        kept = {**reader.found(), **_of_impacts(task, impacts, reader)}
    except FmuError as error:
        return Result.failed(design, NAME, task, str(error))
    except Exception as error:  # whatever a design does, the others are to run
        return Result.failed(design, NAME, task, f"{type(error).__name__}: {error}")
    found = tuple(kept[quantity.column] for quantity in task.quantities)
    return Result(design.number, NAME, found, None, "\n".join(dict.fromkeys(said)) or None)


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
    return of_impacts(task, impacts.table(), reader.struck, reader.sizes)

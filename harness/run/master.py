"""The master algorithm: it alone moves time forward, in whole nanoseconds, and observers look on."""

from __future__ import annotations

import math
from array import array
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Protocol

import numpy as np
import pandas as pd

from ..errors import FmuError, HarnessError, UsageError
from ..fmu.description import Description, Value, Variable
from ..fmu.interface import Instance, Observable
from .division import Division, HeldMessages
from .inputs import InputSignals

# Time as a whole number of nanoseconds, so that it never drifts.

#: Nanoseconds in a second.
SECOND = 10**9

#: Beyond this the conversion to seconds would lose nanoseconds: about 104 days.
_LONGEST = 2**53


def nanoseconds(seconds: float, what: str) -> int:
    """A time rounded to whole nanoseconds; `what` names it in the message.

    Raises:
        UsageError: not finite, negative, or too long.
    """
    if not math.isfinite(seconds) or seconds < 0.0:
        raise UsageError(f"The {what} is {seconds:g} s; give a finite time that is not negative.")
    if seconds * SECOND > _LONGEST:
        raise UsageError(f"The {what} is {seconds:g} s; the clock counts nanoseconds up to {_LONGEST / SECOND:.0f} s.")
    return round(seconds * SECOND)


def seconds(time: int) -> float:
    """A time in nanoseconds as the nearest number of seconds."""
    return time / SECOND


def begin_and_size(begin: int, end: int) -> tuple[float, float]:
    """A step from `begin` to `end` [ns] as FMUs are asked for it: where it begins, and its size [s].

    The size is the difference of the two rounded instants, so that begin + size is where the next step begins.
    """
    time = begin / SECOND
    return time, end / SECOND - time


@dataclass(frozen=True)
class TimeGrid:
    """Equal communication steps from start to stop [ns]; the last one is shortened to end exactly at stop.

    Attributes:
        start: of the run [ns].
        stop: of the run [ns], later than `start`.
        step: from one communication point to the next [ns], > 0.
    """

    start: int
    stop: int
    step: int

    @classmethod
    def of(cls, stop_time: float, step: float, start_time: float = 0.0) -> TimeGrid:
        """The grid for times in seconds.

        Args:
            stop_time: [s], later than `start_time`.
            step: [s], one nanosecond or more.
            start_time: [s], not negative.

        Raises:
            UsageError: a time that is impossible, a step below a nanosecond, or a stop before the start.
        """
        grid = cls(
            nanoseconds(start_time, "start time"), nanoseconds(stop_time, "stop time"), nanoseconds(step, "step")
        )
        if grid.step == 0:
            raise UsageError(f"The step is {step:g} s; give at least one nanosecond (1e-9 s).")
        if grid.stop <= grid.start:
            raise UsageError(f"The stop time {stop_time:g} s must be later than the start time {start_time:g} s.")
        return grid

    @property
    def even(self) -> bool:
        """Whether all steps are of one size."""
        return len(self) == 1 or (self.stop - self.start) % self.step == 0

    def __len__(self) -> int:
        return -(-(self.stop - self.start) // self.step)

    def __iter__(self) -> Iterator[tuple[int, int]]:
        """Begin and end of every step [ns]."""
        for begin in range(self.start, self.stop, self.step):
            yield begin, min(begin + self.step, self.stop)


# What looks on while a unit is simulated.


class Observer(Protocol):
    """Called by the master at communication points."""

    def started(self, unit: Observable, time: float) -> None:
        """After the initialization, at the start time [s].

        Args:
            unit: that is simulated.
            time: of the start [s].
        """

    def stepped(self, unit: Observable, time: float) -> None:
        """After every completed step, at its end [s].

        Args:
            unit: that is simulated.
            time: that is reached [s].
        """


# Recording of variables at every communication point.

_DTYPES = {"Real": "float64", "Integer": "int64", "Boolean": "bool"}
#: Integers of 64 bits, which a double cannot hold, with the code of their array and their type in the table.
_WIDE = {"Int64": ("q", "int64"), "UInt64": ("Q", "uint64"), "Enumeration": ("q", "int64")}


def recorded_variables(description: Description) -> list[Variable]:
    """All inputs and outputs that are numbers, without arrays: the buffered impacts have their own table.

    What ticks by a clock is left out: it has no value at a communication point (`Variable.in_event_mode_only`).

    Args:
        description: of what is simulated.
    """
    return [
        variable
        for variable in description.of("input", "output")
        if variable.type in _DTYPES and "[" not in variable.name
    ]


class Recorder:
    """An observer that keeps variables at every communication point, 8 bytes each.

    Args:
        variables: that are kept, all of them numbers.
    """

    def __init__(self, variables: list[Variable]) -> None:
        self._variables = variables
        self._names = tuple(variable.name for variable in variables)
        self._numbers = array("d")
        self._wide = {
            place: array(_WIDE[variable.fmi_type][0])
            for place, variable in enumerate(variables)
            if variable.fmi_type in _WIDE
        }

    def started(self, unit: Observable, time: float) -> None:
        """Keep the initial values.

        Args:
            unit: that is simulated.
            time: of the start [s].
        """
        self.stepped(unit, time)

    def stepped(self, unit: Observable, time: float) -> None:
        """Keep the values at the end of a step.

        Args:
            unit: that is simulated.
            time: that is reached [s].
        """
        self._numbers.append(time)
        values = unit.get(self._names)
        self._numbers.extend(map(float, values))
        for place, numbers in self._wide.items():
            numbers.append(int(values[place]))

    def table(self) -> pd.DataFrame:
        """One row for each communication point: `time` [s], then the variables by name, in their units."""
        numbers = np.array(self._numbers).reshape(-1, 1 + len(self._names))
        exact = {
            self._names[place]: np.array(values, dtype=_WIDE[self._variables[place].fmi_type][1])
            for place, values in self._wide.items()
        }
        # column by column: pandas takes ten times as long to convert the types of a table
        types = ["float64", *(_DTYPES[variable.type] for variable in self._variables)]
        columns = zip(["time", *self._names], numbers.T, types, strict=True)
        table = {name: column.astype(kind) for name, column, kind in columns if name not in exact}
        return pd.DataFrame({name: exact.get(name, table.get(name)) for name in ["time", *self._names]})


class Ending(Enum):
    """How a run ended."""

    COMPLETED = "completed"
    INTERRUPTED = "interrupted"
    FAILED = "failed"


@dataclass(frozen=True)
class Outcome:
    """How far a run came.

    Attributes:
        ending: why it ended.
        final_time: last communication point that was reached [s].
        steps: number of steps completed.
        error: what the FMU refused, or else why it could not go on, when it failed.
        divided: how many of the steps were taken in parts (`division`).
    """

    ending: Ending
    final_time: float
    steps: int
    error: HarnessError | None = None
    divided: int = 0


def never() -> bool:
    """No request to stop: the run goes on."""
    return False


def run_fixed_step(
    slave: Instance,
    grid: TimeGrid,
    start_values: Mapping[str, Value],
    observers: Sequence[Observer] = (),
    inputs: InputSignals | None = None,
    stop_requested: Callable[[], bool] = never,
    collectors: Sequence[Observer] = (),
    messages: HeldMessages | None = None,
) -> Outcome:
    """Set the start values of `slave`, initialize it, and take it through the grid.

    Inputs are set at the beginning of each step and stay constant in it. A step with more impacts or events than the
    FMU's buffers hold is taken in parts, where the FMU can be put back (`division`). An error of the slave ends the
    run, and everything observed before it stays with the observers. "Completed" means that the stop time was reached.

    Args:
        slave: to be run.
        grid: of communication points.
        start_values: of inputs and parameters by name.
        observers: look on at the points of the grid.
        inputs: signals.
        stop_requested: asked before each step.
        collectors: look on at the ends of parts, too.
        messages: the receiver of the slave's messages.
    """
    reached, steps = grid.start, 0
    division = Division(slave, messages)
    everybody = [*observers, *collectors]
    try:
        slave.set(start_values if inputs is None else {**start_values, **inputs.at(seconds(grid.start))})
        slave.initialize(seconds(grid.start), seconds(grid.stop))
        for observer in everybody:
            observer.started(slave, seconds(grid.start))
        for begin, end in grid:
            if stop_requested():
                break
            if inputs is not None:
                slave.set(inputs.at(seconds(begin)))
            for time in division.take(*begin_and_size(begin, end)):
                for collector in collectors:
                    collector.stepped(slave, time)
            reached, steps = end, steps + 1
            for observer in everybody:
                observer.stepped(slave, seconds(end))
        division.close()
        slave.terminate()
    except FmuError as error:
        return Outcome(Ending.FAILED, seconds(reached), steps, error, division.divided)
    ending = Ending.COMPLETED if reached == grid.stop else Ending.INTERRUPTED
    return Outcome(ending, seconds(reached), steps, None, division.divided)

"""The master algorithm: it alone moves time forward."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum

from .clock import TimeGrid, begin_and_size, seconds
from .description import Value
from .errors import FmuError, HarnessError
from .inputs import InputSignals
from .observers import Observer
from .slave import Slave


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
    """

    ending: Ending
    final_time: float
    steps: int
    error: HarnessError | None = None


def never() -> bool:
    """Nobody asks the run to stop."""
    return False


def run_fixed_step(
    slave: Slave,
    grid: TimeGrid,
    start_values: Mapping[str, Value],
    observers: Sequence[Observer] = (),
    inputs: InputSignals | None = None,
    stop_requested: Callable[[], bool] = never,
) -> Outcome:
    """Set the start values of `slave`, initialize it, and take it through the grid.

    Inputs are set at the beginning of each step and stay constant in it. An error of the slave ends the run, and
    everything observed before it stays with the observers. "Completed" means that the stop time was reached.
    """
    reached, steps = grid.start, 0
    try:
        slave.set(start_values if inputs is None else {**start_values, **inputs.at(seconds(grid.start))})
        slave.initialize(seconds(grid.start), seconds(grid.stop))
        for observer in observers:
            observer.started(slave, seconds(grid.start))
        for begin, end in grid:
            if stop_requested():
                break
            if inputs is not None:
                slave.set(inputs.at(seconds(begin)))
            slave.step(*begin_and_size(begin, end))
            reached, steps = end, steps + 1
            for observer in observers:
                observer.stepped(slave, seconds(end))
        slave.terminate()
    except FmuError as error:
        return Outcome(Ending.FAILED, seconds(reached), steps, error)
    ending = Ending.COMPLETED if reached == grid.stop else Ending.INTERRUPTED
    return Outcome(ending, seconds(reached), steps)

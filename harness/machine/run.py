"""A machine from start to stop."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from ..clock import TimeGrid, seconds
from ..description import Value
from ..errors import FmuError
from ..inputs import InputSignals
from ..master import Ending, Outcome, never
from ..observers import Observer
from .algorithms.base import Algorithm
from .machine import Machine
from .watched import Watched


def run_machine(
    machine: Machine,
    algorithm: Algorithm,
    grid: TimeGrid,
    start_values: Mapping[str, Value],
    observers: Sequence[Observer] = (),
    inputs: InputSignals | None = None,
    stop_requested: Callable[[], bool] = never,
) -> Outcome:
    """Set start values, initialize, and take a machine through the grid; an algorithm may make more steps of one.

    An error of a component ends the run, and everything observed before it stays with the observers; what was seen in a
    step that not all parts have completed has not happened.
    """
    reached, steps = grid.start, 0
    machine.point = 0
    watched = [part.component for part in machine.parts.values() if isinstance(part.component, Watched)]
    try:
        machine.set(start_values if inputs is None else {**start_values, **inputs.at(seconds(grid.start))})
        if inputs is not None:
            machine.drive(inputs, grid.start)
        machine.initialize(seconds(grid.start), seconds(grid.stop))
        for observer in observers:
            observer.started(machine, seconds(grid.start))
        for number, (_, end) in enumerate(grid, start=1):
            while reached < end and not stop_requested():
                memories = [one.memories() for one in watched]
                try:
                    reached = algorithm.advance(machine, reached, end)
                except FmuError:
                    for one, memory in zip(watched, memories, strict=True):
                        one.recall(memory)
                    raise
                machine.point = number if reached == end else None
                steps += 1
                for observer in observers:
                    observer.stepped(machine, seconds(reached))
            if reached < end:
                break
        machine.terminate()
    except FmuError as error:
        return Outcome(Ending.FAILED, seconds(reached), steps, error)
    finally:
        machine.free_states()
    ending = Ending.COMPLETED if reached == grid.stop else Ending.INTERRUPTED
    return Outcome(ending, seconds(reached), steps)

"""By which ways designs can run."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from ..fmu import Fmu
from . import by_fmu
from .task import Design, Result, Task


@dataclass(frozen=True)
class Way:
    """One way of running designs.

    Attributes:
        name: what the results call it.
        run: runs some designs and gives a result for each; called in worker processes, so it must be importable there.
        together: how many designs are given to one call.
    """

    name: str
    run: Callable[[Fmu, Task, Sequence[Design]], list[Result]]
    together: int = 1


BY_FMU = Way(by_fmu.NAME, by_fmu.run_designs)
#: Designs for one compiled call: whoever kills the command waits for, or loses, no more than these.
_TOGETHER = 64


def fast_way(fmu: Fmu, task: Task, designs: Sequence[Design]) -> Way | None:
    """The way of many designs in one compiled call over threads; None where the FMU or the task does not allow it."""
    from . import by_batch  # which brings the engine, and processes that run FMUs do without

    if not designs or not by_batch.can_run(fmu, task, designs[0]):
        return None
    return Way(by_batch.NAME, by_batch.run_designs, _TOGETHER)

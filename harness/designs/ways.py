"""By which ways designs can run."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

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


def by_batch_in(threads: int | None) -> Way:
    """The way of many designs in one call, in so many threads; None: as many as there are processors."""
    from . import by_batch  # the engine's way in, which takes a moment to load

    return Way(by_batch.NAME, partial(by_batch.run_designs, threads=threads), by_batch.TOGETHER)

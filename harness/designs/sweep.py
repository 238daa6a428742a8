"""A sweep: the designs that are not there yet, run by whoever there is, kept as they come."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import pyarrow as pa

from ..master import never
from .store import Store, failures
from .sweep_file import Sweep
from .workers import Crew


@dataclass(frozen=True)
class Progress:
    """How far a sweep has come.

    Attributes:
        total: designs.
        earlier: of them were there when it began.
        done: of them are there now.
        failed: of those that are there.
    """

    total: int
    earlier: int
    done: int
    failed: int

    @property
    def complete(self) -> bool:
        """Whether nothing is left to do."""
        return self.done == self.total


def perform_sweep(
    sweep: Sweep,
    store: Store,
    crew: Crew,
    on_progress: Callable[[Progress], None],
    stop_requested: Callable[[], bool] = never,
) -> tuple[Progress, pa.Table]:
    """Run what is left of a sweep, and return how far it is, and all results.

    Raises:
        UsageError: the disk refuses.
        HarnessError: the workers are lost.
    """
    table = store.results()
    there = set(table["design"].to_pylist())
    progress = Progress(len(sweep.designs), len(there), len(there), len(failures(table)))
    on_progress(progress)
    left = (design for design in sweep.designs if design.number not in there)
    for pairs in crew(left, stop_requested):
        store.append(pairs)
        failed = sum(result.failure is not None for _, result in pairs)
        progress = Progress(progress.total, progress.earlier, progress.done + len(pairs), progress.failed + failed)
        on_progress(progress)
    return progress, store.finish() if progress.complete else store.results()

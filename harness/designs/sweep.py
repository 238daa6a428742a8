"""Parameter sweep: its file, its design points (grid, Latin hypercube, Sobol), and the run of those still missing."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
import pyarrow as pa

from ..fmu.description import Description
from ..run.master import never
from ..toml_file import TomlFile
from .store import Store, failures
from .task import MOST_DESIGNS, Design, Task, recorded, with_slenderness
from .variation import Axis, axes, shared
from .workers import Executor

# The list of designs: the same file always gives the same list.

#: Points in the unit cube: number of points, number of axes, seed -> shape (points, axes), all in [0, 1).
_Sampler = Callable[[int, int, int], npt.NDArray[np.float64]]


def grid(axes: Sequence[Axis]) -> list[Design]:
    """Every value with every other; the last axis goes first."""
    combinations = itertools.product(*(axis.grid for axis in axes))
    return [
        Design(number, dict(zip([axis.name for axis in axes], values, strict=True)))
        for number, values in enumerate(combinations, start=1)
    ]


def sampled(axes: Sequence[Axis], method: str, count: int, seed: int) -> list[Design]:
    """`count` designs by one of `METHODS`."""
    points = METHODS[method](count, len(axes), seed)
    return [
        Design(number, {axis.name: axis.at(float(x)) for axis, x in zip(axes, point, strict=True)})
        for number, point in enumerate(points, start=1)
    ]


def _random(count: int, axes: int, seed: int) -> npt.NDArray[np.float64]:
    return np.random.default_rng(seed).random((count, axes))


def _latin_hypercube(count: int, axes: int, seed: int) -> npt.NDArray[np.float64]:
    from scipy.stats import qmc  # takes a second to load

    return np.asarray(qmc.LatinHypercube(axes, rng=np.random.default_rng(seed)).random(count))


def _sobol(count: int, axes: int, seed: int) -> npt.NDArray[np.float64]:
    """The first of a sequence whose length is a power of 2, for which alone it is balanced."""
    from scipy.stats import qmc  # takes a second to load

    whole = math.ceil(math.log2(count)) if count > 1 else 0
    return np.asarray(qmc.Sobol(axes, rng=np.random.default_rng(seed)).random_base2(whole))[:count]


METHODS: dict[str, _Sampler] = {"random": _random, "latin_hypercube": _latin_hypercube, "sobol": _sobol}


# The file of a sweep, checked as a whole.

_GRID = "grid"
TABLES = ("title", "fmu", "run", "set", "sweep", "vary", "record")


@dataclass(frozen=True)
class Sweep:
    """What a file asks for.

    Attributes:
        title: for people.
        task: what is done with each design.
        axes: what is varied.
        method: how designs are chosen.
        seed: of what is random in it; 0 in a grid.
        designs: all of them.
    """

    title: str
    task: Task
    axes: tuple[Axis, ...]
    method: str
    seed: int
    designs: Sequence[Design]

    @property
    def how(self) -> tuple[str, Mapping[str, Any]]:
        """What besides the axes decides which designs there are, for the `identity`."""
        return "sweep", {"method": self.method, "count": len(self.designs), "seed": self.seed}


def read_sweep(file: TomlFile, description: Description) -> Sweep:
    """The sweep of a file for an FMU.

    Raises:
        UsageError: mistakes in the file, all of them.
    """
    title, running, fixed = shared(file, TABLES, description, ("optimise", "an optimum"))
    section = file.section("sweep", why='write [sweep] and below it method = "latin_hypercube" and count = 64')
    method = section.choice("method", (_GRID, *METHODS), needed='write e.g. method = "latin_hypercube"')
    by_grid = method == _GRID
    wants_count = "write how many designs there shall be, as in count = 64" if method and not by_grid else ""
    count = section.whole("count", least=1, most=MOST_DESIGNS, needed=wants_count)
    seed = section.whole("seed", least=0)
    if by_grid:
        for name in ("count", "seed"):
            if name in section.table:
                section.wrong(name, "does not go with a grid, which has every value with every other")
    section.done()
    varied = axes(file, description, running.inputs, list(fixed), grid=by_grid if method else None)
    if by_grid and (together := math.prod(len(axis.grid) for axis in varied)) > MOST_DESIGNS:
        section.wrong(
            "method", f"= '{_GRID}' makes {together:,} designs, more than {MOST_DESIGNS:,}; take fewer values"
        )
    record = file.section("record", why='write [record] and below it e.g. end = ["wheel_angle"]')
    quantities = recorded(record, description)
    if record.given and not any(record.table.values()):
        file.wrong(("record",), 'is empty; write what to keep of each design, as in end = ["wheel_angle"]')
    file.check()
    assert running.grid is not None  # otherwise there were mistakes
    assert method is not None
    designs = grid(varied) if by_grid else sampled(varied, method, count or 1, seed or 0)
    return Sweep(
        title,
        Task(running.grid, fixed, running.inputs, with_slenderness(quantities, description), running.material),
        tuple(varied),
        method,
        seed or 0,
        designs,
    )


# Between which values a quantity lies, and in which designs it has them.


def range_cells(values: npt.NDArray[np.float64], numbers: Sequence[int]) -> list[str]:
    """Smallest value, its design, largest value, its design, as text; "" each where there is no value at all.

    Args:
        values: of the quantity, NaN where there is none, shape (designs,).
        numbers: of the designs; of equal values the first counts.
    """
    there = np.flatnonzero(~np.isnan(values))
    if not there.size:
        return [""] * 4
    places = (there[np.argmin(values[there])], there[np.argmax(values[there])])
    return [text for place in places for text in (f"{values[place]:.6g}", str(numbers[place]))]


# A sweep: the designs that are not there yet, run by whoever there is, kept as they come.


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
    executor: Executor,
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
    for pairs in executor(left, stop_requested):
        store.append(pairs)
        failed = sum(result.failure is not None for _, result in pairs)
        progress = Progress(progress.total, progress.earlier, progress.done + len(pairs), progress.failed + failed)
        on_progress(progress)
    return progress, store.finish() if progress.complete else store.results()

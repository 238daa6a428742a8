"""The file of a sweep, checked as a whole."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ..description import Description
from ..toml_file import TomlFile
from . import sampling
from .plan import shared
from .quantities import recorded, with_slenderness
from .task import MOST_DESIGNS, Design, Task
from .variation import Axis, axes

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
    if "optimise" in file.data:
        file.wrong(("optimise",), f"belongs to an optimum: mechanism-fmu optimise {file.path}")
        file.check()
    title, running, fixed = shared(file, TABLES, description)
    section = file.section("sweep", why='write [sweep] and below it method = "latin_hypercube" and count = 64')
    method = section.choice("method", (_GRID, *sampling.METHODS), needed='write e.g. method = "latin_hypercube"')
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
    designs = sampling.grid(varied) if by_grid else sampling.sampled(varied, method, count or 1, seed or 0)
    return Sweep(
        title,
        Task(running.grid, fixed, running.inputs, with_slenderness(quantities, description), running.material),
        tuple(varied),
        method,
        seed or 0,
        designs,
    )

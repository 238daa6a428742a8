"""Who runs the designs: this process (`here`), or some of this machine's (`worker_processes`)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from time import perf_counter

from ..fmu import Fmu
from ..master import never
from .task import Design, Result, Task
from .ways import Way

#: Designs with their results, as they came back together.
Pairs = list[tuple[Design, Result]]

#: Runs designs and yields what has come, as soon as it has; begins no more once it is asked to stop.
Crew = Callable[[Iterable[Design], Callable[[], bool]], Iterator[Pairs]]

#: What is lost at most when this process is killed, unless a single design takes longer [s].
_PORTION = 0.5


@dataclass(frozen=True)
class Work:
    """What a worker needs to know once.

    Attributes:
        fmu: extracted where the worker can read it.
        task: of every design.
        way: by which they run.
    """

    fmu: Fmu
    task: Task
    way: Way

    def run(self, designs: Sequence[Design]) -> Pairs:
        """Some designs with their results."""
        return list(zip(designs, self.way.run(self.fmu, self.task, designs), strict=True))


def portions(designs: Iterable[Design], size: int) -> Iterator[list[Design]]:
    """The designs, so many at a time."""
    rest = iter(designs)
    while portion := list(islice(rest, size)):
        yield portion


def here(work: Work, designs: Iterable[Design], stop_requested: Callable[[], bool] = never) -> Iterator[Pairs]:
    """Run designs in this process, in portions that take half a second or so: that much work is lost by a kill."""
    rest, size = iter(designs), 1
    while portion := list(islice(rest, size)):
        if stop_requested():
            return
        began = perf_counter()
        done = work.run(portion)
        good = sum(result.failure is None for _, result in done)
        if good:  # what fails at once says nothing about how long the others take
            fitting = int(_PORTION * good / (perf_counter() - began))
            size = max(1, min(fitting, 2 * size, work.way.together))
        yield done

"""Who runs the designs: this process, or some of this machine's."""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from itertools import islice
from time import perf_counter

from ..fmu import Fmu
from ..master import never
from ..processes import serve_only, starting_from
from .task import Design, Result, Task
from .ways import Way

#: Designs with their results, as they came back together.
Pairs = list[tuple[Design, Result]]

#: Runs designs and yields what has come, as soon as it has; begins no more once it is asked to stop.
Crew = Callable[[Iterable[Design], Callable[[], bool]], Iterator[Pairs]]

#: What is lost at most when this process is killed, unless a single design takes longer [s].
_PORTION = 0.5

_CRASHED = (
    "The process that ran it ended without a word, twice: the FMU crashed it, or it was killed, perhaps because the "
    "memory was full."
)


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


class Processes:
    """Processes of this machine, to be used in a `with`; they are started when the first designs come.

    When a process dies, those designs that might have been its victims run again, each in a process of its own; one
    that kills this, too, has failed. All others go on.
    """

    def __init__(self, work: Work, count: int) -> None:
        self._work, self._count = work, count
        self._pool: ProcessPoolExecutor | None = None

    def __enter__(self) -> Processes:
        return self

    def __exit__(self, *_: object) -> None:
        self._end()

    def run(self, designs: Iterable[Design], stop_requested: Callable[[], bool] = never) -> Iterator[Pairs]:
        """Run designs; a `Crew`."""
        waiting = portions(designs, self._work.way.together)
        suspects: list[Design] = []
        more = True
        while more:
            more = yield from self._until_broken(waiting, suspects, stop_requested)
            for design in suspects:
                if not stop_requested():
                    yield _alone(self._work, design)
            suspects.clear()

    def _until_broken(
        self, waiting: Iterator[list[Design]], suspects: list[Design], stop_requested: Callable[[], bool]
    ) -> Generator[Pairs, None, bool]:
        """Run designs until all are done (then return False) or a process has died (then True).

        `waiting` is emptied from the front; each process has one portion more than it works on. The designs that were
        on their way when a process died are added to `suspects`.
        """
        running: dict[Future[Pairs], list[Design]] = {}
        whole = False
        try:
            while True:
                if not stop_requested():
                    for portion in islice(waiting, 2 * self._count - len(running)):
                        suspects += portion  # until it has been taken
                        running[self._started().submit(_run_portion, portion)] = portion
                        suspects.clear()
                if not running:
                    whole = True
                    return False
                came, _ = wait(running, return_when=FIRST_COMPLETED)
                broken = any(isinstance(future.exception(), BrokenProcessPool) for future in came)
                good = [f for f in running if f.done() and f.exception() is None] if broken else list(came)
                yield [pair for future in good for pair in future.result()]
                for future in good:
                    del running[future]
                if broken:
                    suspects += [design for portion in running.values() for design in portion]
                    return True
        except BrokenProcessPool:  # found when a portion was given to it
            suspects += [design for portion in running.values() for design in portion]
            return True
        finally:
            if not whole:
                self._end()

    def _started(self) -> ProcessPoolExecutor:
        if self._pool is None:
            self._pool = _pool(self._work, self._count)
        return self._pool

    def _end(self) -> None:
        if self._pool is not None:
            self._pool.shutdown(cancel_futures=True)
        self._pool = None


def _alone(work: Work, design: Design) -> Pairs:
    """Run one design in a process of its own."""
    with _pool(work, 1) as pool:
        try:
            return pool.submit(_run_portion, [design]).result()
        except BrokenProcessPool:
            return [(design, Result.failed(design, work.way.name, work.task, _CRASHED))]


def _pool(work: Work, count: int) -> ProcessPoolExecutor:
    """Processes that know their work; there is one for each processor."""
    pool = ProcessPoolExecutor(count, starting_from(__name__), _begin, (work,))
    # All at the first design: one that is started while another dies is overlooked, and the pool waits for it for ever.
    pool._safe_to_dynamically_spawn_children = False  # type: ignore[attr-defined]
    return pool


_work: Work | None = None


def _begin(work: Work) -> None:
    """Prepare a process."""
    global _work
    _work = work
    serve_only(work.fmu.folder)


def _run_portion(designs: list[Design]) -> Pairs:
    assert _work is not None
    return _work.run(designs)

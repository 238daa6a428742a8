"""Backends (batch, FMU) and executors of designs: this process, or worker processes of this machine."""

from __future__ import annotations

import math
import selectors
import socket
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import islice
from multiprocessing.process import BaseProcess
from time import monotonic, perf_counter
from typing import Any

from mechanism_fmu.processors import processors

from ..fmu import Fmu
from ..fmu.processes import BrokenFrameError, LateFrameError, Wire, serve_only, starting_from
from ..run.master import never
from . import by_fmu
from .task import Design, Result, Task

# By which ways designs can run.


@dataclass(frozen=True)
class Backend:
    """One way of running designs.

    Attributes:
        name: what the results call it.
        run: runs some designs and gives a result for each; called in worker processes, so it must be importable there.
        together: how many designs are given to one call.
        side_by_side: how many of them one call runs at the same time.
    """

    name: str
    run: Callable[[Fmu, Task, Sequence[Design]], list[Result]]
    together: int = 1
    side_by_side: int = 1


BY_FMU = Backend(by_fmu.NAME, by_fmu.run_designs)


def by_batch_in(threads: int | None) -> Backend:
    """The way of many designs in one call, in so many threads; None: as many as this process may use."""
    from . import by_batch  # the engine's way in, which takes a moment to load

    count = threads or processors()
    return Backend(by_batch.NAME, partial(by_batch.run_designs, threads=count), max(by_batch.TOGETHER, count), count)


# Who runs the designs: this process (`here`), or some of this machine's.

#: Designs with their results, as they came back together.
Pairs = list[tuple[Design, Result]]

#: Runs designs and yields what has come, as soon as it has; begins no more once it is asked to stop.
Executor = Callable[[Iterable[Design], Callable[[], bool]], Iterator[Pairs]]

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
    way: Backend

    def run(self, designs: Sequence[Design]) -> Pairs:
        """Some designs with their results."""
        return list(zip(designs, self.way.run(self.fmu, self.task, designs), strict=True))


def portions(designs: Iterable[Design], size: int) -> Iterator[list[Design]]:
    """The designs, so many at a time."""
    rest = iter(designs)
    while portion := list(islice(rest, size)):
        yield portion


def here(work: Work, designs: Iterable[Design], stop_requested: Callable[[], bool] = never) -> Iterator[Pairs]:
    """Run designs in this process, in portions that take half a second or so: that much work is lost by a kill.

    Each portion is as much as keeps all threads busy: a generation of a search has few designs.
    """
    least = work.way.side_by_side
    rest, size = iter(designs), least
    while portion := list(islice(rest, size)):
        if stop_requested():
            return
        began = perf_counter()
        done = work.run(portion)
        good = sum(result.failure is None for _, result in done)
        if good:  # what fails at once says nothing about how long the others take
            fitting = int(_PORTION * good / (perf_counter() - began))
            size = max(least, min(fitting, 2 * size, work.way.together) // least * least)
        yield done


# Processes of this machine that run designs.
#
# What they send is plain data, and checked (`wire`): an FMU in them can write whatever it likes.

#: A result that has begun to come must be there within [s].
_PATIENCE = 60.0
#: So long may a process take for its end [s].
_ENDING = 10.0

_CRASHED = (
    "The process that ran it ended without a word, twice: the FMU crashed it, or it was killed, perhaps because the "
    "memory was full."
)

_TYPES: dict[str, tuple[type, ...]] = {"Real": (float, int), "Integer": (int,), "Boolean": (bool,), "String": (str,)}


class Processes:
    """Processes of this machine, to be used in a `with`; they are started when the first designs come.

    When a process dies, or sends what is no result, those designs that it had been given run again, each in a process
    of its own; one that kills this, too, has failed. All others go on.
    """

    def __init__(self, work: Work, count: int) -> None:
        self._work, self._count = work, count
        self._workers: list[_Worker] = []

    def __enter__(self) -> Processes:
        return self

    def __exit__(self, *_: object) -> None:
        self._end()

    def run(self, designs: Iterable[Design], stop_requested: Callable[[], bool] = never) -> Iterator[Pairs]:
        """Run designs; an `Executor`. Each process has one portion more than it works on.

        What comes is kept back for half a second, and that much may be lost by a kill: to write down each design by
        itself would take longer than to run it.
        """
        waiting = portions(designs, self._work.way.together)
        suspects: list[Design] = []
        pairs: Pairs = []
        until = math.inf
        whole = False
        try:
            while True:
                if not stop_requested():
                    self._give(waiting, suspects)
                if any(worker.given for worker in self._workers) and (left := until - monotonic()) > 0.0:
                    if came := self._came(suspects, left):
                        pairs += came
                        until = min(until, monotonic() + _PORTION)
                elif pairs:
                    yield pairs
                    pairs, until = [], math.inf
                elif suspects and not stop_requested():
                    yield _alone(self._work, suspects.pop(0))
                else:
                    whole = True
                    return
        finally:
            if not whole:
                self._end()

    def _give(self, waiting: Iterator[list[Design]], suspects: list[Design]) -> None:
        """Give every process as much as it may have; one that is gone is replaced."""
        for round_ in (1, 2):
            for place in range(self._count):
                if len(self._workers) > place and len(self._workers[place].given) >= round_:
                    continue
                portion = next(waiting, None)
                if portion is None:
                    return
                if len(self._workers) <= place:
                    self._workers.append(_Worker(self._work))
                if not self._workers[place].give(portion):
                    suspects += self._replace(self._workers[place])

    def _came(self, suspects: list[Design], within: float) -> Pairs:
        """What has come from processes within [s], if there is any; designs of dead ones: `suspects`.

        At least one process has something to do.
        """
        pairs: Pairs = []
        for worker in _ready([worker for worker in self._workers if worker.given], within):
            done = worker.take()
            if done is None:
                suspects += self._replace(worker)
            else:
                pairs += done
        return pairs

    def _replace(self, worker: _Worker) -> list[Design]:
        """Let a process go; the designs that it was given. Another one takes its place with the next portion."""
        self._workers.remove(worker)
        worker.kill()
        return [design for portion in worker.given for design in portion]

    def _end(self) -> None:
        for worker in self._workers:
            worker.ask_to_end()
        for worker in self._workers:
            worker.end()
        self._workers.clear()


class _Worker:
    """A process, with the portions that it has been given, the oldest first."""

    def __init__(self, work: Work) -> None:
        here, there = socket.socketpair()
        context = starting_from(__name__)
        self.process: BaseProcess = context.Process(target=_serve, args=(there, work), daemon=True)  # type: ignore[attr-defined]
        self.process.start()
        there.close()
        self.wire = Wire(here, turns=False)
        self.given: deque[list[Design]] = deque()
        self._task, self._way = work.task, work.way.name

    def give(self, portion: list[Design]) -> bool:
        """Send it designs; False when it is gone."""
        self.given.append(portion)
        plain = [[design.number, {name: _plain(value) for name, value in design.values.items()}] for design in portion]
        try:
            self.wire.send(plain, limit=_PATIENCE)
        except (LateFrameError, BrokenFrameError, OSError):
            return False
        return True

    def take(self) -> Pairs | None:
        """The results of its oldest portion; None when it is gone, or has sent something else."""
        try:
            data, _ = self.wire.receive(_PATIENCE)
            results = read_results(data, self.given[0], self._task, self._way)
        except (LateFrameError, BrokenFrameError, EOFError, OSError):
            return None
        return list(zip(self.given.popleft(), results, strict=True))

    def ask_to_end(self) -> None:
        """Let it end when it has done what it has; one that has something to do is not waited for."""
        if self.given:
            self.process.kill()
            return
        try:
            self.wire.send([], limit=_ENDING)
        except (LateFrameError, OSError):
            self.process.kill()

    def end(self) -> None:
        """Wait for its end."""
        self.process.join(_ENDING)
        self.kill()

    def kill(self) -> None:
        """End it."""
        if self.process.is_alive():
            self.process.kill()
            self.process.join()
        self.wire.close()


def _ready(workers: Sequence[_Worker], within: float) -> list[_Worker]:
    """Those that have sent something, or are gone; waits for one, but no longer than so [s]."""
    if pending := [worker for worker in workers if worker.wire.pending]:
        return pending
    with selectors.DefaultSelector() as selector:
        for worker in workers:
            selector.register(worker.wire, selectors.EVENT_READ, worker)
        return [key.data for key, _ in selector.select(None if math.isinf(within) else within)]


def _alone(work: Work, design: Design) -> Pairs:
    """Run one design in a process of its own."""
    worker = _Worker(work)
    try:
        done = worker.take() if worker.give([design]) else None
        worker.ask_to_end()
    finally:
        worker.end()
    return done or [(design, Result.failed(design, work.way.name, work.task, _CRASHED))]


def _serve(end: socket.socket, work: Work) -> None:
    """Run designs until the other side says that there are no more, or is gone."""
    leader = serve_only(work.fmu.folder)
    wire = Wire(end, turns=False)
    try:
        while asked := wire.receive()[0]:
            pairs = work.run([Design(number, values) for number, values in asked])
            wire.send(
                [
                    [r.number, [_plain(value) for value in r.values], r.failure, r.warnings, _plain_events(r)]
                    for _, r in pairs
                ]
            )
    except (EOFError, ConnectionError):  # the other process is gone
        leader.join()


def _plain_events(result: Result) -> list[str] | None:
    return None if result.events is None else list(result.events)


def read_results(data: Any, designs: Sequence[Design], task: Task, way: str) -> list[Result]:
    """The results of designs from plain data.

    Raises:
        BrokenFrameError: these are none.
    """
    if type(data) is not list or len(data) != len(designs):
        raise BrokenFrameError(f"it has not the results of {len(designs)} designs")
    return [_result(one, design, task, way) for one, design in zip(data, designs, strict=True)]


def _result(data: Any, design: Design, task: Task, way: str) -> Result:
    if type(data) is not list or len(data) != 5:
        raise BrokenFrameError("one of its results has not five parts")
    number, values, failure, warnings, events = data
    if type(number) is not int or number != design.number:
        raise BrokenFrameError("a result in it is of another design")
    if type(values) is not list or len(values) != len(task.quantities):
        raise BrokenFrameError("a result in it has not the quantities that are asked for")
    for value, quantity in zip(values, task.quantities, strict=True):
        if value is not None and type(value) not in _TYPES[quantity.type]:
            raise BrokenFrameError(f"a result in it has a value of type {type(value).__name__} for {quantity.column}")
    for text in (failure, warnings):
        if text is not None and type(text) is not str:
            raise BrokenFrameError("a result in it has a reason that is no text")
    if events is not None and (type(events) is not list or any(type(name) is not str for name in events)):
        raise BrokenFrameError("a result in it has events that are no names")
    return Result(number, way, tuple(values), failure, warnings, None if events is None else tuple(events))


def _plain(value: Any) -> Any:
    """A number as JSON knows it; of numpy's types it knows only some."""
    return value.item() if hasattr(value, "item") else value

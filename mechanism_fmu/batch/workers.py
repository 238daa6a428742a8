"""Threads that run the designs of a job, or one design after the other by way of `MovingMechanism`."""

from __future__ import annotations

import math
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor, wait
from ctypes import CDLL, byref
from threading import Lock

import numpy as np

from .. import codes
from ..engine import status
from ..model import Mechanism, MechanismError
from ..moving import MovingMechanism, SimulationError
from .job import Job, as_c
from .prepared import Refusals

# One design by way of `MovingMechanism`: what `many.c` does, for where it cannot run, and for the words of a failure.


class OneByOne:
    """Takes designs of a job, one after the other, through one block of its own.

    Args:
        job: it.
        mechanism: of the same structure, for the names in messages.
        library: of the compiled engine; None: just in time.
    """

    def __init__(self, job: Job, mechanism: Mechanism, library: CDLL | None) -> None:
        self._job = job
        self._block = np.zeros(job.words)
        self._block[: len(job.given)] = job.given
        self._simulation = MovingMechanism.over(mechanism, self._block, library)
        self._records = self._simulation.field("impacts")
        self._pull_time = self._simulation.field("pull_time")
        self._rule = codes.STOP_AT_IMPACT + (codes.STOP_AT_EVENT if job.events.shape[1] else 0)
        self._seen = 0

    def run(self, design: int) -> None:
        """Take one design as far as it goes.

        Raises:
            MechanismError, SimulationError: it fails; what it did before is in the job.
        """
        job, simulation = self._job, self._simulation
        job.impact_count[design] = job.event_count[design] = 0
        self._seen = 0
        self._block[: len(self._job.given)] = self._job.given
        self._block[job.varied_word] = job.varied_value[design]
        self._drive(0)
        simulation.begin(float(job.times[0]))
        job.reached[design] = simulation.time
        if job.events.shape[1]:
            self._keep_beginning(design)
            self._keep_events(design)
        self._look(design)
        for point, target in enumerate(job.times[1:].tolist()):
            self._drive(point)
            try:
                simulation.begin_step()
                self._step(design, target)
            finally:
                job.reached[design] = simulation.time
                self._keep_impacts(design)
            self._look(design)
            if job.until_impact and job.impact_count[design]:
                break
        job.pulled[design] = np.where(self._pull_time <= simulation.time, self._pull_time, math.inf)
        job.values[design] = simulation.read_array()[job.read_output]

    def _drive(self, point: int) -> None:
        if len(self._job.driven_word):
            self._block[self._job.driven_word] = self._job.driven_value[point]

    def _step(self, design: int, target: float) -> None:
        while True:
            self._simulation.go_on(target, self._rule)
            self._keep_impacts(design)
            if self._job.events.shape[1]:
                self._keep_events(design)
            if self._simulation.time >= target or (self._job.until_impact and self._job.impact_count[design]):
                return

    def _keep_impacts(self, design: int) -> None:
        job, counters = self._job, self._simulation.counters
        count, held = counters.item(codes.COUNT_IMPACTS), counters.item(codes.COUNT_IN_STEP)
        for k in range(int(job.impact_count[design]), min(count, job.impacts.shape[1])):
            place = held - (count - k)
            if place >= 0:
                place = (counters.item(codes.FIRST_IMPACT) + place) % len(self._records)  # the buffer goes round
                job.impacts[design, k] = self._records[place, job.impact_field]
        job.impact_count[design] = count

    def _keep_event(self, design: int, guard: float, subject: float) -> None:
        place = self._job.event_count.item(design)
        if place < self._job.events.shape[1]:
            self._job.events[design, place] = guard, subject
        self._job.event_count[design] += 1

    def _keep_beginning(self, design: int) -> None:
        mode, slip = (self._simulation.field(name).tolist() for name in ("contact_mode", "rub_slip"))
        for c, closed in enumerate(mode):
            if closed == codes.CLOSED:
                self._keep_event(design, codes.GUARD_BEGIN, c)
        for k, how in enumerate(slip):
            if how == codes.STICKS:
                self._keep_event(design, codes.GUARD_BEGIN, len(mode) + k)

    def _keep_events(self, design: int) -> None:
        counters, records = self._simulation.counters, self._simulation.field("events")
        count, held = counters.item(codes.COUNT_EVENTS), counters.item(codes.EVENTS_IN_STEP)
        for k in range(self._seen, count):
            place = held - (count - k)
            which = records[place, [codes.EVENT_GUARD, codes.EVENT_SUBJECT]] if place >= 0 else [codes.NONE] * 2
            self._keep_event(design, *which)
        self._seen = count

    def _look(self, design: int) -> None:
        job = self._job
        if len(job.least):
            values = self._simulation.read_array()[job.read_output]
            np.fmin(job.least[design], values, out=job.least[design])
            np.fmax(job.greatest[design], values, out=job.greatest[design])


#: Receives how many designs are done, and how many there are.
Progress = Callable[[int, int], None]

_PERIOD = 0.2


def no_callback(_done: int, _all: int) -> None:
    """No callback: progress is not reported."""


def run_job(job: Job, mechanism: Mechanism, library: CDLL | None, threads: int, progress: Progress) -> Refusals:
    """Run all designs of a job whose status is `status.OK`; return why those failed that did.

    Compiled ahead of time, each thread makes one call, in which it takes design after design. Just in time, the threads
    go back to Python between the engine's calls.

    Args:
        job: it.
        mechanism: of the same structure, for the names in messages.
        library: of the compiled engine; None: just in time.
        threads: how many.
        progress: called a few times a second.
    """
    if library is None:
        failures: Refusals = {}
        turn = Lock()
        _share(job, threads, lambda: _one_by_one(job, OneByOne(job, mechanism, None), failures, turn), progress)
        return failures
    before = job.status.copy()
    whole = as_c(job)

    def in_one_call() -> None:
        block = np.zeros(job.words)  # of its scratch, the largest part, only what is used takes memory
        library.engine_many(byref(whole), block.ctypes.data)

    _share(job, threads, in_one_call, progress)
    again = OneByOne(job, mechanism, library)
    return {design: _why(again, design) for design in np.flatnonzero(job.status != before).tolist()}


def _share(job: Job, threads: int, work: Callable[[], None], progress: Progress) -> None:
    count = len(job.status)
    with ThreadPoolExecutor(threads) as pool:
        try:
            running = {pool.submit(work) for _ in range(threads)}
            while running:
                done, running = wait(running, timeout=_PERIOD)
                for thread in done:
                    thread.result()
                progress(max(0, min(job.next.item(0), count) - len(running)), count)
        finally:
            job.next[0] = count  # whatever stops this thread stops the others


def _one_by_one(job: Job, runner: OneByOne, failures: Refusals, turn: Lock) -> None:
    while True:
        with turn:
            design = job.next.item(0)
            job.next[0] += 1
        if design >= len(job.status):
            return
        if job.status[design] == status.OK:
            try:
                runner.run(design)
            except (MechanismError, SimulationError) as error:
                failures[design] = str(error)


def _why(again: OneByOne, design: int) -> str:
    """The words of a failure, from a repetition of it."""
    try:
        again.run(design)
    except (MechanismError, SimulationError) as error:
        return str(error)
    raise AssertionError(f"Design {design} fails in one call, but not by itself.")

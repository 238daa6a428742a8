"""Threads that share the designs of a job."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor, wait
from ctypes import CDLL, byref
from threading import Lock

import numpy as np

from ..engine import status
from ..model import Mechanism, MechanismError
from ..simulation import SimulationError
from .job import Job, as_c
from .one import OneByOne
from .refusals import Refusals

#: Is told how many designs are done, and how many there are.
Progress = Callable[[int, int], None]

_PERIOD = 0.2


def nobody(_done: int, _all: int) -> None:
    """Nobody wants to know."""


def run_job(job: Job, mechanism: Mechanism, library: CDLL | None, threads: int, progress: Progress) -> Refusals:
    """Run all designs of a job whose status is `status.OK`; return why those failed that did.

    Compiled ahead of time, each thread makes one call, in which it takes design after design. Just in time, the threads
    go back to Python between the engine's calls.

    Args:
        job: it.
        mechanism: of the same structure, for the names in messages.
        library: of the compiled engine; None: just in time.
        threads: how many.
        progress: told a few times a second.
    """
    if library is None:
        failures: Refusals = {}
        turn = Lock()
        _share(job, threads, lambda: _one_by_one(job, OneByOne(job, mechanism, None), failures, turn), progress)
        return failures
    told = job.status.copy()
    whole = as_c(job)

    def in_one_call() -> None:
        block = np.empty_like(job.given)
        library.engine_many(byref(whole), block.ctypes.data)

    _share(job, threads, in_one_call, progress)
    again = OneByOne(job, mechanism, library)
    return {design: _why(again, design) for design in np.flatnonzero(job.status != told).tolist()}


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

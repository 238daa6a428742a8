"""Agreement first, then times: one sweep by the fast path, by MuJoCo and by solve_ivp in a process pool."""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from ..fmus import build_ratchet
from ..ratchet import Parameters
from ..timing import Comparison, DisagreementError, batch, in_turns
from .sweep import FastPath, Found, MuJoCo, pooled, processes, random_designs

#: What times of impacts [s] and speeds [rad/s] must be accurate to, and the tolerances that give it: of 1, 2 and 5
#: times powers of ten, the largest ones that do.
ACCURACY = 1e-8
TOLERANCE, PLAIN_TOLERANCE = 2e-6, 1e-5
_EXACT = 1e-12

#: MuJoCo's impact comes with the end of a step, and its contact is soft.
_MUJOCO = (1e-3, 2e-4, 2e-4)

#: The paper's experiment, and just beyond its impact [s].
_LONG, _SHORT = 6.0, 1.2
_LEAST_MUJOCO, _LEAST_PLAIN = 15.0, 100.0
_DESIGNS, _FEW = 256, 16
#: In which two ways take turns.
ROUNDS = 9


@dataclass(frozen=True)
class Accuracy:
    """How far a way is from a run at a relative tolerance of 1e-12: largest differences over all designs.

    Attributes:
        way: which.
        stop_time: [s].
        time: of the impact [s].
        speed_after: of the wheel after it [rad/s].
        speed_at_end: of the wheel at the stop time [rad/s].
    """

    way: str
    stop_time: float
    time: float
    speed_after: float
    speed_at_end: float


@dataclass(frozen=True)
class Sweep:
    """A sweep by the fast path, and what its numbers should be.

    Attributes:
        designs: of it.
        stop_time: [s].
        threads: and processes.
        fast: ready to run.
        exact: at a relative tolerance of 1e-12.
    """

    designs: list[Parameters]
    stop_time: float
    threads: int
    fast: FastPath
    exact: Found

    @classmethod
    def of(cls, fmu: Path, count: int, stop_time: float, threads: int) -> Sweep:
        """The sweep of so many designs, by the FMU of the ratchet."""
        designs = random_designs(count)
        exact = FastPath(fmu, designs, stop_time, _EXACT).run(threads)
        return cls(designs, stop_time, threads, FastPath(fmu, designs, stop_time, TOLERANCE), exact)

    def run(self) -> Found:
        """All designs."""
        return self.fast.run(self.threads)

    def time(self) -> float:
        """Time of one design [s]."""
        return batch(self.run, 1) / len(self.designs)

    def judge(self, way: str, found: Found, within: tuple[float, float, float]) -> Accuracy:
        """How accurate a way is.

        Raises:
            DisagreementError: less than it should be.
        """
        errors = found.error(self.exact.first(len(found.impact_time)))
        if not all(error <= limit for error, limit in zip(errors, within, strict=True)):
            raise DisagreementError(f"{way} to {self.stop_time:g} s is off by {errors}, more than {within}.")
        return Accuracy(way, self.stop_time, *errors)


def against_mujoco(sweep: Sweep, rounds: int, least_ratio: float | None) -> tuple[Comparison, list[Accuracy]]:
    """Both run all designs, with as many threads."""
    mujoco = MuJoCo(sweep.designs, sweep.stop_time, sweep.threads)
    try:
        mujoco.run()
        accuracies = [
            sweep.judge("fast path", sweep.run(), (ACCURACY,) * 3),
            sweep.judge("MuJoCo", mujoco.found(), _MUJOCO),
        ]
        times = in_turns(lambda: batch(mujoco.run, 1) / len(sweep.designs), sweep.time, rounds)
    finally:
        mujoco.close()
    subject = f"one of {len(sweep.designs)} designs, {sweep.threads} threads (baseline: MuJoCo's rollout)"
    return Comparison(subject, f"to {sweep.stop_time:g} s", *times, least_ratio), accuracies


def against_plain(
    sweep: Sweep, pool: ProcessPoolExecutor, count: int, rounds: int, least_ratio: float | None
) -> tuple[Comparison, list[Accuracy]]:
    """The plain program runs the first `count` designs only."""
    few = sweep.designs[:count]

    def run() -> Found:
        return pooled(pool, few, sweep.stop_time, PLAIN_TOLERANCE)

    accuracies = [sweep.judge("solve_ivp", run(), (ACCURACY,) * 3)]
    times = in_turns(lambda: batch(run, 1) / len(few), sweep.time, rounds)
    subject = f"one design, {sweep.threads} threads (baseline: solve_ivp in {sweep.threads} processes)"
    return Comparison(subject, f"to {sweep.stop_time:g} s", *times, least_ratio), accuracies


def compare(
    folder: Path, rounds: int, say: Callable[[str], None], designs: int = _DESIGNS
) -> tuple[list[Comparison], list[Accuracy]]:
    """Both comparisons of the long sweep, then of the short one.

    Args:
        folder: for the FMU.
        rounds: in which two ways take turns.
        say: what begins.
        designs: of the sweep.

    Raises:
        DisagreementError: a way is less accurate than it should be.
    """
    say("builds the FMU (a first build compiles the engine ahead of time)")
    fmu, threads = build_ratchet(folder), os.cpu_count() or 1
    comparisons, accuracies = [], []
    with processes(threads) as pool:
        for stop_time in (_LONG, _SHORT):
            required = stop_time == _LONG
            sweep = Sweep.of(fmu, designs, stop_time, threads)
            say(f"MuJoCo, to {stop_time:g} s")
            compared = [against_mujoco(sweep, rounds, _LEAST_MUJOCO if required else None)]
            say(f"solve_ivp, to {stop_time:g} s")
            compared += [against_plain(sweep, pool, _FEW, rounds, _LEAST_PLAIN if required else None)]
            comparisons += [comparison for comparison, _ in compared]
            accuracies += [accuracy for _, found in compared for accuracy in found]
    return comparisons, accuracies

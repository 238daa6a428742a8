"""A problem that several programs can state: what each finds at its settings, how long it takes, and who is ahead."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float64]

#: What runs once, and gives the quantities of its case.
Run = Callable[[], Vector]

#: This engine, as the tables name it, its tolerances, and that of the reference.
OURS = "mechanism_fmu"
TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 3e-13)
EXACT = 1e-13
#: What a run gives that ends with a message before its time.
FAILED: Vector = np.array([math.nan])


@dataclass(frozen=True)
class Program:
    """A way to solve a case.

    Attributes:
        code: its name, as `peers.PEERS` has it, or `OURS`.
        method: of integration and the coordinates, for the tables.
        settings: tolerances or numbers of steps, from coarse to fine.
        prepare: from one of them to what runs; what it does itself is not timed.
        word: what a setting is: "tolerance" or "steps".
    """

    code: str
    method: str
    settings: tuple[float, ...]
    prepare: Callable[[float], Run]
    word: str = "tolerance"

    def labelled(self, setting: float) -> str:
        """A setting, as tables print it."""
        return f"{setting:.0f} steps" if self.word == "steps" else f"tolerance {setting:.0e}"


@dataclass(frozen=True)
class Case:
    """A problem.

    Attributes:
        name: of it on the command line.
        title: of it.
        statement: what moves, with its data, and what is compared.
        programs: the engine first.
        floor: what the reference is good for: at least three times what scipy at its tightest differs from it. Smaller
            errors are not told apart.
        cannot: what each peer that is left out, or states the problem only nearly, cannot say; by code.
        within: largest error of the engine at a tolerance of 1e-9, which a test holds it to.
    """

    name: str
    title: str
    statement: str
    programs: tuple[Program, ...]
    floor: float
    cannot: dict[str, str]
    within: float

    def reference(self) -> Vector:
        """The quantities by the engine at `EXACT`."""
        return self.programs[0].prepare(EXACT)()


@dataclass(frozen=True)
class Point:
    """One run: code, method, setting in words, processor time [s], and largest error of all quantities."""

    code: str
    method: str
    setting: str
    seconds: float
    error: float


@dataclass(frozen=True)
class Verdict:
    """A peer at its own best accuracy, and this engine at the same or a better one.

    Attributes:
        peer: its point.
        ours: the fastest of this engine that is as accurate; None where there is none.
    """

    peer: Point
    ours: Point | None

    @property
    def ratio(self) -> float:
        """Time of the peer over ours; 0 where we are not as accurate."""
        return self.peer.seconds / self.ours.seconds if self.ours is not None else 0.0

    @property
    def is_ahead(self) -> bool:
        """Whether the peer is ahead."""
        return self.ratio < 1.0


def error(found: Vector, exact: Vector) -> float:
    """The largest difference of two vectors of the same shape; infinite where one is not a number."""
    off = float(np.max(np.abs(found - exact)))
    return off if math.isfinite(off) else math.inf


def measure(program: Program, setting: float, exact: Vector, rounds: int = 3) -> Point:
    """Prepare and run so many times, and keep the shortest processor time of the runs alone."""
    shortest, found = math.inf, exact
    for _ in range(rounds):
        run = program.prepare(setting)
        began = time.process_time()
        found = run()
        shortest = min(shortest, time.process_time() - began)
    return Point(program.code, program.method, program.labelled(setting), shortest, error(found, exact))


def verdicts(points: Sequence[Point], floor: float) -> list[Verdict]:
    """Each peer at its best accuracy, those that are ahead first, then by ratio.

    Where a peer has several methods, each is a peer of its own. An error below the floor counts as the floor.
    """
    ways = dict.fromkeys((point.code, point.method) for point in points if point.code != OURS)
    found = []
    for way in ways:
        its = [point for point in points if (point.code, point.method) == way]
        best = min(its, key=lambda point: (max(point.error, floor), point.seconds))
        able = [point for point in points if point.code == OURS and point.error <= max(best.error, floor)]
        found.append(Verdict(best, min(able, key=lambda point: point.seconds, default=None)))
    return sorted(found, key=lambda verdict: verdict.ratio)


def overtaken(points: Sequence[Point], floor: float) -> list[Verdict]:
    """Peers at any setting where nothing of ours is both as accurate and as fast, of each way the most accurate one."""
    found: dict[tuple[str, str], Verdict] = {}
    for point in sorted(points, key=lambda point: point.error, reverse=True):
        if point.code == OURS or not math.isfinite(point.error):
            continue
        verdict = verdicts([point, *(one for one in points if one.code == OURS)], floor)[0]
        if verdict.is_ahead:
            found[point.code, point.method] = verdict
    return list(found.values())

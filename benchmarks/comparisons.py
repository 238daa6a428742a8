"""All comparisons of `python -m benchmarks`, part by part, in the order of its table."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from mechanism_fmu.fmu.start import CACHE_VARIABLE
from mechanism_fmu.model import MechanismError

from . import acceleration, bending, cams, cycle, elastodynamics, fmu_step, fmus, impacts, master, startup, step
from .c_limit import compare as c_limit
from .c_limit.library import NoCompilerError
from .native_surface import compare as native_surface
from .timing import Comparison


@dataclass(frozen=True)
class Part:
    """Some comparisons.

    Attributes:
        title: what is compared.
        compare: does so, in an empty folder for its files and in so many rounds.
        lacks: errors by which it says that something it needs is not installed.
    """

    title: str
    compare: Callable[[Path, int], list[Comparison]]
    lacks: tuple[type[Exception], ...] = ()


def _of_fmus(folder: Path, rounds: int) -> list[Comparison]:
    """The starts come first: they leave the compiled engine in the cache from which the steps take it."""
    ratchet, plain, cache = fmus.build_ratchet(folder), fmus.build_plain(folder), folder / "cache"
    starts = startup.compare(ratchet, folder, cache)
    before = os.environ.get(CACHE_VARIABLE)
    os.environ[CACHE_VARIABLE] = str(cache)
    try:
        return [*fmu_step.compare(plain, ratchet, folder, rounds), *starts]
    finally:
        del os.environ[CACHE_VARIABLE]
        if before is not None:
            os.environ[CACHE_VARIABLE] = before


PARTS = (
    Part("one acceleration (compiles the engine first)", lambda _, rounds: acceleration.compare(rounds)),
    Part("one acceleration of ten bodies with four cams", lambda _, rounds: cams.compare(rounds)),
    Part("one step", lambda _, rounds: step.compare(rounds)),
    Part("one impact", lambda _, rounds: impacts.compare(rounds)),
    Part("one simulated second of the free ratchet", lambda _, rounds: cycle.compare(rounds)),
    Part("a linkage that bends", lambda _, rounds: elastodynamics.compare(rounds) + bending.compare(rounds)),
    Part("the same algorithm by hand in C", c_limit.compare, (NoCompilerError,)),
    Part(
        "that algorithm in C and the engine of FMUs (a first build compiles the engine ahead of time)",
        c_limit.compare_with_fmus,
        (NoCompilerError, MechanismError),
    ),
    Part(
        "the native FMU, from C (builds it)",
        native_surface.compare,
        (NoCompilerError, MechanismError),
    ),
    Part("a machine of native FMUs", master.compare, (MechanismError,)),
    Part("start and one step of the FMU by pythonfmu (and one that compiles the engine)", _of_fmus),
)

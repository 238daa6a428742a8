"""What each run finds: sizes, builds and starts, some speed, deviations, a few designs at the limits, tests."""

from __future__ import annotations

import re
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path
from statistics import median

import numpy as np

import build_fmu as build_files
import models
from harness.page.page_file import page
from mechanism_fmu.fmu.native.package import build_native_fmu
from mechanism_fmu.fmu.package import build_fmu
from mechanism_fmu.model import MechanismError

from .. import limits
from ..fmus import ROOT
from .number import Number, Part

_ROUNDS = 5
#: Bars of the chains beside MuJoCo's.
_CHAINS = (10, 20, 50, 100)
#: Designs of each model at the limits.
_FEW = 10


def parts() -> list[Part]:
    """All of them."""
    return [
        Part("sizes and starts", sizes_and_starts, lacks=(MechanismError,)),
        Part("the base case beside solve_ivp", lambda _: base_case(), ("scipy",)),
        Part("chains beside MuJoCo", lambda _: chains(), ("mujoco", "numba")),
        Part("published problems", lambda _: deviations(), ("scipy",)),
        Part(f"designs at the limits, {_FEW} a model", lambda _: of_limits(_FEW)),
        Part("tests", lambda _: tests()),
    ]


def sizes_and_starts(folder: Path) -> Iterator[Number]:
    """The ratchet's files in every form, times of their builds with a compiled engine, and the start of an FMU."""
    from .. import startup

    model = models.load("ratchet")
    forms: tuple[tuple[str, Callable[[Path], Path]], ...] = (
        ("native FMU, FMI 2.0, all platforms", lambda place: build_native_fmu(model, place)),
        ("native FMU, FMI 3.0, all platforms", lambda place: build_native_fmu(model, place, fmi=3)),
        ("FMU by pythonfmu", lambda place: build_fmu(model, place)),
    )
    for name, build in forms:
        place = folder / name.replace(" ", "_")
        build(place)
        began = time.perf_counter()
        fmu = build(place)
        yield Number("size", f"ratchet: {name}", "kB", fmu.stat().st_size / 1e3)
        yield Number("time", f"ratchet: build of a {name}", "s", time.perf_counter() - began)
    html = page(build_files.web("ratchet")).encode()
    yield Number("size", "ratchet: page that computes", "kB", len(html) / 1e3)
    for found in startup.compare(fmu, folder / "starts", folder / "cache"):
        yield Number("time", f"start of that FMU, {found.case}", "s", median(found.fast))


def base_case() -> Iterator[Number]:
    """Beside a plain program with scipy."""
    from .. import base_case

    yield Number("speed", "base case at equal error, time over solve_ivp's", "1", base_case.measure(_ROUNDS).ratio)


def chains() -> Iterator[Number]:
    """Beside MuJoCo."""
    from .. import growth

    for count in _CHAINS:
        ours, theirs = growth.compare(count, _ROUNDS)
        yield Number("speed", f"acceleration of a chain of {count}, time over MuJoCo's", "1", ours / theirs)


def deviations() -> Iterator[Number]:
    """Of the published problems."""
    from ..world.case import SHOWN
    from ..world.cases import CASES

    for case in CASES.values():
        for tolerance in SHOWN:
            name = f"{case.title} at {tolerance:.0e}"
            yield Number("deviation", name, "1", case.deviation(case.run(tolerance)))


def of_limits(count: int) -> Iterator[Number]:
    """So many designs of each model at the limits of its parameters."""
    return limits_of([one for name in models.available() for one in limits.survey(name, count) if one], count)


def limits_of(found: list[limits.Run], count: int) -> Iterator[Number]:
    """What the survey says of designs that have run, of which there were so many a model."""
    slow = [one for one in found if one.is_slow]
    steps = f"over {limits.STEPS_EACH} steps for each turn, swing or event"
    counts = {
        "designs tried": len(found),
        f"of these, slow: over {limits.ALLOWED} s for {limits.MOTION} s of motion": len(slow),
        f"of the slow ones, without a reason: {steps}": sum(not one.has_reason for one in slow),
        "of the slow ones, stiff: with implicit steps": sum(one.implicit > 0 for one in slow),
    }
    for name, value in counts.items():
        yield Number("limits", f"{count} a model: {name}", "1", value)
    middle = float(np.median([one.seconds for one in found]))
    yield Number("limits", f"{count} a model: time of the middle one", "ms", 1e3 * middle)


def tests() -> Iterator[Number]:
    """How many there are by folder, and how many of them are slow."""
    every = _collected("")
    slow = _collected("slow")
    for kind, count in sorted(every.items()):
        yield Number("tests", kind, "1", count)
    yield Number("tests", "all", "1", sum(every.values()))
    yield Number("tests", "of these, slow", "1", sum(slow.values()))


def _collected(marks: str) -> Counter[str]:
    command = [sys.executable, "-m", "pytest", "--collect-only", "-q", "-p", "no:xdist", "-m", marks, "tests"]
    said = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False).stdout
    files = (line.rpartition(": ") for line in said.splitlines() if re.fullmatch(r"tests/\S+\.py: \d+", line))
    found: Counter[str] = Counter()
    for file, _, count in files:
        found[kind_of(file)] += int(count)
    return found


def kind_of(file: str) -> str:
    """The folder below tests, or two where the first is `unit`, of a file with tests."""
    parts = Path(file).parts[1:-1]
    return "/".join(parts[: 2 if parts[:1] == ("unit",) else 1]) or "house"

"""Start-up of a freshly unzipped FMU: without the compiled engine, which numba then compiles, and as it is."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import fmpy

from mechanism_fmu.fmu.start import CACHE_VARIABLE

from .fmus import ROOT
from .timing import Comparison, require_agreement

_SUBJECT = "start of an unzipped FMU (baseline: without its compiled engine)"
_LONGEST = 0.2
_STARTS = 5

#: What `benchmarks.start` reports: what it stands for, and what it must stay below [s].
_CASES = {
    "instance": ("instantiate .. exitInitializationMode", _LONGEST),
    "process": ("the same, with import fmpy", None),
    "cpu": ("the same, processor time", None),
}


def compare(fmu: Path, folder: Path, cache: Path) -> list[Comparison]:
    """Compare a start without the compiled engine and starts with it; unzips into new folders in `folder`.

    Args:
        fmu: built where ziglang is installed.
        folder: for what is unzipped.
        cache: an empty folder.
    """
    bare = _start(_unzipped(fmu, folder / "bare", bare=True), cache / "bare")
    starts = [_start(_unzipped(fmu, folder / f"start{k}"), cache) for k in range(1 + _STARTS)][1:]
    for start in starts:
        require_agreement("The first step after a start", bare["wheel_angle"], start["wheel_angle"], 0.0)
    return [
        Comparison(_SUBJECT, case, (bare[key],), tuple(start[key] for start in starts), longest=longest)
        for key, (case, longest) in _CASES.items()
    ]


def _unzipped(fmu: Path, folder: Path, bare: bool = False) -> Path:
    fmpy.extract(str(fmu), unzipdir=str(folder))
    if bare:
        for library in folder.glob("resources/*/engine/compiled/*"):
            library.unlink()
    return folder


def _start(folder: Path, cache: Path) -> dict[str, float]:
    done = subprocess.run(
        [sys.executable, "-m", "benchmarks.start", str(folder)],
        cwd=ROOT,
        env=os.environ | {CACHE_VARIABLE: str(cache)},
        check=True,
        stdout=subprocess.PIPE,
        text=True,
    )
    found: dict[str, float] = json.loads(done.stdout)
    return found

"""Start-up of a freshly unzipped FMU: the first one compiles the engine, later ones find it in the cache."""

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

_SUBJECT = "start of an unzipped FMU (baseline: the first)"
_LONGEST = 1.5
_LATER_STARTS = 5

#: What `benchmarks.start` reports: what it stands for, and what it must stay below [s].
_CASES = {
    "instance": ("instantiate .. exitInitializationMode", _LONGEST),
    "process": ("the same, with import fmpy", _LONGEST),
    "cpu": ("the same, processor time", None),
}


def compare(fmu: Path, folder: Path, cache: Path) -> list[Comparison]:
    """Compare the first start, with an empty `cache`, and later ones; unzips into new folders in `folder`."""
    starts = [_start(fmu, folder / f"start{k}", cache) for k in range(1 + _LATER_STARTS)]
    first, later = starts[0], starts[1:]
    for start in later:
        require_agreement("The first step after a later start", first["wheel_angle"], start["wheel_angle"], 0.0)
    return [
        Comparison(_SUBJECT, case, (first[key],), tuple(start[key] for start in later), longest=longest)
        for key, (case, longest) in _CASES.items()
    ]


def _start(fmu: Path, folder: Path, cache: Path) -> dict[str, float]:
    fmpy.extract(str(fmu), unzipdir=str(folder))
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

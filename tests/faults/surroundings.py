"""What trials need around them: caches of their own, a user who is not root, a clock that can be set back."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path

from mechanism_fmu.fmu.native.objects import compiled_engine, engine_folder, is_bundled
from tests.faults.limits import NOBODY, become_nobody
from tests.faults.running import ROOT, Place
from tests.faults.trials import Trial

_IMPORTS = """
import build_fmu, harness.app.commands.one_run, harness.app.commands.designs_run, harness.app.commands.designs_run
import harness.app.commands.machine_run, harness.papers.study.study_report, harness.report.sweep_report
import mechanism_fmu.fmu.package, scipy.optimize, scipy.stats
print(open("/proc/self/status").read().partition("VmPeak:")[2].split()[0])
"""

#: A trial that lacks nothing but its place.
Begin = Callable[[Place], Trial]


def engine_cache(folder: Path) -> Path:
    """A new cache with the compiled engine, which takes a minute to compile where it is not in the user's own."""
    compiled_engine()
    (folder / "mechanism_fmu").mkdir(parents=True, mode=0o700)
    if not is_bundled():
        shutil.copytree(engine_folder(), folder / "mechanism_fmu" / engine_folder().name)
    return folder


def with_own_cache(begin: Begin, place: Place) -> Trial:
    """A trial with a copy of the cache."""
    assert place.cache is not None
    return begin(replace(place, cache=shutil.copytree(place.cache, place.folder / "cache")))


def as_nobody(begin: Begin, place: Place) -> Trial:
    """A trial by a user who is not root: whoever runs this is it, or becomes nobody."""
    if os.geteuid() != 0:
        return with_own_cache(begin, place)
    assert place.cache is not None
    cache = shutil.copytree(place.cache, place.folder / "cache")
    for path in [place.folder, cache, *cache.rglob("*")]:
        os.chown(path, NOBODY, NOBODY)
    return begin(replace(place, cache=cache, environment={"HOME": str(place.folder)}, before=become_nobody))


@cache
def least_memory() -> int:
    """The address space that the program takes with all that it imports [bytes].

    With less, it is OpenBLAS that decides what happens: it may ask for memory for ever.
    """
    command = [sys.executable, "-c", _IMPORTS]
    environment = os.environ | {"PYTHONPATH": str(ROOT), "OPENBLAS_NUM_THREADS": "1"}
    return int(subprocess.run(command, env=environment, capture_output=True, text=True, check=True).stdout) * 1024


def clock_library(folder: Path) -> Path:
    """The library of `clock.c`, for LD_PRELOAD."""
    library = folder / "clock.so"
    if not library.exists():
        source = Path(__file__).with_name("clock.c")
        subprocess.run(["gcc", "-shared", "-fPIC", str(source), "-o", str(library)], check=True)
    return library

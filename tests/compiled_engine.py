"""The engine that the tests run on: the compiled one of FMUs where it lies ready, else one made just in time.

Numbers are the same (tests/fmu/native/test_just_in_time_agrees.py); compiling just in time takes a minute of each
process.
"""

from __future__ import annotations

import ctypes
import tempfile
from functools import cache
from pathlib import Path

import numba

from mechanism_fmu.engine import run
from mechanism_fmu.fmu.native.objects import engine_is_compiled, engine_libraries
from mechanism_fmu.model import MechanismError

_waits = False


def wait_for_it(yes: bool) -> None:
    """Whether `library` waits until the engine is compiled, because another process is at it."""
    global _waits
    if yes != _waits:
        _waits = yes
        library.cache_clear()


@cache
def library() -> ctypes.CDLL | None:
    """The library of these very sources for this platform, or None."""
    if numba.config.DISABLE_JIT or not (_waits or engine_is_compiled()):
        return None
    try:
        libraries = engine_libraries()
    except MechanismError:
        return None  # no linker
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        path = run.library_path(Path(folder))
        if path is None or path.name not in libraries:
            return None
        path.write_bytes(libraries[path.name])
        return run.load(path)


def use_it() -> None:
    """From now on, `Simulation` looks here for the engine."""
    run.compiled_library = library

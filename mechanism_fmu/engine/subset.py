"""The part of Python the engine is written in, and the decorator that compiles it.

Engine functions use scalars, `math`, loops, and views of one block of memory: no allocation, no exceptions, no Python
objects (see `docs/decisions/001-one-block.md`). Compiled or not, they give the same numbers; with the environment
variable NUMBA_DISABLE_JIT=1 they run as plain Python.
"""

from __future__ import annotations

from typing import Any

import numba

#: Numba does not notice a change in a callee, so a compilation is kept on disk only for the copy of the library that
#: an FMU unpacks into a folder named after its contents; that copy has another package name.
KEEP_COMPILED = __name__.partition(".")[0] != "mechanism_fmu"

_OPTIONS: dict[str, Any] = {
    "error_model": "numpy",
    "boundscheck": False,
    "fastmath": False,
    "nogil": True,
    "cache": KEEP_COMPILED,
}

#: Compile a function of the engine.
jit = numba.njit(**_OPTIONS)

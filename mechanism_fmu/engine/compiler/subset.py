"""The part of Python the engine is written in, and the decorator that compiles it.

Engine functions use scalars, `math`, loops, and views of one block of memory: no allocation, no exceptions, no Python
objects (see `docs/decisions/001-one-block.md`). Compiled or not, they give the same numbers; without numba, or with the
environment variable NUMBA_DISABLE_JIT=1, they run as plain Python.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from importlib.util import find_spec
from typing import Any, TypeVar

from .marks import keep_apart as keep_apart, keep_small as keep_small

#: Whether compilation is switched off, as for debugging.
AS_PYTHON = os.environ.get("NUMBA_DISABLE_JIT", "0") not in ("", "0")
#: Whether functions are compiled when Python calls them.
COMPILES = not AS_PYTHON and find_spec("numba") is not None

_Function = TypeVar("_Function", bound=Callable[..., Any])


def entry(function: _Function) -> _Function:
    """Compile a function that Python calls."""
    if not COMPILES:
        return function
    from .just_in_time import compiled_entry

    return compiled_entry(function)


def jit(function: _Function) -> _Function:
    """Compile a function that only compiled functions call."""
    if not COMPILES:
        return function
    from .just_in_time import compiled_inner

    return compiled_inner(function)

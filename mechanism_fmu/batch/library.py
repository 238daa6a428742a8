"""The engine's shared library with the call that runs many designs."""

from __future__ import annotations

from ctypes import CDLL, c_void_p
from pathlib import Path

from ..engine.run import load


def load_many(path: Path | None) -> CDLL | None:
    """The engine's library in a file; None where there is none, or one without this call, or none for this system."""
    library = None if path is None else load(path)
    if library is None or not hasattr(library, "engine_many"):
        return None
    library.engine_many.argtypes, library.engine_many.restype = (c_void_p, c_void_p), None
    return library

"""The way into the engine: compiled ahead of time where there is a library for this platform, else just in time.

Libraries that lie here (`compiled/<processor>-<system>.*`) exist in FMUs only; elsewhere `mechanism_fmu.fmu.native`
knows where one is. Numbers are the same either way.
"""

from __future__ import annotations

import ctypes
import platform
import sys
from collections.abc import Callable
from functools import cache, partial
from pathlib import Path
from typing import Any, NamedTuple

from ..tables.declare import Array
from .compiler import subset

_SYSTEMS = {"linux": ("linux", ".so"), "win32": ("windows", ".dll"), "darwin": ("darwin", ".dylib")}
_PROCESSORS = {"amd64": "x86_64", "arm64": "aarch64"}

_STATUS, _TIME = ctypes.c_int64, ctypes.c_double
#: Result and arguments, behind the block and its length, of the library's functions.
_SIGNATURES: dict[str, tuple[Any, tuple[Any, ...]]] = {
    "begin": (_STATUS, (_TIME,)),
    "advance": (_STATUS, (_TIME,)),
    "begin_step": (_STATUS, ()),
    "go_on": (_STATUS, (_TIME, ctypes.c_int64)),
    "read_outputs": (None, ()),
    "read_output_rates": (None, ()),
    "exchange": (_STATUS, (ctypes.c_int64, _TIME)),
    "respond": (None, ()),
}


class NotCompiledError(RuntimeError):
    """There is neither a compiled engine here nor what compiles one."""


class Engine(NamedTuple):
    """The entry points for one block: see `begin`, `stepper`, `outputs`, `events`, `sensitivities`."""

    begin: Callable[[float], int]
    advance: Callable[[float], int]
    begin_step: Callable[[], int]
    go_on: Callable[[float, int], int]
    read_outputs: Callable[[], None]
    read_output_rates: Callable[[], None]
    exchange: Callable[[int, float], int]
    respond: Callable[[], None]


def engine_for(block: Array, library: ctypes.CDLL | None = None) -> Engine:
    """The engine for an instance's block, float64 of shape (words,), which must live as long.

    Args:
        block: of the instance.
        library: what `load` has given; None for the library that lies here, if one does.

    Raises:
        NotCompiledError: there is no library, and numba is not installed.
    """
    library = library or compiled_library()
    if library is not None:
        address, words = block.ctypes.data, len(block)
        functions: list[Any] = [getattr(library, f"engine_{name}") for name in Engine._fields]
        return Engine(*(partial(function, address, words) for function in functions))
    if not (subset.COMPILES or subset.AS_PYTHON):
        raise NotCompiledError(
            "There is no compiled engine for this platform, and the package numba, which compiles one, is not "
            "installed. Install it: python -m pip install numba; in a clone: python -m pip install -e '.[dev]'"
        )
    from .exchange.events import exchange
    from .exchange.sensitivities import respond
    from .outputs import read_output_rates, read_outputs
    from .starting.begin import begin
    from .stepping.stepper import advance, begin_step, go_on

    entries: list[Any] = [begin, advance, begin_step, go_on, read_outputs, read_output_rates, exchange, respond]
    return Engine(*(partial(function, block) for function in entries))


@cache
def compiled_library() -> ctypes.CDLL | None:
    """The library for this platform, or None: there is none, or the system cannot load it."""
    path = library_path(Path(__file__).with_name("compiled"))
    return load(path) if path is not None and path.is_file() else None


def load(path: Path) -> ctypes.CDLL | None:
    """A library of the engine, or None: the system cannot load it."""
    try:
        library = ctypes.CDLL(str(path))
    except OSError:
        return None  # e.g. a Linux without glibc
    for name, (result, arguments) in _SIGNATURES.items():
        function = getattr(library, f"engine_{name}")
        function.argtypes, function.restype = (ctypes.c_void_p, ctypes.c_int64, *arguments), result
    return library


def library_path(folder: Path) -> Path | None:
    """Where the library for this platform would be; None on systems that there is none for."""
    if sys.platform not in _SYSTEMS:
        return None
    machine = platform.machine().lower()
    system, suffix = _SYSTEMS[sys.platform]
    return folder / f"{_PROCESSORS.get(machine, machine)}-{system}{suffix}"

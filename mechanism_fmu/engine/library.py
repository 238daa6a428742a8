"""The engine as a C library: its exported functions as LLVM intermediate code.

Most take the address of an instance's block and its length in words. The functions are those that Python calls; only
the way in differs. To be compiled for any processor, numba must have been imported with NUMBA_CPU_NAME=generic,
NUMBA_CPU_FEATURES= and NUMBA_DISABLE_INTEL_SVML=1 (see `mechanism_fmu.fmu.native.objects`).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from numba import carray, cfunc, types

from .elementary import atan2, cos, sin, tan
from .outputs import read_output_rates, read_outputs
from .starting.begin import begin
from .stepping.stepper import begin_step, go_on

_BLOCK = types.CPointer(types.float64)
_OPTIONS: dict[str, Any] = {"nopython": True, "error_model": "numpy", "boundscheck": False, "fastmath": False}


def _begin(block: Any, words: int, time: float) -> int:
    return begin(carray(block, (words,)), time)


def _begin_step(block: Any, words: int) -> int:
    return begin_step(carray(block, (words,)))


def _go_on(block: Any, words: int, target: float, rule: int) -> int:
    return go_on(carray(block, (words,)), target, rule)


def _read_outputs(block: Any, words: int) -> None:
    read_outputs(carray(block, (words,)))


def _read_output_rates(block: Any, words: int) -> None:
    read_output_rates(carray(block, (words,)))


def _sin(x: float) -> float:
    return sin(x)


def _cos(x: float) -> float:
    return cos(x)


def _tan(x: float) -> float:
    return tan(x)


def _atan2(y: float, x: float) -> float:
    return atan2(y, x)


#: The exported functions by name, with the types of result and arguments.
EXPORTS: dict[str, tuple[Callable[..., Any], Any]] = {
    "mechanism_begin": (_begin, types.int64(_BLOCK, types.int64, types.float64)),
    "mechanism_begin_step": (_begin_step, types.int64(_BLOCK, types.int64)),
    "mechanism_go_on": (_go_on, types.int64(_BLOCK, types.int64, types.float64, types.int64)),
    "mechanism_read_outputs": (_read_outputs, types.void(_BLOCK, types.int64)),
    "mechanism_read_output_rates": (_read_output_rates, types.void(_BLOCK, types.int64)),
    # what the formulas of a model call
    "mechanism_sin": (_sin, types.float64(types.float64)),
    "mechanism_cos": (_cos, types.float64(types.float64)),
    "mechanism_tan": (_tan, types.float64(types.float64)),
    "mechanism_atan2": (_atan2, types.float64(types.float64, types.float64)),
}


def intermediate_code(name: str) -> str:
    """LLVM intermediate code of one exported function with all that it calls."""
    function, signature = EXPORTS[name]
    compiled = cfunc(signature, **_OPTIONS)(function)
    code: str = compiled.inspect_llvm()
    return code.replace(compiled.native_name, name)

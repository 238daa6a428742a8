"""The engine as a C library: its exported functions as LLVM intermediate code.

Most take the address of an instance's block and its length in words. The functions are those that Python calls; only
the way in differs. To be compiled for any processor, numba must have been imported with NUMBA_CPU_NAME=generic,
NUMBA_CPU_FEATURES= and NUMBA_DISABLE_INTEL_SVML=1 (see `mechanism_fmu.fmu.native.objects`).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from llvmlite.binding import parse_assembly
from numba import carray, cfunc, types

from .compiler.just_in_time import compiled_inner
from .compiler.machine_code import InnerCompiler
from .elementary import atan2, cos, sin, tan
from .exchange.events import exchange
from .exchange.sensitivities import respond
from .outputs import read_output_rates, read_outputs
from .starting.begin import begin
from .stepping.stepper import begin_step, go_on


def _part(entry: Any) -> Any:
    """What Python calls is machine code of its own; here it is a part of a program."""
    return compiled_inner(entry.py_func)


_BEGIN, _BEGIN_STEP, _GO_ON = _part(begin), _part(begin_step), _part(go_on)
_READ_OUTPUTS, _READ_OUTPUT_RATES = _part(read_outputs), _part(read_output_rates)
_EXCHANGE, _RESPOND = _part(exchange), _part(respond)

_BLOCK = types.CPointer(types.float64)
_OPTIONS: dict[str, Any] = {"nopython": True, "error_model": "numpy", "boundscheck": False, "fastmath": False}


def _begin(block: Any, words: int, time: float) -> int:
    status: int = _BEGIN(carray(block, (words,)), time)
    return status


def _begin_step(block: Any, words: int) -> int:
    status: int = _BEGIN_STEP(carray(block, (words,)))
    return status


def _go_on(block: Any, words: int, target: float, rule: int) -> int:
    status: int = _GO_ON(carray(block, (words,)), target, rule)
    return status


def _read_outputs(block: Any, words: int) -> None:
    _READ_OUTPUTS(carray(block, (words,)))


def _read_output_rates(block: Any, words: int) -> None:
    _READ_OUTPUT_RATES(carray(block, (words,)))


def _exchange(block: Any, words: int, what: int, time: float) -> int:
    status: int = _EXCHANGE(carray(block, (words,)), what, time)
    return status


def _respond(block: Any, words: int) -> None:
    _RESPOND(carray(block, (words,)))


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
    "mechanism_exchange": (_exchange, types.int64(_BLOCK, types.int64, types.int64, types.float64)),
    "mechanism_respond": (_respond, types.void(_BLOCK, types.int64)),
    # what the formulas of a model call
    "mechanism_sin": (_sin, types.float64(types.float64)),
    "mechanism_cos": (_cos, types.float64(types.float64)),
    "mechanism_tan": (_tan, types.float64(types.float64)),
    "mechanism_atan2": (_atan2, types.float64(types.float64, types.float64)),
}


#: Numba counts references to the arrays that it makes of the caller's blocks; they are the caller's, so that nothing is
#: to be counted, and its own counting is for the processor that it runs on.
_NO_COUNTING = """
define linkonce_odr void @NRT_incref(ptr %0) alwaysinline { ret void }
define linkonce_odr void @NRT_decref(ptr %0) alwaysinline { ret void }
"""


def intermediate_code(name: str) -> Any:
    """The program of an exported function."""
    function, signature = EXPORTS[name]
    return program(function, signature, name)


def program(function: Callable[..., Any], signature: Any, name: str) -> Any:
    """LLVM intermediate code of a function, by a name, with all that it calls, as it is before any optimisation."""
    compiled = cfunc(signature, pipeline_class=InnerCompiler, **_OPTIONS)(function)
    code = compiled._library._get_module_for_linking()
    exported = code.get_function(compiled.native_name)
    exported.name = name
    exported.linkage = "external"
    module = parse_assembly(_NO_COUNTING)
    module.link_in(code)
    return module

"""What numba makes of the functions of the engine; `subset` takes it where numba is installed."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba
from numba import types
from numba.extending import lower_builtin, type_callable

from . import bits as bits, indices as indices, views as views  # teach the compiler tables, bits, and plain indices
from .machine_code import InnerCompiler, check_files, ignore_literals, refuse_python_calls
from .marks import keep_apart, keep_small

#: Numba does not notice a change in a callee, so a compilation is kept on disk only for the copy of the library that
#: an FMU unpacks into a folder named after its contents; that copy has another package name.
KEEP_COMPILED = __name__.partition(".")[0] != "mechanism_fmu"

_OPTIONS: dict[str, Any] = {
    "error_model": "numpy",
    "boundscheck": False,
    "fastmath": False,
    "nogil": True,
    # no counting of references: the caller holds the block, and two atomic operations a call cost a tenth of the time
    "_nrt": False,
    "cache": KEEP_COMPILED,
}

_INNER_OPTIONS = _OPTIONS | {
    "cache": False,  # what is kept is the entry point, with all of its parts
    "no_cpython_wrapper": True,
    "no_cfunc_wrapper": True,
    "pipeline_class": InnerCompiler,
}

_Function = TypeVar("_Function", bound=Callable[..., Any])


def compiled_entry(function: _Function) -> _Function:
    """Compile a function that Python calls."""
    compiled = numba.njit(**_OPTIONS)(function)
    if KEEP_COMPILED and compiled is not function:  # which it is when NUMBA_DISABLE_JIT=1
        check_files(compiled)
    return cast(_Function, compiled)


def compiled_inner(function: _Function) -> _Function:
    """Compile a function that only compiled functions call."""
    inner = numba.njit(**_INNER_OPTIONS)(function)
    if inner is not function:  # which it is when NUMBA_DISABLE_JIT=1
        refuse_python_calls(inner)
        ignore_literals(inner)
    return cast(_Function, inner)


def _mark_small(context: Any, builder: Any, _signature: Any, _args: Any) -> Any:
    builder.function.attributes.add("optsize")
    return context.get_dummy_value()


def _mark_apart(context: Any, builder: Any, _signature: Any, _args: Any) -> Any:
    builder.function.attributes.add("noinline")
    return _mark_small(context, builder, _signature, _args)


for _mark, _lowering in ((keep_small, _mark_small), (keep_apart, _mark_apart)):
    type_callable(_mark)(lambda _context: lambda: types.none)
    lower_builtin(_mark)(_lowering)

"""The functions of `mechanism_fmu.elementary`, compiled: the same sums and products, hence the same bits."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from types import FunctionType, ModuleType
from typing import Any

from llvmlite import ir
from numba import types
from numba.extending import lower_builtin, type_callable

from ..elementary import exact, exponentials, trigonometric
from .compiler.subset import jit, keep_apart

# What the folder calls of `exact` that Python has from its C library: exact in any form, here on the bits of a number.

_BITS, _DOUBLE = ir.IntType(64), ir.DoubleType()
_FRACTION = 2**52 - 1
_BIAS = 1023

type_callable(exact.split_exponent)(lambda _context: lambda _x: types.Tuple((types.float64, types.int64)))
type_callable(exact.scaled)(lambda _context: lambda _x, _k: types.float64)


@lower_builtin(exact.split_exponent, types.float64)  # type: ignore[untyped-decorator]
def _split_exponent(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
    (x,) = arguments
    subnormal = builder.fcmp_ordered("<", x, ir.Constant(_DOUBLE, 2.0**-1022))
    x = builder.select(subnormal, builder.fmul(x, ir.Constant(_DOUBLE, 2.0**54)), x)
    bits = builder.bitcast(x, _BITS)
    bias = builder.select(subnormal, ir.Constant(_BITS, _BIAS - 1 + 54), ir.Constant(_BITS, _BIAS - 1))
    exponent = builder.sub(builder.lshr(bits, ir.Constant(_BITS, 52)), bias)
    half = ir.Constant(_BITS, (_BIAS - 1) << 52)
    fraction = builder.bitcast(builder.or_(builder.and_(bits, ir.Constant(_BITS, _FRACTION)), half), _DOUBLE)
    return context.make_tuple(builder, signature.return_type, (fraction, exponent))


@lower_builtin(exact.scaled, types.float64, types.int64)  # type: ignore[untyped-decorator]
def _scaled(_context: Any, builder: Any, _signature: Any, arguments: Any) -> Any:
    def power_of_two(k: Any) -> Any:
        bits = builder.shl(builder.add(k, ir.Constant(_BITS, _BIAS)), ir.Constant(_BITS, 52))
        return builder.bitcast(bits, _DOUBLE)

    x, k = arguments
    half = builder.ashr(k, ir.Constant(_BITS, 1))
    return builder.fmul(builder.fmul(x, power_of_two(half)), power_of_two(builder.sub(k, half)))


#: Parts of several functions that few mechanisms call: once, and for size, or each platform's library grew by 8 kB.
_APART = ("two_product", "quotient", "_subtracted", "_angle", "_exponential", "_raised", "_logarithm")


def _apart(function: Any, arguments: Sequence[str]) -> Any:
    """A compiled function, kept out of its callers (see `keep_apart`)."""
    given = ", ".join(arguments)
    namespace: dict[str, Any] = {"function": function, "keep_apart": keep_apart}
    exec(f"def apart({given}):\n    keep_apart()\n    return function({given})", namespace)
    return jit(namespace["apart"])


def _compiled(*modules: ModuleType) -> dict[str, Any]:
    """All functions of modules, compiled; each knows the others by their names."""
    names: dict[str, Any] = {"__name__": __name__, "math": math}
    by_bits = ("split_exponent", "scaled")
    for module in modules:
        names |= {name: value for name, value in vars(module).items() if isinstance(value, float)}
        for name, value in vars(module).items():
            if isinstance(value, FunctionType) and value.__module__ == module.__name__:
                code = value.__code__
                names[name] = value if name in by_bits else jit(FunctionType(code, names, name))
                if name in _APART:
                    names[name] = _apart(names[name], code.co_varnames[: code.co_argcount])
    return names


_FUNCTIONS = _compiled(exact, trigonometric, exponentials)

sine_cosine: Callable[[float], tuple[float, float]] = _FUNCTIONS["sine_cosine"]
sin: Callable[[float], float] = _FUNCTIONS["sin"]
cos: Callable[[float], float] = _FUNCTIONS["cos"]
tan: Callable[[float], float] = _FUNCTIONS["tan"]
atan2: Callable[[float, float], float] = _FUNCTIONS["atan2"]
exp: Callable[[float], float] = _FUNCTIONS["exp"]
log: Callable[[float], float] = _FUNCTIONS["log"]
power: Callable[[float, float], float] = _FUNCTIONS["power"]
tanh: Callable[[float], float] = _FUNCTIONS["tanh"]

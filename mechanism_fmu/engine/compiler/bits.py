"""What `mechanism_fmu.elementary` has from Python's C library, compiled: exact in any form, here on a number's bits."""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import types
from numba.extending import lower_builtin, type_callable

from ...elementary import exact

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

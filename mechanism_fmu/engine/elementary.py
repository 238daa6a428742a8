"""The functions of `mechanism_fmu.elementary`, compiled: the same sums and products, hence the same bits."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from types import FunctionType, ModuleType
from typing import Any

from ..elementary import exact, exponentials, trigonometric
from .compiler.subset import jit, keep_apart

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

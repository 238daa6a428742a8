"""Leaves out of the engine's functions that a negative index counts from the end, which the engine does nowhere.

Numba asks at every access, and has no option against it: a seventh of the instructions.
"""

from __future__ import annotations

from typing import Any

from numba import types
from numba.np import arrayobj

#: What the names of the engine's compiled functions hold: each name behind its length.
_OF_ENGINE = "".join(f"{len(name)}{name}" for name in __name__.split(".")[:-2])

_from_the_end = arrayobj.fix_integer_index


def _as_it_is(context: Any, builder: Any, kind: Any, index: Any, size: Any) -> Any:
    """An index in a function of the engine is taken as it is; in others, as numba does."""
    if _OF_ENGINE in builder.function.name:
        return context.cast(builder, index, kind, types.intp)
    return _from_the_end(context, builder, kind, index, size)


arrayobj.fix_integer_index = _as_it_is

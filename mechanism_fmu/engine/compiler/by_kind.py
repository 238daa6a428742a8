"""One compiled function out of many: which of them is called, a kind's number decides."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

from .subset import jit, keep_small


def by_kind(
    functions: Mapping[int, Callable[..., Any]],
    arguments: str,
    otherwise: str = "None",
    *,
    rest: Callable[..., Any] | None = None,
    small: bool = False,
) -> Callable[..., Any]:
    """A function of a kind's number and other arguments that calls the function of this kind.

    Compiled code cannot look into a table of functions; what stands here is the chain of comparisons that one would
    write by hand.

    Args:
        functions: by number of the kind; each takes `arguments`.
        arguments: their names, e.g. "block, at, k".
        otherwise: what it returns for other kinds, e.g. "0.0" or "math.nan".
        rest: made by `by_kind`, too: is called for other kinds instead.
        small: whether it is compiled for size (see `keep_small`).
    """
    lines = [f"def choose(kind, {arguments}):", *(["    keep_small()"] if small else [])]
    for number in functions:
        lines += [f"    if kind == {number}:", f"        return function_{number}({arguments})"]
    lines.append(f"    return rest(kind, {arguments})" if rest else f"    return {otherwise}")
    namespace: dict[str, Any] = {f"function_{number}": function for number, function in functions.items()}
    namespace |= {"math": math, "rest": rest, "keep_small": keep_small}
    exec("\n".join(lines), namespace)
    chosen: Callable[..., Any] = jit(namespace["choose"])
    return chosen

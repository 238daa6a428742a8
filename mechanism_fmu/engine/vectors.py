"""Vector operations: copy, clear, largest magnitude."""

from __future__ import annotations

from ..tables.declare import Array
from .compiler.subset import jit, keep_small


@jit
def copy(source: Array, target: Array) -> None:
    """Target = source."""
    keep_small()
    for k in range(source.shape[0]):
        target[k] = source[k]


@jit
def clear(vector: Array) -> None:
    """Set all entries to zero."""
    keep_small()
    for k in range(vector.shape[0]):
        vector[k] = 0.0


@jit
def largest(values: Array, count: int) -> float:
    """Largest magnitude of the first `count` values."""
    found = 0.0
    for k in range(count):
        found = max(found, abs(values[k]))
    return found

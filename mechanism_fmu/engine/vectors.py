"""Vectors as wholes, and those of a body in the global frame."""

from __future__ import annotations

from ..tables.declare import Array
from ..tables.motion import Pose
from .compiler.subset import jit, keep_small

#: Entries of a row of two bodies.
_TWO_BODIES = 6


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


@jit
def dot(a: Array, b: Array, length: int) -> float:
    """Scalar product of the first `length` entries, in four sums: one would wait for each addition."""
    if length == _TWO_BODIES:  # the same without a loop, whose overhead would be most of the work
        total: float = (a[0] * b[0] + a[4] * b[4] + a[5] * b[5] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3])
        return total
    first = second = third = fourth = 0.0
    whole = length - length % 4
    for k in range(0, whole, 4):
        first += a[k] * b[k]
        second += a[k + 1] * b[k + 1]
        third += a[k + 2] * b[k + 2]
        fourth += a[k + 3] * b[k + 3]
    for k in range(whole, length):
        first += a[k] * b[k]
    return (first + second) + (third + fourth)


@jit
def add_multiple(target: Array, factor: float, source: Array, length: int) -> None:
    """Target += factor * source, in the first `length` entries."""
    if length == _TWO_BODIES:
        target[0] += factor * source[0]
        target[1] += factor * source[1]
        target[2] += factor * source[2]
        target[3] += factor * source[3]
        target[4] += factor * source[4]
        target[5] += factor * source[5]
        return
    for k in range(length):
        target[k] += factor * source[k]


@jit
def turned(at: Pose, body: int, x: float, y: float) -> tuple[float, float]:
    """A vector (x, y) of a body, in the global frame."""
    c, s = at.cosine[body], at.sine[body]
    return c * x - s * y, s * x + c * y

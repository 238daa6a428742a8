"""Entries of a constraint row: those of the two bodies that it is about, three each; all others are zero."""

from __future__ import annotations

from ...tables.declare import Array
from ...tables.motion import Rows
from ..compiler.subset import jit
from ..vectors import clear


@jit
def begin_row(rows: Rows, row: int, i: int, j: int) -> None:
    """Clear the entries that a row has: it will be one of the bodies i and j, which are noted in ascending order."""
    clear_entries(rows.jacobian[row], rows.body[row])
    rows.body[row, 0] = min(i, j)
    rows.body[row, 1] = max(i, j)


@jit
def clear_entries(line: Array, bodies: Array) -> None:
    """Clear the entries of two bodies; the whole line where what stands there are none, as in scratch never used."""
    last = line.shape[0] // 3 - 1
    if not 0 <= bodies[0] <= last or not 0 <= bodies[1] <= last:
        clear(line)
        return
    for end in range(2):
        first = 3 * bodies[end]
        line[first] = 0.0
        line[first + 1] = 0.0
        line[first + 2] = 0.0


@jit
def along_row(rows: Rows, row: int, vector: Array, ground: int, start: float) -> float:
    """`start` plus the scalar product of a row and a vector with three entries a body, none for the `ground`.

    In the order of the columns: so it has the bits of a sum over all of them.
    """
    entry = rows.jacobian[row]
    total = start
    for end in range(2):
        body = rows.body[row, end]
        if body != ground:
            for k in range(3 * body, 3 * body + 3):
                total += entry[k] * vector[k]
    return total

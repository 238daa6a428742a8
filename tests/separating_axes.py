"""Overlap of convex pieces by separating axes, in plain numpy and independently of the engine.

Points are complex numbers x + i y. A piece is a convex polygon, anticlockwise. Two pieces overlap as deep as the least
distance by which one would have to move along a normal of a side of either.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Piece = NDArray[np.complex128]


class Placed(NamedTuple):
    """Pieces of a body, and its pose.

    Attributes:
        pieces: in the frame of the body.
        origin: of that frame, x + i y; one or many, shape (times,) [m].
        turn: cos + i sin of its angle, likewise.
    """

    pieces: tuple[Piece, ...]
    origin: complex | Piece
    turn: complex | Piece


def overlap(p: Piece, q: Piece) -> NDArray[np.float64]:
    """Depth of the overlap of two pieces at each time [m], negative where they are apart; shapes (times, corners)."""
    separation = np.full(p.shape[0], -np.inf)
    for a, b in ((p, q), (q, p)):
        side = np.roll(a, -1, axis=1) - a
        normal = -1j * side / np.abs(side)  # outward
        beyond = (normal[:, :, None].conj() * (b[:, None, :] - a[:, :, None])).real.min(axis=2)
        separation = np.maximum(separation, beyond.max(axis=1))
    return -separation


def depths(one: Placed, other: Placed) -> NDArray[np.float64]:
    """Deepest overlap of any two pieces of two bodies at each time [m]; 0 where they are apart."""
    at_one, at_other = np.atleast_1d(one.origin), np.atleast_1d(other.origin)
    turn_one, turn_other = np.atleast_1d(one.turn), np.atleast_1d(other.turn)
    times = max(len(at_one), len(at_other))
    least = np.zeros(times)
    for a in one.pieces:
        p = np.broadcast_to(at_one[:, None] + turn_one[:, None] * a, (times, len(a)))
        for b in other.pieces:
            q = np.broadcast_to(at_other[:, None] + turn_other[:, None] * b, (times, len(b)))
            least = np.maximum(least, overlap(p, q))
    return least


def deepest(one: Placed, other: Placed) -> float:
    """Deepest overlap of two bodies at any time [m]."""
    return float(depths(one, other).max())

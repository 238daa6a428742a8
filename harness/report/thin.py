"""Fewer points for the same curve."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.floating]


def thin(time: FloatArray, values: FloatArray, limit: int = 4000) -> tuple[FloatArray, FloatArray]:
    """At most about `limit` points of a curve, with every peak kept.

    Each of `limit / 2` equal stretches of the curve keeps its smallest and its largest value, in their order.

    Args:
        time: shape (points,), increasing.
        values: shape (points,).
        limit: number of points that a chart draws without delay.
    """
    if len(time) <= limit:
        return time, values
    edges = np.linspace(0, len(time), limit // 2 + 1).astype(int)
    kept = {0, len(time) - 1}
    for begin, end in pairwise(edges):
        kept |= {begin + int(np.argmin(values[begin:end])), begin + int(np.argmax(values[begin:end]))}
    order = np.array(sorted(kept))
    return time[order], values[order]

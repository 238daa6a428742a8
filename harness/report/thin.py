"""Fewer points for the same curve, fewer frames for the same motion."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import numpy.typing as npt
import pandas as pd

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


def strongest(impacts: pd.DataFrame, limit: int) -> FloatArray:
    """Times [s] of at most `limit` impacts, in their order: those of the largest velocity.

    Args:
        impacts: a row for each impact, with `time` and, where the FMU reports it, `velocity`; without a velocity the
            impacts that are left are spread evenly.
        limit: >= 1.
    """
    if impacts.empty:
        return np.empty(0)
    time = impacts["time"].to_numpy(dtype=np.float64)
    if len(time) <= limit:
        return np.asarray(time)
    if "velocity" not in impacts:
        kept = np.linspace(0, len(time) - 1, limit).astype(int)
    else:
        speed = np.abs(impacts["velocity"].to_numpy(dtype=np.float64))
        kept = np.sort(np.argsort(-speed, kind="stable")[:limit])
    return np.asarray(time[kept])


def frame_rows(time: FloatArray, instants: FloatArray, limit: int) -> npt.NDArray[np.int_]:
    """Samples for a moving picture: evenly spread, with the two samples around every instant.

    Args:
        time: shape (samples,), increasing, at least one.
        instants: shape (instants,), e.g. of impacts, within the time.
        limit: the most samples, unless the instants alone ask for more.

    Returns:
        Indices of samples, increasing, with the first and the last.
    """
    last = len(time) - 1
    after = np.clip(np.searchsorted(time, instants, side="left"), min(1, last), last)
    needed = np.unique(np.concatenate((np.maximum(after - 1, 0), after, [0, last])))
    spread = np.linspace(0, last, max(min(limit - len(needed), last + 1), 0)).astype(int)
    return np.union1d(needed, spread)

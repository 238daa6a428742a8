"""How finely ringing must be looked at: fast modes die first."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from .checks import FloatArray


class Stretch(NamedTuple):
    """A part of the time after an impact: begin and end [s], and the fastest mode that is heard in it [rad/s]."""

    begin: float
    end: float
    frequency: float


def audible_stretches(
    loudness: FloatArray, frequencies: FloatArray, damping_ratio: float, threshold: float, until: float
) -> Iterator[Stretch]:
    """Parts of the time from an impact to `until` [s], in each of which one mode is the fastest of those still heard.

    A mode is heard while its amplitude, loudness exp(-zeta Lambda t), is above the threshold. All modes have one
    damping ratio, so the fast ones fall silent first. The slowest mode counts as heard to the end.

    Args:
        loudness: amplitude of each mode just after the impact, in any unit, of shape (modes,).
        frequencies: Lambda of each [rad/s], of shape (modes,).
        damping_ratio: zeta of all, > 0.
        threshold: in the unit of the loudness, > 0.
        until: end of the last stretch [s].
    """
    with np.errstate(divide="ignore"):
        ends = np.log(loudness / threshold) / (damping_ratio * frequencies)
    fastest_first = np.argsort(-frequencies)
    ends[fastest_first[-1]] = math.inf
    begin = 0.0
    for mode in fastest_first:
        end = min(float(ends[mode]), until)
        if end > begin:
            yield Stretch(begin, end, float(frequencies[mode]))
            begin = end

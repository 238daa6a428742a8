"""Linear systems with one number that is limited, solved by matrix exponentials. Independent of the library.

x' = A x + b + s u with u = v within +-limit and v = c.x + d: below, within and beyond the limits x' = A_k x + b_k, each
with an exact solution. When v crosses a limit is found by root search, and v' is continuous there.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from scipy.linalg import expm
from scipy.optimize import brentq

Array = np.ndarray[Any, np.dtype[np.float64]]

#: So often v is looked at [s]: it must not cross a limit and come back in between.
_LOOK = 1e-4


@dataclass(frozen=True)
class LimitedSystem:
    """The system: matrices and vectors of shapes (n, n), (n,), (n,), (n,), and numbers."""

    A: Array
    b: Array
    s: Array
    c: Array
    d: float
    limit: float

    def wanted(self, x: Array) -> float:
        """V, before the limit."""
        return float(self.c @ x + self.d)

    def limited(self, x: Array) -> float:
        """U."""
        return min(max(self.wanted(x), -self.limit), self.limit)

    def at(self, times: Sequence[float], start: Array) -> list[Array]:
        """X at rising times from `start` at the first of them."""
        found, side = [start], self._side(start)
        for begin, end in pairwise(times):
            x, side = self._take(found[-1], end - begin, side)
            found.append(x)
        return found

    def _side(self, x: Array) -> int:
        v = self.wanted(x)
        return int(v > self.limit) - int(v < -self.limit)

    def _take(self, x: Array, span: float, side: int) -> tuple[Array, int]:
        """X after a time, and on which side v then is."""
        while True:
            flow = self._flow(side)
            crossing = self._crossing(x, span, side)
            if crossing is None:
                return _after(flow, x, span), side
            time, side = crossing
            x, span = _after(flow, x, time), span - time

    def _crossing(self, x: Array, span: float, side: int) -> tuple[float, int] | None:
        """When v first leaves its side, and to which one."""
        flow, looks = self._flow(side), math.ceil(span / _LOOK)
        look = span / max(looks, 1)
        small = expm(flow * look)
        now = np.append(x, 1.0)
        for k in range(looks):
            later = small @ now
            other = self._side(later[:-1])
            if other != side and not (k == 0 and self._side_rate(x, side) == 0):
                beyond = self.limit * (side if side else other)

                def off(time: float, start: Array = now[:-1], beyond: float = beyond) -> float:
                    return self.wanted(_after(flow, start, time)) - beyond

                time = k * look + float(brentq(off, 0.0, look, xtol=1e-15, rtol=1e-15))
                return time, side + _sign(other - side)
            now = later
        return None

    def _side_rate(self, x: Array, side: int) -> int:
        """0 where x stands on a limit, so that what comes next is no crossing of it."""
        edges = (self.limit, -self.limit) if side == 0 else (side * self.limit,)
        return int(min(abs(self.wanted(x) - edge) for edge in edges) > 1e-12 * max(1.0, self.limit))

    def _flow(self, side: int) -> Array:
        """The matrix of (x, 1)' on a side."""
        n = len(self.b)
        flow = np.zeros((n + 1, n + 1))
        if side == 0:
            flow[:n, :n] = self.A + np.outer(self.s, self.c)
            flow[:n, n] = self.b + self.s * self.d
        else:
            flow[:n, :n] = self.A
            flow[:n, n] = self.b + self.s * side * self.limit
        return flow


def _after(flow: Array, x: Array, time: float) -> Array:
    result: Array = (expm(flow * time) @ np.append(x, 1.0))[:-1]
    return result


def _sign(number: int) -> int:
    return (number > 0) - (number < 0)

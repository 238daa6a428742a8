"""The list of designs: the same file always gives the same list."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence

import numpy as np
import numpy.typing as npt
from scipy.stats import qmc

from .task import Design
from .variation import Axis

#: Points in the unit cube: number of points, number of axes, seed -> shape (points, axes), all in [0, 1).
_Sampler = Callable[[int, int, int], npt.NDArray[np.float64]]


def grid(axes: Sequence[Axis]) -> list[Design]:
    """Every value with every other; the last axis goes first."""
    combinations = itertools.product(*(axis.grid for axis in axes))
    return [
        Design(number, dict(zip([axis.name for axis in axes], values, strict=True)))
        for number, values in enumerate(combinations, start=1)
    ]


def sampled(axes: Sequence[Axis], method: str, count: int, seed: int) -> list[Design]:
    """`count` designs by one of `METHODS`."""
    points = METHODS[method](count, len(axes), seed)
    return [
        Design(number, {axis.name: axis.at(float(x)) for axis, x in zip(axes, point, strict=True)})
        for number, point in enumerate(points, start=1)
    ]


def _random(count: int, axes: int, seed: int) -> npt.NDArray[np.float64]:
    return np.random.default_rng(seed).random((count, axes))


def _latin_hypercube(count: int, axes: int, seed: int) -> npt.NDArray[np.float64]:
    return np.asarray(qmc.LatinHypercube(axes, rng=np.random.default_rng(seed)).random(count))


def _sobol(count: int, axes: int, seed: int) -> npt.NDArray[np.float64]:
    """The first of a sequence whose length is a power of 2, for which alone it is balanced."""
    whole = math.ceil(math.log2(count)) if count > 1 else 0
    return np.asarray(qmc.Sobol(axes, rng=np.random.default_rng(seed)).random_base2(whole))[:count]


METHODS: dict[str, _Sampler] = {"random": _random, "latin_hypercube": _latin_hypercube, "sobol": _sobol}

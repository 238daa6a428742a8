"""Two ways of doing the same thing, timed in turns: what slows the machine slows both, so their ratio holds."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from statistics import median
from time import perf_counter

import numpy as np
from numpy.typing import ArrayLike

#: Makes one batch of operations and returns the time of one of them [s].
Timer = Callable[[], float]


class DisagreementError(RuntimeError):
    """Two things that should be the same are not, so that their times say nothing."""


@dataclass(frozen=True)
class Comparison:
    """Times of one operation done in two ways.

    Attributes:
        subject: what is timed.
        case: under which circumstances.
        slow, fast: time of one operation [s], one entry a round.
        least_ratio: what the ratio must reach, if anything.
        longest: what the median of `fast` must stay below, if anything [s].
    """

    subject: str
    case: str
    slow: tuple[float, ...]
    fast: tuple[float, ...]
    least_ratio: float | None = None
    longest: float | None = None

    @property
    def ratio(self) -> float:
        """How many times faster the fast way is: ratio of the medians."""
        return median(self.slow) / median(self.fast)

    @property
    def met(self) -> bool | None:
        """Whether the requirement is met; None when there is none."""
        if self.longest is not None:
            return median(self.fast) < self.longest
        return None if self.least_ratio is None else self.ratio >= self.least_ratio


def in_turns(slow: Timer, fast: Timer, rounds: int) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Times of both, slow and fast in turns; one round before does not count."""
    pairs = [(slow(), fast()) for _ in range(rounds + 1)][1:]
    return tuple(pair[0] for pair in pairs), tuple(pair[1] for pair in pairs)


def batch(operation: Callable[[], object], count: int) -> float:
    """Time of one `operation` [s], mean of `count`."""
    began = perf_counter()
    for _ in range(count):
        operation()
    return (perf_counter() - began) / count


def require_agreement(what: str, slow: ArrayLike, fast: ArrayLike, within: float) -> None:
    """Check that two results are the same.

    Raises:
        DisagreementError: they differ by more than `within` (absolute, in SI units).
    """
    difference = float(np.max(np.abs(np.subtract(slow, fast))))
    if not difference <= within:
        raise DisagreementError(
            f"{what}: the two ways differ by {difference:.3g}, more than {within:g}, so their times say nothing. "
            "Run the tests: one of the two is wrong."
        )

"""Time as a whole number of nanoseconds, so that it never drifts."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from .errors import UsageError

#: Nanoseconds in a second.
SECOND = 10**9

#: Beyond this the conversion to seconds would lose nanoseconds: about 104 days.
_LONGEST = 2**53


def nanoseconds(seconds: float, what: str) -> int:
    """A time rounded to whole nanoseconds; `what` names it in the message.

    Raises:
        UsageError: not finite, negative, or too long.
    """
    if not math.isfinite(seconds) or seconds < 0.0:
        raise UsageError(f"The {what} is {seconds:g} s; give a finite time that is not negative.")
    if seconds * SECOND > _LONGEST:
        raise UsageError(f"The {what} is {seconds:g} s; the clock counts nanoseconds up to {_LONGEST / SECOND:.0f} s.")
    return round(seconds * SECOND)


def seconds(time: int) -> float:
    """A time in nanoseconds as the nearest number of seconds."""
    return time / SECOND


def begin_and_size(begin: int, end: int) -> tuple[float, float]:
    """A step from `begin` to `end` [ns] as FMUs are asked for it: where it begins, and its size [s].

    The size is the difference of the two rounded instants, so that begin + size is where the next step begins.
    """
    time = begin / SECOND
    return time, end / SECOND - time


@dataclass(frozen=True)
class TimeGrid:
    """Equal communication steps from start to stop [ns]; the last one is shortened to end exactly at stop."""

    start: int
    stop: int
    step: int

    @classmethod
    def of(cls, stop_time: float, step: float, start_time: float = 0.0) -> TimeGrid:
        """The grid for times in seconds.

        Raises:
            UsageError: a time that is impossible, a step below a nanosecond, or a stop before the start.
        """
        grid = cls(
            nanoseconds(start_time, "start time"), nanoseconds(stop_time, "stop time"), nanoseconds(step, "step")
        )
        if grid.step == 0:
            raise UsageError(f"The step is {step:g} s; give at least one nanosecond (1e-9 s).")
        if grid.stop <= grid.start:
            raise UsageError(f"The stop time {stop_time:g} s must be later than the start time {start_time:g} s.")
        return grid

    @property
    def even(self) -> bool:
        """Whether all steps are of one size."""
        return len(self) == 1 or (self.stop - self.start) % self.step == 0

    def __len__(self) -> int:
        return -(-(self.stop - self.start) // self.step)

    def __iter__(self) -> Iterator[tuple[int, int]]:
        """Begin and end of every step [ns]."""
        for begin in range(self.start, self.stop, self.step):
            yield begin, min(begin + self.step, self.stop)

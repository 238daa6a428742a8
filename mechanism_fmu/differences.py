"""Derivatives by differences between motions with the same events in the same order, extrapolated to a step of zero.

Through impacts a motion is a smooth function of its beginning and of its parameters as long as events keep their order
(what the saltation matrix says in closed form). Where however little changes the order, there is no derivative: the
motion grazes. That the slopes on both sides agree is looked at always, whatever is known of events: where they do not,
there is none, and where they hardly do, the derivative is known no better than that. At a limit, as where restitution
or friction is 0, the first step must keep the order: with less of it, bounces are slower than those that the engine
counts, and its motion is flat there.

Source: C. J. F. Ridders, Accurate computation of F'(x) and F'(x) F''(x), Advances in Engineering Software 4 (1982).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]

#: Steps, over the scale of a variable [1]: the first, by how much each is less, how many are extrapolated.
_FIRST, _LESS, _LEVELS = 4e-3, 2.0, 6
#: Slopes on both sides differ where they do so by so many times the estimated error of that, by this part of them, and
#: by what the noise of a motion, this part of a quantity (ten times the usual tolerance), makes of the first step.
_CERTAIN, _DIFFERENT, _NOISE = 10.0, 1e-5, 1e-8
#: Where events change, steps become less down to this, over the scale [1].
_LEAST = 1e-7


@dataclass(frozen=True)
class Sample:
    """What comes of a point.

    Attributes:
        values: of the quantities, shape (quantities,); None where there are none.
        change: in words, in what its events differ from those at the middle; "" if they are the same.
    """

    values: Array | None
    change: str = ""


#: From points, shape (variables,) each, to what comes of them.
Sampling = Callable[[Sequence[Array]], Sequence[Sample]]


@dataclass(frozen=True)
class Slopes:
    """A derivative, and how well it is known.

    Attributes:
        matrix: d quantity / d variable, shape (quantities, variables) [their units]; not a number where there is none.
        errors: estimated from the extrapolation, at least rounding over the largest step, the same shape.
        changes: of each variable, why there is none, or "".
        within: of each variable, how little it was moved at last [its unit].
    """

    matrix: Array
    errors: Array
    changes: tuple[str, ...]
    within: Array


def slopes(
    sample: Sampling,
    middle: Array,
    x: Array,
    scales: Array,
    *,
    low: Array | None = None,
    high: Array | None = None,
    levels: int = _LEVELS,
    least: float = _LEAST,
) -> Slopes:
    """The derivative by differences on both sides, or on one where a variable is at its limit, extrapolated.

    Args:
        sample: gives the quantities; it is asked for the points of all variables at one step together.
        middle: quantities at x, shape (quantities,).
        x: where, shape (variables,).
        scales: what steps are shares of, shape (variables,) [their units].
        low: limits of the variables, the same shape; None: none.
        high: likewise.
        levels: how many steps are extrapolated.
        least: step over the scale [1] within which events must keep their order; at a limit, the first step.
    """
    down = np.full_like(x, np.inf) if low is None else x - low
    up = np.full_like(x, np.inf) if high is None else high - x
    columns = [_Column(k, middle, float(x[k]), float(scales[k]), float(down[k]), float(up[k])) for k in range(len(x))]
    while asked := [column for column in columns if column.goes_on(levels, least)]:
        points = [_moved(x, column.place, end) for column in asked for end in column.ends()]
        samples = iter(sample(points))
        for column in asked:
            column.take([next(samples) for _ in column.ends()])
    return Slopes(
        np.column_stack([column.best for column in columns]),
        np.column_stack([column.known_within for column in columns]),
        tuple(column.why_none for column in columns),
        np.array([column.step * _LESS for column in columns]),
    )


def _moved(x: Array, place: int, value: float) -> Array:
    moved = x.copy()
    moved[place] = value
    return moved


#: So many times what is left of the jump of the slope, once its part of the step's size is taken out, holds what a kink
#: within the last steps may do to an extrapolated slope: found in 6000 draws.
_KINK = 4.0


class _Table:
    """Richardson's table of a quotient whose error has the powers `first`, `first + apart` ... of the step."""

    def __init__(self, size: int, first: int, apart: int) -> None:
        self.rows: list[list[Array]] = []
        self.first, self.apart = first, apart
        self.best, self.error = np.full(size, np.nan), np.full(size, np.inf)

    def add(self, quotient: Array) -> None:
        """Fill the last row, and keep of each component the entry that is known best."""
        row = [quotient]
        self.rows.append(row)
        if len(self.rows) == 1:
            self.best, self.error = quotient, np.where(np.isnan(quotient), np.inf, np.abs(quotient))
            return
        if len(self.rows) == 2:
            self.error = np.full_like(self.best, np.inf)
        for j, above in enumerate(self.rows[-2]):
            power = _LESS ** (self.first + j * self.apart)
            row.append((power * row[j] - above) / (power - 1.0))
            new = np.maximum(np.abs(row[-1] - row[j]), np.abs(row[-1] - above))
            better = new <= self.error
            self.best, self.error = np.where(better, row[-1], self.best), np.where(better, new, self.error)


class _Column:
    """The derivative by one variable, while steps become less; it may go `down` and `up` by so much [its unit]."""

    def __init__(self, place: int, middle: Array, x: float, scale: float, down: float, up: float) -> None:
        self.place, self.middle, self.x, self.scale = place, middle, x, scale
        step = _FIRST * scale
        self.sides: tuple[float, ...] = (1.0, -1.0)
        self.at_limit = min(down, up) == 0.0
        if min(down, up) < step:
            self.sides = (1.0,) if up >= down else (-1.0,)
            step = min(step, max(up, down))
        self.step = step
        self.change = ""
        self._forget()

    def _forget(self) -> None:
        both = len(self.sides) == 2
        self.slope = _Table(len(self.middle), 2 if both else 1, 2 if both else 1)
        self.jump = _Table(len(self.middle), 1, 2)  # of the slope, from below to above

    @property
    def best(self) -> Array:
        none = np.full_like(self.middle, np.nan)
        return none if self.why_none else self.slope.best

    @property
    def known_within(self) -> Array:
        if self.why_none:
            return np.full_like(self.middle, np.inf)
        rounding = np.finfo(np.float64).eps * np.abs(self.middle) / self._largest_step
        error: Array = np.maximum(self.slope.error, np.where(self.slope.best == 0.0, 0.0, rounding))
        if self.jump.rows:
            error = np.maximum(error, 0.5 * (np.abs(self.jump.best) + self.jump.error))
        if len(self.jump.rows) > 3:  # of a kink within the last steps, what is left does not fall as the steps' cubes
            left = [np.abs(row[1]) for row in self.jump.rows[1:]]
            last = np.maximum(left[-2], left[-1])
            stays = (left[-1] > 0.25 * left[-2]) | (left[-2] > 0.25 * left[-3])
            stays &= last <= np.maximum(left[0], left[1])  # of noise, it grows as steps become less
            error = np.where(stays, np.maximum(error, _KINK * last), error)
        return error

    @property
    def _largest_step(self) -> float:
        return self.step * _LESS ** len(self.slope.rows)

    @property
    def _kink(self) -> str:
        """In words, the slopes on both sides where they differ; "" where they do not."""
        if len(self.jump.rows) < 2:
            return ""
        below, above = self.slope.best - 0.5 * self.jump.best, self.slope.best + 0.5 * self.jump.best
        least = np.maximum(_CERTAIN * self.jump.error, _DIFFERENT * np.maximum(np.abs(below), np.abs(above)))
        least = np.maximum(least, _NOISE * np.abs(self.middle) / self._largest_step)
        for k in np.flatnonzero(np.abs(self.jump.best) > least):
            return f"none that is known, but the slope is {below[k]:.6g} below and {above[k]:.6g} above"
        return ""

    def goes_on(self, levels: int, least: float) -> bool:
        """Whether there is to be another row, of so many, with a step over the scale that is more than the least."""
        given_up = self.at_limit and bool(self.change)
        return not given_up and len(self.slope.rows) < levels and self.step > least * self.scale

    @property
    def why_none(self) -> str:
        return self._kink if self.slope.rows else self.change or "its limits leave no room for a step"

    def ends(self) -> list[float]:
        return [self.x + side * self.step for side in self.sides]

    def take(self, samples: Sequence[Sample]) -> None:
        """The next row of Richardson's table, unless events have changed: only one order of events is extrapolated."""
        self.change = next((one.change for one in samples if one.change), self.change)
        ends = [one.values for one in samples if one.values is not None and not one.change]
        if len(ends) < len(samples):
            self.change = self.change or "beside it there is no value"
            self._forget()
        elif len(ends) == 2:
            self.slope.add((ends[0] - ends[1]) / (2.0 * self.step))
            self.jump.add((ends[0] - 2.0 * self.middle + ends[1]) / self.step)
        else:
            self.slope.add(self.sides[0] * (ends[0] - self.middle) / self.step)
        self.step /= _LESS

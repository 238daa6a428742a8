"""Fit of impact laws to measured impacts: their numbers with uncertainty, cross-validated errors, and which is best.

The numbers of a law are those of the least mean error over all rows: errors, not their squares, so that a few wild rows
decide nothing. All that is said of uncertainty comes from one table for each law, the error of every row in every cell
of a grid around the minimum: another choice of rows is other weights of its rows.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
import numpy.typing as npt

from ..errors import UsageError
from .impact_laws import LAWS, Array, Contact, Law, newton
from .measured_impacts import Impacts

#: What the numbers of a law may be: mu, e, e_t; and the cells of the first grid in each direction.
BOUNDS = ((0.0, 2.0), (0.0, 1.0), (0.0, 1.0))
_COARSE = (21, 21, 6)
#: Cells in each direction of every finer grid, how many of the coarser it spans to each side, and how often.
_FINER, _SPAN, _TIMES = 11, 1.5, 4
#: Half the width of the grid for other choices of rows, at first, and its cells, of laws with two and three numbers.
_HALF = (0.04, 0.04, 0.2)
_CELLS = {2: 13, 3: 9}
#: Of the choices, what share may have its minimum on the rim of that grid; else it is made twice as wide.
_ON_RIM = 0.01
#: The numbers of each single impact, by Newton's law, are looked for in steps of this (1 / 50).
_OWN_CELLS = 51
#: Choices of rows for intervals, and the share of them that an interval holds.
CHOICES, SHARE = 1000, 0.95
#: Numbers with an uncertainty are not to be had from fewer impacts.
FEWEST = 10
#: So many numbers are held at once, at most [doubles].
_BLOCK = 4_000_000

Interval = tuple[float, float]


@dataclass(frozen=True)
class Fitted:
    """One law, fitted.

    Attributes:
        law: which.
        numbers: mu, e, and e_t where it has that [1].
        intervals: of these [1], which hold `SHARE` of the choices of rows (bootstrap).
        errors: of each row at these numbers [1], shape (rows,).
        unseen: of each row at numbers fitted to the other folds [1], shape (rows,).
        behind: mean of `unseen` above that of the chosen law [1], and its interval; zeros for that one.
    """

    law: Law
    numbers: tuple[float, ...]
    intervals: tuple[Interval, ...]
    errors: Array
    unseen: Array
    behind: tuple[float, Interval] = (0.0, (0.0, 0.0))


@dataclass(frozen=True)
class Identified:
    """What a table of impacts says.

    Attributes:
        laws: all of `LAWS`, in their order.
        own: error of each row by Newton's law with numbers of its own [1], shape (rows,).
        bound: error of each row by the best impulse at the contact [1], shape (rows,): no rigid law is better.
        folds: of the cross-validation.
    """

    laws: tuple[Fitted, ...]
    own: Array
    bound: Array
    folds: int

    @property
    def chosen(self) -> Fitted:
        """Of the laws that the engine has, that with the least cross-validated mean error."""
        return min((f for f in self.laws if f.law.engine), key=lambda fitted: float(fitted.unseen.mean()))


def identify(
    impacts: Impacts, folds: int = 5, seed: int = 1, on_law: Callable[[str, float], object] = lambda *_: None
) -> Identified:
    """Fit all laws.

    Args:
        impacts: measured.
        folds: number of parts of the rows; each is predicted by numbers fitted to the others.
        seed: whole number that decides folds and choices; the same gives the same numbers.
        on_law: told the label of each law before it is fitted, and which share is done.

    Raises:
        UsageError: there are too few impacts, or folds.
    """
    rows = len(impacts)
    if rows < FEWEST:
        raise UsageError(f"There are {rows} impacts; uncertain numbers need at least {FEWEST}.")
    if not 2 <= folds <= rows:
        raise UsageError(f"--folds {folds} cannot be: give from 2 to the number of impacts, {rows}, e.g. 5.")
    random = np.random.default_rng(seed)
    fold_of = random.permutation(rows) % folds
    choices = _choices(random, rows)
    fitted: list[Fitted] = []
    for number, law in enumerate(LAWS):
        on_law(law.label, number / (len(LAWS) + 1))
        fitted.append(_fitted(impacts, law, fold_of, choices))
    on_law("Bounds", len(LAWS) / (len(LAWS) + 1))
    own, bound = _own_numbers(impacts), impacts.errors(impacts.best_impulse())
    chosen = Identified(tuple(fitted), own, bound, folds).chosen
    return Identified(tuple(_behind(one, chosen, choices) for one in fitted), own, bound, folds)


def _choices(random: np.random.Generator, rows: int) -> list[Array]:
    """Weights of other choices of as many rows, with repetition (bootstrap), in blocks of shape (choices, rows)."""
    block = max(1, _BLOCK // rows)
    sizes = [min(block, CHOICES - done) for done in range(0, CHOICES, block)]
    return [random.multinomial(rows, np.full(rows, 1.0 / rows), size).astype(np.float32) for size in sizes]


def _fitted(impacts: Impacts, law: Law, fold_of: npt.NDArray[np.int64], choices: Sequence[Array]) -> Fitted:
    numbers = least(impacts, law)
    folds = int(fold_of.max()) + 1
    training = np.array([fold_of != fold for fold in range(folds)], dtype=np.float64)
    of_choices, of_folds = _of_others(impacts, law, numbers, choices, training)
    tail = 50.0 * (1.0 - SHARE)
    low, high = np.percentile(of_choices, (tail, 100.0 - tail), axis=0)
    unseen = np.empty(len(impacts))
    for fold, there in enumerate(of_folds):
        rows = fold_of == fold
        part = impacts.part(rows)
        unseen[rows] = part.errors(law.impulse(part.contact, *there))
    intervals = tuple((float(a), float(b)) for a, b in zip(low, high, strict=True))
    errors = impacts.errors(law.impulse(impacts.contact, *np.asarray(numbers)))
    return Fitted(law, numbers, intervals, errors, unseen)


def least(impacts: Impacts, law: Law) -> tuple[float, ...]:
    """The numbers of a law with the least mean error [1]: the best cell of ever finer grids, then a Newton step.

    Args:
        impacts: measured.
        law: which.
    """
    axes = [np.linspace(low, high, cells) for (low, high), cells in zip(BOUNDS, _COARSE, strict=True)][: law.numbers]
    for _ in range(_TIMES):
        means = _means(impacts, law, axes)
        place = np.unravel_index(int(np.argmin(means)), means.shape)
        axes = [
            _axis(float(axis[at]), _SPAN * float(axis[1] - axis[0]), bounds, _FINER)
            for axis, at, bounds in zip(axes, place, BOUNDS, strict=False)
        ]
    return tuple(_refined(axes, _means(impacts, law, axes)[None])[0].tolist())


def _axis(middle: float, half: float, bounds: Interval, cells: int) -> Array:
    """Places around a middle, moved as a whole, and if need be cut, so that they are within bounds."""
    low, high = bounds
    half = min(half, 0.5 * (high - low))
    begin = min(max(middle - half, low), high - 2.0 * half)
    return np.linspace(begin, begin + 2.0 * half, cells)


def _surface(impacts: Impacts, law: Law, axes: Sequence[Array], rows: slice = slice(None)) -> Array:
    """Errors of rows in all cells, shape (rows, cells), the last number fastest."""
    part = impacts.part(rows)
    contact = Contact(*(values[:, None] for values in part.contact))
    # mu by mu: arrays of a row's e (and e_t) stay in the cache, and Routh's path of compression is gone once
    others = np.array(list(product(*axes[1:]))).T
    columns = [part.errors(law.impulse(contact, mu, *others)) for mu in axes[0]]
    return np.concatenate(columns, axis=1)


def _means(impacts: Impacts, law: Law, axes: Sequence[Array]) -> Array:
    """Mean errors over all rows in all cells, of the shape of the grid."""
    shape = tuple(len(axis) for axis in axes)
    rows, block = len(impacts), max(1, _BLOCK // int(np.prod(shape)))
    sums = sum(_surface(impacts, law, axes, slice(begin, begin + block)).sum(axis=0) for begin in range(0, rows, block))
    return np.asarray(sums / rows).reshape(shape)


def _of_others(
    impacts: Impacts, law: Law, numbers: tuple[float, ...], choices: Sequence[Array], training: Array
) -> tuple[Array, Array]:
    """The numbers for choices of rows and for training sets, shapes (choices, numbers) and (folds, numbers)."""
    widen = 1.0
    while True:
        axes = [
            _axis(middle, widen * half, bounds, _CELLS[law.numbers])
            for middle, half, bounds in zip(numbers, _HALF, BOUNDS, strict=False)
        ]
        shape = tuple(len(axis) for axis in axes)
        rows, block = len(impacts), max(1, _BLOCK // int(np.prod(shape)))
        sums: list[Array] = [np.zeros((len(weights), int(np.prod(shape)))) for weights in (*choices, training)]
        for begin in range(0, rows, block):
            part = slice(begin, begin + block)
            surface = _surface(impacts, law, axes, part)
            for total, weights in zip(sums, (*choices, training), strict=True):
                total += weights[:, part] @ surface
        on_choices = np.concatenate(sums[:-1]).reshape(-1, *shape)
        if _on_rim(axes, on_choices) <= _ON_RIM or widen * min(_HALF) > 1.0:
            return _refined(axes, on_choices), _refined(axes, sums[-1].reshape(-1, *shape))
        widen *= 2.0


def _on_rim(axes: Sequence[Array], sums: Array) -> float:
    """Share of the tables whose least cell is on a rim that is no bound of the number."""
    places = np.unravel_index(sums.reshape(len(sums), -1).argmin(axis=1), sums.shape[1:])
    out = np.zeros(len(sums), dtype=bool)
    for axis, at, (low, high) in zip(axes, places, BOUNDS, strict=False):
        out |= (at == 0) & (axis[0] > low)
        out |= (at == len(axis) - 1) & (axis[-1] < high)
    return float(out.mean())


def _refined(axes: Sequence[Array], sums: Array) -> Array:
    """Places of the minima of tables, shape (tables, numbers): the least cell, and one Newton step within a cell.

    Gradient and Hessian are central differences around the cell, or around the next one inside where it is on the rim.
    """
    tables, shape = len(sums), np.array(sums.shape[1:])
    count = len(shape)
    least = np.stack(np.unravel_index(sums.reshape(tables, -1).argmin(axis=1), sums.shape[1:]), axis=1)
    middle = np.clip(least, 1, shape - 2)

    def at(*shifts: tuple[int, int]) -> Array:
        place = middle.copy()
        for axis, by in shifts:
            place[:, axis] += by
        return np.asarray(sums[(np.arange(tables), *place.T)])

    gradient = np.stack([0.5 * (at((k, 1)) - at((k, -1))) for k in range(count)], axis=1)
    hessian = np.empty((tables, count, count))
    for i, j in product(range(count), repeat=2):
        if i == j:
            hessian[:, i, i] = at((i, 1)) - 2.0 * at() + at((i, -1))
        else:
            corners = [a * b * at((i, a), (j, b)) for a, b in product((1, -1), repeat=2)]
            hessian[:, i, j] = 0.25 * sum(corners)
    # where a table is not convex there, its least cell stands
    convex = np.linalg.eigvalsh(hessian)[:, 0] > 0.0
    step = np.zeros((tables, count))
    step[convex] = -np.linalg.solve(hessian[convex], gradient[convex][:, :, None])[:, :, 0]
    offset = np.where(convex[:, None], np.clip(middle + step, least - 1, least + 1), least)
    offset = np.clip(offset, 0, shape - 1)
    begins, steps = np.array([axis[0] for axis in axes]), np.array([axis[1] - axis[0] for axis in axes])
    return np.asarray(begins + offset * steps)


def _own_numbers(impacts: Impacts) -> Array:
    """Least error of each row by Newton's law with numbers of its own, on a grid."""
    law = Law("own", "", newton)
    axes = [np.linspace(0.0, 1.0, _OWN_CELLS)] * 2
    rows, block = len(impacts), max(1, _BLOCK // _OWN_CELLS**2)
    parts = [_surface(impacts, law, axes, slice(begin, begin + block)).min(axis=1) for begin in range(0, rows, block)]
    return np.concatenate(parts)


def _behind(one: Fitted, chosen: Fitted, choices: Sequence[Array]) -> Fitted:
    """The law with how far it is behind the chosen one, row by row, on rows that the fits have not seen."""
    apart = one.unseen - chosen.unseen
    means = np.concatenate([weights @ apart for weights in choices]) / len(apart)
    tail = 50.0 * (1.0 - SHARE)
    low, high = np.percentile(means, (tail, 100.0 - tail))
    difference = float(apart.mean()), (float(low), float(high))
    return Fitted(one.law, one.numbers, one.intervals, one.errors, one.unseen, difference)

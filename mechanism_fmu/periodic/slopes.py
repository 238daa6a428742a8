"""The derivative of the map from one cycle to the next, through its impacts: differences along one order of events.

Through an impact the motion is a smooth function of its beginning as long as events keep their order (what the
saltation matrix says in closed form); so differences between motions with the same events, extrapolated to a step of
zero, are that derivative. Where however small steps change the order, there is none: the motion grazes.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..model import MechanismError
from ..moving import SimulationError
from .passage import CycleError, Passage
from .start import Array, Problem

#: Steps, over the scale of the unknown [1]: the first, by how much each is less, how many are extrapolated.
_FIRST, _LESS, _LEVELS = 4e-3, 2.0, 6
#: Where events change, steps become less down to this, over the scale [1].
_LEAST = 1e-7
#: In Newton's method one step does.
_ROUGH = 1e-4

#: From unknowns to the end of the cycle: the compared outputs, less what they advance; and the passage.
Map = Callable[[Array], tuple[Array, Passage]]


class GrazingError(CycleError):
    """The order of events changes however little the beginning does: there is no derivative."""


@dataclass(frozen=True)
class Slopes:
    """A derivative, and how well it is known.

    Attributes:
        matrix: d end / d beginning, shape (unknowns, unknowns) [their units].
        errors: estimated from the extrapolation, the same shape.
    """

    matrix: Array
    errors: Array


def slopes(problem: Problem, cycle: Map, x: Array, sequence: tuple[str, ...], least: float = _LEAST) -> Slopes:
    """The derivative by differences on both sides, extrapolated.

    Args:
        problem: whose unknowns they are.
        cycle: the map.
        x: where, shape (unknowns,).
        sequence: of the events there.
        least: step over the scale of the unknown [1], within which events must keep their order.

    Raises:
        GrazingError: the order of events changes within the least step.

    Source: C. J. F. Ridders, Accurate computation of F'(x) and F'(x) F''(x), Advances in Engineering Software 4 (1982).
    """
    columns = [_column(problem, cycle, x, k, sequence, max(least, _LEAST)) for k in range(len(x))]
    return Slopes(np.column_stack([c for c, _ in columns]), np.column_stack([e for _, e in columns]))


def rough_slopes(problem: Problem, cycle: Map, x: Array) -> Array:
    """The derivative as Newton's method needs it, shape (unknowns, unknowns): one difference for each unknown.

    Args:
        problem: whose unknowns they are.
        cycle: the map.
        x: where, shape (unknowns,).
    """
    steps = _ROUGH * problem.scales(x)
    columns = []
    for step in np.diag(steps):
        size = float(np.abs(step).sum())
        columns.append((cycle(x + step)[0] - cycle(x - step)[0]) / (2.0 * size))
    return np.column_stack(columns)


def _column(
    problem: Problem, cycle: Map, x: Array, k: int, sequence: tuple[str, ...], least: float
) -> tuple[Array, Array]:
    """The derivative by one unknown, and its error; each shape (unknowns,)."""
    scale = float(problem.scales(x)[k])
    step, change = _FIRST * scale, ""
    rows: list[list[Array]] = []
    best, error = np.zeros_like(x), np.full_like(x, np.inf)
    while len(rows) < _LEVELS and step > least * scale:
        ends = []
        for side in (1.0, -1.0):
            moved = x.copy()
            moved[k] += side * step
            end, differs = _end(cycle, moved, sequence)
            change = differs or change
            ends.append(end)
        if ends[0] is None or ends[1] is None:
            rows.clear()  # only what lies within one order of events is extrapolated
            best, error = np.zeros_like(x), np.full_like(x, np.inf)
        else:
            rows.append([(ends[0] - ends[1]) / (2.0 * step)])
            best, error = _extrapolated(rows, best, error)
        step /= _LESS
    if not rows:
        name = problem.unknowns[k]
        raise GrazingError(
            f"Grazing: within {2.0 * step:.1e} {name.unit} of {name.name} = {x[k]:.9g} {name.unit} the order of events "
            f"changes: {change}. There the motion has no derivative, and so no multipliers. Change a parameter so that "
            "this contact clearly strikes or clearly misses, or begin the cycle elsewhere, where no contact is about "
            "to touch."
        )
    if len(rows) == 1:
        error = np.abs(best)
    return best, error


def _extrapolated(rows: list[list[Array]], best: Array, error: Array) -> tuple[Array, Array]:
    """The last row of Richardson's table filled, and of each component the entry that is known best."""
    row, factor = rows[-1], _LESS * _LESS
    if len(rows) == 1:
        return row[0], error
    for j, above in enumerate(rows[-2]):
        power = factor ** (j + 1)
        row.append((power * row[j] - above) / (power - 1.0))
        new = np.maximum(np.abs(row[-1] - row[j]), np.abs(row[-1] - above))
        better = new <= error
        best, error = np.where(better, row[-1], best), np.where(better, new, error)
    return best, error


def _end(cycle: Map, x: Array, sequence: tuple[str, ...]) -> tuple[Array | None, str]:
    """The end of a cycle with this order of events; or None, and what is otherwise."""
    try:
        end, passage = cycle(x)
    except (CycleError, MechanismError, SimulationError) as error:
        return None, f"on one side it says {str(error)!r}"
    if passage.sequence == sequence:
        return end, ""
    return None, _difference(sequence, passage)


def _difference(sequence: tuple[str, ...], other: Passage) -> str:
    """The first event that is another, in words."""
    there = other.sequence
    place = next((i for i, (a, b) in enumerate(zip(sequence, there, strict=False)) if a != b), None)
    if place is None:
        place = min(len(sequence), len(there))
    here = sequence[place] if place < len(sequence) else "the end of the cycle"
    if place < len(there):
        return f"{here} is event {place + 1}, but beside it {there[place]} at {other.events[place].time:.9g} s"
    return f"{here} is event {place + 1}, but beside it the cycle ends before"

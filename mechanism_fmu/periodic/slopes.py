"""The derivative of the map from one cycle to the next, through its impacts: differences along one order of events."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from .. import differences
from ..differences import Sample, Slopes
from ..model import MechanismError
from ..moving import SimulationError
from .passage import CycleError, Passage
from .start import Array, Problem

#: Within such a step, over the scale of the unknown [1], events must keep their order.
_LEAST = 1e-7
#: In Newton's method one step does.
_ROUGH = 1e-4

#: From unknowns to the end of the cycle: the compared outputs, less what they advance; and the passage.
Map = Callable[[Array], tuple[Array, Passage]]


class GrazingError(CycleError):
    """The order of events changes however little the beginning does: there is no derivative."""


def slopes(problem: Problem, cycle: Map, x: Array, sequence: tuple[str, ...], least: float = _LEAST) -> Slopes:
    """The derivative of the end of a cycle by its beginning, shape (unknowns, unknowns) [their units].

    Args:
        problem: whose unknowns they are.
        cycle: the map.
        x: where, shape (unknowns,).
        sequence: of the events there.
        least: step over the scale of the unknown [1], within which events must keep their order.

    Raises:
        GrazingError: the order of events changes within the least step.
    """

    def sample(points: Sequence[Array]) -> list[Sample]:
        return [Sample(*_end(cycle, point, sequence)) for point in points]

    found = differences.slopes(sample, cycle(x)[0], x, problem.scales(x), least=max(least, _LEAST))
    for unknown, value, change, within in zip(problem.unknowns, x, found.changes, found.within, strict=True):
        if change:
            raise GrazingError(
                f"Grazing: within {within:.1e} {unknown.unit} of {unknown.name} = {value:.9g} {unknown.unit} the order "
                f"of events changes: {change}. There the motion has no derivative, and so no multipliers. Change a "
                "parameter so that this contact clearly strikes or clearly misses, or begin the cycle elsewhere, where "
                "no contact is about to touch."
            )
    return found


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

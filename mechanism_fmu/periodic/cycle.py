"""A periodic motion by shooting: Newton's method on the map from the beginning of a cycle to its end.

x is sought with P(x) = x, P the state at the end of the cycle less what it advances. Floquet multipliers are the
eigenvalues of dP/dx there; all within the unit circle: what is disturbed returns. On a section that of the direction
along the motion, 1, is not among them.

Source: R. Seydel, Practical Bifurcation and Stability Analysis, 3rd ed. (2010), sections 7.4 and 7.5; through impacts:
R. I. Leine, H. Nijmeijer, Dynamics and Bifurcations of Non-Smooth Mechanical Systems (2004), chapters 7 and 8.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from ..model import MechanismError
from ..moving import Event, SimulationError
from .passage import CycleError, Passage, Section, passages
from .slopes import rough_slopes, slopes
from .start import COORDINATES, RATES, Array, Problem

#: The end is the beginning within this, over the scales of the unknowns [1]; what Newton's method can no longer mend,
#: within the second.
_CLOSED, _NEARLY = 1e-10, 1e-7
#: Where Newton's method comes no nearer than this, the same, whether it grazes is asked first.
_NEAR_GRAZING = 1e-4
_ITERATIONS, _HALVINGS = 20, 8
#: The next cycle is the same within this, over the scales of the unknowns [1].
_AGAIN = 1e-5
#: Errors of the integration over its tolerance, and those of multipliers by them [1].
_OF_INTEGRATION = 1e2
#: A start that is farther from the section, over the scale of rates and coordinates [1], is not on it.
_ON_SECTION = 1e-6


@dataclass(frozen=True)
class Cycle:
    """A periodic motion.

    Attributes:
        problem: what was asked.
        start: the unknowns at its beginning, shape (unknowns,) [their units].
        period: [s].
        multipliers: Floquet's, largest first, shape (unknowns,), complex.
        errors: of these, estimated by the extrapolation, the same shape.
        matrix: derivative of the end by the beginning, shape (unknowns, unknowns) [their units].
        residual: largest difference of end and beginning, over the scales of the unknowns [1].
        again: the same of the cycle after this one, without a new start [1].
        events: of the cycle.
        closing: closing speeds of impacts, by time [m/s; rad/s].
        moved: coordinates that have advanced at the end, by name [m, rad].
        iterations: of Newton's method.
    """

    problem: Problem
    start: Array
    period: float
    multipliers: npt.NDArray[np.complex128]
    errors: Array
    matrix: Array
    residual: float
    again: float
    events: tuple[Event, ...]
    closing: dict[float, float]
    moved: dict[str, float]
    iterations: int

    @property
    def margins(self) -> Array:
        """How far each multiplier may be off, shape (unknowns,): its error, and what the integration adds."""
        return np.maximum(self.errors, _OF_INTEGRATION * self.problem.tolerance)

    @property
    def stable(self) -> bool:
        """Whether all multipliers are within the unit circle, by more than their margin."""
        return bool(np.all(np.abs(self.multipliers) + self.margins < 1.0))

    @property
    def undecided(self) -> bool:
        """Whether the largest multiplier is on the unit circle as far as it is known."""
        sizes = np.abs(self.multipliers)
        return not self.stable and bool(np.all(sizes - self.margins <= 1.0))


def find_cycle(
    problem: Problem,
    end: Section | float,
    settle: int = 0,
    report: Callable[[str, float], None] = lambda _text, _done: None,
) -> Cycle:
    """The periodic motion near the start of the model, or near what the motion is after some cycles.

    Args:
        problem: model, numbers and unknowns.
        end: where a cycle ends: the section, or the period [s].
        settle: so many cycles go by before Newton's method begins: where the motion attracts, it then begins near.
        report: is called with what is done, and which share of the whole (0..1).

    Raises:
        CycleError: none is found; the message says why and what to do.
        GrazingError: it has no multipliers.
        MechanismError: the mechanism cannot begin as the problem says.
        SimulationError: the motion cannot go on.

    Source: R. Seydel, Practical Bifurcation and Stability Analysis, 3rd ed. (2010), sections 7.4 and 7.5.
    """
    problem = _settled(problem, end, settle).with_state()
    if isinstance(end, Section) and problem.state and any(unknown.of_body for unknown in problem.unknowns):
        end = end.after(settle)
    if isinstance(end, Section) and end.output.rpartition(".")[2] in COORDINATES + RATES:
        problem = replace(problem, held=(end.output,))
    if problem.touching:
        raise CycleError(
            f"Closed at the beginning of the cycle: {', '.join(problem.touching)}. Where a contact of outlines is "
            "closed, its bodies cannot be moved one by one: one side would be inside. Begin the cycle where none is: "
            "with another --section or value of it, or another phase of the drive."
        )
    x = problem.guess()
    _require_on_section(problem, end, x)

    def cycle(x: Array) -> tuple[Array, Passage]:
        (passage,) = passages(lambda: problem.simulation(x), end)
        return _compared(problem, passage) - problem.advances, passage

    x, iterations, residual = _newton(problem, cycle, x, report)
    first, second = passages(lambda: problem.simulation(x), end, 2)
    again = _again(problem, x, first, second)
    if _AGAIN < again <= _NEAR_GRAZING:  # what may graze, and does no more, or does so only then
        slopes(problem, cycle, x, first.sequence, 30.0 * again)
    if again > _AGAIN:
        raise CycleError(_another(problem, x, first, again))
    report("multipliers", 0.7)
    found = slopes(problem, cycle, x, first.sequence)
    multipliers, errors = _multipliers(found.matrix, found.errors)
    return Cycle(
        problem,
        x,
        first.time,
        multipliers,
        errors,
        found.matrix,
        residual,
        again,
        first.events,
        {event.time: first.closing[event.time] for event in first.events if event.time in first.closing},
        _moved(first.values, problem.simulation(x).read()),
        iterations,
    )


def _settled(problem: Problem, end: Section | float, settle: int) -> Problem:
    """The problem from the state after so many cycles."""
    if settle <= 0:
        return problem
    from_start = replace(problem, unknowns=(), state=None)
    last = passages(lambda: from_start.simulation(np.zeros(0)), end, settle)[-1]
    return replace(problem, state=dict(last.values), closed=last.closed)


def _require_on_section(problem: Problem, end: Section | float, x: Array) -> None:
    if not isinstance(end, Section):
        return
    values = problem.simulation(x).read()
    if end.output not in values:
        names = ", ".join(name for name in values if "[" not in name and not name.startswith("drawing"))
        raise MechanismError(f"There is no output {end.output!r} for a section; there are: {names}.")
    if abs(values[end.output] - end.value) > _ON_SECTION * max(1.0, abs(end.value)):
        raise MechanismError(
            f"The cycle must begin on the section {end.output} = {end.value:g}, but there it is "
            f"{values[end.output]:.6g}. Set start parameters so that it is, or name coordinates and rates of bodies as "
            "unknown and let the motion go there first, with --settle 1 or more."
        )


def _compared(problem: Problem, passage: Passage) -> Array:
    return np.array([passage.values[unknown.output] for unknown in problem.unknowns])


def _newton(
    problem: Problem,
    cycle: Callable[[Array], tuple[Array, Passage]],
    x: Array,
    report: Callable[[str, float], None],
) -> tuple[Array, int, float]:
    """The fixed point, the iterations, and the residual over the scales; steps that do not help are halved."""

    def rest(x: Array) -> Array:
        return cycle(x)[0] - x

    r = rest(x)
    for iteration in range(_ITERATIONS):
        size = float(np.max(np.abs(r) / problem.scales(x)))
        report(f"iteration {iteration}, residual {size:.1e}", min(0.6, iteration / 10))
        if size <= _CLOSED:
            return x, iteration, size
        matrix = np.eye(len(x)) - rough_slopes(problem, cycle, x)
        if np.linalg.cond(matrix) > 1e12:
            raise CycleError(
                "A multiplier is 1: each beginning near by is as good as this one, or grows without end. If the cycle "
                "is of any amplitude, as without losses, fix one unknown; if a coordinate goes on by itself, leave it "
                "out, or say by how much with --advance."
            )
        step = np.linalg.solve(matrix, r)
        for halving in range(_HALVINGS):
            moved = x + step / 2**halving
            try:
                new = rest(moved)
            except (CycleError, MechanismError, SimulationError):
                continue
            if np.max(np.abs(new) / problem.scales(x)) < size:
                x, r = moved, new
                break
        else:
            if size <= _NEARLY:
                return x, iteration, size
            if size <= _NEAR_GRAZING:  # impacts that come and go keep Newton's method from its end
                slopes(problem, cycle, x, cycle(x)[1].sequence, 30.0 * size)
            raise CycleError(_not_found(problem, x, size))
    raise CycleError(_not_found(problem, x, float(np.max(np.abs(r) / problem.scales(x)))))


def _not_found(problem: Problem, x: Array, size: float) -> str:
    where = ", ".join(f"{u.name} = {value:.6g} {u.unit}" for u, value in zip(problem.unknowns, x, strict=True))
    return (
        f"No periodic motion near {where}: the end differs from the beginning by {size:.2g} of the scales, and no "
        f"step makes that less ({_CLOSED:g} is wanted). Begin elsewhere with --set, or, if the motion attracts, let it "
        "come there first, with --settle 20."
    )


def _again(problem: Problem, x: Array, first: Passage, second: Passage) -> float:
    """How much the second cycle differs from the first, over the scales [1]."""
    change = _compared(problem, second) - _compared(problem, first) - problem.advances
    late = abs(second.time - 2.0 * first.time) / first.time
    return max(float(np.max(np.abs(change) / problem.scales(x))), late)


def _another(problem: Problem, x: Array, first: Passage, size: float) -> str:
    others = [
        f"{name} by {value:.3g}" for name, value in _moved(first.values, problem.simulation(x).read(), True).items()
    ]
    return (
        f"The unknowns return, but the next cycle is another one: it differs by {size:.2g}, where {_AGAIN:g} is "
        f"allowed. Something that is not among the unknowns does not return. What has changed in the first cycle: "
        f"{', '.join(others) or 'no coordinate'}. Name it as unknown (with --advance if it goes on by itself), or take "
        "more --passages."
    )


def _moved(last: Mapping[str, float], begun: Mapping[str, float], rates: bool = False) -> dict[str, float]:
    """Coordinates, and where wanted rates, too, that differ at the end from the beginning."""
    kinds = COORDINATES + (RATES if rates else ())
    changes = {name: last[name] - begun[name] for name in begun if "." in name and name.rpartition(".")[2] in kinds}
    return {name: change for name, change in changes.items() if abs(change) > 1e-7}


def _multipliers(matrix: Array, errors: Array) -> tuple[npt.NDArray[np.complex128], Array]:
    """Eigenvalues, largest first, and to first order what the errors of the matrix make of them.

    Source: J. H. Wilkinson, The Algebraic Eigenvalue Problem (1965), chapter 2, section 8.
    """
    values, right = np.linalg.eig(matrix.astype(np.complex128))
    order = np.argsort(-np.abs(values), kind="stable")
    values, right = values[order], right[:, order]
    try:
        left = np.linalg.inv(right)  # rows are the left vectors, with left @ right = 1
    except np.linalg.LinAlgError:
        return values, np.full(len(values), float(errors.max()))
    bounds = np.array([float(np.abs(left[k]) @ errors @ np.abs(right[:, k])) for k in range(len(values))])
    return values, bounds

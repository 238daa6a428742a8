"""Kineto-elastodynamic synthesis: the lightest linkage that keeps to its path and below its stress at its speed.

The paper names it; the method is this project's: sequential quadratic programming over cross-sections, and lengths if
wanted, with one constraint for every time of the cycle.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.optimize import minimize

from .cycle import Cycle
from .elastic_cycle import MassModel, deflection_of, elastic_cycle, stress_of
from .elements import FloatArray, LinkageError
from .responses import periodic_response
from .structure.linkage import Linkage
from .structure.places import named_place

# What a design of a linkage is worth: its mass, how far it strays from the path, and how much it is stressed.


@dataclass(frozen=True)
class Judgement:
    """A design over a cycle.

    Attributes:
        mass: of all members [kg]; lumped masses and rigid bodies are not for the design to change.
        deviation: of the path point from the path that is wanted, shape (times,) [m].
        stress: the largest in each element, shape (times, elements) [Pa].
    """

    mass: float
    deviation: FloatArray
    stress: FloatArray


def judge_quasi_static(cycle: Cycle, place: str, target: FloatArray | None = None) -> Judgement:
    """By Case 2: the rigid motion's inertia bends the linkage.

    Args:
        cycle: over one period.
        place: of the path point, e.g. "arm.end".
        target: the path that is wanted, shape (times, 2) [m]; by default that of the same linkage if it were rigid.

    Raises:
        LinkageError: there is no such place.

    Source: Case 2 of Erdman, Sandor, Oakberg (1972): `quasi_static`; docs/explanation/elastodynamics-dynamics.md,
        section Synthesis.
    """
    return _judged(cycle, cycle.displacement, place, target)


def judge_steady_state(
    cycle: Cycle,
    place: str,
    damping_ratio: float,
    target: FloatArray | None = None,
    mass_model: MassModel = MassModel.LUMPED,
) -> Judgement:
    """By Case 3: the periodic motion of the swinging linkage.

    Args:
        cycle: over one period, its end included, as `elastic_cycle` asks for it.
        place: of the path point.
        damping_ratio: zeta of every mode [-].
        target: as of `judge_quasi_static`.
        mass_model: of the members.

    Warns:
        UserWarning: as of `periodic_response`.

    Raises:
        LinkageError: as of `elastic_cycle`, or there is no such place.
        ValueError: as of `periodic_response`.

    Source: docs/explanation/elastodynamics-dynamics.md, section Synthesis, by eqs (K1) to (K5).
    """
    swinging = elastic_cycle(cycle, damping_ratio, mass_model)
    displacement = periodic_response(swinging).samples(swinging.samples)
    return _judged(cycle, np.vstack([displacement, displacement[:1]]), place, target)


def member_mass(linkage: Linkage) -> float:
    """Mass of all members [kg].

    Args:
        linkage: whose members count; lumped masses and rigid bodies do not.

    Source: textbook: the sum of rho A l.
    """
    return float(sum(e.member.density * e.member.section.area * e.length for e in linkage.elements))


def rigid_path(cycle: Cycle, place: str) -> FloatArray:
    """Where a place would be if nothing bent, shape (times, 2) [m].

    Args:
        cycle: of the linkage.
        place: its name, e.g. "arm.end".

    Raises:
        LinkageError: there is no such place.

    Source: the motion itself: r + A s of a point of a body, as of ME451.
    """
    places = cycle.configurations.linkage.freedoms.places
    of = places[named_place(places, place)]
    return cycle.configurations.pose.place(of.body, of.point)


def _judged(cycle: Cycle, displacement: FloatArray, place: str, target: FloatArray | None) -> Judgement:
    configurations = cycle.configurations
    off = deflection_of(configurations, displacement, place)[:, :2]
    if target is not None:
        off = off + rigid_path(cycle, place) - target
    return Judgement(
        member_mass(configurations.linkage), np.hypot(off[:, 0], off[:, 1]), stress_of(configurations, displacement)
    )


#: By how much the search stays inside the limits, in parts of them, so that rounding cannot leave it outside.
_MARGIN = 1e-6
#: Step of the forward differences, in parts of the way between the bounds.
_STEP = 1e-6
#: When the search ends: the change of the mass, in parts of that at the start.
_SETTLED = 1e-8


@dataclass(frozen=True)
class Synthesis:
    """What a search found.

    Attributes:
        design: x, shape (n,).
        before, after: the design that it began with, and the one that it found.
        evaluations: how many designs were judged.
    """

    design: FloatArray
    before: Judgement
    after: Judgement
    evaluations: int


def lightest(
    judge: Callable[[FloatArray], Judgement],
    start: npt.ArrayLike,
    lower: npt.ArrayLike,
    upper: npt.ArrayLike,
    largest_deviation: float,
    largest_stress: float,
) -> Synthesis:
    """The design of least mass whose deviation and stress stay within limits at all times of its cycle.

    What it finds is the lightest in its neighbourhood; where the limits leave several regions, as on either side of a
    resonance, start from each. If the search does not come within the limits from `start`, it tries once from `upper`.

    Args:
        judge: of a design x, shape (n,).
        start: the design to begin with, shape (n,).
        lower: bounds of the design, shape (n,).
        upper: bounds of the design, shape (n,), above the lower ones.
        largest_deviation: [m].
        largest_stress: [Pa].

    Raises:
        LinkageError: bounds or limits cannot be, or no design was found within the limits; the message says how near
            the best came.

    Source: sequential quadratic programming, SLSQP of scipy; docs/explanation/elastodynamics-dynamics.md, section
        Synthesis. Erdman, Sandor, Oakberg (1972) name synthesis; the method is this project's.
    """
    search = _Search(judge, *_box(start, lower, upper), largest_deviation, largest_stress)
    if not (largest_deviation > 0.0 and largest_stress > 0.0):
        raise LinkageError(
            f"The limits are {largest_deviation:g} m and {largest_stress:g} Pa, but both must be positive."
        )
    ends = []
    for begin in (search.scaled_start, np.ones_like(search.scaled_start)):
        ends.append(search.run(begin))
        if search.within(ends[-1]):
            return Synthesis(search.design(ends[-1]), search.at(search.scaled_start), search.at(ends[-1]), search.count)
    best = min(ends, key=search.excess)
    judged = search.at(best)
    raise LinkageError(
        f"No design between the bounds was found that keeps the deviation below {largest_deviation:g} m and the stress "
        f"below {largest_stress:g} Pa; the best has {judged.deviation.max():.4g} m and {judged.stress.max():.4g} Pa, "
        f"at {search.design(best)}. Widen the bounds, or allow more."
    )


class _Search:
    """Designs scaled to 0..1 between their bounds, each judged once."""

    def __init__(
        self,
        judge: Callable[[FloatArray], Judgement],
        start: FloatArray,
        lower: FloatArray,
        upper: FloatArray,
        largest_deviation: float,
        largest_stress: float,
    ) -> None:
        self._judge, self._lower, self._width = judge, lower, upper - lower
        self._limits = largest_deviation, largest_stress
        self._known: dict[bytes, Judgement] = {}
        self.scaled_start = (start - lower) / self._width
        self.count = 0

    def design(self, scaled: FloatArray) -> FloatArray:
        return self._lower + scaled * self._width

    def at(self, scaled: FloatArray) -> Judgement:
        key = scaled.tobytes()
        if key not in self._known:
            self._known[key] = self._judge(self.design(scaled))
            self.count += 1
        return self._known[key]

    def mass(self, scaled: FloatArray) -> float:
        return self.at(scaled).mass / self.at(self.scaled_start).mass

    def slack(self, scaled: FloatArray) -> FloatArray:
        """What is left to the limits in parts of them, for every time, shape (times * (1 + elements),)."""
        judged, (deviation, stress) = self.at(scaled), self._limits
        used = np.concatenate([judged.deviation / deviation, judged.stress.ravel() / stress])
        return np.asarray(1.0 - _MARGIN - used)

    def excess(self, scaled: FloatArray) -> float:
        return float(-self.slack(scaled).min())

    def within(self, scaled: FloatArray) -> bool:
        return self.excess(scaled) <= _MARGIN

    def run(self, begin: FloatArray) -> FloatArray:
        found = minimize(
            self.mass,
            begin,
            jac=lambda x: self._slopes(self.mass, x),
            bounds=[(0.0, 1.0)] * len(begin),
            constraints={"type": "ineq", "fun": self.slack, "jac": lambda x: self._slopes(self.slack, x).T},
            method="SLSQP",
            options={"ftol": _SETTLED, "maxiter": 100},
        )
        return np.asarray(np.clip(found.x, 0.0, 1.0))

    def _slopes(self, function: Callable[[FloatArray], FloatArray | float], x: FloatArray) -> FloatArray:
        """Derivatives by each coordinate, shape (n, ...), away from the nearer bound."""
        steps = np.where(x <= 0.5, _STEP, -_STEP)
        here = function(x)
        return np.array([(function(x + row) - here) / row.sum() for row in np.diag(steps)])


def _box(start: npt.ArrayLike, lower: npt.ArrayLike, upper: npt.ArrayLike) -> tuple[FloatArray, FloatArray, FloatArray]:
    x, low, high = (np.atleast_1d(np.asarray(values, dtype=float)) for values in (start, lower, upper))
    if not (x.shape == low.shape == high.shape and np.all((low <= x) & (x <= high) & (low < high))):
        raise LinkageError(
            f"The start {x} must have as many numbers as the bounds {low} and {high}, and lie between them; lower "
            "bounds must be below upper ones."
        )
    return x, low, high

"""What a design of a linkage is worth: its mass, how far it strays from the path, and how much it is stressed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .cycle import Cycle
from .dynamics import MassModel, deflection_of, elastic_cycle, stress_of
from .elements import FloatArray
from .linkage import Linkage
from .periodic import periodic_response
from .places import named_place


@dataclass(frozen=True)
class Judgement:
    """A design over a cycle.

    Attributes:
        mass: of all members [kg]; disks and rigid bodies are not for the design to change.
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
        target: the path that is wanted, shape (times, 2) [m]; unless told, that of the same linkage if it were rigid.

    Raises:
        LinkageError: there is no such place.
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
    """
    swinging = elastic_cycle(cycle, damping_ratio, mass_model)
    displacement = periodic_response(swinging).samples(swinging.samples)
    return _judged(cycle, np.vstack([displacement, displacement[:1]]), place, target)


def member_mass(linkage: Linkage) -> float:
    """Mass of all members [kg]."""
    return float(sum(e.member.density * e.member.section.area * e.length for e in linkage.elements))


def rigid_path(cycle: Cycle, place: str) -> FloatArray:
    """Where a place would be if nothing bent, shape (times, 2) [m].

    Raises:
        LinkageError: there is no such place.
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

"""Case 3: from the quasi-static cycle of a linkage to its equations of motion, and back to deflections and stresses."""

from __future__ import annotations

from enum import Enum

import numpy as np
import numpy.typing as npt

from .configuration import Configurations
from .consistent import consistent_load, consistent_mass
from .cycle import Cycle
from .elastic_cycle import ElasticCycle
from .elements import FloatArray
from .errors import LinkageError
from .frequencies import instantaneous_modes
from .masses import mass_matrix, system_forces
from .stresses import largest_stress, section_forces

#: What the end of a period may differ from its beginning, in parts of the largest value.
_CLOSED = 1e-6


class MassModel(Enum):
    """Where the mass of a member is.

    LUMPED: half at each of its ends: the paper's Case 2 has masses at the joints, the halves are this project's. A
        rotation without a disk has no inertia then.
    CONSISTENT: along it, swinging with the cubics in which it bends.
    """

    LUMPED = "lumped"
    CONSISTENT = "consistent"


def elastic_cycle(cycle: Cycle, damping_ratio: npt.ArrayLike, mass_model: MassModel = MassModel.LUMPED) -> ElasticCycle:
    """M u'' + C u' + K u = P over one period, with the loads, friction and inertia forces of the quasi-static cycle.

    Args:
        cycle: over one period, at even times, its end included: configurations and loads there are those of the start.
        damping_ratio: zeta of every mode, or of each of the m modes in ascending order [-].
        mass_model: of the members.

    Raises:
        LinkageError: the times are not even, or what the cycle ends with is not what it began with.
        ValueError: as of `InstantaneousModes.damping`.
    """
    configurations = cycle.configurations
    steps = np.diff(configurations.pose.time)
    if len(steps) == 0 or np.ptp(steps) > 1e-9 * steps.max():
        raise LinkageError("The times of a cycle must be even, e.g. numpy.linspace(0, period, 361).")
    load = system_forces(configurations, cycle.forces)
    if mass_model is MassModel.LUMPED:
        mass = mass_matrix(configurations)
    else:
        mass = consistent_mass(configurations)
        load = load + consistent_load(configurations)
    for name, values in (("stiffness", configurations.stiffness), ("load", load)):
        gap, most = np.abs(values[-1] - values[0]).max(), np.abs(values).max()
        if gap > _CLOSED * most:
            raise LinkageError(
                f"The {name} at the end of the cycle differs from that at its beginning by {gap:.3g}, of {most:.3g} at "
                "most: give one whole period, from its beginning to its end, of a motion that repeats."
            )
    stiffness = configurations.stiffness[:-1]
    mass = np.broadcast_to(mass, configurations.stiffness.shape)[:-1]
    damping = instantaneous_modes(stiffness, mass).damping(damping_ratio)
    return ElasticCycle(float(steps.sum()), mass, damping, stiffness, load[:-1])


def deflection_of(configurations: Configurations, displacement: FloatArray, place: str) -> FloatArray:
    """(delta_x, delta_y, rotation) of a place, shape (times, 3) [m, m, rad], from u, shape (times, m).

    Raises:
        LinkageError: there is no such place.
    """
    return np.asarray((configurations.displacement(place) @ displacement[:, :, None])[:, :, 0])


def stress_of(configurations: Configurations, displacement: FloatArray) -> FloatArray:
    """Largest stress in each element, shape (times, elements) [Pa], from u, shape (times, m): f = F^-1 C u.

    Inertia forces between the ends of a member bend it further; that part, of lumped masses none, is not in it.
    """
    linkage = configurations.linkage
    deformation = (configurations.compatibility @ displacement[:, :, None])[:, :, 0]
    element_forces = np.asarray(np.linalg.solve(linkage.flexibility, deformation.T).T)
    return largest_stress(linkage, section_forces(linkage, element_forces))

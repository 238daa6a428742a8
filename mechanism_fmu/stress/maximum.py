"""The largest bending stress that an impact leaves in a tooth."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache

from .beam import Beam
from .checks import require_impact_velocity, require_within
from .converged import WEDGE, converged_modes
from .field import BendingField
from .material import Material
from .modes import ritz_modes
from .natural_mode import Mode
from .search import largest_stress
from .tooth import WedgeTooth

#: With less damping there are thousands of nearly equal swings to compare, and with none there is no largest one.
_LEAST_DAMPING = 1e-4


@dataclass(frozen=True)
class MaximumStress:
    """Where and when the tooth is stressed most after an impact.

    Attributes:
        stress: |sigma_b| of the outer fibre [Pa].
        position: xi = x / length [-], 0 at the root, 1 at the tip.
        time: since the impact [s].
        coefficient: C = stress / (v_I sqrt(rho E)) [-]; for beams of one shape it depends only on the damping ratio,
            the number of modes and their scaling.
    """

    stress: float
    position: float
    time: float
    coefficient: float


def maximum_stress(
    tooth: Beam, material: Material, impact_velocity: float, modes: tuple[Mode, ...] | None = None
) -> MaximumStress:
    """Largest |sigma_b| of `bending_stress` over length and time: 1e-10 relative, its position to 1e-5.

    The stress is proportional to the velocity, so the search is made once for a tooth and a material and then
    remembered; a further impact on the same tooth costs microseconds. At velocity 0 the stress is 0, and position,
    time and coefficient are those of every other velocity.

    Args:
        tooth: the beam.
        material: what it is made of; here its damping ratio must be 1e-4 or more.
        impact_velocity: |v_I| [m/s], >= 0: the tooth's length times the jump of the wheel's rate in the impact,
            l |omega_after - omega_before|. A turning tooth does not vibrate, only the jump of its rotation makes it.
        modes: the modes that take part; without them the two of `ritz_modes`, as in the paper. `converged_modes` give
            the stress of all modes.

    Raises:
        ValueError: when velocity or damping ratio is outside its limits or not a number, or `modes` is empty.

    Source: Pennestrì, Valentini, Vita, eqs (13), (16) and section 5.1.
    """
    require_impact_velocity(impact_velocity)
    found = _of_wedge(tooth, material, modes) if isinstance(tooth, WedgeTooth) else None
    if found is None:
        found = _maximum_at_unit_velocity(tooth, material, modes)
    return replace(found, stress=found.stress * impact_velocity)


def _of_wedge(tooth: WedgeTooth, material: Material, modes: tuple[Mode, ...] | None) -> MaximumStress | None:
    """What one wedge of E = rho = 1 says of all, for the paper's modes and the converged ones; None for others.

    A ~ 1 - xi and I ~ (1 - xi)^3, so that only the scale of time differs. It is l^2 / (h sqrt(E / rho)) with the root's
    height h = l tan(alpha): l / (tan(alpha) sqrt(E / rho)), 1 for the reference wedge.
    """
    unit = Material(1.0, 1.0, material.damping_ratio)
    if modes is None:
        found = _maximum_at_unit_velocity(WEDGE, unit, None)
    elif modes == converged_modes(tooth, material):
        found = _maximum_at_unit_velocity(WEDGE, unit, converged_modes(WEDGE, unit))
    else:
        return None
    slowness = math.sqrt(material.density / material.youngs_modulus)
    return replace(
        found,
        stress=found.coefficient * math.sqrt(material.density * material.youngs_modulus),
        time=found.time * slowness * tooth.length / math.tan(tooth.apex_angle),
    )


@lru_cache(maxsize=1024)
def _maximum_at_unit_velocity(tooth: Beam, material: Material, modes: tuple[Mode, ...] | None) -> MaximumStress:
    advice = "with less, the largest stress comes after very many swings or never"
    require_within("damping ratio", material.damping_ratio, _LEAST_DAMPING, 1.0, "", advice)
    field = BendingField(tooth, material, ritz_modes(tooth, material) if modes is None else modes)
    largest = largest_stress(field)
    return MaximumStress(
        stress=largest.stress,
        position=largest.x / tooth.length,
        time=largest.t,
        coefficient=largest.stress / math.sqrt(material.density * material.youngs_modulus),
    )

"""Tip effects of a blow besides bending: axial stress along the tooth, and Hertz pressure at the contact.

Rigid-body impacts have impulses, not forces. A force needs the duration of the contact, which nobody knows who has not
measured it; `shortest_contact` is a very short one and gives a large force. Neither is a bound: an elastic striker may
part sooner.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from .beam import Beam, FloatArray, require_all_within, require_within
from .material import Material

_LARGEST_FORCE, _LARGEST_IMPULSE = 1e12, 1e9


def shortest_contact(tooth: Beam, material: Material) -> float:
    """Time 2 l / c [s] in which a wave runs along the tooth and back, c = sqrt(E / rho).

    A rigid striker leaves the end of a uniform bar no earlier than the wave comes back from the other end and pushes it
    off. A tapered tooth throws parts of the wave back sooner, and an elastic striker brings its own waves.

    Args:
        tooth: the beam, of which the length counts.
        material: what it is made of; its damping plays no part.

    Source: W. Goldsmith, Impact (1960), longitudinal impact on rods.
    """
    return 2 * tooth.length * math.sqrt(material.density / material.youngs_modulus)


def peak_force(impulse: float, duration: float) -> float:
    """Largest force [N] of a pulse that is half a sine in time: pi / 2 impulse / duration.

    Args:
        impulse: [N s], >= 0: of the blow, or its part along the tooth.
        duration: of the contact [s]; `shortest_contact` gives the force of a very short one.

    Raises:
        ValueError: when a value is outside its limits or not a number.

    Source: definition of a half sine, whose mean is 2 / pi of its largest value; docs/explanation/stress.md, section
        Shear, axial stress, contact pressure.
    """
    require_within("impulse", impulse, 0.0, _LARGEST_IMPULSE, "N s", "give its size, without sign")
    require_within(
        "duration of the contact", duration, 1e-12, 1e6, "s", "shortest_contact gives that of a very short one"
    )
    return math.pi / 2 * impulse / duration


def axial_stress(tooth: Beam, force: float, x: npt.ArrayLike) -> FloatArray:
    """Mean normal stress F / A [Pa] along the tooth under a force along it at its tip, of shape (len(x),).

    Quasi-static: it holds when the contact lasts several times `shortest_contact`. Where the contact is near, the
    stress is Hertz's instead; that the force may act beside the axis, and bend, is not in it.

    Args:
        tooth: the beam.
        force: along x, from the tip towards the root [N], e.g. `peak_force`; the stress has its sign, so that pressure
            is positive.
        x: distances from the root [m], where the tooth has a cross section; a number or shape (n,).

    Raises:
        ValueError: when the force is not finite, or a place is off the tooth or at a sharp tip.

    Source: textbook law F / A; docs/explanation/stress.md, section Shear, axial stress, contact pressure.
    """
    require_within("force", force, -_LARGEST_FORCE, _LARGEST_FORCE, "N", "give a finite one")
    places = np.atleast_1d(np.asarray(x, dtype=np.float64))
    require_all_within("place", places, 0.0, tooth.length, "m", "x runs from the root to the tip of the tooth")
    area = tooth.area(places)
    if not np.all(area > 0):
        at = float(places[np.argmin(area)])
        raise ValueError(f"the tooth has no cross section at x = {at:g} m: ask for a place farther from the tip.")
    return np.asarray(force / area)


@dataclass(frozen=True)
class LineContact:
    """Two cylinders, or a cylinder and a plane, pressed together along a line.

    Attributes:
        half_width: a, of the strip of contact [m].
        pressure: p_0, the largest, in its middle [Pa].
        shear: largest shear stress, 0.300 p_0 [Pa].
        shear_depth: how deep below the surface that is, 0.786 a [m].
    """

    half_width: float
    pressure: float
    shear: float
    shear_depth: float


def hertz_line_contact(
    force: float,
    width: float,
    radius: float,
    material: Material,
    other: Material | None = None,
    poisson_ratio: float = 0.3,
) -> LineContact:
    """Hertz pressure of a rounded tip on a flat, or of any two cylinders.

    1 / E* = (1 - nu^2) (1 / E_1 + 1 / E_2), a^2 = 4 F R / (pi b E*), p_0 = 2 F / (pi b a). It holds for smooth elastic
    bodies, a much smaller than the radius and than the tooth's height; not for a sharp edge (radius 0), nor beyond
    first yield, p_0 = 1.67 yield strengths, nor for friction, and not near the ends of the line.

    Args:
        force: F, that presses them together [N], > 0, e.g. `peak_force`.
        width: b, of the line: the thinner of the two bodies [m].
        radius: R of the tip on a flat [m]; of two cylinders 1 / R = 1 / R_1 + 1 / R_2, a hollow's radius negative.
        material: of one body.
        other: of the other; the same unless given.
        poisson_ratio: nu of both [-], 0 to 0.5.

    Raises:
        ValueError: when a value is outside its limits or not a number.

    Source: K. L. Johnson, Contact Mechanics (1985), section 4.2.
    """
    require_within("force", force, 1e-12, _LARGEST_FORCE, "N", "give what presses the two bodies together")
    require_within("width of the contact", width, 1e-6, 1e3, "m", "give it in metres")
    require_within(
        "radius of the contact", radius, 1e-9, 1e6, "m", "give it in metres; a sharp edge has no finite pressure"
    )
    require_within("Poisson's ratio", poisson_ratio, 0.0, 0.5, "", "steel has 0.3")
    moduli = material.youngs_modulus, (other or material).youngs_modulus
    effective = 1 / ((1 - poisson_ratio**2) * sum(1 / modulus for modulus in moduli))
    half_width = math.sqrt(4 * force * radius / (math.pi * width * effective))
    pressure = 2 * force / (math.pi * width * half_width)
    return LineContact(half_width, pressure, 0.300 * pressure, 0.786 * half_width)

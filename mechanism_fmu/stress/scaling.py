"""How large a mode shape is taken: it has no scale of its own, but the stress depends on it."""

from __future__ import annotations

import math
from enum import Enum

import numpy as np

from .beam import Beam
from .ends import End
from .material import Material
from .natural_mode import NaturalMode
from .quadrature import gauss_points

#: A mode of which this part or less takes part in a motion takes no part in it.
_NO_SHARE = 1e-9


class ModeScaling(Enum):
    """The scale of mode shapes that all start with eta'(0) = v_I; see docs/decisions/003-mode-scaling.md.

    Attributes:
        FIRST_COEFFICIENT: the lowest power of xi that the root allows has the coefficient 1; for a clamped root a_1 = 1
            of u = a_1 xi^2 + a_2 xi^3 + ..., which gives the paper's "40 % of the length".
        PROJECTION: the shapes add up to xi, the rigid rotation about the root, so that the tooth starts with the
            velocity v_I xi all along. The stress then depends on no scale.
    """

    FIRST_COEFFICIENT = "a1 = 1"
    PROJECTION = "projection of the rigid rotation"


def scaled(mode: NaturalMode, beam: Beam, material: Material, root: End, scaling: ModeScaling) -> NaturalMode:
    """The bending mode `mode`, scaled.

    Raises:
        ValueError: the mode has no such scale.
    """
    if scaling is ModeScaling.PROJECTION:
        return mode.scaled(_share_in_rotation(mode, beam, material))
    return mode.scaled(1 / _first_coefficient(mode, root))


def _first_coefficient(mode: NaturalMode, root: End) -> float:
    """Coefficient of the lowest power of xi that the root allows [-]: 2 for a clamped root, 1 for a pinned, else 0."""
    power = next(power for power in range(3) if power not in root.vanishing)
    derivatives = mode.shape(np.array([0.0]), derivative=power)
    return float(derivatives[0]) / math.factorial(power)


def _share_in_rotation(mode: NaturalMode, beam: Beam, material: Material) -> float:
    """Coefficient of the mode when the rotation xi is written as a sum of modes: integral of rho A u xi over m [-].

    Raises:
        ValueError: the mode takes no part in it.
    """
    x, dx = gauss_points(beam, len(mode.series))
    xi = x / beam.length
    weight = material.density * dx * beam.area(x)
    share = float(weight @ (xi * mode.shape(xi))) / mode.mass
    largest = math.sqrt(float(weight @ xi**2) / mode.mass)
    if abs(share) <= _NO_SHARE * largest:
        raise ValueError(
            f"{mode.name} takes no part in a rotation about the root, so the projection gives it no scale: choose "
            "ModeScaling.FIRST_COEFFICIENT, or hold the root."
        )
    return share

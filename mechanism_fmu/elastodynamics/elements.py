"""Flexibility matrices of the elements of Erdman, Sandor and Oakberg (1972): d = F f.

Deformations d and forces f of an element stand in the order axial [m; N], transverse [m; N], rotation [rad; N m], as
far as it has them: tension, the normal to the left of the element and counter-clockwise turns are positive. Numbers of
equations are the paper's.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from ..model import Section

FloatArray = np.ndarray[Any, np.dtype[np.float64]]


def _require_positive(**values: float) -> None:
    """Refuse a size that is not positive and finite.

    Raises:
        ValueError: with its name, value and limit.
    """
    for name, value in values.items():
        if not 0.0 < value < np.inf:
            raise ValueError(f"{name} = {value:g} of an elastic element must be positive and finite, in SI units.")


def _require_beam(length: float, section: Section, young: float) -> None:
    _require_positive(length=length, area=section.area, second_moment=section.second_moment, young=young)


def cantilever(length: float, section: Section, young: float) -> FloatArray:
    """F of a beam clamped at one end and loaded at the other, eq (2), shape (3, 3).

    [[l/AE, 0, 0], [0, l^3/3EI, l^2/2EI], [0, l^2/2EI, l/EI]]; without the last row and column where no moment can act
    at the free end, as at a pin.

    Raises:
        ValueError: a size is not positive and finite; so do all elements here.
    """
    _require_beam(length, section, young)
    bending = young * section.second_moment
    return np.array(
        [
            [length / (section.area * young), 0.0, 0.0],
            [0.0, length**3 / (3 * bending), length**2 / (2 * bending)],
            [0.0, length**2 / (2 * bending), length / bending],
        ]
    )


def two_force_member(length: float, section: Section, young: float) -> FloatArray:
    """F of a link with a pin at either end, eq (4), shape (1, 1): l/AE."""
    _require_beam(length, section, young)
    return np.array([[length / (section.area * young)]])


def supported_beam(length: float, section: Section, young: float) -> FloatArray:
    """F of a beam on two supports with a moment at one end, eq (7), shape (2, 2): axial, and rotation there.

    diag(l/AE, l/3EI). The rotation is that against the chord. So is a link whose other end is pinned to a slider.
    """
    _require_beam(length, section, young)
    return np.diag([length / (section.area * young), length / (3 * young * section.second_moment)])


def bent_coupler(cantilever_length: float, supported_length: float, section: Section, young: float) -> FloatArray:
    """F of a coupler of two parts welded at a fixed angle (the paper's Fig. 3), shape (5, 5).

    The first part is a cantilever with its free end at the path point, the second is supported by two pins and carries
    the first one's moment; the angle is no matter of F, but of how forces are transferred.
    """
    first = cantilever(cantilever_length, section, young)
    return block_diagonal((first, supported_beam(supported_length, section, young)))


def torsion_shaft(length: float, polar_moment: float, shear_modulus: float) -> FloatArray:
    """F of a shaft that is twisted, eq (6), shape (1, 1): l/GJ [rad/(N m)], J the torsion constant [m4], G [Pa]."""
    _require_positive(length=length, polar_moment=polar_moment, shear_modulus=shear_modulus)
    return np.array([[length / (shear_modulus * polar_moment)]])


def spatial_link(length: float, section: Section, young: float) -> FloatArray:
    """F of a spatial link with a revolute and a spherical joint, eq (9), shape (2, 2): axial, and transverse.

    diag(l/AE, l^3/3EI): it bends in one plane only, from the revolute joint on, as a cantilever without end moment.
    """
    return cantilever(length, section, young)[:2, :2]


def block_diagonal(matrices: Iterable[FloatArray]) -> FloatArray:
    """One matrix with others along its diagonal and zeros beside them."""
    blocks = [*matrices]
    ends = np.cumsum([(0, 0), *(block.shape for block in blocks)], axis=0)
    found = np.zeros(ends[-1])
    for block, (row, column) in zip(blocks, ends, strict=False):
        found[row : row + block.shape[0], column : column + block.shape[1]] = block
    return found

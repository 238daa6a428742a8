"""Flexibility matrices of the elements of Erdman, Sandor and Oakberg (1972): d = F f; and of beams that taper.

Deformations d and forces f of an element stand in the order axial [m; N], transverse [m; N], rotation [rad; N m], as
far as it has them: tension, the normal to the left of the element and counter-clockwise turns are positive. Numbers
of equations are the paper's.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, Protocol

import numpy as np
from scipy.integrate import quad_vec

from ..model import Section

# What is refused.


class LinkageError(ValueError):
    """The mechanism cannot be analysed as a structure; the message names the part, and says why and what to do."""


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

    Args:
        length: l [m], > 0.
        section: A [m2] and I [m4] of it count, both > 0.
        young: E [Pa], > 0.

    Raises:
        ValueError: a size is not positive and finite.

    Source: Erdman, Sandor, Oakberg (1972), eq (2).
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
    """F of a link with a pin at either end, shape (1, 1): l/AE [m/N].

    Args:
        length: l [m], > 0.
        section: A [m2] and I [m4] of it count, both > 0.
        young: E [Pa], > 0.

    Raises:
        ValueError: a size is not positive and finite.

    Source: Erdman, Sandor, Oakberg (1972), eq (4).
    """
    _require_beam(length, section, young)
    return np.array([[length / (section.area * young)]])


def supported_beam(length: float, section: Section, young: float) -> FloatArray:
    """F of a beam on two supports with a moment at one end, eq (7), shape (2, 2): axial, and rotation there.

    diag(l/AE, l/3EI). The rotation is that against the chord. So is a link whose other end is pinned to a slider.

    Args:
        length: l [m], > 0.
        section: A [m2] and I [m4] of it count, both > 0.
        young: E [Pa], > 0.

    Raises:
        ValueError: a size is not positive and finite.

    Source: Erdman, Sandor, Oakberg (1972), eq (7).
    """
    _require_beam(length, section, young)
    return np.diag([length / (section.area * young), length / (3 * young * section.second_moment)])


def bent_coupler(cantilever_length: float, supported_length: float, section: Section, young: float) -> FloatArray:
    """F of a coupler of two parts welded at a fixed angle (the paper's Fig. 3), shape (5, 5).

    The first part is a cantilever with its free end at the path point, the second is supported by two pins and carries
    the first one's moment; the angle is no matter of F, but of how forces are transferred.

    Args:
        cantilever_length: l of the first part [m], > 0.
        supported_length: l of the second part [m], > 0.
        section: of both; A [m2] and I [m4] of it count, both > 0.
        young: E of both [Pa], > 0.

    Raises:
        ValueError: a size is not positive and finite.

    Source: Erdman, Sandor, Oakberg (1972), Fig. 3, with eqs (2) and (7) along the diagonal.
    """
    first = cantilever(cantilever_length, section, young)
    return block_diagonal((first, supported_beam(supported_length, section, young)))


def torsion_shaft(length: float, polar_moment: float, shear_modulus: float) -> FloatArray:
    """F of a shaft that is twisted, shape (1, 1): l/GJ [rad/(N m)].

    Args:
        length: l [m], > 0.
        polar_moment: J, the torsion constant of the cross section [m4], > 0.
        shear_modulus: G [Pa], > 0.

    Raises:
        ValueError: a size is not positive and finite.

    Source: Erdman, Sandor, Oakberg (1972), eq (6).
    """
    _require_positive(length=length, polar_moment=polar_moment, shear_modulus=shear_modulus)
    return np.array([[length / (shear_modulus * polar_moment)]])


def spatial_link(length: float, section: Section, young: float) -> FloatArray:
    """F of a spatial link with a revolute and a spherical joint, eq (9), shape (2, 2): axial, and transverse.

    diag(l/AE, l^3/3EI): it bends in one plane only, from the revolute joint on, as a cantilever without end moment.

    Args:
        length: l [m], > 0.
        section: A [m2] and I [m4] of it count, both > 0.
        young: E [Pa], > 0.

    Raises:
        ValueError: a size is not positive and finite.

    Source: Erdman, Sandor, Oakberg (1972), eq (9).
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


# Flexibility of beams whose cross section changes along the length, by integration.

#: Relative error that is asked of the integrals, and the largest that is let pass.
_ASKED, _LET_PASS = 1e-13, 1e-10
#: Pieces into which an integral is divided at most.
_MOST_PIECES = 500


class VaryingBeam(Protocol):
    """A straight beam from x = 0 to x = length; every beam of `mechanism_fmu.stress` is one.

    Attributes:
        length: l [m].
        breaks: places between the ends where a formula of the cross section changes [m], ascending.
    """

    @property
    def length(self) -> float:
        """Length l [m]."""

    @property
    def breaks(self) -> tuple[float, ...]:
        """Places where the formulas of the cross section change [m]."""

    def area(self, x: FloatArray, /) -> FloatArray:
        """Area A of the cross section [m2] at the places `x` [m], in its shape.

        Args:
            x: distances from the start of the beam [m], any shape.
        """

    def second_moment(self, x: FloatArray, /) -> FloatArray:
        """Second moment I of the cross section [m4] at the places `x` [m], in its shape.

        Args:
            x: distances from the start of the beam [m], any shape.
        """


def tapered_cantilever(beam: VaryingBeam, young: float) -> FloatArray:
    """Flexibility, shape (3, 3), of a cantilever held at x = 0, for force along, force across and moment at its end.

    F11 = int dx / EA [m/N], F22 = int (l - x)^2 / EI dx [m/N], F23 = int (l - x) / EI dx [1/N] and
    F33 = int dx / EI [1/(N m)].

    Args:
        beam: its length, A(x) and I(x).
        young: E [Pa].

    Raises:
        ValueError: E is not positive, or an integral does not exist: A or I vanish somewhere.

    Source: Erdman, Sandor, Oakberg (1972), eq (2), with A and I as functions of x by the unit-load method:
        docs/explanation/elastodynamics-dynamics.md, eq (K11).
    """

    def integrand(x: float) -> FloatArray:
        area, second_moment = _section(beam, x)
        arm = beam.length - x
        return np.array([1.0 / area, arm * arm / second_moment, arm / second_moment, 1.0 / second_moment])

    axial, across, mixed, turn = integral(beam, integrand) / _positive(young)
    return np.array([[axial, 0.0, 0.0], [0.0, across, mixed], [0.0, mixed, turn]])


def integral(beam: VaryingBeam, integrand: Callable[[float], FloatArray]) -> FloatArray:
    """Integrals over the length, shape (m,), of m functions of x that are positive in the middle of the beam.

    Raises:
        ValueError: one is not known to 1e-10 of itself, each counted by its value in the middle.
    """
    scale = np.abs(integrand(0.5 * beam.length)) * beam.length
    values, error = quad_vec(
        lambda x: integrand(x) / scale,
        0.0,
        beam.length,
        epsabs=0.0,
        epsrel=_ASKED,
        norm="max",
        limit=_MOST_PIECES,
        points=beam.breaks,
    )
    if not error <= _LET_PASS * np.max(np.abs(values)):
        raise ValueError(
            f"the flexibility of the beam of {beam.length:g} m is known to {error / np.max(np.abs(values)):.1g} only, "
            f"but must be to {_LET_PASS:g}: A(x) or I(x) vanish or jump somewhere; name the jumps in `breaks`."
        )
    return np.asarray(values * scale)


def _section(beam: VaryingBeam, x: float) -> tuple[float, float]:
    """A [m2] and I [m4] at one place."""
    place = np.array([x])
    area, second_moment = float(beam.area(place)[0]), float(beam.second_moment(place)[0])
    if not (area > 0.0 and second_moment > 0.0):
        raise ValueError(
            f"A = {area:g} m2 and I = {second_moment:g} m4 at x = {x:g} m of a beam of {beam.length:g} m: both must be "
            "positive all along, or the beam gives way without limit. End it before its tip."
        )
    return area, second_moment


def _positive(modulus: float) -> float:
    if not 0.0 < modulus < np.inf:
        raise ValueError(f"the modulus is {modulus:g} Pa, but must be positive and finite: give E in pascal.")
    return modulus

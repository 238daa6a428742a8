"""Beam properties that modes need, integrals over a beam, its slenderness; and what is refused."""

from __future__ import annotations

import itertools
from functools import lru_cache
from typing import Protocol

import numpy as np
import numpy.typing as npt
from numpy.polynomial.legendre import leggauss

# What cannot be right is refused here, by name, with the limit and the way out.

#: Any array of real numbers.
FloatArray = npt.NDArray[np.float64]

#: Largest impact velocity [m/s], of either sign; far beyond any beam theory, it only keeps the stress finite.
LARGEST_VELOCITY = 1e6


def require_within(name: str, value: float, low: float, high: float, unit: str, advice: str) -> None:
    """Refuse a `value` outside the closed interval `low`..`high`, NaN included.

    Raises:
        ValueError: with name, value, unit, limits and advice.
    """
    if not low <= value <= high:
        shown = f"{name} = {value:g} {unit}".rstrip()
        raise ValueError(f"{shown}, but it must lie between {low:g} and {high:g}: {advice}.")


def require_impact_velocity(value: float) -> None:
    """Refuse an impact velocity [m/s] that is negative or not finite.

    Raises:
        ValueError: with the value and the way out.
    """
    require_within(
        "impact velocity",
        value,
        0.0,
        LARGEST_VELOCITY,
        "m/s",
        "give the tooth's length times the jump of the wheel's rate in the impact, without sign",
    )


def require_all_within(name: str, values: FloatArray, low: float, high: float, unit: str, advice: str) -> None:
    """Refuse an array that has any value outside `low`..`high`, and name the first one.

    Raises:
        ValueError: with name, value, unit, limits and advice.
    """
    outside = values[~((values >= low) & (values <= high))]
    if outside.size:
        require_within(name, float(outside.flat[0]), low, high, unit, advice)


# What the modes need to know of a beam: length, thickness and cross section.


class Beam(Protocol):
    """A straight beam along x, from its root x = 0 to its tip x = length.

    `WedgeTooth`, `TrapezoidTooth`, `RectangularTooth`, `SectionBeam` and `TableBeam` are beams; so is anything with
    these members. It must be hashable, because `maximum_stress` remembers what it found for a beam.

    Attributes:
        length: l [m].
        thickness: b, along the axis of the wheel [m].
        breaks: places between root and tip where the formulas of the cross section change [m], ascending.
    """

    @property
    def length(self) -> float:
        """Length l [m]."""

    @property
    def thickness(self) -> float:
        """Thickness b [m]."""

    @property
    def breaks(self) -> tuple[float, ...]:
        """Places where the formulas of the cross section change [m]."""

    def area(self, x: FloatArray, /) -> FloatArray:
        """Area A of the cross section [m2] at the distances `x` from the root [m], in its shape.

        Args:
            x: distances from the root [m], any shape.
        """

    def second_moment(self, x: FloatArray, /) -> FloatArray:
        """Second moment I_n of the cross section [m4] at the distances `x` from the root [m], in its shape.

        Args:
            x: distances from the root [m], any shape.
        """

    def outer_fibre(self, x: FloatArray, /) -> FloatArray:
        """Distance of the outer fibre from the neutral axis [m] at the places `x` from the root [m], in its shape.

        Args:
            x: distances from the root [m], any shape.
        """

    def __hash__(self) -> int:
        """A number for the beam."""


# Integrals over the length of a beam.

#: Points beyond those that a constant cross section needs: enough for any that a drawing shows.
_MORE_POINTS = 40


def gauss_points(beam: Beam, degree: int) -> tuple[FloatArray, FloatArray]:
    """Places x [m] and weights [m] of a Gauss–Legendre rule, piece by piece between the breaks of the beam.

    It is exact for the square of a polynomial up to `degree`, times a polynomial up to degree 80.
    """
    nodes, weights = gauss_rule(degree + 1 + _MORE_POINTS)
    pieces = list(itertools.pairwise((0.0, *beam.breaks, beam.length)))
    x = [a + (b - a) * (nodes + 1) / 2 for a, b in pieces]
    dx = [(b - a) * weights / 2 for a, b in pieces]
    return np.concatenate(x), np.concatenate(dx)


@lru_cache
def gauss_rule(points: int) -> tuple[FloatArray, FloatArray]:
    """Nodes and weights of the Gauss–Legendre rule on (-1, 1); not to be written to."""
    nodes, weights = leggauss(points)
    return nodes, weights


# Whether a tooth is slender enough for beam theory.

#: Least length over root height. Shear adds 3 E I / (kappa G A l^2) = 0.78 (h / l)^2 to what bending alone deflects a
#: uniform cantilever under a force at its tip (Poisson's ratio 0.3, kappa = 5/6): 3 % at 5, but 280 % at 0.53.
LEAST_SLENDERNESS = 5.0


def slenderness(beam: Beam) -> float:
    """Length over height at the root [-]; the height is twice the distance of the outer fibre.

    Args:
        beam: whose root is at x = 0.

    Raises:
        ValueError: when the beam has no height at its root.

    Source: definition: l / h at the root, the measure of beam theory; S. P. Timoshenko, J. M. Gere, Mechanics of
        Materials, section on deflections by shear.
    """
    height = 2 * float(beam.outer_fibre(np.array([0.0]))[0])
    if not height > 0:
        raise ValueError(
            f"the beam is {height:g} m high at its root, but a root that holds it has a height: turn it round."
        )
    return beam.length / height


def beam_theory_note(beam: Beam) -> str:
    """One sentence: length over root height, and whether beam theory covers such a beam.

    The limit, 5, is for the first mode and the static deflection. The n-th mode bends over about l / n, so fast modes
    leave the theory of Euler and Bernoulli at larger ratios already.

    Args:
        beam: whose root is at x = 0.

    Raises:
        ValueError: as of `slenderness`.

    Source: S. P. Timoshenko, J. M. Gere, Mechanics of Materials, section on deflections by shear.
    """
    ratio = f"Length over root height is {slenderness(beam):.3g}"
    if slenderness(beam) >= LEAST_SLENDERNESS:
        return f"{ratio}, within beam theory ({LEAST_SLENDERNESS:g} or more)."
    return (
        f"{ratio}, outside beam theory ({LEAST_SLENDERNESS:g} or more): the stress compares teeth of one shape, but "
        "is not that of the real tooth."
    )

"""Cam profiles by themselves, before they meet a follower: curvature, hollows, jumps."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from itertools import pairwise

import numpy as np

from ..model.curves import Curve, Piece
from .equations import FloatArray

# Values and derivatives of profiles over many places at once.


def piece_values(piece: Piece, places: FloatArray) -> FloatArray:
    """Rho [m] and its first two derivatives on a piece at `places` [rad]: from shape (places,) to (3, places)."""
    xi = places - float(piece.start)
    values = np.zeros((3, len(xi)))
    for term in piece.terms:
        polynomial = np.polynomial.Polynomial([float(c) for c in term.polynomial] or [0.0])
        amplitude, frequency, phase = map(float, (term.amplitude, term.frequency, term.phase))
        for order in range(3):
            values[order] += (polynomial.deriv(order) if order else polynomial)(xi)
            values[order] += amplitude * frequency**order * np.sin(frequency * xi + phase + order * np.pi / 2)
    return values


def curve_values(curve: Curve, places: FloatArray) -> FloatArray:
    """Value and first two derivatives of a curve at `places`: from shape (places,) to (3, places)."""
    if curve.periodic:
        places = float(curve.start) + (places - float(curve.start)) % float(curve.span)
    starts = np.array([float(piece.start) for piece in curve.pieces])
    which = np.clip(np.searchsorted(starts, places, side="right") - 1, 0, None)
    values = np.empty((3, len(places)))
    for k, piece in enumerate(curve.pieces):
        values[:, which == k] = piece_values(piece, places[which == k])
    return values


def curvature(values: FloatArray) -> FloatArray:
    """Curvature of a profile [1/m]: positive where it bends as a circle about its centre does.

    Args:
        values: rho, rho' and rho'' [m], shape (3, places).
    """
    rho, rate, bend = values
    result: FloatArray = (rho * rho + 2 * rate * rate - rho * bend) / (rho * rho + rate * rate) ** 1.5
    return result


def radius_of(curve: Curve) -> float | None:
    """The radius of a profile that is a circle about its centre [m], None of any other."""
    values = curve_values(curve, np.linspace(0.0, 2 * np.pi, 8))
    round_ = len(curve.pieces) == 1 and not values[1:].any()
    return float(values[0, 0]) if round_ else None


_SAMPLES = 400
#: A jump of a derivative at a join counts when it is larger than this part of the radius.
_JUMP = 1e-6


@dataclass(frozen=True)
class Jump:
    """At alpha [rad], the derivative of rho of this order (0: rho itself) is `before` and `after` [m]."""

    alpha: float
    order: int
    before: float
    after: float


@dataclass(frozen=True)
class ProfileReport:
    """A cam's profile.

    Attributes:
        least_rho, largest_rho: distances from the centre [m].
        tip_radius: smallest radius of curvature where the profile is convex [m].
        tip_alpha: where that is [rad].
        hollow_radius: smallest radius of curvature where it is concave [m]; infinite when convex.
        hollow_alpha: where that is [rad].
        hollows: where it is concave, from and to [rad].
        jumps: of rho, rho' and rho'' at joins: an edge, a jump in the follower's speed, or in its acceleration.
    """

    least_rho: float
    largest_rho: float
    tip_radius: float
    tip_alpha: float
    hollow_radius: float
    hollow_alpha: float
    hollows: tuple[tuple[float, float], ...]
    jumps: tuple[Jump, ...]

    @property
    def convex(self) -> bool:
        """Whether a flat face touches every point of it."""
        return not self.hollows

    def problems(self, roller_radius: float | None = None, flat: bool = False) -> tuple[str, ...]:
        """What an engineer should know, one sentence each.

        Args:
            roller_radius: of the follower's roller [m]; 0 of a point; None when it has none.
            flat: whether the follower has a flat face.
        """
        return tuple(self._problems(roller_radius, flat))

    def _problems(self, roller_radius: float | None, flat: bool) -> list[str]:
        found = []
        where = ", ".join(f"{math.degrees(a):.2f} to {math.degrees(b):.2f} deg" for a, b in self.hollows)
        if flat and not self.convex:
            found.append(
                f"The profile is not convex (hollow at {where}): a flat face bridges the hollow. Give a larger base "
                "circle, a gentler rise, or a roller."
            )
        if roller_radius is not None and roller_radius >= self.hollow_radius:
            found.append(
                f"A roller of radius {roller_radius:g} m does not fit into the hollow at "
                f"{math.degrees(self.hollow_alpha):.2f} deg, whose radius is {self.hollow_radius:.6g} m: it touches at "
                "two points. Give a smaller roller, or a smoother profile."
            )
        if self.least_rho <= 0.0:
            found.append(f"rho falls to {self.least_rho:g} m: a profile must stay away from its centre.")
        what = ("an edge", "a jump in the follower's speed", "a jump in the follower's acceleration")
        found += [
            f"At {math.degrees(jump.alpha):.2f} deg the {('radius', 'slope', 'bend')[jump.order]} of the profile jumps "
            f"from {jump.before:.6g} to {jump.after:.6g} m: {what[jump.order]}."
            for jump in self.jumps
        ]
        return found

    def undercut(self, roller_radius: float) -> bool:
        """Whether a cam cut with such a roller [m], this profile being the path of its centre, is undercut.

        Args:
            roller_radius: [m].
        """
        return roller_radius >= self.tip_radius


def profile_report(profile: Curve) -> ProfileReport:
    """Curvature, hollows and jumps of a profile with plain numbers.

    Args:
        profile: its numbers are plain ones.

    Source: textbook: curvature of a curve in polar coordinates, (rho^2 + 2 rho'^2 - rho rho'') / (rho^2 +
        rho'^2)^(3/2).
    """
    ends = [float(piece.start) for piece in profile.pieces[1:]] + [float(profile.start) + float(profile.span)]
    begins = [float(profile.start), *ends[:-1]]
    rhos: list[FloatArray] = []
    bends: list[tuple[float, float]] = []
    hollows: list[tuple[float, float]] = []
    at_ends = []
    for piece, begin, end in zip(profile.pieces, begins, ends, strict=True):
        if end <= begin:
            continue
        grid = np.linspace(begin, end, _SAMPLES + 1)
        values = piece_values(piece, grid)
        at_ends.append((begin, values[:, 0], end, values[:, -1]))
        rhos.append(values[0])
        bend = partial(_bend, piece)
        found = curvature(values)
        bends += [_extreme(bend, grid, found, 1.0), _extreme(bend, grid, found, -1.0)]
        hollows += _below_zero(bend, grid, found)
    rho = np.concatenate(rhos)
    tip, hollow = max(bends), min(bends)
    return ProfileReport(
        least_rho=float(rho.min()),
        largest_rho=float(rho.max()),
        tip_radius=1 / tip[0] if tip[0] > 0 else math.inf,
        tip_alpha=tip[1],
        hollow_radius=-1 / hollow[0] if hollow[0] < 0 else math.inf,
        hollow_alpha=hollow[1],
        hollows=tuple(_joined(hollows)),
        jumps=tuple(_jumps(at_ends, profile)),
    )


def _extreme(
    function: Callable[[float], float], grid: FloatArray, values: FloatArray, sign: float
) -> tuple[float, float]:
    """The largest value (sign 1) or the least one (sign -1) on a grid and between its points, and its place."""
    from scipy.optimize import minimize_scalar  # an extra: only cams get here

    k = int(np.argmax(sign * values))
    near = grid[max(k - 1, 0)], grid[min(k + 1, len(grid) - 1)]
    found = minimize_scalar(lambda x: -sign * function(x), bounds=near, method="bounded", options={"xatol": 1e-9})
    place = float(found.x) if -found.fun > sign * values[k] else float(grid[k])
    return function(place), place


def _bend(piece: Piece, alpha: float) -> float:
    return float(curvature(piece_values(piece, np.array([alpha])))[0])


def _below_zero(function: Callable[[float], float], grid: FloatArray, values: FloatArray) -> list[tuple[float, float]]:
    """The ranges within a piece where a function, with its values on a grid, is negative."""
    from scipy.optimize import brentq  # an extra: only cams get here

    negative = (values < 0.0).tolist()
    edges = [
        float(brentq(function, a, b))
        for (a, b), (p, q) in zip(pairwise(grid), pairwise(negative), strict=True)
        if p != q
    ]
    marks = [float(grid[0]), *edges, float(grid[-1])]
    return [(a, b) for a, b in pairwise(marks) if b > a and function((a + b) / 2) < 0]


def _joined(ranges: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Ranges that touch each other as one."""
    joined: list[tuple[float, float]] = []
    for begin, end in ranges:
        if joined and begin - joined[-1][1] < 1e-12:
            joined[-1] = (joined[-1][0], end)
        else:
            joined.append((begin, end))
    return joined


def _jumps(at_ends: list[tuple[float, FloatArray, float, FloatArray]], profile: Curve) -> list[Jump]:
    joins = list(pairwise(at_ends))
    if profile.periodic:
        joins.append((at_ends[-1], at_ends[0]))
    found = []
    for (_, _, _, before), (begin, after, _, _) in joins:
        for order in range(3):
            if abs(after[order] - before[order]) > _JUMP * abs(before[0]):
                found.append(Jump(begin, order, float(before[order]), float(after[order])))
                break  # what follows from it is not reported again
    return found

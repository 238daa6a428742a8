"""How deep the material of one outline lies within that of another, at many poses at once, independently of the engine.

Points are complex numbers x + i y, times run along the first axis. Corners of either outline are asked, points between
them, and of each arc the points where its normal is that of an element of the other: where an outline has gone into
another, one of these is where it is deepest. A point lies within the material when the outline turns around it.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mechanism_fmu.model import Outline
from tests.outlines_apart import Pose, placed

Points = NDArray[np.complex128]
Lengths = NDArray[np.float64]

#: Parts of an element at which it is asked besides.
_PARTS = np.arange(6) / 6


class Poses(NamedTuple):
    """Where a body stands at many times.

    Attributes:
        origin: of its frame, x + i y, shape (times,) [m].
        turn: cos + i sin of its angle, shape (times,).
    """

    origin: Points
    turn: Points


def resting(times: int) -> Poses:
    """The ground's, at so many times."""
    return Poses(np.zeros(times, complex), np.ones(times, complex))


class _Shape:
    """The elements of a closed outline, and the points of it that are always asked."""

    def __init__(self, outline: Outline) -> None:
        elements = placed(outline, Pose())
        self.hole = outline.hole
        self.start = np.array([one.start for one in elements])
        self.end = np.array([one.end for one in elements])
        self.centre = np.array([one.centre for one in elements])
        self.radius = np.array([one.radius for one in elements])
        self.middle = np.array([one.middle for one in elements])
        self.half = np.array([one.half for one in elements])
        self.is_arc = self.radius > 0.0
        chord = self.end - self.start
        top = self.centre + self.radius * np.exp(1j * self.middle)
        self.side = np.where(self.is_arc, ((top - self.start) / chord).imag, 0.0)  # of an arc, beside its chord
        self.points = np.array([complex(*one.point(part)) for one in outline.elements for part in _PARTS])

    def around(self) -> tuple[complex, float]:
        """A circle around it."""
        centre = self.points.mean()
        reach = max(
            np.abs(self.points - centre).max(), (np.abs(self.centre - centre) * self.is_arc + self.radius).max()
        )
        return complex(centre), float(reach)

    def holds(self, direction: Points) -> NDArray[np.bool_]:
        """Whether arcs, along the last axis, have points in directions from their centres."""
        off = np.angle(direction * np.exp(-1j * self.middle))
        held: NDArray[np.bool_] = self.is_arc & (np.abs(off) <= self.half)
        return held

    def distance(self, p: Points) -> Lengths:
        """From the nearest element."""
        p = p[..., None]
        way = self.end - self.start
        part = ((p - self.start) * way.conj()).real / np.abs(way) ** 2
        straight = np.abs(p - self.start - np.clip(part, 0.0, 1.0) * way)
        ends = np.minimum(np.abs(p - self.start), np.abs(p - self.end))
        out = p - self.centre
        round_ = np.where(self.holds(out), np.abs(np.abs(out) - self.radius), ends)
        found: Lengths = np.where(self.is_arc, round_, straight).min(axis=-1)
        return found

    def contains(self, p: Points) -> NDArray[np.bool_]:
        """Whether points lie within the material, by how often the outline turns around them."""
        p = p[..., None]
        with np.errstate(divide="ignore", invalid="ignore"):
            turns = np.nan_to_num(np.angle((self.end - p) / (self.start - p)))
        # of a point right on the chord, rounding says on which side it is: the same for both terms
        in_segment = (np.abs(p - self.centre) < self.radius) & ((turns > 0.0) == (self.side > 0.0)) & self.is_arc
        turns = turns + np.where(in_segment, -2.0 * np.pi * np.sign(self.side), 0.0)
        around = np.rint(turns.sum(axis=-1) / (2.0 * np.pi))
        return (around == 0) if self.hole else (around > 0)

    def towards(self, other: _Shape, seen: Poses) -> Points:
        """The points of its arcs where the normal is that of an element of another outline, in that one's frame.

        `seen` is where its frame stands in the other's; nan where an arc has no such point.
        """
        centre = (seen.origin[:, None] + seen.turn[:, None] * self.centre)[:, :, None]
        way = other.end - other.start
        foot = other.start + ((centre - other.start) * way.conj()).real / np.abs(way) ** 2 * way
        out = np.where(other.is_arc, other.centre, foot) - centre
        size = np.abs(out)
        unit = np.where(size > 0.0, out / np.where(size > 0.0, size, 1.0), np.nan)
        found = []
        for side in (unit, -unit):
            local = np.swapaxes(side / seen.turn[:, None, None], 1, 2)
            held = np.swapaxes(self.holds(np.nan_to_num(local)), 1, 2)
            found.append(np.where(held, centre + self.radius[None, :, None] * side, np.nan))
        return np.concatenate(found, axis=2).reshape(len(seen.origin), -1)


def _within(one: _Shape, other: _Shape, seen: Poses) -> Lengths:
    """How deep the points of one outline lie within the other at most, at each time [m]."""
    points = np.concatenate([seen.origin[:, None] + seen.turn[:, None] * one.points, one.towards(other, seen)], axis=1)
    points = np.where(np.isnan(points), np.inf, points)
    finite = np.isfinite(points)
    points = np.where(finite, points, 1e9)
    inside = finite & other.contains(points)
    depth = np.zeros(points.shape)
    depth[inside] = other.distance(points[inside])
    deepest: Lengths = depth.max(axis=1)
    return deepest


def depths(a: Outline, of_a: Poses, b: Outline, of_b: Poses) -> Lengths:
    """How deep two closed outlines lie within each other at each time, shape (times,) [m]; 0 where they are apart.

    Args:
        a, b: closed outlines of plain numbers.
        of_a, of_b: where the bodies that carry them stand.

    Source: winding numbers, and points of equal normals.
    """
    one, other = _Shape(a), _Shape(b)
    found = np.zeros(len(of_a.origin))
    (ca, ra), (cb, rb) = one.around(), other.around()
    between = np.abs(of_a.origin + of_a.turn * ca - of_b.origin - of_b.turn * cb)
    near = np.ones(len(found), bool) if one.hole or other.hole else between < ra + rb
    if not near.any():
        return found
    pose_a, pose_b = Poses(of_a.origin[near], of_a.turn[near]), Poses(of_b.origin[near], of_b.turn[near])
    seen = Poses((pose_a.origin - pose_b.origin) * pose_b.turn.conj(), pose_a.turn * pose_b.turn.conj())
    back = Poses((pose_b.origin - pose_a.origin) * pose_a.turn.conj(), pose_b.turn * pose_a.turn.conj())
    found[near] = np.maximum(_within(one, other, seen), _within(other, one, back))
    return found

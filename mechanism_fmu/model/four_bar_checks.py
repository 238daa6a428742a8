"""What is wrong, or odd, with lengths of a four-bar linkage that are each within their limits."""

from __future__ import annotations

import math
from types import SimpleNamespace

from .conditions import size
from .findings import Finding, at_most, first
from .four_bar import diagonal

#: Coupler and rocker in line to this fraction of their lengths cannot say where they go.
_IN_LINE = 1e-9
#: Lengths are those of a change point when they are off by less than this fraction of their sum.
_CHANGES_WITHIN = 1e-6

_AT = "at crank_angle_start = {:.6g} deg the crank pin is {:.6g} m from the rocker's hinge"


def objections(values: SimpleNamespace) -> tuple[Finding, ...]:
    """Why the linkage cannot be assembled at the start: value, limit and way out; at most one applies."""
    b, c, distance = values.coupler_length, values.rocker_length, diagonal(values)
    both, difference = b + c, size(b - c)
    where = (values.crank_angle_start * (180 / math.pi), distance)
    return first(
        Finding(
            at_most(distance, _IN_LINE * both),
            "At crank_angle_start = {:.6g} deg the crank pin lies on the rocker's hinge, so that coupler and rocker "
            "can point anywhere: crank_length and ground_length are {:.6g} m. Change one, or crank_angle_start.",
            (where[0], values.crank_length),
        ),
        Finding(
            at_most(both * (1 - _IN_LINE), distance),
            "coupler_length + rocker_length = {:.6g} m is too short: " + _AT + ", so that the two must reach over more "
            "than that. Give links that are longer by more than {:.6g} m in all, or change crank_angle_start.",
            (both, *where, distance - both),
        ),
        Finding(
            at_most(distance, difference + _IN_LINE * both),
            "coupler_length = {:.6g} m and rocker_length = {:.6g} m differ by {:.6g} m, which is too much: " + _AT + "."
            " Give lengths that differ by less than {:.6g} m, or change crank_angle_start.",
            (b, c, difference, *where, distance),
        ),
    )


def warnings(values: SimpleNamespace) -> tuple[Finding, ...]:
    """What the linkage cannot do, by Grashof's rule; it means something only where nothing is objected to."""
    a, b, c, d = values.crank_length, values.coupler_length, values.rocker_length, values.ground_length
    flat = _CHANGES_WITHIN * (a + b + c + d)
    nearest, difference = size(d - a), size(b - c)
    shown = (d, a, b, c)
    return first(
        *(
            Finding(
                flat - size(excess),
                f"Change point: {sums}, with ground_length = {{:.6g}} m, crank_length = {{:.6g}} m, coupler_length = "
                "{:.6g} m, rocker_length = {:.6g} m, so that all links can lie in one line. There the constraints lose "
                "a rank, and whether the linkage goes on open or crossed is undetermined. Change a length by more than "
                "{:.3g} m, or keep the motion away from there.",
                (*shown, flat),
            )
            for sums, excess in (
                ("ground + crank = coupler + rocker", d + a - b - c),
                ("ground + coupler = crank + rocker", d + b - a - c),
                ("ground + rocker = crank + coupler", d + c - a - b),
            )
        ),
        Finding(
            d + a - b - c,
            "The crank cannot turn fully: coupler_length + rocker_length = {:.6g} m is shorter than ground_length + "
            "crank_length = {:.6g} m. It swings between positions where coupler and rocker are stretched in line. For "
            "full turns make the two longer by more than {:.6g} m in all.",
            (b + c, d + a, d + a - b - c),
        ),
        Finding(
            difference - nearest,
            "The crank cannot turn fully: coupler_length and rocker_length differ by {:.6g} m, ground_length and "
            "crank_length only by {:.6g} m. It swings between positions where coupler and rocker are folded in line. "
            "For full turns let the two differ by less than {:.6g} m.",
            (difference, nearest, nearest),
        ),
    )

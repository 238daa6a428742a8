"""Directions are given as vectors of any length > 0."""

from __future__ import annotations

from ..body import Point
from ..conditions import length
from ..functions import where_positive


def unit_vector(axis: Point) -> Point:
    """The unit vector along `axis`; a vector of no length, which `check_joint_numbers` refuses, stays as it is."""
    long = length(axis)
    size = where_positive(long, long, 1.0)
    return axis[0] / size, axis[1] / size

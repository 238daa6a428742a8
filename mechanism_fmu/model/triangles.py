"""Sides and angles of triangles, in a form that also has a value where there is no such triangle.

Parameters can be out of reach of each other: these give the nearest that there is, and objections say what is wrong.
"""

from __future__ import annotations

from .functions import Number, atan2, sqrt, where_positive


def root(square: Number) -> Number:
    """Square root, 0 of what is negative."""
    return sqrt(where_positive(square, square, 0.0))


def angle_between(adjacent: Number, square: Number = 1.0) -> Number:
    """The angle in 0..pi [rad] whose cosine is adjacent/sqrt(square); 0 or pi where that is beyond 1 or -1."""
    return atan2(root(square - adjacent * adjacent), adjacent)

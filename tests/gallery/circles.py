"""Linkages by circles, in complex numbers: another way than the project's, for the closed forms of the gallery."""

from __future__ import annotations

from typing import Any

import numpy as np


def meet(a: Any, b: Any, from_a: float, from_b: float, left: bool = True) -> Any:
    """Where circles about `a` and `b` meet, on the left or right of the way from a to b (law of cosines).

    Args:
        a: centres [m], complex, an array or one.
        b: likewise.
        from_a: radius about a [m].
        from_b: radius about b [m].
        left: which of the two.
    """
    way = b - a
    distance = np.abs(way)
    angle = np.arccos((distance**2 + from_a**2 - from_b**2) / (2 * from_a * distance))
    return a + from_a * way / distance * np.exp(1j * angle if left else -1j * angle)


def angle(vector: Any) -> Any:
    """Angles of vectors [rad], without jumps of a turn."""
    return np.unwrap(np.angle(vector))

"""The tooth of a ratchet wheel as a wedge-shaped cantilever beam."""

from __future__ import annotations

import math
from dataclasses import dataclass

from .checks import FloatArray, require_within


@dataclass(frozen=True)
class WedgeTooth:
    """A right-angled triangle, fixed at its root x = 0 and tapering to a sharp tip at x = length.

    Source: Pennestrì, Valentini, Vita, eq (14) and the section modulus below eq (16).

    Attributes:
        length: l, from root to tip [m], 1e-6 to 1e3.
        apex_angle: alpha, of the tip [rad], 1e-4 to 1.57 (a right angle is no wedge).
        thickness: b, along the axis of the wheel [m], 1e-6 to 1e3.

    Raises:
        ValueError: when a value is outside its limits or not a number.
    """

    length: float
    apex_angle: float
    thickness: float = 0.02

    def __post_init__(self) -> None:
        """Refuse a value outside its limits."""
        for name, value in (("length", self.length), ("thickness", self.thickness)):
            require_within(f"tooth {name}", value, 1e-6, 1e3, "m", "give it in metres")
        require_within(
            "tooth apex angle", self.apex_angle, 1e-4, 1.57, "rad", "give it in radians, below a right angle"
        )

    def area(self, x: FloatArray) -> FloatArray:
        """Area A of the cross section [m2] at the distances `x` from the root [m], in its shape; eq (14)."""
        return self.thickness * self._height(x)

    def second_moment(self, x: FloatArray) -> FloatArray:
        """Second moment I_n of the cross section [m4] at the distances `x` from the root [m], in its shape; eq (14)."""
        return self.thickness / 12 * self._height(x) ** 3

    def section_modulus(self, x: FloatArray) -> FloatArray:
        """Section modulus W_b [m3] at the distances `x` from the root [m], in its shape."""
        return self.thickness / 6 * self._height(x) ** 2

    def outer_fibre(self, x: FloatArray) -> FloatArray:
        """Distance of the outer fibre from the neutral axis [m] at the distances `x` from the root [m], in its shape.

        It is I_n / W_b, in the form that stays exact at the tip, where both vanish.
        """
        return self._height(x) / 2

    def _height(self, x: FloatArray) -> FloatArray:
        return (self.length - x) * math.tan(self.apex_angle)

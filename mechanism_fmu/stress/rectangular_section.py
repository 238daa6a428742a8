"""Beams of rectangular cross section: their height along x says all."""

from __future__ import annotations

from abc import ABC, abstractmethod

from .checks import FloatArray, require_within

#: Sizes in which a tooth is believed to be given in metres [m].
SMALLEST, LARGEST = 1e-6, 1e3


class RectangularSection(ABC):
    """A beam whose cross section is `thickness` wide and `_height(x)` high, in the plane of the motion."""

    length: float
    thickness: float

    @property
    def breaks(self) -> tuple[float, ...]:
        """The same formula all along."""
        return ()

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

        It is I_n / W_b, in the form that stays exact at a tip where both vanish.
        """
        return self._height(x) / 2

    @abstractmethod
    def _height(self, x: FloatArray) -> FloatArray:
        """Height h [m] at the distances `x` from the root [m], in its shape."""


def require_size(name: str, value: float) -> None:
    """Refuse a size of a tooth [m] that cannot be, NaN included.

    Raises:
        ValueError: with name, value and limits.
    """
    require_within(f"tooth {name}", value, SMALLEST, LARGEST, "m", "give it in metres")

"""What the modes need to know of a beam: length, thickness and cross section."""

from __future__ import annotations

from typing import Protocol

from .checks import FloatArray


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
        """Area A of the cross section [m2] at the distances `x` from the root [m], in its shape."""

    def second_moment(self, x: FloatArray, /) -> FloatArray:
        """Second moment I_n of the cross section [m4] at the distances `x` from the root [m], in its shape."""

    def outer_fibre(self, x: FloatArray, /) -> FloatArray:
        """Distance of the outer fibre from the neutral axis [m] at the places `x` from the root [m], in its shape."""

    def __hash__(self) -> int:
        """A number for the beam."""

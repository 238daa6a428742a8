"""Teeth as beams of rectangular cross section, and beams of any other, from functions or from a table."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .beam import Beam, FloatArray, require_within
from .interpolation import monotone_cubic

# Beams of rectangular cross section: their height along x says all.

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
        """Area A of the cross section [m2] at the distances `x` from the root [m], in its shape; eq (14).

        Args:
            x: distances from the root [m], any shape.
        """
        return self.thickness * self._height(x)

    def second_moment(self, x: FloatArray) -> FloatArray:
        """Second moment I_n of the cross section [m4] at the distances `x` from the root [m], in its shape; eq (14).

        Args:
            x: distances from the root [m], any shape.
        """
        return self.thickness / 12 * self._height(x) ** 3

    def section_modulus(self, x: FloatArray) -> FloatArray:
        """Section modulus W_b [m3] at the distances `x` from the root [m], in its shape.

        Args:
            x: distances from the root [m], any shape.
        """
        return self.thickness / 6 * self._height(x) ** 2

    def outer_fibre(self, x: FloatArray) -> FloatArray:
        """Distance of the outer fibre from the neutral axis [m] at the distances `x` from the root [m], in its shape.

        It is I_n / W_b, in the form that stays exact at a tip where both vanish.

        Args:
            x: distances from the root [m], any shape.
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


@dataclass(frozen=True)
class WedgeTooth(RectangularSection):
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
        require_size("length", self.length)
        require_size("thickness", self.thickness)
        _require_apex_angle(self.apex_angle)

    def _height(self, x: FloatArray) -> FloatArray:
        return (self.length - x) * math.tan(self.apex_angle)


def _require_apex_angle(value: float) -> None:
    require_within("tooth apex angle", value, 1e-4, 1.57, "rad", "give it in radians, below a right angle")


def wedge_of_sawtooth(chord: float, slope_length: float, chord_angle: float, thickness: float = 0.02) -> WedgeTooth:
    """The right-angled triangle that stands for a tooth of a sawtooth wheel, in either of the shapes of Fig. 7.

    Slope L, face F and chord h are the sides of the tooth; alpha lies at its apex, between L and F. The right angle
    lies on the line of the face. With alpha + alpha_2 < 90 deg the face ends before it and the beam has the face's
    length, l = F (Fig. 7, left); otherwise it lies on the face, across from the root of the slope, and
    l = L cos(alpha) (right).

    Args:
        chord: h, distance between two roots [m].
        slope_length: L, from a root to the apex [m].
        chord_angle: alpha_2, from the chord to the slope at the root [rad], between 0 and pi.
        thickness: b [m].

    Raises:
        ValueError: when a size or angle is outside its limits, or L is so short that the apex angle is 90 deg or more.

    Source: Pennestrì, Valentini, Vita, Figs 5 and 7.
    """
    require_size("chord", chord)
    require_size("slope length", slope_length)
    require_within("angle between chord and slope", chord_angle, 1e-4, 3.14, "rad", "give it in radians, below pi")
    along, across = slope_length - chord * math.cos(chord_angle), chord * math.sin(chord_angle)
    apex_angle = math.atan2(across, along)
    _require_apex_angle(apex_angle)
    face = math.hypot(along, across)
    left = apex_angle + chord_angle < math.pi / 2
    return WedgeTooth(face if left else slope_length * math.cos(apex_angle), apex_angle, thickness)


@dataclass(frozen=True)
class TrapezoidTooth(RectangularSection):
    """A tooth whose height changes linearly from the root to a blunt tip.

    Attributes:
        length: l, from root to tip [m], 1e-6 to 1e3.
        root_height: at x = 0 [m], 1e-6 to 1e3.
        tip_height: at x = length [m], 0 (a sharp tip) to 1e3.
        thickness: b [m], 1e-6 to 1e3.

    Raises:
        ValueError: when a value is outside its limits or not a number.

    Source: textbook: a rectangular section, A = b h, I = b h^3/12, W = b h^2/6, with h linear in x.
    """

    length: float
    root_height: float
    tip_height: float
    thickness: float = 0.02

    def __post_init__(self) -> None:
        """Refuse a value outside its limits."""
        require_size("length", self.length)
        require_size("root height", self.root_height)
        require_within("tooth tip height", self.tip_height, 0.0, LARGEST, "m", "give it in metres; 0 is a sharp tip")
        require_size("thickness", self.thickness)

    def _height(self, x: FloatArray) -> FloatArray:
        # In this form it is exact at both ends.
        return (self.root_height * (self.length - x) + self.tip_height * x) / self.length


@dataclass(frozen=True)
class RectangularTooth(RectangularSection):
    """A tooth of the same height all along: the uniform beam.

    Attributes:
        length: l [m], 1e-6 to 1e3.
        height: h, in the plane of the motion [m], 1e-6 to 1e3.
        thickness: b [m], 1e-6 to 1e3.

    Raises:
        ValueError: when a value is outside its limits or not a number.

    Source: textbook: a rectangular section, A = b h, I = b h^3/12, W = b h^2/6.
    """

    length: float
    height: float
    thickness: float = 0.02

    def __post_init__(self) -> None:
        """Refuse a value outside its limits."""
        for name in ("length", "height", "thickness"):
            require_size(name, getattr(self, name))

    def _height(self, x: FloatArray) -> FloatArray:
        return np.full_like(x, self.height)


def beam_in_words(beam: Beam) -> str:
    """What a beam is, with its sizes, for the reader of a report."""
    length = f"length {beam.length * 1e3:.4g} mm"
    if isinstance(beam, WedgeTooth):
        return f"wedge of {length} and apex angle {beam.apex_angle:.4g} rad"
    if isinstance(beam, TrapezoidTooth):
        heights = f"{beam.root_height * 1e3:.4g} and {beam.tip_height * 1e3:.4g} mm"
        return f"trapezoid of {length} and heights {heights}"
    if isinstance(beam, RectangularTooth):
        return f"uniform bar of {length} and height {beam.height * 1e3:.4g} mm"
    return f"beam of {length}"


# Beams of any cross section, from functions or from a table.

#: A quantity of the cross section at distances from the root [m], in their shape.
Section = Callable[[FloatArray], FloatArray]


@dataclass(frozen=True)
class SectionBeam:
    """A beam whose cross section is given by functions of the distance from the root.

    They must be positive between root and tip; at either end they may vanish, as at the tip of a wedge.

    Attributes:
        length: l [m], 1e-6 to 1e3.
        area: A(x) [m2] for an array of distances x from the root [m], in its shape.
        second_moment: I_n(x) [m4], as `area`.
        outer_fibre: distance of the outer fibre from the neutral axis at x [m], as `area`.
        thickness: b [m], 1e-6 to 1e3.
        breaks: places where one of the functions is not smooth [m], ascending, between root and tip.

    Raises:
        ValueError: when a size is outside its limits or not a number, a break is not between root and tip or not after
            the one before, or a function is not positive in the middle of the beam.
    """

    length: float
    area: Section
    second_moment: Section
    outer_fibre: Section
    thickness: float = 0.02
    breaks: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        """Refuse what cannot be a beam."""
        object.__setattr__(self, "breaks", tuple(self.breaks))  # so that a list will do
        require_size("length", self.length)
        require_size("thickness", self.thickness)
        edges = [0.0, *self.breaks, self.length]
        if not np.all(np.diff(edges) > 0):
            raise ValueError(
                f"the breaks {self.breaks} m must ascend and lie between root and tip, 0 and {self.length:g} m."
            )
        places = np.convolve(edges, [0.5, 0.5], mode="valid")
        for name in ("area", "second_moment", "outer_fibre"):
            values = np.asarray(getattr(self, name)(places))
            if values.shape != places.shape or not np.all((values > 0) & np.isfinite(values)):
                raise ValueError(
                    f"{name} of the beam gives {values} at x = {places} m: it must give a positive number for each."
                )


@dataclass(frozen=True)
class TableBeam:
    """A beam whose cross section is given at some places.

    Between them it follows monotone cubics (PCHIP), which never overshoot.

    Attributes:
        places: x [m], ascending from the root, 0, to the tip; at least two.
        areas: A at the places [m2], positive between the ends.
        second_moments: I_n at the places [m4], positive between the ends.
        outer_fibres: distance of the outer fibre from the neutral axis at the places [m], positive between the ends.
        thickness: b [m], 1e-6 to 1e3.

    Raises:
        ValueError: when the columns differ in length, the places do not ascend from 0, or a value is negative, not a
            number, or zero other than at one end.

    Source: F. N. Fritsch and J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984), as `monotone_cubic`.
    """

    places: tuple[float, ...]
    areas: tuple[float, ...]
    second_moments: tuple[float, ...]
    outer_fibres: tuple[float, ...]
    thickness: float = 0.02

    def __post_init__(self) -> None:
        """Refuse what cannot be a beam."""
        for name in ("places", "areas", "second_moments", "outer_fibres"):  # so that lists will do
            object.__setattr__(self, name, tuple(map(float, getattr(self, name))))
        if len(self.places) < 2 or self.places[0] != 0.0 or not np.all(np.diff(self.places) > 0):
            raise ValueError(f"the places {self.places} m of the table must ascend from the root, 0, to the tip.")
        require_size("length", self.length)
        require_size("thickness", self.thickness)
        for name in ("areas", "second_moments", "outer_fibres"):
            column = np.array(getattr(self, name))
            if len(column) != len(self.places):
                raise ValueError(
                    f"the table has {len(self.places)} places, but {len(column)} {name}: give one for each."
                )
            inside = np.all(column[1:-1] > 0) and max(column[0], column[-1]) > 0
            if not (inside and np.all((column >= 0) & np.isfinite(column))):
                raise ValueError(f"{name} of the table, {column}, must be positive; at one end zero will do.")

    @property
    def length(self) -> float:
        """Length l [m]."""
        return self.places[-1]

    @property
    def breaks(self) -> tuple[float, ...]:
        """The places between root and tip."""
        return self.places[1:-1]

    def area(self, x: FloatArray) -> FloatArray:
        """Area A [m2] at the distances `x` from the root [m], in its shape.

        Args:
            x: distances from the root [m], any shape.
        """
        return np.asarray(self._interpolants[0](x))

    def second_moment(self, x: FloatArray) -> FloatArray:
        """Second moment I_n [m4] at the distances `x` from the root [m], in its shape.

        Args:
            x: distances from the root [m], any shape.
        """
        return np.asarray(self._interpolants[1](x))

    def outer_fibre(self, x: FloatArray) -> FloatArray:
        """Distance of the outer fibre from the neutral axis [m] at the places `x` from the root [m], in its shape.

        Args:
            x: distances from the root [m], any shape.
        """
        return np.asarray(self._interpolants[2](x))

    @cached_property
    def _interpolants(self) -> tuple[Callable[[FloatArray], FloatArray], ...]:
        return tuple(monotone_cubic(self.places, y) for y in (self.areas, self.second_moments, self.outer_fibres))

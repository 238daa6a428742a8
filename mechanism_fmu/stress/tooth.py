"""Teeth as beams of rectangular cross section: the paper's wedge, a trapezoid, a rectangle."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .beam import Beam
from .checks import FloatArray, require_within
from .rectangular_section import LARGEST, RectangularSection, require_size


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

"""Beams of any cross section, from functions or from a table."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.interpolate import PchipInterpolator

from .checks import FloatArray
from .rectangular_section import require_size

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
        """Area A [m2] at the distances `x` from the root [m], in its shape."""
        return np.asarray(self._interpolants[0](x))

    def second_moment(self, x: FloatArray) -> FloatArray:
        """Second moment I_n [m4] at the distances `x` from the root [m], in its shape."""
        return np.asarray(self._interpolants[1](x))

    def outer_fibre(self, x: FloatArray) -> FloatArray:
        """Distance of the outer fibre from the neutral axis [m] at the places `x` from the root [m], in its shape."""
        return np.asarray(self._interpolants[2](x))

    @cached_property
    def _interpolants(self) -> tuple[PchipInterpolator, ...]:
        columns = self.areas, self.second_moments, self.outer_fibres
        return tuple(PchipInterpolator(self.places, column) for column in columns)

"""A chart as data: `interactive` draws it in a report, `static` into SVG and PNG files."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy.typing as npt


@dataclass(frozen=True)
class Curve:
    """One curve, in the units that the plot's axes name.

    Attributes:
        name: for the legend; curves of the same name are shown and hidden together, with one entry.
        x, y: shape (points,) each.
        colour: as "#rrggbb".
        line: whether its points are joined.
        dots: whether each point has a dot.
        filled: whether the area that it encloses is filled; it must be closed.
    """

    name: str
    x: npt.ArrayLike
    y: npt.ArrayLike
    colour: str
    line: bool = True
    dots: bool = False
    filled: bool = False


@dataclass(frozen=True)
class Plot:
    """Curves with common axes.

    Attributes:
        title: what it shows.
        x_label, y_label: what the axes measure, with the unit.
        curves: in the order in which they are drawn.
        to_scale: whether both axes have the same scale, as a shape needs it.
        from_zero: whether the y axis begins at 0.
        legend: whether names are shown.
    """

    title: str
    x_label: str
    y_label: str
    curves: Sequence[Curve]
    to_scale: bool = False
    from_zero: bool = False
    legend: bool = True

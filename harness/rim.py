"""The rim of a toothed wheel, as the drawing in its FMU tells it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from .description import Value
from .drawing import Drawing, Quantity

#: The places of corners: (x, y) [m], shape (corners,) each.
Outline = tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]


@dataclass(frozen=True)
class Rim:
    """The corners of one pitch, which the wheel repeats.

    Attributes:
        count: number of teeth, >= 1.
        radii: distance of each corner from the wheel's centre [m]; the first is the root of a tooth.
        angles: of each corner, from the wheel's x axis [rad].
        clockwise: whether the teeth follow each other clockwise.
    """

    count: int
    radii: tuple[float, ...]
    angles: tuple[float, ...]
    clockwise: bool

    def wheel(self) -> Outline:
        """The whole rim about the wheel's centre, closed: its last corner is its first."""
        turns = np.repeat(np.arange(self.count), len(self.radii))
        angles = np.tile(self.angles, self.count) + turns * self._pitch
        radii = np.tile(self.radii, self.count)
        return _closed(radii * np.cos(angles)), _closed(radii * np.sin(angles))

    def tooth(self) -> Outline:
        """One tooth from its root to the next one, as the paper's Fig. 5 shows it.

        Its root is the origin, the wheel's radius there points up, and the next root lies to the right.
        """
        radii = np.array([*self.radii, self.radii[0]])
        angles = np.array([*self.angles, self.angles[0] + self._pitch]) - self.angles[0]
        side = -1.0 if self.clockwise else 1.0
        return side * radii * np.sin(angles), radii * np.cos(angles) - radii[0]

    @property
    def _pitch(self) -> float:
        return (-1 if self.clockwise else 1) * 2 * np.pi / self.count


def _closed(values: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    return np.append(values, values[0])


def rim_of(drawing: Drawing, parameters: Mapping[str, Value]) -> Rim | None:
    """The rim of the first wheel of a drawing; None when it has none that parameters alone describe.

    Args:
        drawing: of an FMU.
        parameters: all parameters and calculated parameters of an instance.
    """
    for shape in drawing.shapes:
        quantities = [shape.quantities["count"], *sum(shape.outline, ())] if shape.kind == "wheel" else []
        if quantities and all(_known(quantity, parameters) for quantity in quantities):
            count, *numbers = (_number(quantity, parameters) for quantity in quantities)
            return Rim(round(count), tuple(numbers[::2]), tuple(numbers[1::2]), shape.clockwise)
    return None


def _known(quantity: Quantity, parameters: Mapping[str, Value]) -> bool:
    return not isinstance(quantity, str) or quantity.removeprefix("-") in parameters


def _number(quantity: Quantity, parameters: Mapping[str, Value]) -> float:
    if not isinstance(quantity, str):
        return quantity
    value = float(parameters[quantity.removeprefix("-")])
    return -value if quantity.startswith("-") else value

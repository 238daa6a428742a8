"""A mechanism in motion: the shapes of a drawing, with numbers for every frame."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..drawing import Place, Quantity, Shape
from .thin import FloatArray

#: A bar that turns further than this between two frames [rad] may point anywhere in between.
_SURE_TURN = 0.2


@dataclass(frozen=True)
class Scene:
    """Numbers for the shapes of a drawing.

    Attributes:
        shapes: in the order in which they are drawn.
        columns: shape (frames,) each: the variables that move, by name.
        constants: the other variables, by name.
    """

    shapes: Sequence[Shape]
    columns: Mapping[str, FloatArray]
    constants: Mapping[str, float]

    def value(self, quantity: Quantity) -> FloatArray | float:
        """A quantity: shape (frames,) when it moves, else a number."""
        if not isinstance(quantity, str):
            return quantity
        name = quantity.removeprefix("-")
        value = self.columns[name] if name in self.columns else self.constants[name]
        return -value if quantity.startswith("-") else value

    def at_start(self, quantity: Quantity) -> float:
        """A quantity that makes the form of a part, which does not move: its value in the first frame."""
        return float(np.ravel(self.value(quantity))[0])


@dataclass(frozen=True)
class _Spot:
    """Where a point is: within `slack` of (x, y), which are numbers or of shape (frames,) [m]."""

    x: FloatArray | float
    y: FloatArray | float
    slack: float = 0.0


def names_of(shapes: Sequence[Shape]) -> set[str]:
    """Names of the variables that a drawing needs."""
    quantities: list[Quantity] = []
    for shape in shapes:
        quantities += shape.quantities.values()
        quantities += [quantity for point in shape.outline for quantity in point]
        quantities += [] if isinstance(shape.at, str) else shape.at
    return {quantity.removeprefix("-") for quantity in quantities if isinstance(quantity, str)}


def bounds(scene: Scene) -> tuple[float, float, float, float]:
    """The smallest box that holds the mechanism in all frames and on the way between them.

    Returns:
        Left, bottom, right, top [m].
    """
    ends: dict[str, _Spot] = {}
    boxes = []
    for shape in scene.shapes:
        spot = _spot(shape.at, scene, ends)
        boxes.append(_box(spot, _radius(shape, scene)))
        if shape.kind == "bar":
            ends[shape.name] = _far_end(shape, spot, scene)
            boxes.append(_box(ends[shape.name], 0.0))
    left, bottom, right, top = np.array(boxes).T
    return float(left.min()), float(bottom.min()), float(right.max()), float(top.max())


def _spot(at: Place, scene: Scene, ends: Mapping[str, _Spot]) -> _Spot:
    return ends[at] if isinstance(at, str) else _Spot(scene.value(at[0]), scene.value(at[1]))


def _far_end(bar: Shape, start: _Spot, scene: Scene) -> _Spot:
    angle, length = scene.value(bar.quantities["angle"]), scene.value(bar.quantities["length"])
    turns = np.abs(np.diff(np.ravel(angle)))
    if turns.size and turns.max() > _SURE_TURN:
        return _Spot(start.x, start.y, start.slack + float(np.max(np.abs(length))))
    return _Spot(start.x + length * np.cos(angle), start.y + length * np.sin(angle), start.slack)


def _radius(shape: Shape, scene: Scene) -> float:
    """How far a shape reaches around its place, whichever way it is turned [m]."""
    if shape.kind == "disc":
        return float(np.max(np.abs(scene.value(shape.quantities["radius"]))))
    return max((abs(scene.at_start(radius)) for radius, _ in shape.outline), default=0.0)


def _box(spot: _Spot, radius: float) -> tuple[float, float, float, float]:
    around = spot.slack + radius
    return (
        float(np.min(spot.x)) - around,
        float(np.min(spot.y)) - around,
        float(np.max(spot.x)) + around,
        float(np.max(spot.y)) + around,
    )

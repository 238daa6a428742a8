"""A mechanism in motion: the shapes of a drawing, with numbers for every frame, and the room that they take."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..run.drawing import WITH_POINTS, Place, Quantity, Shape
from .plot import FloatArray

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
        quantities += [quantity for point in (*shape.outline, *shape.copies) for quantity in point]
        for place in (shape.at, shape.to):
            quantities += [] if place is None or isinstance(place, str) else place
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
        if shape.kind in WITH_POINTS:
            for k, (x, y) in enumerate(points_of(shape, scene)):
                ends[f"{shape.name}.{k}"] = _Spot(spot.x, spot.y, spot.slack + math.hypot(x, y))
        if shape.to is not None:
            boxes.append(_box(_spot(shape.to, scene, ends), 0.0))
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
    if shape.kind in WITH_POINTS:
        return max(math.hypot(x, y) for points in chains_of(shape, scene) for x, y in points)
    return max((abs(scene.at_start(radius)) for radius, _ in shape.outline), default=0.0)


def points_of(shape: Shape, scene: Scene) -> list[tuple[float, float]]:
    """The points of a link or outline, in its own frame [m]."""
    return [(scene.at_start(x), scene.at_start(y)) for x, y in shape.outline]


def copies_of(shape: Shape, scene: Scene) -> list[tuple[float, float, float]]:
    """Where a polyline is drawn once more in its own frame: x, y [m] and angle [rad]."""
    return [(scene.at_start(x), scene.at_start(y), scene.at_start(angle)) for x, y, angle in shape.copies]


def chains_of(shape: Shape, scene: Scene) -> list[list[tuple[float, float]]]:
    """The points of a link or outline, and those of each of its copies, in its own frame [m]."""
    points = points_of(shape, scene)
    turned = [(x, y, math.cos(angle), math.sin(angle)) for x, y, angle in copies_of(shape, scene)]
    return [points, *([(x + c * u - s * v, y + s * u + c * v) for u, v in points] for x, y, c, s in turned)]


def _box(spot: _Spot, radius: float) -> tuple[float, float, float, float]:
    around = spot.slack + radius
    return (
        float(np.min(spot.x)) - around,
        float(np.min(spot.y)) - around,
        float(np.max(spot.x)) + around,
        float(np.max(spot.y)) + around,
    )


def hull(points: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """The corners of the convex hull of points, counter-clockwise: two of points on a line, one of equal points.

    Source: A. M. Andrew, Another efficient algorithm for convex hulls in two dimensions, Inf. Process. Lett. 9 (1979).
    """

    def half(ordered: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
        corners: list[tuple[float, float]] = []
        for x, y in ordered:
            while len(corners) > 1:
                (ax, ay), (bx, by) = corners[-2:]
                if (bx - ax) * (y - ay) - (by - ay) * (x - ax) > 0.0:
                    break
                corners.pop()
            corners.append((x, y))
        return corners[:-1]

    ordered = sorted(set(points))
    return ordered if len(ordered) < 3 else half(ordered) + half(ordered[::-1])

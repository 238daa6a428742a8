"""Drawing of a mechanism: shapes in terms of its FMU's variables, for whoever knows a mechanism only by its FMU.

Lengths are in metres and angles in radians, counter-clockwise positive, from the global x axis unless said.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator
from dataclasses import dataclass, fields

from .errors import MechanismError

#: A number, or the name of the parameter, calculated parameter or output that holds it; "-name" is its negative.
Quantity = float | str

#: A point (x, y) [m] in the global frame, or the name of an earlier bar, for its far end, or "<link>.<number>" for a
#: point of an earlier link or outline, counted from 0.
Place = tuple[Quantity, Quantity] | str


@dataclass(frozen=True)
class Bar:
    """A straight link.

    Attributes:
        name: unique within the drawing; it stands in the legend.
        at: where it starts.
        angle: of its direction [rad].
        length: to its far end [m], where other shapes may start.
    """

    name: str
    at: Place
    angle: Quantity
    length: Quantity


@dataclass(frozen=True)
class Wheel:
    """A wheel whose rim repeats itself: gears, ratchet wheels, cams (a count of 1).

    Its form does not move: an output that count or outline name counts with its value at the start.

    Attributes:
        name: as of `Bar`.
        at: its centre.
        angle: of its x axis [rad].
        count: how often the outline goes around, >= 1.
        outline: the rim over one pitch, 2 pi / count: polar points (radius [m], angle from the x axis [rad]).
        clockwise: whether the next piece of the rim lies clockwise of this one; the points run that way too.
    """

    name: str
    at: Place
    angle: Quantity
    count: Quantity
    outline: tuple[tuple[Quantity, Quantity], ...]
    clockwise: bool = False


@dataclass(frozen=True)
class Disc:
    """A full circle.

    Attributes:
        name: as of `Bar`.
        at: its centre.
        radius: [m].
    """

    name: str
    at: Place
    radius: Quantity


@dataclass(frozen=True)
class Hinge:
    """A revolute joint; at a point (x, y) it is fixed to the ground, at a bar's far end it moves along.

    Attributes:
        at: its centre.
    """

    at: Place


@dataclass(frozen=True)
class Striker:
    """The point that strikes: an impact flashes there.

    Attributes:
        at: the point.
    """

    at: Place


@dataclass(frozen=True)
class _Points:
    """Points of a rigid body."""

    name: str
    at: Place
    angle: Quantity
    points: tuple[tuple[Quantity, Quantity], ...]


@dataclass(frozen=True)
class Link(_Points):
    """A rigid body as its points show it: a rod between two, else the plate that their hull makes.

    Attributes:
        name: as of `Bar`.
        at: the origin of the body's frame.
        angle: of the frame [rad].
        points: (x, y) [m] in the frame, one or more, where other shapes may start. They do not move in it: an output
            counts with its value at the start.
    """


@dataclass(frozen=True)
class Polyline(_Points):
    """A line through points of a rigid body, closed where there are three or more: a plate, a wall, a guide.

    Attributes:
        name, at, angle, points: as of `Link`.
        copies: where in the frame it is drawn once more, such as teeth: turned by an angle [rad] about the origin, then
            displaced by (x, y) [m], as (x, y, angle). Other shapes start from points of the line itself.
    """

    copies: tuple[tuple[Quantity, Quantity, Quantity], ...] = ()


@dataclass(frozen=True)
class _Between:
    """What reaches from one place to another."""

    name: str
    at: Place
    to: Place


@dataclass(frozen=True)
class Spring(_Between):
    """A coil spring between two places.

    Attributes:
        name: as of `Bar`.
        at, to: its ends.
    """


@dataclass(frozen=True)
class Rod(_Between):
    """A thin rod between two places.

    Attributes:
        name: as of `Bar`.
        at, to: as of `Spring`.
    """


@dataclass(frozen=True)
class Trace:
    """The path of a point over the whole run.

    Attributes:
        name: as of `Bar`.
        at: the point.
    """

    name: str
    at: Place


#: Any shape of a drawing.
Shape = Bar | Wheel | Disc | Hinge | Striker | Link | Polyline | Spring | Rod | Trace


def square_tooth(gap: float, tooth: float, share: float, count: int) -> tuple[tuple[float, float], ...]:
    """The outline of a `Wheel` with square teeth: one, about the x axis, and half the gaps before and behind it.

    Args:
        gap: radius between teeth [m].
        tooth: radius of their tips [m].
        share: of the pitch that a tooth takes.
        count: of the teeth.
    """
    half, end = share * math.pi / count, math.pi / count
    return (gap, -end), (gap, -half), (tooth, -half), (tooth, half), (gap, half), (gap, end)


def check_drawing(drawing: Collection[Shape], variables: Collection[str]) -> None:
    """Check that a drawing stands on its own.

    Args:
        drawing: shapes, each after the bar that it starts from.
        variables: names of the model's parameters, calculated parameters and outputs.

    Raises:
        MechanismError: a variable or a bar that does not exist, a name given twice, or a number that is not finite.
    """
    names: set[str] = set()
    bars: set[str] = set()
    for number, shape in enumerate(drawing, start=1):
        name = getattr(shape, "name", "")
        label = f"{type(shape).__name__} {name!r}" if name else f"{type(shape).__name__} (shape {number})"
        if name in names:
            raise MechanismError(f"Drawing: two shapes are named {name!r}; give each a name of its own.")
        for place in places(shape):
            if isinstance(place, str) and place not in bars:
                raise MechanismError(
                    f"Drawing, {label}: there is no bar {place!r} before it to start from; "
                    f"bars before it: {', '.join(sorted(bars)) or 'none'}. Or give a point (x, y)."
                )
        for quantity in quantities(shape):
            _check_quantity(quantity, label, variables)
        names |= {name} - {""}
        if isinstance(shape, Bar):
            bars.add(name)
        if isinstance(shape, Link | Polyline):
            bars |= {f"{name}.{k}" for k in range(len(shape.points))}


def places(shape: Shape) -> tuple[Place, ...]:
    """Where a shape is: one place, or two."""
    return (shape.at, shape.to) if isinstance(shape, Spring | Rod) else (shape.at,)


def quantities(shape: Shape) -> Iterator[Quantity]:
    """All numbers of a shape, given or named."""
    for place in places(shape):
        if not isinstance(place, str):
            yield from place
    for field in fields(shape):
        if field.name in ("outline", "points", "copies"):
            yield from (quantity for point in getattr(shape, field.name) for quantity in point)
        elif field.name not in ("name", "at", "to", "clockwise"):
            yield getattr(shape, field.name)


def _check_quantity(quantity: Quantity, label: str, variables: Collection[str]) -> None:
    if isinstance(quantity, str):
        name = quantity.removeprefix("-")
        if name not in variables:
            raise MechanismError(
                f"Drawing, {label}: the model has no variable {name!r}; name one of its parameters, calculated "
                "parameters or outputs, add it there, or give a number."
            )
    elif not math.isfinite(quantity):
        raise MechanismError(f"Drawing, {label}: {quantity} is not a finite number; give one, or a variable's name.")

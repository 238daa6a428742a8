"""Drawing of an FMU's mechanism: `resources/drawing.json`, when the FMU has one."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..fmu.description import Description, Variable
from ..fmu.resources import FlawError, resource
from .master import recorded_variables

#: A number, or the name of a variable, with a leading "-" for its negative.
Quantity = float | str

#: A point (x, y) [m], the name of the bar whose far end it is, or "<link>.<number>" for a point of a link or outline.
Place = tuple[Quantity, Quantity] | str

#: What each kind of shape needs besides its place: lengths in m, angles in rad.
_QUANTITIES = {
    "bar": ("angle", "length"),
    "wheel": ("angle", "count"),
    "disc": ("radius",),
    "hinge": (),
    "striker": (),
    "link": ("angle",),
    "polyline": ("angle",),
    "spring": (),
    "rod": (),
    "trace": (),
}

_UNNAMED = ("hinge", "striker")
#: Kinds that are rigid bodies with points, and kinds that reach from one place to another.
WITH_POINTS = ("link", "polyline")
BETWEEN = ("spring", "rod")


@dataclass(frozen=True)
class Shape:
    """One part of a drawing.

    Attributes:
        kind: "bar", "wheel", "disc", "hinge" (fixed to the ground at a point, else moving), "striker" (the
            point where an impact shows), "link" (a body by its points), "polyline" (a line through points of a body),
            "spring", "rod" or "trace" (the path of a point).
        at: where it starts, or its centre.
        name: "" of hinges and strikers.
        quantities: by name: `angle` [rad] and `length` [m] of a bar, `angle` and `count` of a wheel, `radius` [m] of a
            disc.
        outline: of a wheel, over one pitch: (radius [m], angle from the wheel's x axis [rad]); of a link or outline
            its points (x, y) [m] in its own frame.
        to: the other end of a spring or rod.
        clockwise: whether the outline of a wheel continues clockwise.
        copies: where in its frame a polyline is drawn once more: x, y [m], and the angle [rad] by which it is turned.
    """

    kind: str
    at: Place
    name: str = ""
    quantities: Mapping[str, Quantity] = field(default_factory=dict)
    outline: tuple[tuple[Quantity, Quantity], ...] = ()
    clockwise: bool = False
    to: Place | None = None
    copies: tuple[tuple[Quantity, Quantity, Quantity], ...] = ()


@dataclass(frozen=True)
class Drawing:
    """All shapes of an FMU, in the order in which they are drawn.

    Attributes:
        shapes: () when the FMU has no drawing, or none that can be used.
        objection: why it cannot be used, for the user; "" when nothing is wrong.
    """

    shapes: tuple[Shape, ...] = ()
    objection: str = ""


def is_of_drawing(variable: Variable) -> bool:
    """Whether a variable is no more than a number of a default drawing's shape, which no table needs to show.

    Args:
        variable: of an FMU of this project.
    """
    drawn = variable.name.startswith("drawing_") and variable.description.startswith("Drawing: ")
    return drawn and variable.causality == "calculatedParameter"


def read_drawing(folder: Path, description: Description) -> Drawing:
    """The drawing in the extracted FMU `folder`; one that cannot be used is an objection and never an error."""
    try:
        data = resource(folder, "drawing.json", "shapes")
        return Drawing() if data is None else Drawing(tuple(_shapes(data, description)))
    except (ValueError, RecursionError) as error:
        return Drawing(
            objection=f"The FMU's drawing (resources/drawing.json) cannot be shown: {error}. Build the FMU again."
        )


def _shapes(data: Mapping[str, Any], description: Description) -> Iterator[Shape]:
    variables = [*recorded_variables(description), *description.of("parameter", "calculatedParameter")]
    reader = _Reader({variable.name for variable in variables if variable.type in ("Real", "Integer")})
    for number, raw in enumerate(data["shapes"], start=1):
        yield reader.shape(raw, f"shape {number}")


class _Reader:
    """Reads one shape after another; a shape may start from any bar before it.

    Args:
        variables: names of the variables that have a value in every run.
    """

    def __init__(self, variables: set[str]) -> None:
        self._variables = variables
        self._bars: set[str] = set()

    def shape(self, raw: Any, label: str) -> Shape:
        kind = raw.get("kind") if isinstance(raw, dict) else None
        if not isinstance(kind, str) or kind not in _QUANTITIES:
            raise FlawError(f"{label} is of the unknown kind {kind!r}")
        name = raw.get("name", "")
        if not isinstance(name, str) or (kind not in _UNNAMED and not name):
            raise FlawError(f"{label} has no name")
        if name:
            label = f"{kind} '{name}'"
        outline = raw.get("points" if kind in WITH_POINTS else "outline", [])
        if not isinstance(outline, list) or (kind in ("wheel", *WITH_POINTS) and not outline):
            raise FlawError(f"{label} has no outline")
        shape = Shape(
            kind,
            self._place(raw.get("at"), label),
            name,
            {key: self._quantity(raw.get(key), f"{key} of {label}") for key in _QUANTITIES[kind]},
            tuple(self._pair(point, f"outline of {label}") for point in outline),
            raw.get("clockwise") is True,
            self._place(raw.get("to"), label) if kind in BETWEEN else None,
            tuple(self._copies(raw.get("copies", []), f"copies of {label}") if kind == "polyline" else ()),
        )
        if kind == "bar":
            self._bars.add(name)
        if kind in WITH_POINTS:
            self._bars |= {f"{name}.{k}" for k in range(len(outline))}
        return shape

    def _place(self, raw: Any, label: str) -> Place:
        if not isinstance(raw, str):
            return self._pair(raw, f"place of {label}")
        if raw not in self._bars:
            raise FlawError(f"{label} starts from '{raw}', which is no bar before it")
        return raw

    def _copies(self, raw: Any, label: str) -> Iterator[tuple[Quantity, Quantity, Quantity]]:
        if not isinstance(raw, list) or any(not isinstance(one, list) or len(one) != 3 for one in raw):
            raise FlawError(f"the {label} are no list of x, y and an angle each")
        for x, y, angle in raw:
            yield self._quantity(x, label), self._quantity(y, label), self._quantity(angle, label)

    def _pair(self, raw: Any, label: str) -> tuple[Quantity, Quantity]:
        if not isinstance(raw, list) or len(raw) != 2:
            raise FlawError(f"the {label} is no pair of numbers")
        return self._quantity(raw[0], label), self._quantity(raw[1], label)

    def _quantity(self, raw: Any, label: str) -> Quantity:
        if isinstance(raw, str):
            if raw.removeprefix("-") not in self._variables:
                raise FlawError(f"the {label} is the variable '{raw.removeprefix('-')}', which the FMU has not")
            return raw
        if isinstance(raw, bool) or not isinstance(raw, (int, float)) or not math.isfinite(raw):
            raise FlawError(f"the {label} is {raw!r}, neither a number nor the name of a variable")
        return float(raw)

"""Animation of a mechanism: what `animation.js` plays in the report."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from html import escape
from pathlib import Path
from typing import Any

import numpy as np

from ..run.drawing import WITH_POINTS, Quantity, Shape
from ..run.experiment import Run
from .motion import Contact, contacts
from .page import section
from .plot import FloatArray, frame_rows, strongest
from .scene import Scene, bounds, copies_of, hull, names_of, points_of
from .style import COLOURS, IMPACT_COLOUR, WHEEL, themed

# The player of mechanisms in motion: what `animation.js` brings to life, whatever the pictures are of.

#: More impacts than this are not shown one by one.
MOST_IMPACTS = 400

#: Parts of a picture's size that nobody sees, and the same as an angle [rad].
_FINENESS, _ANGLE_DECIMALS = 1e-4, 4

#: Nothing smaller is drawn [m].
_LEAST_SIZE = 1e-12
#: More teeth than this are no picture.
_MOST_TEETH = 10_000

#: A run plays within these times [s] by default; the speeds to choose from reach at least from 0.1 to 10.
_SHORTEST, _LONGEST = 2.0, 20.0


def picture_data(scene: Scene, angles: set[str]) -> dict[str, Any] | None:
    """What the player needs of one mechanism, as JSON; None when there is nothing to draw.

    Keys: `columns` of the frames; `shapes`, whose numbers are plain or [column, sign]; `view`, the box [m] that holds
    everything at all times.

    Args:
        scene: it.
        angles: which of its columns are in rad.
    """
    moves = all(np.isfinite(column).all() for column in scene.columns.values())
    if not moves or not all(map(math.isfinite, scene.constants.values())):
        return None
    with np.errstate(over="ignore", invalid="ignore"):
        left, bottom, right, top = box = bounds(scene)
    size = max(right - left, top - bottom)
    if not all(map(math.isfinite, (*box, size))) or size < _LEAST_SIZE:
        return None
    return {
        "columns": [
            rounded(column, _ANGLE_DECIMALS if name in angles else decimals(size * _FINENESS))
            for name, column in scene.columns.items()
        ],
        "shapes": _shapes(scene),
        "view": list(box),
    }


def times_data(time: FloatArray) -> dict[str, Any]:
    """The player's clock: `time` [s] of the frames, `speeds` and the default `speed`, `decimals` of the time shown."""
    span = float(time[-1] - time[0])
    speeds, speed = playing_speeds(span)
    return {
        "time": rounded(time, decimals(float(np.diff(time).min(initial=span or 1.0)) / 100)),
        "speeds": speeds,
        "speed": speed,
        "decimals": decimals(span / 1000 or 1.0),
    }


def flags(signal: Iterable[Any]) -> str:
    """Whether something is on, for each frame."""
    return "".join("01"[bool(flag)] for flag in signal)


def playing_speeds(span: float) -> tuple[list[float], float]:
    """Speeds to choose from, in the series 1, 2, 5 and at least from 0.1 to 10, and the default.

    The default is 1 when a run of length `span` [s] then takes between 2 and 20 s, else the nearest to it that does.
    """
    slow, fast = -1, 1
    if span > 0:
        slow = min(slow, math.floor(math.log10(span / _LONGEST)))
        fast = max(fast, math.ceil(math.log10(span / _LONGEST)))
    speeds = [float(f"{digit}e{power}") for power in range(slow, fast) for digit in (1, 2, 5)] + [10.0**fast]
    fitting = [speed for speed in speeds if span / _LONGEST <= speed <= span / _SHORTEST]
    return speeds, min(fitting, key=lambda speed: abs(math.log(speed)), default=1.0)


def decimals(step: float) -> int:
    """Decimals that distinguish multiples of `step` > 0."""
    return max(0, math.ceil(-math.log10(step)))


def rounded(values: FloatArray, places: int) -> list[float]:
    """Short texts in JSON."""
    return [round(value, places) for value in values.tolist()]


def player(data: Mapping[str, Any], pictures: str) -> str:
    """The element that the script brings to life.

    Args:
        data: of `times_data`, `impacts` (times [s]), `contacts` with a flag for each frame, `flash` (a colour), and of
            `picture_data`: of one picture here, or of several under `panels`.
        pictures: an <svg> for each, in their order, with legends.
    """
    return playing("animation", pictures + controls(data), data, Path(__file__).with_name("animation.js"))


def playing(kind: str, shown: str, data: Mapping[str, Any], script: Path) -> str:
    """An element of a class, with its data, and the script that plays it by `player.js`."""
    # "<" could close the script element
    text = json.dumps(data, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
    code = "".join(file.read_text(encoding="utf-8") for file in (Path(__file__).with_name("player.js"), script))
    held = f'{shown}<script type="application/json">{text}</script>'
    return f'<div class="{kind}">{themed(held)}</div><script>{code}</script>'


def legend(shapes: Sequence[Mapping[str, Any]], contacts: Sequence[Contact]) -> str:
    """The names of a picture's parts, and lamps for its contacts."""
    parts = "".join(
        f'<li><i style="background:{shape["colour"]}"></i>{escape(shape["name"])}</li>'
        for shape in shapes
        if shape["name"]
    )
    lamps = "".join(
        f'<li class="lamp" style="--lamp:{contact.colour}">{escape(contact.name)}</li>' for contact in contacts
    )
    in_contact = f'<ul class="lamps"><li>active contacts:</li>{lamps}</ul>' if lamps else ""
    return f'<div class="legend"><ul>{parts}</ul>{in_contact}</div>'


def colours_of(kinds: Sequence[str]) -> list[str]:
    """A colour for each shape of these kinds, in their order: bars, links and traces stay apart."""
    apart = iter(COLOURS * len(kinds))
    return [next(apart) if kind in ("bar", "link", "trace") else WHEEL for kind in kinds]


def _shapes(scene: Scene) -> list[dict[str, Any]]:
    """The shapes for the player: its own copy of `Shape`, with numbers, colours and a wheel's whole rim."""
    moving = list(scene.columns)
    colours = iter(colours_of([shape.kind for shape in scene.shapes]))
    struck_with = {shape.at for shape in scene.shapes if shape.kind == "striker" and isinstance(shape.at, str)}

    def number(quantity: Quantity) -> float | list[int]:
        if isinstance(quantity, str) and (name := quantity.removeprefix("-")) in moving:
            return [moving.index(name), -1 if quantity.startswith("-") else 1]
        return scene.at_start(quantity)

    def shown(shape: Shape) -> dict[str, Any]:
        at = shape.at if isinstance(shape.at, str) else list(map(number, shape.at))
        numbers = {name: number(quantity) for name, quantity in shape.quantities.items() if name != "count"}
        record: dict[str, Any] = {"kind": shape.kind, "name": shape.name, "at": at, **numbers}
        if shape.kind == "bar":
            record["pointed"] = shape.name in struck_with
        if shape.kind == "wheel":
            count = round(min(max(scene.at_start(shape.quantities["count"]), 1), _MOST_TEETH))
            record["count"] = count
            record["pitch"] = (-1 if shape.clockwise else 1) * 2 * math.pi / count
            record["outline"] = [[scene.at_start(radius), scene.at_start(angle)] for radius, angle in shape.outline]
        if shape.kind in WITH_POINTS:
            record["points"] = points_of(shape, scene)
        if shape.copies:
            record["copies"] = copies_of(shape, scene)
        if shape.kind == "link":
            record["hull"] = hull(record["points"])
        if shape.to is not None:
            record["to"] = shape.to if isinstance(shape.to, str) else list(map(number, shape.to))
        colour = next(colours)
        if shape.name:
            record["colour"] = colour
        return record

    return [shown(shape) for shape in scene.shapes]


def controls(data: Mapping[str, Any]) -> str:
    """What the reader plays by: the time, buttons, speeds; that for the next impact only where `impacts` has any."""
    speeds = "".join(
        f'<option value="{speed!r}"{" selected" if speed == data["speed"] else ""}>{speed:g}×</option>'
        for speed in data["speeds"]
    )
    next_impact = '<button type="button" class="next">Next impact</button>' if data["impacts"] else ""
    return (
        '<div class="timeline"><div class="marks" aria-hidden="true"></div>'
        '<input type="range" min="0" max="1000" step="1" value="0" aria-label="Time"></div>'
        f'<div class="controls"><button type="button" class="play">Play</button>{next_impact}'
        f"<label>Speed <select>{speeds}</select></label>"
        '<output class="time"></output><span class="struck"></span></div>'
    )


# The mechanism in motion: an animation that plays in the report, from the recorded outputs alone.

#: Of the section.
HEADING = "Mechanism"

#: A smooth motion needs no more frames, and the report stays small; each impact takes two of them.
_MOST_FRAMES = 2000


def animation(run: Run, heading: str = HEADING, about: str = "") -> str:
    """The section with the animation; "" when the FMU has no drawing, or the run never began.

    `about` is what else there is to say.
    """
    if run.drawing.objection:
        return section(heading, note=run.drawing.objection)
    if not run.drawing.shapes or run.results.empty or not run.parameters:
        return ""
    data = animation_data(run)
    if data is None:
        return section(heading, note="The motion is not finite, or has no extent: there is nothing to draw.")
    note = f"{about} Drawn from the recorded angles and the FMU's parameters.".strip()
    if len(run.impacts) > MOST_IMPACTS:
        note += f" Of {len(run.impacts)} impacts the {MOST_IMPACTS} strongest flash."
    picture = '<svg role="img" aria-label="The mechanism at the time shown below"></svg>'
    return section(heading, player(data, picture + legend(data["shapes"], contacts(run))), note=note)


def animation_data(run: Run) -> dict[str, Any] | None:
    """What the player needs (`player`), as JSON; None when there is nothing to draw."""
    names = sorted(names_of(run.drawing.shapes))
    moving = [name for name in names if name in run.results]
    table = run.results[["time", *moving]].to_numpy(dtype=np.float64)
    usable = np.isfinite(table).all(axis=1)
    if not usable.any():
        return None
    table, results = table[usable], run.results[usable]
    impacts = strongest(run.impacts, MOST_IMPACTS)
    impacts = impacts[np.isfinite(impacts)]
    rows = frame_rows(table[:, 0], impacts, _MOST_FRAMES)
    frames = table[rows]
    columns = dict(zip(moving, frames.T[1:], strict=True))
    constants = {name: float(run.parameters[name]) for name in names if name not in columns}
    angles = {name for name in moving if run.description.variable(name).unit == "rad"}
    picture = picture_data(Scene(run.drawing.shapes, columns, constants), angles)
    if picture is None:
        return None
    active = [
        {"name": contact.name, "colour": contact.colour, "active": flags(results[contact.variable].iloc[rows])}
        for contact in contacts(run)
    ]
    clock = times_data(frames[:, 0])
    return clock | picture | {"impacts": rounded(impacts, 9), "contacts": active, "flash": IMPACT_COLOUR}

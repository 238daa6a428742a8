"""The mechanism in motion: an animation that plays in the report, from the recorded outputs alone."""

from __future__ import annotations

import json
import math
from html import escape
from importlib.resources import files
from typing import Any

import numpy as np
import pandas as pd

from ..drawing import Quantity, Shape
from ..experiment import Run
from .modes import contacts
from .page import section
from .scene import Scene, bounds, names_of
from .style import COLOURS, IMPACT_COLOUR
from .thin import FloatArray, frame_rows, strongest

#: Of the section.
HEADING = "Mechanism"

#: A smooth motion needs no more frames, and the report stays small.
_MOST_FRAMES = 2000
#: More impacts than this are not shown one by one; each takes two frames.
_MOST_IMPACTS = 400

#: Parts of a picture's size that nobody sees, and the same as an angle [rad].
_FINENESS, _ANGLE_DECIMALS = 1e-4, 4

#: Nothing smaller is drawn [m].
_LEAST_SIZE = 1e-12
#: More teeth than this are no picture.
_MOST_TEETH = 10_000

#: A run plays within these times [s] unless told otherwise; the speeds to choose from reach at least from 0.1 to 10.
_SHORTEST, _LONGEST = 2.0, 20.0

_WHEEL = "#c9d2dc"


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
    script = files("harness.report").joinpath("animation.js").read_text(encoding="utf-8")
    note = f"{about} Drawn from the recorded angles and the FMU's parameters.".strip()
    if len(run.impacts) > _MOST_IMPACTS:
        note += f" Of {len(run.impacts)} impacts the {_MOST_IMPACTS} strongest flash."
    # "<" could close the script element
    text = json.dumps(data, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
    parts = [_player(data), f'<script type="application/json">{text}</script>']
    return section(heading, f'<div class="animation">{"".join(parts)}</div><script>{script}</script>', note=note)


def animation_data(run: Run) -> dict[str, Any] | None:
    """What the player needs, as JSON; None when there is nothing to draw.

    Keys: `time` [s] and `columns` of the frames; `shapes`, whose numbers are plain or [column, sign]; `view`, the
    box [m] that holds everything at all times; `impacts`, times [s]; `contacts` with a flag for each frame;
    `speeds` and the default `speed`; `decimals` of the time shown.
    """
    names = sorted(names_of(run.drawing.shapes))
    moving = [name for name in names if name in run.results]
    table = run.results[["time", *moving]].to_numpy(dtype=np.float64)
    usable = np.isfinite(table).all(axis=1)
    if not usable.any():
        return None
    table, results = table[usable], run.results[usable]
    impacts = strongest(run.impacts, _MOST_IMPACTS)
    impacts = impacts[np.isfinite(impacts)]
    rows = frame_rows(table[:, 0], impacts, _MOST_FRAMES)
    frames = table[rows]
    time, columns = frames[:, 0], dict(zip(moving, frames.T[1:], strict=True))
    constants = {name: float(run.parameters[name]) for name in names if name not in columns}
    if not all(map(math.isfinite, constants.values())):
        return None
    scene = Scene(run.drawing.shapes, columns, constants)
    with np.errstate(over="ignore", invalid="ignore"):
        left, bottom, right, top = box = bounds(scene)
    size = max(right - left, top - bottom)
    if not all(map(math.isfinite, (*box, size))) or size < _LEAST_SIZE:
        return None
    span = float(time[-1] - time[0])
    speeds, speed = playing_speeds(span)
    return {
        "time": _rounded(time, _decimals(float(np.diff(time).min(initial=span or 1.0)) / 100)),
        "columns": [
            _rounded(column, _ANGLE_DECIMALS if _is_angle(name, run) else _decimals(size * _FINENESS))
            for name, column in columns.items()
        ],
        "shapes": _shapes(scene, moving),
        "view": list(box),
        "impacts": _rounded(impacts, 9),
        "contacts": [
            {"name": contact.name, "colour": contact.colour, "active": _flags(results[contact.variable].iloc[rows])}
            for contact in contacts(run)
        ],
        "speeds": speeds,
        "speed": speed,
        "decimals": _decimals(span / 1000 or 1.0),
        "flash": IMPACT_COLOUR,
    }


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


def _flags(signal: pd.Series[bool]) -> str:
    return "".join("01"[bool(flag)] for flag in signal)


def _is_angle(name: str, run: Run) -> bool:
    return run.description.variable(name).unit == "rad"


def _decimals(step: float) -> int:
    """Decimals that tell multiples of `step` > 0 apart."""
    return max(0, math.ceil(-math.log10(step)))


def _rounded(values: FloatArray, decimals: int) -> list[float]:
    return [round(value, decimals) for value in values.tolist()]


def _shapes(scene: Scene, moving: list[str]) -> list[dict[str, Any]]:
    """The shapes for the player: its own copy of `Shape`, with numbers, colours and a wheel's whole rim."""
    colours = iter(COLOURS * len(scene.shapes))
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
        if shape.name:
            record["colour"] = next(colours) if shape.kind == "bar" else _WHEEL
        return record

    return [shown(shape) for shape in scene.shapes]


def _player(data: dict[str, Any]) -> str:
    """The elements that the script brings to life."""
    speeds = "".join(
        f'<option value="{speed!r}"{" selected" if speed == data["speed"] else ""}>{speed:g}×</option>'
        for speed in data["speeds"]
    )
    parts = "".join(
        f'<li><i style="background:{shape["colour"]}"></i>{escape(shape["name"])}</li>'
        for shape in data["shapes"]
        if shape["name"]
    )
    lamps = "".join(
        f'<li class="lamp" style="--lamp:{contact["colour"]}">{escape(contact["name"])}</li>'
        for contact in data["contacts"]
    )
    in_contact = f'<ul class="lamps"><li>active contacts:</li>{lamps}</ul>' if lamps else ""
    next_impact = '<button type="button" class="next">Next impact</button>' if data["impacts"] else ""
    return (
        '<svg role="img" aria-label="The mechanism at the time shown below"></svg>'
        f'<div class="legend"><ul>{parts}</ul>{in_contact}</div>'
        '<div class="timeline"><div class="marks" aria-hidden="true"></div>'
        '<input type="range" min="0" max="1000" step="1" value="0" aria-label="Time"></div>'
        f'<div class="controls"><button type="button" class="play">Play</button>{next_impact}'
        f"<label>Speed <select>{speeds}</select></label>"
        '<output class="time"></output><span class="struck"></span></div>'
    )

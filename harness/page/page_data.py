"""What the scripts of a page get to know of a model: variables, drawing, charts."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from mechanism_fmu.fmu.native.web import WebModule
from mechanism_fmu.fmu.parts.fmi_units import display_factor
from mechanism_fmu.fmu.parts.resources import DRAWING, drawing
from mechanism_fmu.fmu.parts.variables import Variable, variables_of

from ..report.animation import WHEEL, colours_of, decimals
from ..report.motion import QUANTITIES, contacts_named
from ..report.page import COLOURS

_TYPES = {"Real": "Float64", "Integer": "Int32", "Boolean": "Boolean"}

#: A run has no more points than this; each impact is one more.
_MOST_POINTS = 2000

#: What a default drawing's numbers begin with: they are for no chart.
_OF_DRAWING = "Drawing: "

#: The page's own colours, which are others in the dark.
_PALETTE = {colour: f"var(--c{k})" for k, colour in enumerate(COLOURS, start=1)} | {WHEEL: "var(--wheel)"}


def page_data(web: WebModule) -> dict[str, Any]:
    """All that the scripts need of a model, as JSON.

    Keys: `name`, `token`; `stop` [s], `steps`, `decimals` of times; `given`, the parameters and inputs; `reals` and
    `flags`, the outputs that a run records, in this order behind time and impact; `constants`, the calculated
    parameters that the drawing needs; `shapes`, those of drawing.json with colours, and `moving`, the reals that move
    them; `contacts`, the flags that have a lamp; `charts`, titles with names of reals; `impact`, the reals of the last
    impact.

    Args:
        web: the model for a page.

    Raises:
        MechanismError: its drawing names what it does not have.
    """
    model = web.model
    variables = variables_of(model)
    shapes = _shapes(drawing(model), variables)
    needed = set(_names(shapes))
    reals = [v for v in variables if v.causality == "output" and v.type == "Real" and "[" not in v.name]
    flags = [v for v in variables if v.causality == "output" and v.type == "Boolean" and v.variability == "discrete"]
    shown = [v for v in reals if v.variability == "continuous" and not _is_of_drawing(v)]
    constants = [v for v in variables if v.causality == "calculatedParameter" and v.name in needed]
    lamps = contacts_named([v.name for v in flags], lambda _: True)
    return {
        "name": model.name,
        "token": web.token,
        "stop": model.stop_time,
        "steps": max(1, min(_MOST_POINTS, round(model.stop_time / model.step_size))),
        "decimals": decimals(model.stop_time / 1000),
        "given": [_given(v) for v in variables if v.causality in ("input", "parameter")],
        "reals": [_known(v) for v in reals],
        "flags": [_known(v) for v in flags],
        "constants": [_known(v) for v in constants],
        "shapes": shapes,
        "moving": [v.name for v in reals if v.name in needed],
        "contacts": [{"variable": c.variable, "name": c.name, "colour": _PALETTE[c.colour]} for c in lamps],
        "charts": _charts(shown),
        "impact": [v.name for v in reals if v.source.startswith("impact.") and v.source != "impact.time"],
    }


def slider_range(start: float, minimum: float | None, maximum: float | None) -> tuple[float, float]:
    """From where to where a slider goes: from half to twice its start, of zero from -1 to 1, within the limits.

    The limits of a value say what the engine computes, often far beyond what anybody builds.
    """
    low, high = sorted((start / 2, start * 2)) if start else (-1.0, 1.0)
    return low if minimum is None else max(low, minimum), high if maximum is None else min(high, maximum)


def _known(v: Variable) -> dict[str, Any]:
    """A variable that can be read; `shown` is the unit for people, of which one SI unit is `factor`."""
    unit = v.unit or "1"
    shown = v.display_unit or unit
    return {
        "name": v.name,
        "reference": v.value_reference,
        "type": _TYPES[v.type],
        "description": v.description,
        "unit": "" if unit == "1" else unit,
        "shown": "" if shown == "1" else shown,
        "factor": display_factor(unit, shown) if v.display_unit else 1.0,
    }


def _given(v: Variable) -> dict[str, Any]:
    """A variable that can be set, with the range of its slider, unless it is yes or no."""
    known = _known(v) | {"causality": v.causality, "start": v.start}
    if v.type != "Boolean":
        known["range"] = slider_range(float(v.start or 0.0), v.minimum, v.maximum)
    return known


def _charts(variables: Sequence[Variable]) -> list[dict[str, Any]]:
    """A chart for each unit, in the order in which they come."""
    units = dict.fromkeys(v.unit or "1" for v in variables)
    return [
        {"title": QUANTITIES.get(unit, "Values"), "names": [v.name for v in variables if (v.unit or "1") == unit]}
        for unit in units
    ]


def _is_of_drawing(v: Variable) -> bool:
    return v.name.startswith("drawing_") and v.description.startswith(_OF_DRAWING)


def _shapes(files: Mapping[str, bytes], variables: Iterable[Variable]) -> list[dict[str, Any]]:
    """The shapes of the drawing with their colours; none where it moves with what a run does not record."""
    if DRAWING not in files:
        return []
    shapes: list[dict[str, Any]] = json.loads(files[DRAWING])["shapes"]
    recorded = {v.name for v in variables if v.causality != "output" or (v.type == "Real" and "[" not in v.name)}
    if not recorded.issuperset(_names(shapes)):
        return []
    colours = colours_of([shape["kind"] for shape in shapes])
    return [
        shape | ({"colour": _PALETTE[colour]} if shape.get("name") else {})
        for shape, colour in zip(shapes, colours, strict=True)
    ]


def _names(shapes: Iterable[Mapping[str, Any]]) -> Iterator[str]:
    """The variables that shapes need."""
    for shape in shapes:
        for key, value in shape.items():
            of_point = key in ("at", "to") and isinstance(value, str)
            if key not in ("kind", "name", "colour") and not of_point:
                yield from _in(value)


def _in(value: Any) -> Iterator[str]:
    if isinstance(value, str):
        yield value.removeprefix("-")
    elif isinstance(value, list):
        for one in value:
            yield from _in(one)

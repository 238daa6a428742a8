"""What the scripts of a page get to know of a model: variables, drawing, charts."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from mechanism_fmu.fmu.native.web import WebModule
from mechanism_fmu.fmu.native.web_data import WebData, web_data
from mechanism_fmu.fmu.parts.fmi_units import display_factor
from mechanism_fmu.fmu.parts.resources import DRAWING, drawing
from mechanism_fmu.fmu.parts.variables import Variable, variables_of

from ..report.animation import colours_of, decimals
from ..report.motion import QUANTITIES, STICKS, SUFFIX, contacts_named
from ..report.style import THEMED
from .shown_units import LADDERS, shown_unit
from .stress_data import stress_data

_TYPES = {"Real": "Float64", "Integer": "Int32", "Boolean": "Boolean"}

#: A run has no more points than this; each impact is one more.
_MOST_POINTS = 2000

#: Outputs that say something of one communication step only, and counters of impacts.
_OF_A_STEP = ("impact.in_step", "impact.lost", "event.in_step")
_COUNTED = (*_OF_A_STEP, "impact.count", "impact.any", "impact.by_poisson")

#: What a default drawing's numbers begin with: they are for no chart.
_OF_DRAWING = "Drawing: "


def page_data(web: WebModule) -> dict[str, Any]:
    """All that the scripts need of a model, as JSON.

    Keys: `name`, `token`; `stop` [s] of the first case, `decimals` of times; `cases`, of which the page begins with the
    first; `given`, the parameters and inputs; `reals`, `flags` and `wholes`, the outputs that a run records, in this
    order behind time and impact, in rows of `width` numbers; `constants`, the calculated parameters that the drawing
    needs; `shapes`, those of drawing.json with colours, and `moving`, the reals that move them; `contacts`, the flags
    that have a lamp, and `parts`, the contacts that have a strip; `charts`, titles with
    names of outputs and other units for them; `impact`, what is recorded of the last impact, `struck`, which of it
    numbers a contact, and `stress`, what it leaves.

    Args:
        web: the model for a page.

    Raises:
        MechanismError: its drawing names what it does not have, or a case cannot be.
    """
    model = web.model
    more, variables = web_data(model), variables_of(model)
    shapes = _shapes(drawing(model), variables)
    needed = set(_names(shapes))
    outputs = [v for v in variables if v.causality == "output" and "[" not in v.name]
    reals = [v for v in outputs if v.type == "Real"]
    flags = [v for v in outputs if v.type == "Boolean" and v.variability == "discrete"]
    wholes = [v for v in outputs if v.type == "Integer" and v.source not in _OF_A_STEP]
    of_impact = [v for v in (*reals, *wholes) if v.source.startswith("impact.") and v.source not in _COUNTED]
    constants = [v for v in variables if v.causality == "calculatedParameter" and v.name in needed]
    return {
        "name": model.name,
        "token": web.token,
        **beginning_with(more.cases[0], [_with_steps(case) for case in more.cases[1:]]),
        "given": [_given(v, more) for v in variables if v.causality in ("input", "parameter")],
        "reals": [_known(v) for v in reals],
        "flags": [_known(v) for v in flags],
        "wholes": [_known(v) for v in wholes],
        "width": 2 + len(reals) + len(flags) + len(wholes),
        "constants": [_known(v) for v in constants],
        "shapes": shapes,
        "moving": [v.name for v in reals if v.name in needed],
        "contacts": [
            {"variable": c.variable, "name": c.name, "colour": THEMED[c.colour]}
            for c in contacts_named([v.name for v in flags], lambda _: True)
        ],
        "parts": _parts([v.name for v in flags]),
        "charts": _charts([v for v in reals if v.variability == "continuous" and not _is_of_drawing(v)])
        + _counts([v for v in wholes if v not in of_impact]),
        "impact": [v.name for v in of_impact if v.source != "impact.time"],
        "struck": _struck(of_impact, more.contacts),
        "stress": stress_data(more.struck, of_impact),
    }


def beginning_with(first: Mapping[str, Any], others: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """What the page holds of its cases: `cases`, and of the first one `stop` and `decimals`."""
    stop = first["stop"]
    return {"stop": stop, "decimals": decimals(stop / 1000), "cases": [_with_steps(first), *others]}


#: Of a start of zero, by unit: half a turn each way, and what is slow for people; else 1.
_AROUND_ZERO = {"rad": math.pi, "rad/s": 10.0, "m/s2": 10.0}


def slider_range(start: float, minimum: float | None, maximum: float | None, unit: str = "1") -> tuple[float, float]:
    """From where to where a slider goes without a usual range: half to twice its start, or around zero.

    It stays within the limits. They say what the engine computes, often far beyond what anybody builds.
    """
    around = _AROUND_ZERO.get(unit, 1.0)
    low, high = sorted((start / 2, start * 2)) if start else (-around, around)
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


def _with_steps(case: Mapping[str, Any]) -> dict[str, Any]:
    """A case with the number of its `steps`."""
    return {**case, "steps": max(1, min(_MOST_POINTS, round(case["stop"] / case["step"])))}


def _given(v: Variable, more: WebData) -> dict[str, Any]:
    """A variable that can be set, with the range of its slider, unless it is yes or no."""
    group = "setting" if v.name in more.settings else v.causality
    known = _known(v) | {"causality": v.causality, "group": group, "start": v.start}
    if v.type != "Boolean":
        start = float(v.start or 0.0)
        low, high = more.usual.get(v.name) or slider_range(start, v.minimum, v.maximum, v.unit or "1")
        known["range"] = (low, high)
        if v.display_unit is None and v.unit in LADDERS:
            known["shown"], known["factor"] = shown_unit(v.unit, start or max(abs(low), abs(high)))
    return known


def _charts(variables: Sequence[Variable]) -> list[dict[str, Any]]:
    """A chart for each unit, in the order in which they come."""
    units = dict.fromkeys(v.unit or "1" for v in variables)
    return [
        {
            "title": QUANTITIES.get(unit, "Values"),
            "names": [v.name for v in variables if (v.unit or "1") == unit],
            "ladder": () if any(v.display_unit for v in variables if v.unit == unit) else LADDERS.get(unit, ()),
        }
        for unit in units
    ]


def _counts(variables: Sequence[Variable]) -> list[dict[str, Any]]:
    """A chart of whole numbers, where there are any."""
    return [{"title": "Counts", "names": [v.name for v in variables], "ladder": ()}] if variables else []


def _parts(flags: Sequence[str]) -> list[dict[str, str]]:
    """What closes or sticks, with the flags that say so; "" for none."""
    names = dict.fromkeys(name.removesuffix(end) for name in flags for end in (SUFFIX, STICKS) if name.endswith(end))
    return [
        {"name": name.replace("_", " ")}
        | {
            key: f"{name}{end}" if f"{name}{end}" in flags else ""
            for key, end in (("active", SUFFIX), ("sticks", STICKS))
        }
        for name in names
    ]


def _struck(of_impact: Iterable[Variable], contacts: Iterable[str]) -> dict[str, Any] | None:
    """The whole number that says which contact was struck, with the contacts' names."""
    names = [name.replace("_", " ") for name in contacts]
    return next(({"variable": v.name, "names": names} for v in of_impact if v.source == "impact.contact"), None)


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
        shape | ({"colour": THEMED[colour]} if shape.get("name") else {})
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

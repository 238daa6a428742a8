"""A bending linkage in motion, with its deflection exaggerated as much as the reader likes."""

from __future__ import annotations

import json
import math
from importlib.resources import files
from typing import Any

import numpy as np

from ..ked.solution import Bent, FloatArray, Solution
from .player import decimals, rounded
from .style import COLOURS

#: Positions of a turn; between them the script interpolates.
_MOST_FRAMES = 180
#: The most that the slider exaggerates, and the part of the picture that the largest deviation takes at first.
_MOST, _SEEN = 200, 0.1
#: Parts of the picture's size that nobody sees.
_FINENESS = 1e-4


def deflected(found: Solution) -> str:
    """The element that the script brings to life: `deflected.js`."""
    data = deflected_data(found)
    script = files("harness.report").joinpath("deflected.js").read_text(encoding="utf-8")
    # "<" could close the script element
    text = json.dumps(data, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
    lines = "".join(
        f'<li><i style="background:{member["colour"]}"></i>{member["name"]}</li>' for member in data["members"]
    )
    return (
        '<div class="animation deflected"><svg role="img" aria-label="The bent linkage at the angle shown below"></svg>'
        f'<div class="legend"><ul>{lines}<li>grey: rigid</li></ul></div>'
        '<input type="range" class="angle" min="0" max="360" step="0.5" value="0" aria-label="Angle of the crank">'
        '<div class="controls"><button type="button" class="play">Play</button>'
        '<label>Motion <select><option value="dynamic">elastodynamic</option>'
        '<option value="static">quasi-static</option></select></label>'
        f'<label>Deflection × <input type="range" class="times" min="1" max="{_MOST}" step="1" '
        f'value="{data["times"]}" aria-label="Exaggeration of the deflection"></label>'
        f'<output class="time"></output></div><script type="application/json">{text}</script></div>'
        f"<script>{script}</script>"
    )


def deflected_data(found: Solution) -> dict[str, Any]:
    """What the script needs, as JSON.

    Keys: `view`, the box [m] of the rigid motion; `times`, the exaggeration at first; `degrees` of the frames;
    `members`, each with `start` and `end` (x, y of all frames, one after the other [m]), and `static` and `dynamic`
    (six displacements of its ends a frame); `path`, `rigid` [m], and its `static` and `dynamic` deflection.
    """
    frames = np.arange(0, len(found.angle), math.ceil(len(found.angle) / _MOST_FRAMES))
    starts, ends = found.rigid.starts[frames], found.rigid.ends[frames]
    points = np.concatenate([starts, ends], axis=1).reshape(-1, 2)
    low, high = points.min(axis=0), points.max(axis=0)
    size = float((high - low).max())
    largest = max(found.static.largest_deviation, found.dynamic.largest_deviation)
    times = _MOST if largest <= 0.0 else min(_MOST, max(1, round(_SEEN * size / largest)))
    places = decimals(size * _FINENESS)
    fine = decimals(size * _FINENESS / _MOST)

    def bent(one: Bent, member: int) -> list[float]:
        return rounded(one.ends[frames, member].ravel(), fine)

    def path(values: FloatArray, to: int) -> list[float]:
        return rounded(values[frames, :2].ravel(), to)

    return {
        "view": [round(x, places) for x in (*low.tolist(), *high.tolist())],
        "times": times,
        "degrees": rounded(found.degrees[frames], 6),
        "members": [
            {
                "name": name,
                "colour": COLOURS[k % len(COLOURS)],
                "start": rounded(starts[:, k].ravel(), places),
                "end": rounded(ends[:, k].ravel(), places),
                "static": bent(found.static, k),
                "dynamic": bent(found.dynamic, k),
            }
            for k, name in enumerate(found.members)
        ],
        "path": {
            "rigid": path(found.rigid.path, places),
            "static": path(found.static.deflection, fine),
            "dynamic": path(found.dynamic.deflection, fine),
        },
    }

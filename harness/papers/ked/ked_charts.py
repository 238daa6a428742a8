"""Charts of a bending linkage: frame, joints, friction, flywheel, lightest design; its motion, exaggerated."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np

from ...report.animation import decimals, playing, rounded
from ...report.plot import Curve, Plot
from ...report.style import COLOURS
from .solution import Bent, FloatArray, Solution
from .synthesis import Synthesised

# Charts of the report of a bending linkage: frame, joints, friction, flywheel, and the lightest design.

_ANGLE = "crank angle [deg]"
_BEFORE, _AFTER, _LIMIT = COLOURS[6], COLOURS[0], COLOURS[1]


def round_turn(values: FloatArray, end: float | None = None) -> FloatArray:
    """With the first value at the end again, or `end`: a turn closes."""
    return np.append(values, values[0] if end is None else end)


def frame_plots(found: Solution) -> list[Plot]:
    """Hodograph of the shaking force, the shaking moment, and the forces in the joints."""
    rigid, angle = found.rigid, round_turn(found.degrees, 360.0)
    x, y = (1e3 * float(c) for c in rigid.shaking.about)
    force = [round_turn(rigid.shaking.force[:, k]) for k in (0, 1)]
    joints = [
        Curve(joint.joint, angle, round_turn(joint.force), COLOURS[k % len(COLOURS)])
        for k, joint in enumerate(rigid.joints)
    ]
    return [
        Plot(
            "Shaking force: hodograph, a mark each 30°",
            "force on the frame, x [N]",
            "force on the frame, y [N]",
            [Curve("shaking force", force[0], force[1], COLOURS[0]), _marks(found)],
            to_scale=True,
            legend=False,
        ),
        Plot(
            f"Shaking moment about ({x:g}, {y:g}) mm",
            _ANGLE,
            "moment on the frame [N.m]",
            [Curve("shaking moment", angle, round_turn(rigid.shaking.moment), COLOURS[0])],
            legend=False,
        ),
        Plot("Forces in the joints", _ANGLE, "force [N]", joints, from_zero=True),
    ]


def friction_plots(found: Solution, without: Solution | None) -> list[Plot]:
    """The input torque with and without friction, and the friction of each joint."""
    angle = round_turn(found.degrees, 360.0)
    torque = [Curve("with friction", angle, round_turn(found.rigid.torque), _AFTER)]
    if without is not None:
        torque.insert(0, Curve("without", angle, round_turn(without.rigid.torque), _BEFORE))
    plots = [Plot("Torque that keeps the speed", _ANGLE, "torque [N.m]", torque)]
    for turning, title, unit in ((True, "Friction torque of the pins", "N.m"), (False, "Friction of the sliders", "N")):
        curves = [
            Curve(joint.joint, angle, round_turn(joint.friction), COLOURS[k % len(COLOURS)])
            for k, joint in enumerate(found.rigid.joints)
            if joint.turning is turning and joint.friction.any()
        ]
        if curves:
            plots.append(Plot(title, _ANGLE, f"on body i [{unit}]", curves))
    return plots


def flywheel_plot(found: Solution) -> Plot:
    """The crank's speed over the turn with the flywheel.

    Raises:
        ValueError: none was asked for.
    """
    wheel = found.rigid.flywheel
    if wheel is None:
        raise ValueError("there is no flywheel")
    angle, rpm = round_turn(found.degrees, 360.0), 30 / math.pi
    return Plot(
        "Speed of the crank with the flywheel, under a constant drive torque",
        _ANGLE,
        "speed [rpm]",
        [
            Curve("with the flywheel", angle, round_turn(rpm * wheel.speed), _AFTER),
            Curve("mean", np.array([0.0, 360.0]), np.full(2, found.rpm), _BEFORE),
        ],
    )


def synthesis_plots(found: Synthesised) -> list[Plot]:
    """Deviation and largest stress over the turn before and after, beside their limits."""
    degrees = np.degrees(found.angle[:-1]) % 360.0
    order = np.argsort(degrees)
    angle = degrees[order]
    plots = []
    limited = (("deviation", "mm", 1e3, found.limits.deviation), ("stress", "MPa", 1e-6, found.limits.stress))
    for what, unit, factor, limit in limited:
        curves = []
        for when, judged, colour in (("before", found.before, _BEFORE), ("after", found.after, _AFTER)):
            values = judged.deviation if what == "deviation" else judged.stress.max(axis=1)
            curves.append(Curve(when, angle, factor * values[:-1][order], colour))
        if limit is not None:
            curves.append(Curve("limit", np.array([0.0, 360.0]), np.full(2, factor * limit), _LIMIT))
        title = f"{what.capitalize()}, {found.limits.judged_by}"
        plots.append(Plot(title, _ANGLE, f"{what} [{unit}]", curves, from_zero=True))
    return plots


def _marks(found: Solution) -> Curve:
    """Dots at each 30 deg, as far as there are such angles."""
    marked = np.abs(found.degrees / 30.0 - np.round(found.degrees / 30.0)) < 1e-9
    x, y = found.rigid.shaking.force[marked].T
    return Curve("each 30 deg", x, y, COLOURS[1], line=False, dots=True)


# A bending linkage in motion, with its deflection exaggerated as much as the reader likes.

#: Positions of a turn; between them the script interpolates.
_MOST_FRAMES = 180
#: The most that the slider exaggerates, and the part of the picture that the largest deviation takes at first.
_MOST, _SEEN = 200, 0.1
#: Parts of the picture's size that nobody sees.
_FINENESS = 1e-4


def deflected(found: Solution) -> str:
    """The element that the script brings to life: `deflected.js`."""
    data = deflected_data(found)
    lines = "".join(
        f'<li><i style="background:{member["colour"]}"></i>{member["name"]}</li>' for member in data["members"]
    )
    shown = (
        '<svg role="img" aria-label="The bent linkage at the angle shown below"></svg>'
        f'<div class="legend"><ul>{lines}<li>grey: rigid</li></ul></div>'
        '<input type="range" class="angle" min="0" max="360" step="0.5" value="0" aria-label="Angle of the crank">'
        '<div class="controls"><button type="button" class="play">Play</button>'
        '<label>Motion <select><option value="dynamic">elastodynamic</option>'
        '<option value="static">quasi-static</option></select></label>'
        f'<label>Deflection × <input type="range" class="times" min="1" max="{_MOST}" step="1" '
        f'value="{data["times"]}" aria-label="Exaggeration of the deflection"></label>'
        '<output class="time"></output></div>'
    )
    return playing("animation deflected", shown, data, Path(__file__).with_name("deflected.js"))


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

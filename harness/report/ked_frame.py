"""Charts of the report of a bending linkage: frame, joints, friction, flywheel, and the lightest design."""

from __future__ import annotations

import math

import numpy as np

from ..ked.solution import FloatArray, Solution
from ..ked.synthesis import Synthesised
from .plot import Curve, Plot
from .style import COLOURS

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

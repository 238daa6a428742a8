"""The two kinematic conditions of the rack and pinion that the ME451 slides state, along a motion."""

from __future__ import annotations

import math

import numpy as np

from mechanism_fmu.kinematics import analyse
from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Body,
    Mechanism,
    RackAndPinion,
    Revolute,
    XDriver,
    polynomial_motion,
)

from .bench import Bench, FloatArray
from .row import Found, Row, Verdict, within

_RADIUS, _WAY, _TURN = 0.5, 0.8, 0.6
_CODE = ("mechanism_fmu/model/joints/rack_and_pinion.py",)


def _motion() -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """A rack that turns about the origin while its pinion goes to the right: angles of both, centre of the pinion."""
    mechanism = Mechanism(
        bodies=(Body("i", 1.0, 1.0), Body("j", 1.0, 1.0, (0.0, _RADIUS, 0.0))),
        joints=(
            Revolute("hinge", "i", (0.0, 0.0), GROUND, (0.0, 0.0)),
            RackAndPinion("mesh", "i", (0.0, 0.0), (0.0, 0.0), 0.0, "j", _RADIUS, 3 * math.pi / 2),
            AngleDriver("turn", "i", polynomial_motion(0.0, _TURN)),
            XDriver("push", "j", (0.0, 0.0), polynomial_motion(0.0, _WAY)),
        ),
    )
    found = analyse(mechanism, np.linspace(0.0, 1.0, 61))
    rack, pinion, x, y = (found.of(name)[0] for name in ("i.angle", "j.angle", "j.x", "j.y"))
    return rack, pinion, x, y


def _distance(_bench: Bench) -> Found:
    rack, _, x, y = _motion()
    away = -np.sin(rack) * x + np.cos(rack) * y
    return within(
        float(np.abs(away - _RADIUS).max()),
        1e-9,
        f"P_jD = {_RADIUS} m at 61 places while the rack turns by {math.degrees(_TURN):.1f}° and the pinion goes "
        f"{_WAY} m aside",
        verdict=Verdict.HOLDS,
    )


def _no_slip(_bench: Bench) -> Found:
    """Segment from where D is on the rack, arc from how far the pinion has turned against it."""
    rack, pinion, x, y = _motion()
    segment = np.cos(rack) * x + np.sin(rack) * y
    arc = -_RADIUS * ((pinion - pinion[0]) - (rack - rack[0]))
    return within(
        float(np.abs((segment - segment[0]) - arc).max()),
        1e-9,
        f"Q_iD = arc Q_jD at 61 places of the same motion, {segment[-1] - segment[0]:.6f} m at its end",
        verdict=Verdict.HOLDS,
    )


ROWS = (
    Row("S-rack-distance", "Rack and pinion", "P_jD stays R_j.", "in words", _CODE, _distance),
    Row("S-rack-slip", "Rack and pinion", "Q_iD is as long as the arc.", "in words", _CODE, _no_slip),
)

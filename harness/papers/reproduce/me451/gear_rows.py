"""Composite joints, gears and racks of the ME451 slides beside the five steps."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from mechanism_fmu.kinematics import analyse
from mechanism_fmu.kinematics.equations import Equations
from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Body,
    Distance,
    Gears,
    Mechanism,
    RackAndPinion,
    Revolute,
    Translational,
    XDriver,
    polynomial_motion,
)
from mechanism_fmu.model.joints import Joint
from mechanism_fmu.slides import CARRIER, MARK_1, MARK_2, RADIUS_1, RADIUS_2, carried_gear, falling_gear, rolled_angle

from ..bench import Bench, FloatArray, off_by
from ..figures.all_figures import redrawn_joint
from ..row import Found, Row, Verdict, judged, within
from .joint_rows import GEAR_PAIR, PARTS, A, B, two_bodies

GEARS, SLIDES = "mechanism_fmu/model/joints/gears.py", "mechanism_fmu/slides.py"

#: Pitch radius of a pinion [m].
_ORIGIN, _RADIUS = (0.0, 0.0), 0.5


def _theta(radii: Sequence[float], angles: Sequence[Any]) -> Any:
    """Eq (1), as it is printed; each angle is phi of the gear and that of its mark."""
    return (radii[0] * angles[0] + radii[1] * (angles[1] - math.pi)) / (radii[0] + radii[1])


def _eq1(_bench: Bench) -> Found:
    """Theta of eq (1) against the direction of the line of centres, along a whole fall of the carrier."""
    carrier, gear = carried_gear(-math.pi / 2)
    theta = _theta((RADIUS_1, RADIUS_2), (0.0 + MARK_1, gear + MARK_2))
    return within(
        float(np.abs(theta - carrier).max()),
        1e-9,
        "θ of (1) is the angle of P_iP_j at 61 places from 30° to −90° (example 3.4.1)",
        f"at the end θ = {math.degrees(theta[-1]):.6f}°",
    )


def _phi(q: FloatArray) -> float:
    """Eq (2), as it is printed, of the gears of `PARTS`: their radii, marks and points."""
    ri, mark_i, rj, mark_j = GEAR_PAIR
    across = complex(*q[3:5]) + B * cmath.rect(1.0, q[5]) - complex(*q[:2]) - A * cmath.rect(1.0, q[2])
    return (across * cmath.rect(1.0, -_theta((ri, rj), (q[2] + mark_i, q[5] + mark_j)))).imag


def _eq2(_bench: Bench) -> Found:
    """Against the row of this project, in states that do not close it."""
    equations = Equations(two_bodies(PARTS["gears"]), 0.0)
    states = [equations.start + 0.3 * np.sin(k + np.arange(6.0)) for k in range(5)]
    return within(
        max(abs(_phi(q) - equations.at(q, 0.0).residual[0]) for q in states),
        1e-12,
        "(r_j^P − r_i^P)ᵀ (−sin θ, cos θ) is the row of this project in five states, closed or not",
    )


def _perpendicular(_bench: Bench) -> Found:
    """The velocity of the material of both gears at D is one: the circles roll."""
    carrier, gear = carried_gear(-math.pi / 2, 240)
    rate = np.gradient(gear, carrier[1] - carrier[0], edge_order=2)[1:-1]
    # speed of D in gear 2 against the carrier's turn: centre moves R1 + R2, D is R2 nearer to gear 1, which stands
    return within(
        float(np.abs(CARRIER - RADIUS_2 * rate).max()),
        1e-6,
        "no slip at D on P_iP_j: the tangent of both pitch circles there is perpendicular to it",
        f"gear 2 turns {rate[0]:.6f} times as fast as the carrier, (R_1 + R_2)/R_2",
        verdict=Verdict.HOLDS,
    )


def _example(_bench: Bench) -> Found:
    carrier, gear = carried_gear(-math.pi / 2)
    above, by_hand = carried_gear(math.pi / 2)[1][-1], rolled_angle(-math.pi / 2)
    return within(
        max(abs(gear[-1] - by_hand), abs(gear[-1] + math.pi), abs(above - math.pi / 2), abs(gear[0])),
        1e-9,
        f"φ₂ = {math.degrees(gear[-1]):.6f}° = −π, gear 2 below gear 1 (+π/2 if it stood above)",
        f"carrier from {math.degrees(carrier[0]):.4f}° to {math.degrees(carrier[-1]):.4f}°; by hand φ₂ = (3θ − π/6)/2 "
        f"− 7π/6 + π = {by_hand:.9f} rad",
        verdict=Verdict.ANSWERED,
    )


def _falls(_bench: Bench) -> Found:
    fall = falling_gear()
    # a disc: its energy of rolling is 3/4 m v^2
    speed = math.sqrt(9.81 * CARRIER * (1 + math.sin(MARK_1)) * 4 / 3) / CARRIER
    return within(
        max(abs(fall.bottom_gear + math.pi), abs(abs(fall.bottom_speed) / speed - 1)),
        1e-6,
        f"φ₂ = {math.degrees(fall.bottom_gear):.4f}° when it first passes below, at {abs(fall.bottom_speed):.5f} rad/s",
        f"as a disc with 9.81 m/s²: {fall.bottom_time:.5f} s; speed from energy {speed:.5f} rad/s; mass and gravity "
        "are not on the slides, φ₂ does not depend on them",
        verdict=Verdict.ANSWERED,
    )


def _turned(bodies: tuple[Body, ...], *joints: Joint) -> float:
    """How far body j turns from t = 0 s to 1 s [rad], without its sign."""
    angle = analyse(Mechanism(bodies=bodies, joints=joints), [0.0, 1.0]).of("j.angle")[0]
    return abs(float(angle[-1] - angle[0]))


def _by_gear(radius: float) -> float:
    """How far the pinion turns with a gear i about (0, -radius) whose rim moves by the way [rad]."""
    return _turned(
        (Body("i", 1.0, 1.0, (0.0, -radius, 0.0)), Body("j", 1.0, 1.0, (0.0, _RADIUS, 0.0))),
        Revolute("axle_i", "i", _ORIGIN, GROUND, (0.0, -radius)),
        Revolute("axle_j", "j", _ORIGIN, GROUND, (0.0, _RADIUS)),
        Gears("mesh", "i", radius, math.pi / 2, "j", _RADIUS, 3 * math.pi / 2),
        AngleDriver("drive", "i", polynomial_motion(0.0, -0.3 / radius)),
    )


def _rack_limit(_bench: Bench) -> Found:
    """A gear of growing radius against a rack: how far the pinion turns for one way of the rack."""
    rolled = _turned(
        (Body("i", 1.0, 1.0), Body("j", 1.0, 1.0, (0.0, _RADIUS, 0.0))),
        Translational("guide", GROUND, _ORIGIN, (1.0, 0.0), "i", _ORIGIN, (1.0, 0.0)),
        XDriver("above", "j", _ORIGIN, polynomial_motion(0.0)),
        RackAndPinion("mesh", "i", _ORIGIN, _ORIGIN, 0.0, "j", _RADIUS, 3 * math.pi / 2),
        XDriver("drive", "i", _ORIGIN, polynomial_motion(0.0, 0.3)),
    )
    turned = [_by_gear(radius) for radius in (10.0, 100.0, 1000.0)]
    return judged(
        max(abs(value - rolled) for value in (*turned, 0.3 / _RADIUS)) < 1e-9,
        f"the pinion turns by {rolled:.6f} rad for 0.3 m of the rack; with gears of R_i = 10, 100, 1000 m for 0.3 m of "
        "the rim: " + ", ".join(f"{value:.6f}" for value in turned),
        "s/R_j, R_j = 0.5 m",
    )


def _composite(_bench: Bench) -> Found:
    """A four-bar with a coupler, and with a massless rod instead."""
    crank, rod, rocker, ground = 0.1, 0.25, 0.2, 0.25
    bodies = (
        Body("crank", 1.0, 1.0, (0.0, 0.0, 0.4)),
        Body("rocker", 1.0, 1.0, (ground, 0.0, 1.5)),
    )
    hinges = (
        Revolute("A0", "crank", _ORIGIN, GROUND, _ORIGIN),
        Revolute("B0", "rocker", _ORIGIN, GROUND, (ground, 0.0)),
        AngleDriver("motor", "crank", polynomial_motion(0.4, 2 * math.pi)),
    )
    coupled = Mechanism(
        bodies=(*bodies, Body("coupler", 1.0, 1.0, (0.09, 0.04, 0.6))),
        joints=(
            *hinges,
            Revolute("A", "coupler", _ORIGIN, "crank", (crank, 0.0)),
            Revolute("B", "coupler", (rod, 0.0), "rocker", (rocker, 0.0)),
        ),
    )
    rodded = Mechanism(
        bodies=bodies,
        joints=(*hinges, Distance("rod", "crank", (crank, 0.0), "rocker", (rocker, 0.0), rod)),
    )
    found = [analyse(mechanism, np.linspace(0.0, 1.0, 13)).of("rocker.angle") for mechanism in (coupled, rodded)]
    return within(
        max(off_by(b, a) for a, b in zip(*found, strict=True)),
        1e-9,
        "a four-bar's rocker moves alike with a coupler (9 coordinates) and with a massless rod (6), over a turn",
        f"rocker after a third of the turn: {math.degrees(found[0][0][4]):.6f}°; angle, rate, acceleration compared",
        verdict=Verdict.HOLDS,
    )


ROWS = (
    Row(
        "S-eq1",
        "eq (1)",
        "Angle θ of the line of centres.",
        "θ = (R_i(φ_i+θ_i) + R_j(φ_j+θ_j−π))/(R_i+R_j)",
        (GEARS,),
        _eq1,
    ),
    Row("S-eq2", "eq (2)", "The row of a gear pair.", "Φ = (r_j^P − r_i^P)ᵀ u⊥", (GEARS,), _eq2),
    Row("S-contact", "Gears", "P_iP_j is perpendicular to the contact plane.", "in words", (GEARS,), _perpendicular),
    Row(
        "S-3.4.1",
        "Example 3.4.1 (twice)",
        "φ₂ when gear 2 has fallen until the carrier is vertical.",
        "asked, not answered",
        (SLIDES, "docs/joints/gears.md"),
        _example,
    ),
    Row(
        "S-3.4.1-fall",
        "Example 3.4.1",
        "“As gear 2 falls”: the same in motion, under gravity.",
        "asked, not answered",
        (SLIDES,),
        _falls,
    ),
    Row(
        "S-fig3.4.2",
        "Fig. 3.4.2",
        "Geometry of a gear set.",
        "drawing lost",
        ("docs/joints/gears.svg",),
        lambda _bench: redrawn_joint("gears.svg"),
    ),
    Row(
        "S-fig3.4.4",
        "Fig. 3.4.4",
        "Concave–convex gears.",
        "drawing lost",
        ("docs/joints/internal_gears.svg",),
        lambda _bench: redrawn_joint("internal_gears.svg"),
    ),
    Row(
        "S-fig3.4.5",
        "Fig. 3.4.5",
        "Rack and pinion.",
        "drawing lost",
        ("docs/joints/rack_and_pinion.svg",),
        lambda _bench: redrawn_joint("rack_and_pinion.svg"),
    ),
    Row("S-rack-limit", "Rack and pinion", "It is a pair of gears with R_i → ∞.", "in words", (GEARS,), _rack_limit),
    Row(
        "S-composite",
        "Composite joints",
        "They eliminate an intermediate body.",
        "in words",
        ("mechanism_fmu/model/joints/pins_and_slides.py",),
        _composite,
    ),
    Row(
        "S-book",
        "Gears",
        "“A couple of mistakes in the book, see Errata slide.”",
        "slide missing",
        (GEARS,),
        Found(
            "neither the book nor the errata slide is at hand; (1) and (2) are as they must be: rows S-eq1, S-eq2",
            Verdict.NOT_DETERMINED,
        ),
    ),
)


# The two kinematic conditions of the rack and pinion that the ME451 slides state, along a motion.

_WAY, _TURN = 0.8, 0.6


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
    return within(
        float(np.abs(np.cos(rack) * y - np.sin(rack) * x - _RADIUS).max()),
        1e-9,
        f"P_jD = {_RADIUS} m at 61 places while the rack turns by {math.degrees(_TURN):.1f}° and the pinion goes "
        f"{_WAY} m aside",
        verdict=Verdict.HOLDS,
    )


def _no_slip(_bench: Bench) -> Found:
    """Segment from where D is on the rack, arc from how far the pinion has turned against it."""
    rack, pinion, x, y = _motion()
    segment = np.cos(rack) * x + np.sin(rack) * y
    turned = (pinion - pinion[0]) - (rack - rack[0])
    return within(
        float(np.abs(segment - segment[0] + _RADIUS * turned).max()),
        1e-9,
        f"Q_iD = arc Q_jD at 61 places of the same motion, {segment[-1] - segment[0]:.6f} m at its end",
        verdict=Verdict.HOLDS,
    )


RACKS = (
    Row("S-rack-distance", "Rack and pinion", "P_jD stays R_j.", "in words", (GEARS,), _distance),
    Row("S-rack-slip", "Rack and pinion", "Q_iD is as long as the arc.", "in words", (GEARS,), _no_slip),
)

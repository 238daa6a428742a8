"""Where the rod that slides on its lower end has one, no or two solutions (Painleve); drawn by `friction_drawing`.

The lines are A = 0 and b = 0, in closed form; the motions in the right plane are runs of the engine.
"""

from __future__ import annotations

import math

from docs.joints.sketch import ACCENT, BODY_I, LINE
from mechanism_fmu.model import GROUND, Mechanism, Output, PointLineContact, rigid_body
from mechanism_fmu.simulation import Simulation, SimulationError

from .pictures import DIMENSION, INK, Point, polar, sheet
from .plane import FIRST, FORMULA, SMALL, Plane, words

#: A uniform rod, 1 m and 1 kg [m, kg, m/s2].
HALF, MASS, GRAVITY = 0.5, 1.0, 9.81
#: Of the right plane; the slip speed of the lower end at the start of a motion [m/s].
MU, SLIP = 1.6, -6.0
#: Starts of motions: angle [rad] and rate [rad/s].
STARTS = ((0.6, 2.0), (0.45, 2.6), (0.75, 2.2), (0.5, 4.6), (0.62, 5.2))

NONE, TWO, LIFTS = ACCENT, "#e9c46a", "#c9d2dc"
_MOST_MU, _RATES = 3.0, (0.0, 7.0)
_ANGLES = (10.0, 90.0)


def rod(angle: float, rate: float, friction: float = MU, slip: float = SLIP) -> Mechanism:
    """The rod on the floor, with its angle above it [rad], its rate [rad/s] and the speed of its lower end [m/s]."""
    c, s = math.cos(angle), math.sin(angle)
    velocity = (slip - HALF * s * rate, HALF * c * rate)
    at, inertia = (HALF * c, HALF * s), MASS * HALF**2 / 3.0
    body = rigid_body("rod", at, mass=MASS, inertia=inertia, angle=angle, speed=rate, velocity=velocity)
    floor = GROUND.line((0, 0), (1, 0))
    contact = PointLineContact("floor", body.at(-HALF, 0.0), floor, closed=True, friction=friction)
    outputs = tuple(Output(name, f"rod.{name}", "") for name in ("angle", "speed"))
    outputs += (Output("closed", "floor.closed", ""), Output("slip", "floor.slip_speed", ""))
    return Mechanism((body,), contacts=(contact,), gravity=(0.0, -GRAVITY), outputs=outputs)


def critical_friction(angle: float) -> float:
    """The coefficient where A = 0: beyond it a normal force presses the sliding end into the floor."""
    c, s = math.cos(angle), math.sin(angle)
    return (1.0 + 3.0 * c * c) / (3.0 * s * c)


def critical_angles(friction: float) -> tuple[float, float]:
    """The two angles [rad] with A = 0: tan^2 - 3 mu tan + 4 = 0."""
    root = math.sqrt(9.0 * friction**2 - 16.0)
    return math.atan(0.5 * (3.0 * friction - root)), math.atan(0.5 * (3.0 * friction + root))


def critical_rate(angle: float) -> float:
    """The rate [rad/s] where b = 0: a rod that turns faster lifts its end off a floor that does not push."""
    return math.sqrt(GRAVITY / (HALF * math.sin(angle)))


def solutions(angle: float, rate: float, friction: float) -> str:
    """The solutions while it slides ahead: "one", "none", "two", or "lifts" for the one without a force."""
    pressed, lifted = friction > critical_friction(angle), rate > critical_rate(angle)
    return ("two" if lifted else "none") if pressed else ("lifts" if lifted else "one")


def motion(angle: float, rate: float) -> list[Point]:
    """Angle [degrees] and rate [rad/s] of the engine's motion, until the end jams, sticks or lifts off."""
    simulation = Simulation(rod(angle, rate))
    points: list[Point] = []
    try:
        while True:
            now = simulation.read()
            if not now["closed"] or now["slip"] >= 0.0:
                return points
            points.append((math.degrees(now["angle"]), now["speed"]))
            simulation.advance(simulation.time + 0.002)
    except SimulationError:
        now = simulation.read()
        return [*points, (math.degrees(now["angle"]), now["speed"])]


def _span(first: float, last: float, count: int = 60) -> list[float]:
    return [first + (last - first) * k / count for k in range(count + 1)]


def _by_friction() -> list[str]:
    """The plane of angle and coefficient, at low rates."""
    s = Plane((60, 330), 4.4, up=95.0)
    low = math.degrees(min(critical_angles(_MOST_MU)))
    high = math.degrees(max(critical_angles(_MOST_MU)))
    edge = [(angle, critical_friction(math.radians(angle))) for angle in _span(low, high)]
    least = (math.degrees(math.atan(2.0)), 4.0 / 3.0)
    shown = [math.degrees(angle) for angle in critical_angles(MU)]
    return [
        s.region(edge, NONE, 0.3),
        s.curve(edge, INK, 1.8),
        s.curve([(0.0, MU), (90.0, MU)], DIMENSION, 1, "5 4"),
        *(s.mark((angle, MU), DIMENSION) for angle in shown),
        *s.across(0.0, 93.0, (0, 30, 60, 90), "θ [°]"),
        *s.upwards(0.0, 3.1, (1, 2, 3), "μ"),
        s.mark(least, ACCENT),
        words(s, least, "μ = 4/3, tan θ = 2", SMALL, dy=22),
        words(s, (63.0, 2.45), "A < 0", FORMULA),
        words(s, (63.0, 2.15), "none, or two", SMALL),
        words(s, (22.0, 1.05), "A > 0", FORMULA),
        words(s, (22.0, 0.75), "one", SMALL),
        words(s, (2.0, MU), "to the right: μ = 1.6", SMALL, dy=-7, anchor="start", colour=DIMENSION),
        *_rod(Plane((66, 128), 74.0, up=74.0)),
    ]


def _rod(s: Plane) -> list[str]:
    """The rod, sliding ahead on its lower end."""
    foot: Point = (0.62, 0.28)
    angle = math.radians(48)
    return [
        s.path([(0.1, foot[1]), (1.35, foot[1])], LINE),
        s.box(polar(foot, 0.5, angle), 1.0, 0.07, angle, BODY_I),
        s.angle(foot, 0.42, 0.0, angle, "θ", 10),
        s.vector(foot, (0.18, foot[1]), ""),
        words(s, (0.2, foot[1]), "v_T", dy=-9),
        s.dot(foot),
    ]


def _by_rate() -> list[str]:
    """The plane of angle and rate, at one coefficient, with motions."""
    s = Plane((480, 330), 5.0, up=41.0)
    low, high = (math.degrees(angle) for angle in critical_angles(MU))
    first, last = _ANGLES
    most = _RATES[1]
    least = math.degrees(math.asin(GRAVITY / (HALF * most**2)))

    def border(start: float, end: float) -> list[Point]:
        return [(angle, critical_rate(math.radians(angle))) for angle in _span(start, end)]

    before, within, behind = border(least, low), border(low, high), border(high, last)
    jam = (low, critical_rate(math.radians(low)))
    parts = [
        s.region([*before, (low, most)], LIFTS, 0.7),
        s.region([*behind, (last, most), (high, most)], LIFTS, 0.7),
        s.region([*within, (high, most), (low, most)], TWO, 0.6),
        s.region([(low, 0.0), *within, (high, 0.0)], NONE, 0.3),
        s.curve(border(least, last), INK, 1.8),
        *(s.curve([(angle, 0.0), (angle, most)], INK, 1.8) for angle in (low, high)),
    ]
    for start in STARTS:
        points = motion(*start)
        parts.append(s.curve(points, FIRST, 1.8))
        half = len(points) // 2
        (a, b), (c, d) = map(s.place, points[half : half + 2])
        turn = math.degrees(math.atan2(d - b, c - a))
        place = f'transform="translate({a:.2f} {b:.2f}) rotate({turn:.2f})"'
        parts.append(f'<path d="M-5 -4 L5 0 L-5 4 Z" fill="{FIRST}" {place}/>')
        parts.append(s.circle(points[0], 3, f'fill="{FIRST}"'))
    middle = 0.5 * (low + high)
    return [
        *parts,
        s.mark(jam, ACCENT),
        *s.across(first, last + 3.0, (10, 30, 50, 70, 90), "θ [°]"),
        *s.upwards(0.0, most + 0.3, (2, 4, 6), "θ' [rad/s]", at=first),
        words(s, (middle, 1.9), "none", SMALL),
        words(s, (middle, 6.2), "two:", SMALL),
        words(s, (middle, 6.2), "slides, lifts off", SMALL, dy=17),
        words(s, (low, 6.2), "one: lifts off", SMALL, dx=-10, anchor="end"),
        words(s, (low, 0.8), "one: slides on", SMALL, dx=-40, anchor="end"),
        *(words(s, (high, rate), "one", SMALL, dx=32) for rate in (0.8, 6.2)),
        words(s, (high, critical_rate(math.radians(high))), "b = 0", dx=36, dy=-8),
        words(s, (high, 3.0), "A = 0", dx=34),
    ]


def painleve_drawing() -> str:
    """The picture as SVG text."""
    title = "The rod that slides on its end: where there are one, no or two solutions"
    return sheet(950, 365, title, [*_by_friction(), *_by_rate()])

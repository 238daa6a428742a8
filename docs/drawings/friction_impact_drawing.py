"""One blow of a rod by the three impact laws, in the plane of its impulse; drawn by `friction_drawing`.

Where the laws end is computed by the engine; lines and Routh's path are the closed forms beside them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from docs.joints.sketch import BODY_I, LINE, add, scale
from mechanism_fmu.model import GROUND, Mechanism, Output, PointLineContact, rigid_body
from mechanism_fmu.simulation import Simulation

from .pictures import INK, Point, polar, sheet
from .plane import FIRST, FORMULA, SECOND, SMALL, THIRD, Plane, words

#: The rod: length 1 m, 1 kg, its lower end below and to the left of its centre of mass, with cos = 3/5, sin = 4/5.
MASS, HALF, COS, SIN = 1.0, 0.5, 0.6, 0.8
INERTIA = MASS * HALF**2 / 3.0
#: Of all its points before the blow [m/s], as it does not turn; friction and restitution.
SPEED: Point = (1.0, -2.0)
MU, E = 0.4, 0.5

Law = Literal["newton", "poisson", "stronge"]
COLOURS: dict[Law, str] = {"newton": FIRST, "poisson": SECOND, "stronge": THIRD}


@dataclass(frozen=True)
class Blow:
    """What an impact has done.

    Attributes:
        impulse: on the lower end, normal and along the floor [N s].
        speed: of the lower end behind it, normal and along the floor [m/s].
        energy: kinetic, behind it [J].
    """

    impulse: Point
    speed: Point
    energy: float


def blow(law: Law, restitution: float = E) -> Blow:
    """The blow by one of the laws, by the engine."""
    angle = math.atan2(SIN, COS)
    rod = rigid_body("rod", (HALF * COS, HALF * SIN), mass=MASS, inertia=INERTIA, angle=angle, velocity=SPEED)
    floor = GROUND.line((0, 0), (1, 0))
    contact = PointLineContact("floor", rod.at(-HALF, 0.0), floor, friction=MU, restitution=restitution)
    read = ("rod.x_rate", "rod.y_rate", "rod.speed", "impact.impulse:floor", "energy.kinetic")
    outputs = tuple(Output(source, source, "") for source in read)
    simulation = Simulation(Mechanism((rod,), contacts=(contact,), outputs=outputs, impact_law=law))
    simulation.advance(1e-9)
    x, y, turn, normal, energy = (simulation.read()[source] for source in read)
    ends = (y - HALF * COS * turn, x + HALF * SIN * turn)
    return Blow((normal, MASS * (x - SPEED[0])), ends, energy)


#: Of the lower end, what impulses do to its speeds: G of `docs/explanation/friction.md` [1/kg].
G_NN = 1.0 / MASS + (HALF * COS) ** 2 / INERTIA
G_NT = -(HALF**2) * COS * SIN / INERTIA
G_TT = 1.0 / MASS + (HALF * SIN) ** 2 / INERTIA


def sticking(normal: float, speed: float = 0.0) -> Point:
    """On the line of no slip, v_T = 0, or of another slip speed: the impulse with this normal part [N s]."""
    return normal, (speed - SPEED[0] - G_NT * normal) / G_TT


def compressed(along: float, speed: float = 0.0) -> Point:
    """On the line of most compression, v_N = 0, or of another v_N: the impulse with this part along the floor [N s]."""
    return (speed - SPEED[1] - G_NT * along) / G_NN, along


def turning_point() -> Point:
    """Where Routh's path comes to the line of no slip [N s]."""
    normal = SPEED[0] / (MU * G_TT - G_NT)
    return normal, -MU * normal


def _rod(s: Plane) -> list[str]:
    """The rod before its blow."""
    foot: Point = (0.75, 0.6)
    angle = math.atan2(SIN, COS)
    middle = polar(foot, 0.8, angle)
    step = scale(SPEED, 0.3)
    return [
        s.path([(0.15, foot[1]), (1.95, foot[1])], LINE),
        *(s.path([(x, foot[1]), (x - 0.06, foot[1] - 0.08)], LINE) for x in (0.3 + 0.15 * k for k in range(11))),
        s.box(middle, 1.6, 0.09, angle, BODY_I),
        s.vector(add(middle, (0.14, 0.0)), add(middle, (0.14, 0.0), step), "", 0, 0),
        words(s, add(middle, (0.14, 0.0), step), "v⁻", dx=16),
        s.vector(foot, add(foot, (0.5, 0.0)), "", 0, 0),
        words(s, add(foot, (0.5, 0.0)), "P_T", dx=6, dy=-8),
        s.vector(foot, add(foot, (0.0, 0.75)), "", 0, 0),
        words(s, add(foot, (0.0, 0.75)), "P_N", dx=-16, dy=4),
        s.dot(foot),
        words(s, (1.05, 0.2), f"μ = {MU:g},  e = {E:g}", FORMULA),
    ]


def _arrow_on(s: Plane, start: Point, end: Point, colour: str, dash: str = "") -> list[str]:
    """A straight part of a path, with a head on it."""
    (x, y), (right, low) = s.place(start), s.place(end)
    angle = math.degrees(math.atan2(low - y, right - x))
    head = f'<path d="M-5 -4.5 L6 0 L-5 4.5 Z" fill="{colour}" '
    head += f'transform="translate({0.65 * x + 0.35 * right:.2f} {0.65 * y + 0.35 * low:.2f}) rotate({angle:.2f})"/>'
    return [s.curve([start, end], colour, 2.4, dash), head]


def impact_drawing() -> str:
    """The picture as SVG text."""
    s = Plane((270, 300), 270.0, up=330.0)
    last, most = 2.05, 0.72
    ends = {law: blow(law).impulse for law in COLOURS}
    half = {law: blow(law, restitution=0.0).impulse for law in COLOURS if law != "newton"}
    low = -0.3
    turn = turning_point()
    cone = [(0.0, 0.0), (most / MU, most), (last, most), (last, low), (-low / MU, low)]
    slip, most_pressed = [sticking(0.28), sticking(last)], [compressed(low), compressed(most)]
    thin = "#7b8794"
    parts = [
        s.region(cone, "#e9c46a", 0.22),
        s.curve([(0.0, 0.0), (most / MU, most)], thin, 1),
        s.curve([(0.0, 0.0), (-low / MU, low)], thin, 1),
        *s.across(0.0, 2.12, (0.5, 1.0, 1.5, 2.0), "P_N [N s]"),
        *s.upwards(low, most + 0.06, (-0.2, 0.2, 0.4, 0.6), "P_T [N s]"),
        s.curve(slip, INK, 1.4, "7 4"),
        s.curve(most_pressed, INK, 1.4, "7 4"),
        s.curve([compressed(low, -E * SPEED[1]), compressed(most, -E * SPEED[1])], INK, 1, "2 4"),
        *_arrow_on(s, (0.0, 0.0), half["poisson"], SECOND, "1 0"),
        *_arrow_on(s, half["poisson"], ends["poisson"], SECOND),
        *_arrow_on(s, (0.0, 0.0), turn, THIRD),
        *_arrow_on(s, turn, ends["stronge"], THIRD),
        *_arrow_on(s, (0.0, 0.0), ends["newton"], FIRST, "1 5"),
        *(s.mark(point, COLOURS[law]) for law, point in half.items()),
        *(s.mark(point, COLOURS[law]) for law, point in ends.items()),
        words(s, ends["newton"], "Newton", dx=12, dy=5, anchor="start", colour=FIRST),
        words(s, ends["poisson"], "Poisson", dx=12, dy=8, anchor="start", colour=SECOND),
        words(s, ends["stronge"], "Stronge", dx=12, dy=10, anchor="start", colour=THIRD),
        words(s, turn, "the slip comes to its end", SMALL, dx=36, dy=6, anchor="start", colour=THIRD),
        words(s, compressed(most), "v_N = 0", dy=-8),
        words(s, compressed(most, -E * SPEED[1]), "v_N⁺ = −e v_N⁻", dx=24, dy=-8),
        words(s, sticking(last), "v_T = 0", dx=4, dy=5, anchor="start"),
        words(s, (0.78 * most / MU, 0.78 * most), "P_T = μ P_N", dx=-12, dy=-6, anchor="end"),
        words(s, (-low / MU, low), "P_T = −μ P_N", dx=-8, dy=-2, anchor="end"),
    ]
    rod = Plane((10, 260), 110.0, up=110.0)
    title = "A blow of a rod by three impact laws, in the plane of its impulse"
    return sheet(900, 415, title, [*_rod(rod), *parts])

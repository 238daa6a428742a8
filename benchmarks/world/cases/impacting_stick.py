"""Impacting stick: a slender rod falls tilted on a rough floor, and rebounds from end to end by three laws of impact.

An end at (X, Y) from the centre of mass, with the velocities v_N = y' + X theta' and v_T = x' - Y theta', is struck by
P_N and P_T, per unit of mass. With the half length l these change v_N and v_T by G P,

    G_NN = 1 + 3 X^2 / l^2        G_TT = 1 + 3 Y^2 / l^2        G_NT = -3 X Y / l^2

and with Coulomb's friction a law of restitution says what P is: Newton's (v_N+ = -e v_N-, in one problem with
friction), Poisson's (e times the impulse of compression), or Stronge's (e^2 times its work), in closed form in
`harness.analysis.impact_laws`, which does not know the engine. Between impacts the centre is on a parabola and the rod
turns steadily.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import cache
from itertools import islice
from typing import Any, Literal, NamedTuple

import numpy as np
from scipy.optimize import brentq

from harness.analysis.impact_laws import Contact, Impulse, newton, poisson, stronge
from harness.report.plot import Curve, Plot
from harness.report.style import COLOURS
from mechanism_fmu import codes
from mechanism_fmu.model import GROUND, Body, Mechanism, Output, PointLineContact, Settings
from mechanism_fmu.simulation import Simulation

from ..case import Case, Known, Run, steps_of

MASS, HALF, GRAVITY = 1.0, 0.5, 9.81
Law = Literal["newton", "poisson", "stronge"]
LAWS: dict[Law, Callable[[Contact, Any, Any], Impulse]] = {"newton": newton, "poisson": poisson, "stronge": stronge}
#: Impacts of a motion.
COUNT = 6
_NAMES = ("Newton", "Poisson", "Stronge")


class Motion(NamedTuple):
    """Where the rod is and how it moves: centre of mass [m], angle [rad], and their rates."""

    x: float
    y: float
    angle: float
    x_rate: float
    y_rate: float
    speed: float


class Coefficients(NamedTuple):
    """Of both ends: of friction, and of restitution."""

    friction: float
    restitution: float


ROUGH = Coefficients(0.3, 0.6)
#: Thrown half a metre above the floor, without turning.
START = Motion(0.0, 0.5 + HALF * math.sin(0.9), 0.9, 2.5, 0.0, 0.0)
#: An impact by which Newton's law creates energy, of the lower end.
_CREATES = Motion(0.0, HALF * 0.8, math.atan2(0.8, 0.6), 1.0, -2.0, 0.0)
_ELASTIC = Coefficients(0.4, 0.95)


def stick(
    law: Law, tolerance: float, start: Motion = START, ends: Coefficients = ROUGH, guard: bool = True
) -> Mechanism:
    """The rod and the floor, which its ends can strike."""
    body = Body("stick", MASS, MASS * HALF**2 / 3, start[:3], start[3:])
    floor = GROUND.line((0, 0), (1, 0))
    contacts = [
        PointLineContact(name, body.at(side * HALF, 0), floor, **ends._asdict())
        for name, side in (("left", -1), ("right", 1))
    ]
    return Mechanism(
        (body,),
        contacts=tuple(contacts),
        outputs=(
            *(Output(name, getattr(body, name), "") for name in Motion._fields),
            Output("kinetic", "energy.kinetic", "J"),
            Output("lost", "energy.lost", "J"),
        ),
        gravity=(0.0, -GRAVITY),
        settings=Settings(tolerance),
        impact_law=law,
        energy_guard=guard,
    )


def _behind(simulation: Simulation, count: int) -> tuple[float, dict[str, float]]:
    """Time [s] of the impact of this number, and what is read right behind it."""
    simulation.begin_step()
    while simulation.counters[codes.COUNT_IMPACTS] < count:
        simulation.go_on(2.0, codes.STOP_AT_IMPACT)
    return simulation.time, simulation.read()


def run(tolerance: float) -> Run:
    """Of each law: what the first impact leaves, times of the others, and what the last one leaves."""
    values: list[float] = []
    steps = 0
    for law in LAWS:
        simulation = Simulation(stick(law, tolerance))
        first, read = _behind(simulation, 1)
        values += [first, *(read[name] for name in Motion._fields[3:])]
        for count in range(2, COUNT + 1):
            time, read = _behind(simulation, count)
            values.append(time)
        values += [*(read[name] for name in ("angle", "speed", "lost"))]
        steps += steps_of(simulation)
    for guard in (False, True):
        simulation = Simulation(stick("newton", tolerance, _CREATES, _ELASTIC, guard=guard))
        before = simulation.read()["kinetic"]
        values.append(_behind(simulation, 1)[1]["kinetic"] / before)
    return Run(tuple(values), steps)


def _flown(at: Motion, time: float) -> Motion:
    """After a time [s] of flight."""
    x, y, angle, x_rate, y_rate, speed = at
    fallen = y + y_rate * time - GRAVITY * time**2 / 2
    return Motion(x + x_rate * time, fallen, angle + speed * time, x_rate, y_rate - GRAVITY * time, speed)


def _struck(at: Motion, side: float, law: Law, ends: Coefficients = ROUGH) -> Motion:
    """After an impact of the left end (-1) or the right one (1)."""
    x, y = side * HALF * math.cos(at.angle), side * HALF * math.sin(at.angle)
    normal, along = at.y_rate + x * at.speed, at.x_rate - y * at.speed
    g = (1 + 3 * (x / HALF) ** 2, -3 * x * y / HALF**2, 1 + 3 * (y / HALF) ** 2)
    contact = Contact(*(np.array([value]) for value in (*g, normal, along)))
    p_n, p_t = (float(p[0]) for p in LAWS[law](contact, np.array([ends.friction]), np.array([ends.restitution])))
    turned = at.speed + 3 * (x * p_n - y * p_t) / HALF**2
    return at._replace(x_rate=at.x_rate + p_t, y_rate=at.y_rate + p_n, speed=turned)


def _gap(time: float, at: Motion, side: float) -> float:
    flown = _flown(at, time)
    return flown.y + side * HALF * math.sin(flown.angle)


def rebounds(law: Law) -> Iterator[tuple[float, Motion]]:
    """Times [s] of the impacts, and the motion right behind each."""
    now, at = 0.0, START
    grid = np.linspace(0.0, 0.5, 251)
    while True:
        hits = []
        for side in (-1.0, 1.0):
            gaps = at.y + at.y_rate * grid - GRAVITY * grid**2 / 2 + side * HALF * np.sin(at.angle + at.speed * grid)
            # an end that has just been struck parts from the floor, whatever rounding says of its gap
            below = np.flatnonzero(gaps[1:] < 0.0)
            if below.size:
                begin, end = grid[below[0]] or 1e-9, grid[below[0] + 1]
                hits.append((brentq(_gap, begin, end, (at, side), xtol=1e-15, rtol=1e-14), side))
        flight, side = min(hits)
        now, at = now + flight, _struck(_flown(at, flight), side, law)
        yield now, at


def _energy(at: Motion) -> float:
    """Kinetic [J]."""
    return MASS * (at.x_rate**2 + at.y_rate**2 + HALF**2 * at.speed**2 / 3) / 2


def _known() -> Iterator[Known]:
    fall = math.sqrt(2 * 0.5 / GRAVITY)
    for name, law in zip(_NAMES, LAWS, strict=True):
        after = _struck(_flown(START, fall), -1.0, law)
        for what, unit, value in (
            ("time of impact 1", "s", fall),
            ("speed along the floor behind it", "m/s", after.x_rate),
            ("speed upwards", "m/s", after.y_rate),
            ("rate of the angle", "rad/s", after.speed),
        ):
            yield Known(f"{name}: {what}", unit, value, "closed form")
        found = list(islice(rebounds(law), COUNT))
        for number, (time, _) in enumerate(found[1:], 2):
            yield Known(f"{name}: time of impact {number}", "s", time, "second formulation")
        last = found[-1][1]
        lost = _energy(START) + MASS * GRAVITY * (START.y - last.y) - _energy(last)
        for what, unit, value in (
            ("angle then", "rad", last.angle),
            ("rate of the angle behind it", "rad/s", last.speed),
            ("energy lost by all of them", "J", lost),
        ):
            yield Known(f"{name}: {what}", unit, value, "second formulation")
    guarded: tuple[tuple[str, Law], ...] = (("Newton's law", "newton"), ("Poisson's, by the guard", "poisson"))
    for name, law in guarded:
        ratio = _energy(_struck(_CREATES, -1.0, law, _ELASTIC)) / _energy(_CREATES)
        yield Known(f"kinetic energy behind another impact over that before: {name}", "1", ratio, "closed form")


@cache
def drawings() -> tuple[Plot, ...]:
    """Height of the centre over its way, and the angle over time, by the three laws."""
    ways, angles = [], []
    for name, law, colour in zip(_NAMES, LAWS, COLOURS, strict=False):
        simulation = Simulation(stick(law, 1e-9))
        times = np.linspace(0.0, 1.2, 601)
        course = []
        for time in times:
            simulation.advance(time)
            read = simulation.read()
            course.append((read["x"], read["y"], read["angle"]))
        x, y, angle = np.transpose(course)
        ways.append(Curve(name, x, y, colour))
        angles.append(Curve(name, times, angle, colour))
    return (
        Plot("Way of the centre of mass", "x [m]", "y [m]", ways),
        Plot("Angle", "time [s]", "angle [rad]", angles),
    )


CASE = Case(
    name="impacting_stick",
    title="Impacting stick",
    statement=(
        "A uniform slender rod of 1 m, tilted by 0.9 rad, is thrown at 2.5 m/s along a floor, its lower end 0.5 m "
        "above it; friction 0.3, restitution 0.6, weight 9.81 m/s\u00b2. The slip of the end ends within the first "
        "impact, so that Newton's, Poisson's and Stronge's laws differ; six impacts, on both ends in turn."
    ),
    source=(
        "W. J. Stronge, Unraveling paradoxical theories for rigid body collisions, Journal of Applied Mechanics 58 "
        "(1991) 1049; D. Stoianovici, Y. Hurmuzlu, A critical study of the applicability of rigid-body collision "
        "theory, Journal of Applied Mechanics 63 (1996) 307, who dropped steel bars; data of this project"
    ),
    known=tuple(_known()),
    run=run,
    model=stick,
    within=1e-11,
    remark=(
        "In flight nothing depends on the size of a step, so that deviations are rounding at any tolerance. By "
        "Newton's law the end sticks after the first impact; by Poisson's and Stronge's it slips back. Newton's law "
        "may create energy where slip ends, as another impact shows (friction 0.4, restitution 0.95, sin(angle) = 0.8, "
        "1 m/s along and 2 m/s down): with `energy_guard`, the default, the engine repeats it by Poisson's. Of the "
        "papers only summaries could be read: none of their numbers is compared."
    ),
    drawings=drawings,
)

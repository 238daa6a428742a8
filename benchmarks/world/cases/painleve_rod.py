"""Painlevé's rod: where no force, or more than one, agrees with friction, and the point at which a motion gets there.

A uniform rod of length 2 l slides on its lower end, backwards (v < 0), leaning by theta over the floor (Génot and
Brogliato 1999). With c = cos(theta), s = sin(theta), a normal force N and friction mu N forwards, its end accelerates

    g_N'' = a N / m + b        a = 1 + 3 c (c - mu s)        b = l theta'^2 s - g
    theta'' = 3 N (mu s - c) / (m l)                         v' = N (mu + 3 s (mu s - c)) / m + l c theta'^2

so that a > 0 > b leaves N = -m b / a; where a < 0 no force does with b < 0, and both 0 and -m b / a do with b > 0. That
takes mu >= 4/3 and tan(theta) between (3 mu -+ sqrt(9 mu^2 - 16)) / 2. Motions come to a = 0 where b = 0, too: with
dt = a d(tau), that is an equilibrium, where they end at a finite time. From a < 0, b < 0 an impact without approach
leads on: it ends the slip, by the impulses P_N = -3 s c m v / 4 and P_T = -(1 + 3 c^2) m v / 4.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import cache
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from harness.report.plot import Curve, Plot
from harness.report.style import COLOURS
from mechanism_fmu.model import GROUND, Mechanism, Output, PointLineContact, Settings, rigid_body
from mechanism_fmu.simulation import Simulation, SimulationError, friction_solutions

from ..case import Case, Known, Run, steps_of

MASS, HALF, GRAVITY = 1.0, 0.5, 9.81
FRICTION = 1.6
#: Angle [rad], its rate [rad/s] and slip speed [m/s] of the motion that comes to the end of all forces.
START = (0.5, 2.5, -7.0)
#: Angle and rate with one force, none, and two; slip speed -1 m/s.
_PLACES = {"one": (0.6, 2.0), "none": (1.1, 0.0), "two": (1.1, 5.0)}


def rod(
    angle: float, rate: float, slip: float, friction: float, tolerance: float = 1e-9, *, method: int = 0, **law: Any
) -> Mechanism:
    """The rod that slides on its lower end, which is at the origin."""
    c, s = math.cos(angle), math.sin(angle)
    body = rigid_body(
        "rod",
        (HALF * c, HALF * s),
        mass=MASS,
        inertia=MASS * HALF**2 / 3.0,
        angle=angle,
        velocity=(slip - HALF * s * rate, HALF * c * rate),
        speed=rate,
    )
    floor = GROUND.line((0, 0), (1, 0))
    return Mechanism(
        (body,),
        contacts=(PointLineContact("floor", body.at(-HALF, 0.0), floor, closed=True, friction=friction),),
        gravity=(0.0, -GRAVITY),
        outputs=(
            Output("slip", "floor.slip_speed", "", "m/s"),
            Output("sticks", "floor.sticks", "", "1"),
            Output("angle", body.angle, "rad"),
            Output("speed", body.speed, "rad/s"),
            Output("x_rate", body.x_rate, "m/s"),
            Output("y_rate", body.y_rate, "m/s"),
            *(Output(name, f"energy.{name}", "", "J") for name in ("kinetic", "work", "lost")),
        ),
        settings=Settings(tolerance, integration_method=method),
        **law,
    )


def _forces(angle: float, rate: float, friction: float = FRICTION) -> list[float]:
    """All normal forces that agree with friction, in order."""
    found = friction_solutions(rod(angle, rate, -1.0, friction))
    return sorted(one.normal_forces["floor"] for one in found)


def _limit(inside: float, outside: float, has: Callable[[float], bool]) -> float:
    """Where, between two numbers, `has` ceases to hold, by bisection to the last bit."""
    while abs(outside - inside) > 1e-15:
        middle = 0.5 * (inside + outside)
        if middle in (inside, outside):
            break
        inside, outside = (middle, outside) if has(middle) else (inside, middle)
    return outside


@cache
def _limits() -> tuple[float, ...]:
    """Of the paradox: the least friction, and the angles with `FRICTION`; they depend on no tolerance."""
    steepness = math.atan(2.0)
    return (
        _limit(1.3, 1.4, lambda friction: len(_forces(steepness, 0.0, friction)) == 1),
        _limit(0.8, 0.9, lambda angle: len(_forces(angle, 0.0)) == 1),
        _limit(1.4, 1.3, lambda angle: len(_forces(angle, 0.0)) == 1),
    )


def run(tolerance: float) -> Run:
    """Limits, forces, the end of the motion, and what an impact without approach leaves."""
    values = list(_limits())
    for place in _PLACES.values():
        forces = _forces(*place)
        values += [float(len(forces)), *(force for force in forces if force > 0.0)]
    simulation = Simulation(rod(*START, FRICTION, tolerance))
    try:
        simulation.advance(1.0)
    except SimulationError as error:
        if "Painleve" not in str(error):
            raise
    read = simulation.read()
    values += [simulation.time, read["angle"], read["speed"], read["slip"], read["lost"]]
    shocked = Simulation(rod(*_PLACES["none"], -1.0, FRICTION, tolerance, tangential_shock=True)).read()
    values += [shocked[name] for name in ("slip", "speed", "x_rate", "y_rate")]
    return Run(tuple(values), steps_of(simulation))


def _coefficients(angle: float, rate: float, friction: float = FRICTION) -> tuple[float, float]:
    """The acceleration of the lower end: a and b."""
    c, s = math.cos(angle), math.sin(angle)
    return 1.0 + 3.0 * c * (c - friction * s), HALF * rate * rate * s - GRAVITY


def end_of_forces(angle: float, rate: float, slip: float) -> tuple[float, float, float, float]:
    """Time [s], angle, rate and slip speed where the motion ends, by the equations in tau."""

    def slopes(_tau: float, y: Any) -> tuple[float, float, float, float]:
        c, s = math.cos(y[1]), math.sin(y[1])
        a, b = _coefficients(y[1], y[2])
        lever = FRICTION * s - c
        return a, a * y[2], -3.0 * b * lever / HALF, -b * (FRICTION + 3.0 * s * lever) + a * HALF * c * y[2] ** 2

    # what is left to go falls as exp(-11 tau)
    found = solve_ivp(slopes, (0.0, 4.0), (0.0, angle, rate, slip), "DOP853", rtol=1e-12, atol=1e-14)
    time, angle, rate, slip = (float(value) for value in found.y[:, -1])
    return time, angle, rate, slip


def _energy(angle: float, rate: float, slip: float) -> float:
    """Kinetic energy and that of the weight, while the end slides [J]."""
    c, s = math.cos(angle), math.sin(angle)
    along, up = slip - HALF * s * rate, HALF * c * rate
    return MASS * ((along**2 + up**2) / 2 + (HALF * rate) ** 2 / 6 + GRAVITY * HALF * s)


def _shock(angle: float, rate: float, slip: float) -> tuple[float, float, float]:
    """Rate of the angle and of the centre of mass, x and y, after an impact that only ends the slip."""
    c, s = math.cos(angle), math.sin(angle)
    normal, along = -0.75 * s * c * slip, -0.25 * (1.0 + 3.0 * c * c) * slip  # over the mass
    return rate + 3.0 * (s * along - c * normal) / HALF, slip - HALF * s * rate + along, HALF * c * rate + normal


def _known() -> Iterator[Known]:
    root = math.sqrt(9.0 * FRICTION**2 - 16.0)
    low, high = (math.atan((3.0 * FRICTION + sign * root) / 2.0) for sign in (-1.0, 1.0))
    yield Known("least friction of the paradox, at tan(theta) = 2", "1", 4.0 / 3.0, "closed form")
    yield Known("least angle of it, with friction 1.6", "rad", low, "closed form")
    yield Known("largest angle of it", "rad", high, "closed form")
    for count, (name, place) in enumerate(
        zip(("a > 0 > b", "a < 0, b < 0", "a < 0 < b"), _PLACES.values(), strict=True)
    ):
        a, b = _coefficients(*place)
        yield Known(f"{name}: number of solutions", "1", (1.0, 0.0, 2.0)[count], "closed form")
        if b / a < 0.0:
            yield Known(f"{name}: normal force that is not 0", "N", -MASS * b / a, "closed form")
    time, _, _, slip = end_of_forces(*START)
    rate = math.sqrt(GRAVITY / (HALF * math.sin(low)))
    yield Known("end of all forces: time", "s", time, "second formulation")
    yield Known("its angle", "rad", low, "closed form")
    yield Known("rate of the angle there", "rad/s", rate, "closed form")
    yield Known("slip speed there", "m/s", slip, "second formulation")
    lost = _energy(*START) - _energy(low, rate, slip)
    yield Known("energy lost until there", "J", lost, "second formulation")
    after = (0.0, *_shock(*_PLACES["none"], -1.0))
    names = ("slip speed", "rate of the angle", "speed along the floor", "speed upwards")
    for name, unit, value in zip(names, ("m/s", "rad/s", "m/s", "m/s"), after, strict=True):
        yield Known(f"impact from a < 0, b < 0: {name} after it", unit, value, "closed form")


@cache
def drawings() -> tuple[Plot, ...]:
    """Motions over angle and rate, with the lines on which a and b are 0."""
    low, high = (one.number for one in CASE.known[1:3])
    angles = np.linspace(0.3, 1.5, 121)
    curves = [
        *(Curve("a = 0", [angle, angle], [-2.0, 7.5], COLOURS[1]) for angle in (low, high)),
        Curve("b = 0", angles, np.sqrt(GRAVITY / (HALF * np.sin(angles))), COLOURS[2]),
    ]
    for rate in np.linspace(-1.0, 5.0, 9):
        simulation = Simulation(rod(0.5, rate, START[2], FRICTION))
        course = []
        try:
            for time in np.arange(0.0, 0.3, 5e-4):
                simulation.advance(time)
                read = simulation.read()
                if read["slip"] >= 0.0 or read["angle"] < 0.3 or not simulation.mode():
                    break
                course.append((read["angle"], read["speed"]))
        except SimulationError:
            read = simulation.read()
            course.append((read["angle"], read["speed"]))
        along, turns = np.transpose(course)
        curves.append(Curve("motions", along, turns, COLOURS[0]))
    return (Plot("Motions that slide backwards at first", "angle [rad]", "rate of the angle [rad/s]", curves),)


CASE = Case(
    name="painleve_rod",
    title="Painlev\u00e9's rod",
    statement=(
        "A uniform rod of 1 m and 1 kg slides on its lower end over a floor with friction 1.6; weight 9.81 m/s\u00b2. "
        "Its end has the acceleration a N / m + b by the normal force N: where it leans so that a < 0, none agrees "
        "with friction or two do. A motion that begins at 0.5 rad, 2.5 rad/s and 7 m/s ends where a = b = 0; from "
        "a, b < 0 an impact without approach leads on."
    ),
    source=(
        "P. Painlev\u00e9, 1895; F. G\u00e9not, B. Brogliato, New results on Painlev\u00e9 paradoxes, European Journal "
        "of Mechanics A 18 (1999) 653"
    ),
    known=tuple(_known()),
    run=run,
    model=rod,
    within=1e-10,
    remark=(
        "With c and s of the angle and friction mu, a = 1 + 3 c (c \u2212 mu s) and b = l angle'\u00b2 s \u2212 g. The "
        "end of the motion is where the engine stops and names Painlev\u00e9's paradox, the contact and a; the force "
        "is 0/0 there, so that rates are known less well than the time. Equations with dt = a d(tau), whose "
        "equilibrium that is, give time and slip, integrated by scipy at 1e-12. Limits are found by bisection over "
        "`friction_solutions`, which tries all modes; like forces, they depend on no tolerance. "
        "`tangential_shock=True` is shown from where a and b are negative. At the end of the motion itself what would "
        "stick is at its bound to the last digits, and the engine goes on by an impact. The papers could not be "
        "opened: no digit of theirs is compared."
    ),
    drawings=drawings,
)

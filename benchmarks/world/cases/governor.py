"""Stiff flyball governor (IFToMM benchmark A05): a problem in space, whose reduced equations are those of a plane.

A shaft turns freely about the vertical, a slider of mass m at the height s turns with it. Two rods, alpha below the
horizontal, are hinged to the shaft's top a = 0.05 m beside its axis and carry balls M at their ends; stiff springs and
dampers join their middles to the slider. With the speed w of the shaft, J(alpha) the inertia of all about its axis, and
I that of a rod with its ball about its hinge,

    T = J(alpha) w^2/2 + I alpha'^2 + m s'^2/2,    H = J w is constant.

There are no products of w with the other rates, so Routh's function is that of a mechanism in the plane which turns
with the shaft, with a potential H^2/(2 J). As the motion is symmetric, J follows from the distance d of the balls, and
that potential from a force H^2 J'(d)/(2 J(d)^2) which drives them apart: exactly, with all inertias of the rods.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from harness.report.plot import Curve, Plot
from mechanism_fmu.model import (
    GROUND,
    Mechanism,
    NonlinearSpring,
    Output,
    Revolute,
    Settings,
    SpringDamper,
    Translational,
    rigid_body,
)
from mechanism_fmu.simulation import Simulation

from ..case import Case, Known, Origin, Run, steps_of

GRAVITY, DENSITY, ASIDE, LENGTH, WIDTH, SIDE, BALL = 9.81, 3000.0, 0.05, 1.0, 0.01, 0.1, 5.0
STIFFNESS, DAMPING, FREE_LENGTH = 8e5, 4e4, 0.5
START, HEIGHT, SPEED = math.radians(30.0), 0.5, math.tau
TIMES = (0.5, 10.0)

#: The shaft is as a rod. Inertias of a rod across and along itself, and of shaft and slider about the axis [kg m2].
ROD, SLIDER = DENSITY * LENGTH * WIDTH**2, DENSITY * SIDE**3
ACROSS, ALONG = ROD * (LENGTH**2 + WIDTH**2) / 12, ROD * WIDTH**2 / 6
ON_AXIS = ALONG + SLIDER * SIDE**2 / 6

_NAMES = tuple(
    (f"{name} after {time:g} s", unit)
    for time in TIMES
    for name, unit in (("height s of the slider", "m"), ("angle alpha", "rad"), ("speed of the shaft", "rad/s"))
)
#: `by_lagrange()`, which takes seconds, for its equations are stiff.
BY_LAGRANGE = (
    0.74324942478633,
    0.25949138154341,
    5.1034154219715,
    0.61962291706137,
    0.39007370184463,
    5.5482036226549,
)
#: By MuJoCo 4.0.0, in space, as tests/unit/test_world_in_mujoco.py finds them: a hinge of the shaft, a slide and two
#: hinges on it, springs and dampers as tendons, balls of 1e-12 kg m2; its Runge-Kutta method of fourth order with
#: 100000 and 200000 steps, extrapolated.
BY_MUJOCO = (
    0.74324942478635,
    0.25949138154339,
    5.1034154219717,
    0.61962291706224,
    0.3900737018437,
    5.5482036226508,
)


def governor(tolerance: float) -> Mechanism:
    """In the plane that turns with the shaft: y is the height over the shaft's lower end."""
    mass = ROD + BALL
    centre = (ROD * LENGTH / 2 + BALL * LENGTH) / mass
    inertia = ACROSS + ROD * LENGTH**2 / 4 + BALL * LENGTH**2 - mass * centre**2
    rod: dict[str, Any] = {"mass": mass, "inertia": inertia, "centre": (centre, 0.0)}
    right = rigid_body("right", (ASIDE, LENGTH), angle=-START, **rod)
    left = rigid_body("left", (-ASIDE, LENGTH), angle=START - math.pi, **rod)
    slider = rigid_body("slider", (0.0, HEIGHT), mass=SLIDER, inertia=1.0)
    momentum = SPEED * inertia_over(_distance(START))

    def centrifugal(distance: Any, _rate: Any) -> Any:
        return -(momentum**2) * slope_over(distance) / (2 * inertia_over(distance) ** 2)

    spring = {"stiffness": STIFFNESS, "damping": DAMPING, "free_length": FREE_LENGTH}
    forces = (
        NonlinearSpring("apart", left.at(LENGTH, 0), right.at(LENGTH, 0), law=centrifugal),
        SpringDamper("right_spring", right.at(LENGTH / 2, 0), slider.at(ASIDE, 0), **spring),
        SpringDamper("left_spring", left.at(LENGTH / 2, 0), slider.at(-ASIDE, 0), **spring),
    )
    joints = (
        Revolute("right_hinge", GROUND.at(ASIDE, LENGTH), right.at(0, 0)),
        Revolute("left_hinge", GROUND.at(-ASIDE, LENGTH), left.at(0, 0)),
        Translational("shaft", GROUND.line((0, 0), (0, 1)), slider.line((0, 0), (0, 1))),
    )
    outputs = (Output("height", slider.y, "m"), Output("angle", right.angle, "rad"))
    parts: dict[str, Any] = {"gravity": (0.0, -GRAVITY), "outputs": outputs, "settings": Settings(tolerance)}
    return Mechanism((left, right, slider), joints, forces, **parts)


def inertia_over(distance: Any) -> Any:
    """J(d): of all about the axis [kg m2] over the distance of the balls [m]."""
    reach = distance / 2 - ASIDE
    rod = ROD * (ASIDE + reach / 2) ** 2 + ALONG + (ACROSS - ALONG) * (reach / LENGTH) ** 2
    return ON_AXIS + 2 * (rod + BALL * (distance / 2) ** 2)


def slope_over(distance: Any) -> Any:
    """J'(d) [kg m]."""
    reach = distance / 2 - ASIDE
    return ROD * (ASIDE + reach / 2) + 2 * (ACROSS - ALONG) * reach / LENGTH**2 + BALL * distance


def _distance(angle: float) -> float:
    return 2 * (ASIDE + LENGTH * math.cos(angle))


def run(tolerance: float) -> Run:
    """Height, angle and the shaft's speed H/J at both times, for each of the two known values."""
    simulation = Simulation(governor(tolerance))
    found = [value for time in TIMES for value in _read(simulation, time)]
    return Run((*found, *found), steps_of(simulation))


def _read(simulation: Simulation, time: float) -> tuple[float, float, float]:
    simulation.advance(time)
    read = simulation.read()
    angle = -read["angle"]
    return read["height"], angle, SPEED * inertia_over(_distance(START)) / inertia_over(_distance(angle))


def by_lagrange(tolerance: float = 1e-12) -> list[float]:
    """The quantities by Lagrange's equations in alpha, s and the shaft's angle, which are not reduced, and DOP853."""
    hinged = ACROSS + ROD * LENGTH**2 / 4 + BALL * LENGTH**2
    moment = GRAVITY * LENGTH * (ROD / 2 + BALL)
    half = LENGTH / 2

    def rates(_time: float, y: Sequence[float]) -> list[float]:
        angle, height, angle_rate, height_rate, speed = y
        c, s = math.cos(angle), math.sin(angle)
        rod = ROD * (ASIDE + half * c) ** 2 + ACROSS * c * c + ALONG * s * s
        inertia = ON_AXIS + 2 * (rod + BALL * (ASIDE + LENGTH * c) ** 2)
        # over the angle
        of_rod = ROD * (ASIDE + half * c) * half + (ACROSS - ALONG) * c
        slope = -4 * s * (of_rod + BALL * (ASIDE + LENGTH * c) * LENGTH)
        x, y_ = half * c, LENGTH - half * s - height  # from the slider to the middle of the rod
        length = math.hypot(x, y_)
        growth = (-x * half * s * angle_rate - y_ * (half * c * angle_rate + height_rate)) / length
        pull = (STIFFNESS * (length - FREE_LENGTH) + DAMPING * growth) / length
        on_rod = pull * (x * half * s + y_ * half * c) + moment * c
        return [
            *(angle_rate, height_rate),
            (slope * speed**2 / 4 + on_rod) / hinged,
            2 * pull * y_ / SLIDER - GRAVITY,
            -slope * angle_rate * speed / inertia,
        ]

    start = [START, HEIGHT, 0.0, 0.0, SPEED]
    found = solve_ivp(rates, (0.0, TIMES[-1]), start, "DOP853", t_eval=TIMES, rtol=tolerance, atol=tolerance / 100)
    return [float(value) for column in found.y.T for value in (column[1], column[0], column[4])]


def _known() -> Iterator[Known]:
    sources: dict[Origin, tuple[float, ...]] = {"second formulation": BY_LAGRANGE, "other program": BY_MUJOCO}
    for origin, values in sources.items():
        for (name, unit), value in zip(_NAMES, values, strict=True):
            yield Known(name, unit, value, origin)


def _pictures() -> list[Plot]:
    """Height of the slider, as the library's page has it, and the shaft's speed."""
    simulation = Simulation(governor(1e-9))
    times = np.linspace(0.0, TIMES[-1], 401)
    height, _, speed = np.array([_read(simulation, float(time)) for time in times]).T
    return [
        Plot("Slider", "time [s]", "height s [m]", [Curve("s", times, height, "#1f6feb")], legend=False),
        Plot("Shaft", "time [s]", "speed [rad/s]", [Curve("speed", times, speed, "#1f6feb")], legend=False),
    ]


CASE = Case(
    name="governor",
    title="Stiff flyball governor",
    statement=(
        "A shaft of 1 m turns freely about the vertical, with 2\u03c0 rad/s at first. Two rods of 1 m with balls of "
        "5 kg at their ends are hinged to its top, 30\u00b0 below the horizontal; springs of 8e5 N/m with dampers of "
        "4e4 N s/m and a free length of 0.5 m join their middles to a slider of 3 kg; 10 s."
    ),
    source=(
        "IFToMM library of computational benchmark problems, A05; M. Gonz\u00e1lez, D. Dopico, U. Lugr\u00eds, "
        "J. Cuadrado, Multibody System Dynamics 16 (2006) 179\u2013190; data as in the programs of L. Tagliapietra and "
        "others (MBSbenchmarksInOpenSim)"
    ),
    known=tuple(_known()),
    run=run,
    model=governor,
    within=1e-11,
    remark=(
        "A problem in space, and no equation of it is left out: the momentum of the shaft is constant, so that what "
        "is left is a motion in the plane that turns with it, with a force that follows from the distance of the "
        "balls. What a plane cannot state of it is a motion that is not symmetric, a torque on the shaft, and the "
        "reactions across the plane. The second formulation keeps the angle of the shaft; MuJoCo has the mechanism in "
        "space. The measure of the library is the curve of s; a picture of it, beside OpenSim's, shows 0.74 m after "
        "0.5 s and 0.62 m after 10 s. The specification itself could not be opened; the data are those of a program "
        "that follows it."
    ),
    drawings=_pictures,
)

"""Slider-crank whose crank and rod are equal: singular twice a turn, where the slider might stay at the pivot.

As long as it does not, the rod's angle is that of the crank, turned over, the slider is at 2 l cos(angle), and with the
masses m of crank and rod, M of the slider,

    l^2 (2/3 m + 2 (m + 2 M) sin(angle)^2) angle'' + 2 l^2 (m + 2 M) sin(angle) cos(angle) angle'^2
        = -m g l cos(angle).
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from mechanism_fmu.model import GROUND, Body, Mechanism, Output, Revolute, RevoluteTranslational, Settings
from mechanism_fmu.simulation import Simulation

from ..case import Case, Known, Run, steps_of

GRAVITY, LENGTH, MASS, SLIDER = 9.81, 1.0, 1.0, 0.5
START, SPEED, STOP = math.pi / 4, 5.0, 5.0


def slider_crank(tolerance: float) -> Mechanism:
    """Crank at 45 degrees with 5 rad/s, rod as long, slider on the x axis."""
    c, s = math.cos(START), math.sin(START)
    crank = Body("crank", MASS, MASS / 12, (c / 2, s / 2, START), (-SPEED * s / 2, SPEED * c / 2, SPEED))
    rod = Body("rod", MASS, MASS / 12, (1.5 * c, s / 2, -START), (-1.5 * SPEED * s, SPEED * c / 2, -SPEED))
    slider = Body("slider", SLIDER, 1.0, (2 * c, 0.0, 0.0), (-2 * SPEED * s, 0.0, 0.0))
    joints = (
        Revolute("pivot", GROUND.at(0, 0), crank.at(-LENGTH / 2, 0)),
        Revolute("pin", crank.at(LENGTH / 2, 0), rod.at(-LENGTH / 2, 0)),
        Revolute("wrist", rod.at(LENGTH / 2, 0), slider.at(0, 0)),
        RevoluteTranslational("guide", GROUND.line((0, 0), (1, 0)), slider.at(0, 0)),
    )
    outputs = (
        Output("angle", crank.angle, "rad"),
        Output("speed", crank.speed, "rad/s"),
        Output("slider", slider.x, "m"),
        Output("kinetic", "energy.kinetic", "J"),
    )
    parts: dict[str, Any] = {"gravity": (0.0, -GRAVITY), "outputs": outputs, "settings": Settings(tolerance)}
    return Mechanism((crank, rod, slider), joints, through_singularities=True, **parts)


def run(tolerance: float) -> Run:
    """The crank's angle and speed and the slider's place after 5 s, and the energy over that of the start."""
    simulation = Simulation(slider_crank(tolerance))
    energies = []
    for time in (0.0, STOP):
        simulation.advance(time)
        read = simulation.read()
        energies.append(read["kinetic"] + MASS * GRAVITY * math.sin(read["angle"]))
    return Run((read["angle"], read["speed"], read["slider"], energies[1] / energies[0]), steps_of(simulation))


def _rates(_time: float, y: np.ndarray) -> list[float]:
    """Lagrange's equation with the inertia 2/3 + 4 sin(angle)^2 and the weights' moment."""
    s, c = math.sin(y[0]), math.cos(y[0])
    return [y[1], -(4 * s * c * y[1] ** 2 + GRAVITY * c) / (2 / 3 + 4 * s * s)]


_END = solve_ivp(_rates, (0.0, STOP), [START, SPEED], "DOP853", rtol=1e-13, atol=1e-14).y[:, -1].tolist()
CASE = Case(
    name="equal_slider_crank",
    title="Slider-crank of equal lengths",
    statement=(
        "Uniform crank and rod of 1 m and 1 kg, slider of 0.5 kg, weight 9.81 m/s\u00b2; crank at 45\u00b0 "
        "with 5 rad/s; 5 s. "
        "Twice a turn the slider is at the pivot, where it might stay."
    ),
    source="a usual test of formulations at singular configurations; data of this project",
    known=(
        Known("angle of the crank after 5 s", "rad", _END[0], "one coordinate"),
        Known("speed of the crank after 5 s", "rad/s", _END[1], "one coordinate"),
        Known("x of the slider after 5 s", "m", 2 * LENGTH * math.cos(_END[0]), "one coordinate"),
        Known("energy after 5 s over that at the start", "1", 1.0, "closed form"),
    ),
    run=run,
    model=slider_crank,
    within=1e-9,
    remark=(
        "`through_singularities=True`, as in the [N-four-bar](n_four_bar.md). In 5 s the slider passes its pivot 9 "
        "times; at any of them it might stay, and its place would be 0."
    ),
)

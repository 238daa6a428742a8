"""Simple pendulum: a point mass on a massless rod, from the horizontal; elliptic functions give its place."""

from __future__ import annotations

import math

from scipy.special import ellipj, ellipk

from mechanism_fmu.model import GROUND, Body, Distance, Mechanism, Output, Settings
from mechanism_fmu.simulation import Simulation

from ..case import Case, Known, Run, steps_of

GRAVITY, LENGTH, STOP = 9.81, 1.0, 10.0


def pendulum(tolerance: float) -> Mechanism:
    """The point mass at (-1, 0) at rest; its body may turn, and does not."""
    bob = Body("bob", 1.0, 1.0, (-LENGTH, 0.0, 0.0))
    return Mechanism(
        (bob,),
        (Distance("rod", GROUND.at(0, 0), bob.at(0, 0), distance=LENGTH),),
        gravity=(0.0, -GRAVITY),
        outputs=(
            Output("x", bob.x, "m"),
            Output("y", bob.y, "m"),
            Output("kinetic", "energy.kinetic", "J"),
        ),
        settings=Settings(tolerance),
    )


def run(tolerance: float) -> Run:
    """Place after 10 s, and the sum of kinetic energy and weight, over the largest kinetic energy."""
    simulation = Simulation(pendulum(tolerance))
    simulation.advance(STOP)
    read = simulation.read()
    drift = (read["kinetic"] + GRAVITY * read["y"]) / (GRAVITY * LENGTH)
    return Run((read["x"], read["y"], drift), steps_of(simulation))


def _place() -> tuple[float, float]:
    """With k = sin(45 deg): sin(angle/2) = k cd(omega t), the angle being that from hanging."""
    parameter = 0.5
    _, cn, dn, _ = ellipj(math.sqrt(GRAVITY / LENGTH) * STOP % (4 * ellipk(parameter)), parameter)
    angle = -2.0 * math.asin(math.sqrt(parameter) * cn / dn)
    return LENGTH * math.sin(angle), -LENGTH * math.cos(angle)


_X, _Y = _place()
CASE = Case(
    name="pendulum",
    title="Simple pendulum",
    statement="A point mass of 1 kg on a massless rod of 1 m, let go at (\u22121, 0); weight 9.81 m/s\u00b2; 10 s.",
    source="IFToMM library of computational benchmark problems, A01; its measure is the energy",
    known=(
        Known("x after 10 s", "m", _X, "closed form"),
        Known("y after 10 s", "m", _Y, "closed form"),
        Known("energy after 10 s over m g l, 0 at the start", "1", 0.0, "closed form"),
    ),
    run=run,
    model=pendulum,
    within=3e-10,
)

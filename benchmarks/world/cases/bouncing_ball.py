"""Bouncing ball: heights and times of a geometric series, as far as doubles can tell its terms from its end."""

from __future__ import annotations

import math

import numpy as np

from mechanism_fmu.model import GROUND, Body, Mechanism, PointLineContact, Settings
from mechanism_fmu.simulation import Simulation

from ..case import Case, Known, Run, impacts_until, steps_of

GRAVITY, HEIGHT, RESTITUTION = 9.81, 1.0, 0.7
_COUNTED = (1, 2, 5, 10, 15)


def ball(tolerance: float) -> Mechanism:
    """A point that falls from 1 m."""
    body = Body("ball", 1.0, 1.0, (0.0, HEIGHT, 0.0))
    floor = PointLineContact("floor", body.at(0, 0), GROUND.line((0, 0), (1, 0)), restitution=RESTITUTION)
    return Mechanism((body,), contacts=(floor,), gravity=(0.0, -GRAVITY), settings=Settings(tolerance))


def run(tolerance: float) -> Run:
    """Times and closing speeds of some impacts."""
    simulation = Simulation(ball(tolerance))
    found = impacts_until(simulation, np.linspace(0.0, 2.546, 500)[1:].tolist())
    chosen = [found[number - 1] for number in _COUNTED]
    return Run(tuple(value for one in chosen for value in (one.time, one.closing_speed)), steps_of(simulation))


def _known() -> tuple[Known, ...]:
    fall = math.sqrt(2 * HEIGHT / GRAVITY)
    found = []
    for number in _COUNTED:
        time = fall * (1 + 2 * sum(RESTITUTION**k for k in range(1, number)))
        speed = GRAVITY * fall * RESTITUTION ** (number - 1)
        found.append(Known(f"time of impact {number}", "s", time, "closed form"))
        found.append(Known(f"closing speed of impact {number}", "m/s", speed, "closed form"))
    return tuple(found)


CASE = Case(
    name="bouncing_ball",
    title="Bouncing ball",
    statement=(
        "A point falls from 1 m on a floor with restitution 0.7, weight 9.81 m/s\u00b2: hops without end in 2.56 s."
    ),
    source="BouncingBall of the FMI project's Reference-FMUs; the usual example of Zeno's paradox in hybrid systems",
    known=_known(),
    run=run,
    model=ball,
    within=1e-9,
    remark=(
        "The series has its end at 2.5587 s. Closing speeds below 1e-6 m/s are taken for rest, half a "
        "microsecond before it."
    ),
)

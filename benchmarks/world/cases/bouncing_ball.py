"""Bouncing ball: times and speeds of a geometric series, and rest where its hops are cut off.

With the height h and restitution e, the ball first strikes at t_1 = sqrt(2 h/g) with v_1 = g t_1, and for impact k

    v_k = e^(k - 1) v_1,    t_k = t_1 (1 + 2 (e + ... + e^(k - 1))),    all end at t_1 (1 + e)/(1 - e).

The engine takes the ball for resting after the first impact that leaves less than `STICK_SPEED` of its scale of speeds.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import count

from mechanism_fmu.engine.dynamics.scaling import LENGTH, RATE
from mechanism_fmu.model import GROUND, Body, Mechanism, Output, PointLineContact, Settings
from mechanism_fmu.simulation import Simulation
from mechanism_fmu.tolerances import STICK_SPEED

from ..case import Case, Known, Origin, Run, impacts_until, steps_of

GRAVITY, HEIGHT, RESTITUTION = 9.81, 1.0, 0.7
_COUNTED = (1, 2, 5, 10, 15)
#: What leaves the floor more slowly rests [m/s]: of a ball with a radius of gyration of 1 m that falls, over what has
#: scale 1 (`engine.dynamics.scaling`).
RESTS = STICK_SPEED * math.sqrt(GRAVITY) / (LENGTH * RATE)


def ball(tolerance: float) -> Mechanism:
    """A point that falls from 1 m."""
    body = Body("ball", 1.0, 1.0, (0.0, HEIGHT, 0.0))
    floor = PointLineContact("floor", body.at(0, 0), GROUND.line((0, 0), (1, 0)), restitution=RESTITUTION)
    outputs = (Output("force", "floor.force", "N"), Output("lost", "energy.lost", "J"))
    return Mechanism((body,), contacts=(floor,), gravity=(0.0, -GRAVITY), outputs=outputs, settings=Settings(tolerance))


def run(tolerance: float) -> Run:
    """Times and closing speeds of some impacts; the last one of all, and what is read at rest."""
    simulation = Simulation(ball(tolerance))
    # ever shorter communication steps, as a step keeps only so many impacts
    found = impacts_until(simulation, [*(END * (1 - 0.9 * RESTITUTION**k) for k in range(70)), 3.0])
    values = [value for number in _COUNTED for value in (found[number - 1].time, found[number - 1].closing_speed)]
    at_rest = simulation.read()
    values += [len(found), found[-1].time, at_rest["lost"] / (GRAVITY * HEIGHT), at_rest["force"]]
    return Run(tuple(values), steps_of(simulation))


FALL = math.sqrt(2 * HEIGHT / GRAVITY)
END = FALL * (1 + RESTITUTION) / (1 - RESTITUTION)


def impact(number: int) -> tuple[float, float]:
    """Time [s] and closing speed [m/s] of an impact, from 1."""
    time = FALL * (1 + 2 * sum(RESTITUTION**k for k in range(1, number)))
    return time, GRAVITY * FALL * RESTITUTION ** (number - 1)


#: The impact after which it rests.
LAST = next(number for number in count(1) if RESTITUTION * impact(number)[1] < RESTS)


def _known() -> Iterator[Known]:
    exact: Origin = "closed form"
    for number in _COUNTED:
        time, speed = impact(number)
        yield Known(f"time of impact {number}", "s", time, exact)
        yield Known(f"closing speed of impact {number}", "m/s", speed, exact)
    yield Known("number of impacts", "1", LAST, exact)
    yield Known("time of the last impact, then rest", "s", impact(LAST)[0], exact)
    yield Known("energy lost, over m g h", "1", 1.0, exact)
    yield Known("force on the floor at rest", "N", GRAVITY, exact)


CASE = Case(
    name="bouncing_ball",
    title="Bouncing ball",
    statement=(
        "A point falls from 1 m on a floor with restitution 0.7, weight 9.81 m/s\u00b2: hops without end in 2.56 s."
    ),
    source="BouncingBall of the FMI project's Reference-FMUs; the usual example of Zeno's paradox in hybrid systems",
    known=tuple(_known()),
    run=run,
    model=ball,
    within=1e-12,
    remark=(
        f"The series has its end at {END:.6f} s. A ball that leaves the floor with less than {RESTS:.1e} m/s, 1e-7 of "
        f"its own scale of speeds, is taken for resting: so it does after impact {LAST}, "
        f"{END - impact(LAST)[0]:.1e} s before that end."
    ),
)

"""Coupler on many rockers: n - 2 constraints more than needed, all of them consistent; it swings as one pendulum."""

from __future__ import annotations

import math
from typing import Any

from scipy.special import ellipj, ellipk

from mechanism_fmu.model import GROUND, Body, Mechanism, Output, Revolute, Settings
from mechanism_fmu.simulation import Simulation

from ..case import Case, Known, Run, steps_of

GRAVITY, LENGTH, SPACING, COUPLER, ROCKER = 9.81, 0.5, 0.4, 4.0, 1.0
START, STOP = math.radians(60.0), 10.0
COUNTS = (2, 5, 10)


def rockers(count: int, tolerance: float) -> Mechanism:
    """A coupler hangs from so many rockers, all 60 degrees from hanging."""
    x, y = LENGTH * math.sin(START), -LENGTH * math.cos(START)
    middle = (count - 1) * SPACING / 2
    coupler = Body("coupler", COUPLER, COUPLER * (middle * 2) ** 2 / 12, (middle + x, y, 0.0))
    bodies, joints = [coupler], []
    for k in range(count):
        rocker = Body(f"rocker{k}", ROCKER, ROCKER * LENGTH**2 / 12, (k * SPACING + x / 2, y / 2, START))
        bodies.append(rocker)
        joints.append(Revolute(f"pivot{k}", GROUND.at(k * SPACING, 0), rocker.at(0, LENGTH / 2)))
        joints.append(Revolute(f"pin{k}", coupler.at(k * SPACING - middle, 0), rocker.at(0, -LENGTH / 2)))
    outputs = (Output("angle", "rocker0.angle", "rad"),)
    parts: dict[str, Any] = {"gravity": (0.0, -GRAVITY), "outputs": outputs, "settings": Settings(tolerance)}
    return Mechanism(tuple(bodies), tuple(joints), **parts)


def run(tolerance: float) -> Run:
    """The rockers' angle after 10 s for each count."""
    values, steps = [], 0
    for count in COUNTS:
        simulation = Simulation(rockers(count, tolerance))
        simulation.advance(STOP)
        values.append(simulation.read()["angle"])
        steps += steps_of(simulation)
    return Run(tuple(values), steps)


def angle(count: int) -> float:
    """A pendulum's: sin(angle/2) = sin(start/2) cd(omega t)."""
    inertia = (count * ROCKER / 3 + COUPLER) * LENGTH**2
    moment = GRAVITY * LENGTH * (count * ROCKER / 2 + COUPLER)
    parameter = math.sin(START / 2) ** 2
    _, cn, dn, _ = ellipj(math.sqrt(moment / inertia) * STOP % (4 * ellipk(parameter)), parameter)
    return 2.0 * math.asin(math.sqrt(parameter) * cn / dn)


CASE = Case(
    name="rockers",
    title="Coupler on redundant rockers",
    statement=(
        "A coupler of 4 kg is pinned, at equal spacings of 0.4 m, to n uniform rockers of 0.5 m and 1 kg that "
        "hang from ground "
        "pivots; let go 60\u00b0 from hanging; 10 s. n \u2212 2 constraints are redundant for good."
    ),
    source="the kind of over-constrained problem of J. Garc\u00eda de Jal\u00f3n and E. Bayo; data of this project",
    known=tuple(Known(f"n = {n}: angle of the rockers", "rad", angle(n), "closed form") for n in COUNTS),
    run=run,
    model=rockers,
    within=1e-9,
    remark=(
        "All of them move as a pendulum, whose angle is an elliptic function. Reactions of redundant pins are "
        "those of least "
        "norm in the metric of the masses."
    ),
)

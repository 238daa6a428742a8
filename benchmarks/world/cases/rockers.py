"""Coupler on many rockers: n - 2 constraints more than needed, all of them consistent; it swings as one pendulum.

With masses M of the coupler and m of each of n rockers of length l, and the angle a from hanging, a_0 at the start,

    (n m/3 + M) l a'' = -(n m/2 + M) g sin(a),    sin(a/2) = sin(a_0/2) cd(omega t).

Redundant constraints leave open how the pivots share what they carry, but not its sum, for upward forces F_k

    sum_k F_k = (n m + M) g + (n m/2 + M) l (sin(a) a'' + cos(a) a'^2).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
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
    on_ground = (Output(f"force{k}", f"pivot{k}.force_y", "N") for k in range(count))
    outputs = (Output("angle", "rocker0.angle", "rad"), *on_ground)
    parts: dict[str, Any] = {"gravity": (0.0, -GRAVITY), "outputs": outputs, "settings": Settings(tolerance)}
    return Mechanism(tuple(bodies), tuple(joints), **parts)


def run(tolerance: float) -> Run:
    """The rockers' angle after 10 s, and the sum of what the pivots carry, for each count."""
    values: list[float] = []
    steps = 0
    for count in COUNTS:
        simulation = Simulation(rockers(count, tolerance))
        simulation.advance(STOP)
        angle, *on_ground = simulation.read().values()
        values += [angle, -sum(on_ground)]
        steps += steps_of(simulation)
    return Run(tuple(values), steps)


def known(count: int) -> tuple[float, float]:
    """Angle [rad] and sum of the pivots' upward forces [N] after 10 s."""
    inertia = (count * ROCKER / 3 + COUPLER) * LENGTH**2
    moment = GRAVITY * LENGTH * (count * ROCKER / 2 + COUPLER)
    parameter = math.sin(START / 2) ** 2
    _, cn, dn, _ = ellipj(math.sqrt(moment / inertia) * STOP % (4 * ellipk(parameter)), parameter)
    angle = 2.0 * math.asin(math.sqrt(parameter) * cn / dn)
    acceleration = -moment * math.sin(angle) / inertia
    squared = 2 * moment * (math.cos(angle) - math.cos(START)) / inertia
    risen = (count * ROCKER / 2 + COUPLER) * LENGTH
    weight = (count * ROCKER + COUPLER) * GRAVITY
    return angle, weight + risen * (math.sin(angle) * acceleration + math.cos(angle) * squared)


def _known() -> Iterator[Known]:
    for count in COUNTS:
        angle, force = known(count)
        yield Known(f"n = {count}: angle of the rockers", "rad", angle, "closed form")
        yield Known(f"n = {count}: what the pivots carry", "N", force, "closed form")


CASE = Case(
    name="rockers",
    title="Coupler on redundant rockers",
    statement=(
        "A coupler of 4 kg is pinned, at equal spacings of 0.4 m, to n uniform rockers of 0.5 m and 1 kg that "
        "hang from ground "
        "pivots; let go 60\u00b0 from hanging; 10 s. n \u2212 2 constraints are redundant for good."
    ),
    source="the kind of over-constrained problem of J. Garc\u00eda de Jal\u00f3n and E. Bayo; data of this project",
    known=tuple(_known()),
    run=run,
    model=rockers,
    within=1e-9,
    remark=(
        "All of them move as a pendulum, whose angle is an elliptic function. How redundant pins share their load is "
        "not a question that rigid bodies answer: ours are those of least norm in the metric of the masses. Their sum "
        "is known, and is compared after 10 s."
    ),
)

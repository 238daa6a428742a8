"""N-four-bar mechanism (IFToMM benchmark A02): N equal parallelograms in a row, 2N + 1 uniform rods of 1 m and 1 kg.

Rockers on ground pivots (i, 0), upright at first, couplers from (i, 1) to (i + 1, 1); weight, and the first rocker's
end at 1 m/s along x. Wherever the rockers lie flat, the rank of the rows drops by N: each parallelogram might go on
crossed. As parallelograms they have one coordinate, the angle of the rockers; with a torque T on the first one,

    ((N + 1) / 3 + N) angle'' = T - g ((N + 1) / 2 + N) cos(angle).
"""

from __future__ import annotations

import math

import numpy as np
from scipy.integrate import solve_ivp

from mechanism_fmu.model import GROUND, Body, Input, Mechanism, Output, Revolute, Settings, Torque
from mechanism_fmu.simulation import Simulation

from ..case import Case, Known, Run, steps_of

GRAVITY = 9.81
ANGLE, SPEED = math.pi / 2, -1.0


def n_four_bar(
    count: int, tolerance: float = 1e-9, through: bool = True, angle: float = ANGLE, speed: float = SPEED
) -> Mechanism:
    """The mechanism, its rockers at an angle [rad] with a speed [rad/s]; input `torque` [N.m] acts on the first one."""
    c, s = math.cos(angle), math.sin(angle)
    dx, dy = -speed * s, speed * c
    bodies, joints = [], []
    for k in range(count + 1):
        place = (k + c / 2, s / 2, angle)
        bodies.append(Body(f"rocker{k}", 1.0, 1 / 12, place, start_rate=(dx / 2, dy / 2, speed)))
        joints.append(Revolute(f"pivot{k}", f"rocker{k}", (-0.5, 0.0), GROUND, (float(k), 0.0)))
    for k in range(count):
        bodies.append(Body(f"coupler{k}", 1.0, 1 / 12, (k + c + 0.5, s, 0.0), start_rate=(dx, dy, 0.0)))
        joints.append(Revolute(f"left{k}", f"coupler{k}", (-0.5, 0.0), f"rocker{k}", (0.5, 0.0)))
        joints.append(Revolute(f"right{k}", f"coupler{k}", (0.5, 0.0), f"rocker{k + 1}", (0.5, 0.0)))
    return Mechanism(
        bodies=tuple(bodies),
        joints=tuple(joints),
        forces=(Torque("drive", "rocker0"),),
        inputs=(Input("torque", "drive.torque", 0.0, "Torque on the first rocker", "N.m"),),
        outputs=(
            Output("angle", "rocker0.angle", "rad"),
            Output("speed", "rocker0.speed", "rad/s"),
            Output("last_angle", f"rocker{count}.angle", "rad"),
            Output("kinetic", "energy.kinetic", "J"),
            Output("work", "energy.work", "J"),
        ),
        gravity=(0.0, -GRAVITY),
        settings=Settings(relative_tolerance=tolerance),
        through_singularities=through,
    )


def known(count: int, time: float, torque: float = 0.0, angle: float = ANGLE, speed: float = SPEED) -> list[float]:
    """Angle [rad] and speed [rad/s] of the rockers at a time [s], by the equation of the one coordinate."""
    inertia, moment = (count + 1) / 3 + count, GRAVITY * ((count + 1) / 2 + count)
    found = solve_ivp(
        lambda _t, y: [y[1], (torque - moment * np.cos(y[0])) / inertia],
        (0.0, time),
        [angle, speed],
        "DOP853",
        rtol=1e-13,
        atol=1e-14,
    )
    return [float(value) for value in found.y[:, -1]]


COUNTS = (1, 2, 10, 40)
STOP = 10.0


def run(tolerance: float) -> Run:
    """Energy over that of the start, and angle of the rockers after 10 s, for each count."""
    values, steps = [], 0
    for count in COUNTS:
        simulation = Simulation(n_four_bar(count, tolerance))
        energies = []
        for time in (0.0, STOP):
            simulation.advance(time)
            read = simulation.read()
            weight = GRAVITY * ((count + 1) / 2 + count) * math.sin(read["angle"])
            energies.append(read["kinetic"] + weight)
        values += [energies[1] / energies[0], read["angle"]]
        steps += steps_of(simulation)
    return Run(tuple(values), steps)


def _known() -> tuple[Known, ...]:
    found = []
    for count in COUNTS:
        found.append(Known(f"N = {count}: energy after 10 s over that at the start", "1", 1.0, "closed form"))
        found.append(Known(f"N = {count}: angle of the rockers", "rad", known(count, STOP)[0], "one coordinate"))
    return tuple(found)


CASE = Case(
    name="n_four_bar",
    title="N-four-bar mechanism",
    statement=(
        "2N + 1 uniform rods of 1 m and 1 kg: rockers on ground pivots 1 m apart, joined by couplers. The rockers are "
        "upright at first, the first one's end moves at 1 m/s along x; weight 9.81 m/s\u00b2; 10 s. Wherever "
        "the rockers "
        "lie flat, the rank of the constraints drops by N."
    ),
    source="IFToMM library of computational benchmark problems, A02; its measure is the energy",
    known=_known(),
    run=run,
    model=n_four_bar,
    within=2e-7,
    remark=(
        "The engine steps over the singular configurations on the branch of parallelograms, because the mechanism says "
        "`through_singularities=True`; without it they are refused by name. The angle is held against the equation of "
        "the one coordinate that the parallelograms have."
    ),
)

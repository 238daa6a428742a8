"""Four-bar with three clearances: all joints but that of the crank on the ground are pins in holes that are larger.

Coordinates are the crank's angle, and centre and angle of coupler and rocker: seven, with a mass matrix that is
constant and diagonal, so that between impacts only the crank's weight is not constant. With d from the centre of a hole
to that of its pin, the gap is

    g = c - |d|,  g' = -(d / |d|) . d',                                                                     (1)

and an impact leaves g'+ = -e g'- by an impulse along d. Energy less the motor's work falls by impacts alone: with e = 1
it stays, however chaotic the motion is.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from harness.report.plot import Curve, Plot
from mechanism_fmu.model import GROUND, Body, ClearanceJoint, Mechanism, Output, Revolute, Settings, Torque
from mechanism_fmu.simulation import Simulation, simulate

from ..case import Case, Known, Run, steps_of
from ..flights import impacts

GROUND_LENGTH, CRANK, COUPLER, ROCKER = 3.0, 1.0, 4.0, 2.5
PIN, PLAY, GRAVITY, TORQUE = 0.05, 0.005, 9.81, 10.0
#: Angles of crank, coupler and rocker [rad], centre of the coupler, and of the rocker from its hinge [m].
START = (
    *(1.570823772407980, 0.3532842020624460, 1.264872058968431),
    *(1.876454585097650, 1.691962091335582, 0.3764686197082958, 1.191962183453451),
)
STOP = 0.5
Vector = npt.NDArray[np.float64]


def four_bar(restitution: float, tolerance: float = 1e-9) -> Mechanism:
    """Uniform bars of 1 kg at rest, and a constant torque on the crank."""
    crank_angle, coupler_angle, rocker_angle, x, y, u, v = START
    middle = (CRANK / 2 * math.cos(crank_angle), CRANK / 2 * math.sin(crank_angle), crank_angle)
    crank = Body("crank", 1.0, CRANK**2 / 12, middle)
    coupler = Body("coupler", 1.0, COUPLER**2 / 12, (x, y, coupler_angle))
    rocker = Body("rocker", 1.0, ROCKER**2 / 12, (GROUND_LENGTH + u, v, rocker_angle))
    pins = (
        ("crank-coupler", crank.at(CRANK / 2, 0.0), coupler.at(-COUPLER / 2, 0.0)),
        ("coupler-rocker", rocker.at(ROCKER / 2, 0.0), coupler.at(COUPLER / 2, 0.0)),
        ("rocker-ground", rocker.at(-ROCKER / 2, 0.0), GROUND.at(GROUND_LENGTH, 0.0)),
    )
    joints = [
        ClearanceJoint(name, pin, hole, pin_radius=PIN, clearance=PLAY, restitution=restitution)
        for name, pin, hole in pins
    ]
    heights = [Output(f"{body.name}_height", f"{body.name}.y", "m") for body in (crank, coupler, rocker)]
    return Mechanism(
        (crank, coupler, rocker),
        (Revolute("hinge", crank.at(-CRANK / 2, 0.0), GROUND),),
        forces=(Torque("motor", crank, torque=TORQUE),),
        contacts=tuple(joints),
        outputs=(*heights, Output("kinetic", "energy.kinetic", "J"), Output("angle", "crank.angle", "rad")),
        gravity=(0.0, -GRAVITY),
        settings=Settings(tolerance),
    )


class FourBar:
    """It in the crank's angle, and x, y [m] and angle [rad] of coupler and rocker."""

    def __init__(self) -> None:
        crank, coupler, rocker, x, y, u, v = START
        self.start: Vector = np.array([crank, x, y, coupler, GROUND_LENGTH + u, v, rocker, *7 * (0.0,)])
        self._inertia = np.array([CRANK**2 / 3, 1.0, 1.0, COUPLER**2 / 12, 1.0, 1.0, ROCKER**2 / 12])
        self._inverse = np.diag(1 / self._inertia)

    def free(self, y: Vector) -> tuple[Vector, Vector]:
        """Accelerations of flight (7,), and the inverse of the mass matrix (7, 7)."""
        crank = TORQUE - GRAVITY * CRANK / 2 * math.cos(y[0])
        force = np.array([crank, 0.0, -GRAVITY, 0.0, 0.0, -GRAVITY, 0.0])
        return force / self._inertia, self._inverse

    def _out(self, y: Vector, number: int) -> tuple[float, float]:
        """From the centre of a hole to that of its pin [m]."""
        crank, px, py, coupler, rx, ry, rocker = y[:7].tolist()
        along, across = COUPLER / 2 * math.cos(coupler), COUPLER / 2 * math.sin(coupler)
        if number == 0:
            return CRANK * math.cos(crank) - px + along, CRANK * math.sin(crank) - py + across
        reach, rise = ROCKER / 2 * math.cos(rocker), ROCKER / 2 * math.sin(rocker)
        if number == 1:
            return rx + reach - px - along, ry + rise - py - across
        return rx - reach - GROUND_LENGTH, ry - rise

    def gaps(self, y: Vector) -> Sequence[float]:
        """Those of eq (1), in the order of the joints [m]."""
        return [PLAY - math.hypot(*self._out(y, number)) for number in range(3)]

    def rows(self, y: Vector, number: int) -> tuple[Vector, Vector]:
        """Derivatives of a gap (7,); nothing slips."""
        x, h = self._out(y, number)
        distance = math.hypot(x, h)
        nx, ny = x / distance, h / distance

        def turning(arm: float, angle: float) -> float:
            return arm * (ny * math.cos(angle) - nx * math.sin(angle))

        crank, coupler, rocker = y[0], y[3], y[6]
        row = (
            (turning(CRANK, crank), -nx, -ny, turning(COUPLER / 2, coupler), 0.0, 0.0, 0.0),
            (0.0, -nx, -ny, -turning(COUPLER / 2, coupler), nx, ny, turning(ROCKER / 2, rocker)),
            (0.0, 0.0, 0.0, 0.0, nx, ny, -turning(ROCKER / 2, rocker)),
        )[number]
        return -np.array(row), np.zeros(7)


#: Restitution, and the impacts that are looked at.
_WATCHED = {0.8: (1, 2, 3, 6, 10, 15, 20, 30), 0.4: (2, 4, 6, 9, 12)}


def second_formulation() -> list[tuple[float, float]]:
    """Times [s] and closing speeds [m/s] of the impacts that are looked at."""
    found = []
    for restitution, chosen in _WATCHED.items():
        struck = impacts(FourBar(), restitution, chosen[-1])
        found += [(struck[k - 1].time, struck[k - 1].speed) for k in chosen]
    return found


#: By `second_formulation`, which takes too long to be asked each time.
FOUND = (
    (0.01780432444794728, 0.5615668497889369),
    (0.03193054744272454, 0.31323866985445864),
    (0.03289422489566033, 0.7186856236751115),
    (0.038007864229858905, 0.8382703386900673),
    (0.06520368727282248, 0.21133766468053758),
    (0.07700473188266868, 0.19551646477727158),
    (0.09457056949044532, 0.06817819827080497),
    (0.11469782207542109, 0.2512445458012977),
    (0.03124960922394359, 0.21809060472539282),
    (0.03440353388641451, 0.6544860664963699),
    (0.0354899122585399, 0.22171347649853607),
    (0.03771054577291142, 0.12364711013712582),
    (0.0380573646157815, 0.05398665735141439),
)


def run(tolerance: float) -> Run:
    """Impacts with much and with little bounce, and the energy that is left without loss."""
    values, steps, found = [], 0, iter(FOUND)
    for restitution, chosen in _WATCHED.items():
        stop = max(next(found)[0] for _ in chosen) + 1e-5
        result = simulate(four_bar(restitution, tolerance), stop, step=stop)
        steps += result.statistics.accepted_steps
        values += [value for k in chosen for value in (result.impacts[k - 1].time, result.impacts[k - 1].closing_speed)]
    simulation = Simulation(four_bar(1.0, tolerance))
    energies = []
    for time in (0.0, STOP):
        simulation.advance(time)
        read = simulation.read()
        height = read["crank_height"] + read["coupler_height"] + read["rocker_height"]
        energies.append(read["kinetic"] + GRAVITY * height - TORQUE * read["angle"])
    return Run((*values, energies[1] / energies[0]), steps + steps_of(simulation))


def _known() -> Iterator[Known]:
    found = iter(FOUND)
    for restitution, chosen in _WATCHED.items():
        for k in chosen:
            time, speed = next(found)
            yield Known(f"e = {restitution}: time of impact {k}", "s", time, "second formulation")
            yield Known(f"e = {restitution}: closing speed of impact {k}", "m/s", speed, "second formulation")
    yield Known(f"e = 1: energy less the motor's work after {STOP} s over that at the start", "1", 1.0, "closed form")


def drawings() -> Sequence[Plot]:
    """How far the pins are from the middle of their holes, over time."""
    made = four_bar(0.8)
    names = [joint.name for joint in made.contacts if isinstance(joint, ClearanceJoint)]
    shown = tuple(Output(name, f"{name}.eccentricity", "1") for name in names)
    result = simulate(replace(made, outputs=shown), 0.2, step=1e-4)
    plots = []
    for name in names:
        curve = Curve(name, result.table["time"], result[name], "#1f6feb")
        plots.append(Plot(f"{name}, e = 0.8", "time [s]", "eccentricity", [curve], legend=False))
    return plots


CASE = Case(
    name="clearance_four_bar",
    title="Four-bar with three clearances",
    statement=(
        "Uniform bars of 1 kg: crank 1 m, coupler 4 m, rocker 2.5 m, ground 3 m. An ideal hinge carries the crank; the "
        "other joints are pins of 50 mm radius in holes of 55 mm, without friction; all at rest, pins in the middle. "
        "10 N m on the crank, weight 9.81 m/s\u00b2."
    ),
    source=(
        "lengths, masses, holes and start of the four-bar with clearances in the examples of Siconos "
        "(FourBarClearancePlugin); torque in place of its control, pins, and restitution above 0: this project"
    ),
    known=tuple(_known()),
    run=run,
    model=four_bar,
    within=1e-9,
    remark=(
        "Three clearances strike in an order that soon depends on every digit: thirty impacts are held at e = 0.8, and "
        "twelve at 0.4, where hops die away behind them. The energy is held beyond that, over about a hundred impacts "
        "with e = 1; what the motor does is its torque times the crank's angle."
    ),
    drawings=drawings,
)

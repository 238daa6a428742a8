"""The four-bar path generator of Erdman, Sandor and Oakberg (1972), Fig. 3, as a model with elastic outputs.

Dimensions, masses and speed are this project's.
"""

from __future__ import annotations

import math
from types import SimpleNamespace

import numpy as np

from mechanism_fmu.elastodynamics import Cycle, configurations, linkage, quasi_static
from mechanism_fmu.kinematics import KinematicMotion
from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Body,
    LumpedMass,
    Mechanism,
    Member,
    Model,
    Output,
    Parameter,
    Revolute,
    Section,
    polynomial_motion,
)
from mechanism_fmu.model.functions import cos, sin
from mechanism_fmu.simulation import Simulation

INCH, POUND = 0.0254, 0.45359237
POUND_FORCE = POUND * 9.80665

#: The numbers in inch, lbf, s, with standard gravity.
IMPERIAL = {
    "ground_length": 10.0,
    "crank_length": 4.0,
    "coupler_length": 10.0,
    "follower_length": 8.0,
    "arm_length": 6.0,
    "width": 0.25,
    "depth": 0.5,
    "young": 30e6,
    "density": 0.283 / (9.80665 / INCH),
    "pound": 1.0 / (9.80665 / INCH),  # a weight of 1 lbf as a mass
    "inch": 1.0,
    "speed": 500 * 2 * math.pi / 60,
    "start": math.radians(30),
}
_UNITS = {name: INCH for name in IMPERIAL if name.endswith("_length")} | {"width": INCH, "depth": INCH}
_UNITS |= {"young": POUND_FORCE / INCH**2, "density": POUND_FORCE / INCH**4}
_UNITS |= {"pound": POUND_FORCE / INCH, "inch": INCH}
#: The same in SI.
SI = {name: value * _UNITS.get(name, 1.0) for name, value in IMPERIAL.items()}

MEMBERS = ("arm", "crank_bar", "link", "follower_bar")
DEFLECTIONS = ("x_deflection", "y_deflection", "rotation")
EFFORTS = ("axial_force", "start_moment", "end_moment", "stress")
_SOURCES = [
    *(f"{member}.{end}.{quantity}" for member in MEMBERS for end in ("start", "end") for quantity in DEFLECTIONS),
    *(f"{member}.{effort}" for member in MEMBERS for effort in EFFORTS),
    *(f"arm.end.{quantity}" for quantity in ("x", "y", "x_bent", "y_bent", "deviation")),
    *(f"{body}.{q}" for body in ("crank", "coupler", "follower") for q in ("x", "y", "angle")),
]


def mechanism(values: SimpleNamespace) -> Mechanism:
    """The linkage, its crank driven at a constant speed from an angle near 30 deg on; all outputs named as sources."""
    half, tilt, start = values.crank_length / 2, math.pi / 6, values.start
    x, y = half * cos(start), half * sin(start)
    path = (values.arm_length * cos(tilt), values.arm_length * sin(tilt))
    section = Section.rectangle(values.width, values.depth)

    def member(name: str, body: str, begin: tuple[float, float], end: tuple[float, float]) -> Member:
        return Member(name, body, begin, end, section, values.young, values.density)

    origin, hinge = (0.0, 0.0), (values.ground_length, 0.0)
    members = arm, crank, link, follower = (
        member("arm", "coupler", origin, path),
        member("crank_bar", "crank", (-half, 0.0), (half, 0.0)),
        member("link", "coupler", origin, (values.coupler_length, 0.0)),
        member("follower_bar", "follower", origin, (values.follower_length, 0.0)),
    )
    pound, square = values.pound, values.pound * values.inch * values.inch
    return Mechanism(
        bodies=(
            Body("crank", 1.0, 1.0, (x, y, start), (-y * values.speed, x * values.speed, values.speed)),
            Body("coupler", 1.0, 1.0, (2 * x, 2 * y, 0.62)),
            Body("follower", 1.0, 1.0, (*hinge, 1.37)),
        ),
        joints=(
            Revolute("crank_hinge", "crank", crank.start, GROUND, (0.0, 0.0)),
            Revolute("A", "coupler", link.start, "crank", crank.end),
            Revolute("B", "follower", follower.end, "coupler", link.end),
            Revolute("follower_hinge", "follower", follower.start, GROUND, hinge),
            AngleDriver("drive", "crank", polynomial_motion(start, values.speed)),
        ),
        members=members,
        lumped_masses=(
            LumpedMass("P", "coupler", arm.end, 0.5 * pound, 0.25 * square * 0.75 * 0.75),
            LumpedMass("at_A", "coupler", link.start, 0.1 * pound, 0.05 * square * 0.5 * 0.5),
            LumpedMass("at_B", "coupler", link.end, 0.1 * pound),
        ),
        outputs=tuple(Output(source.replace(".", "_"), source, source) for source in _SOURCES),
        held=("crank.angle",),
    )


def built(values: dict[str, float]) -> Mechanism:
    """The linkage with plain numbers."""
    return mechanism(SimpleNamespace(**values))


def cycle(values: dict[str, float], steps: int) -> tuple[dict[str, np.ndarray], Cycle]:
    """All outputs at the beginnings of the steps of a cycle, by name, and what the flexibility approach makes of them.

    It is given the motion that the engine has there, so that nothing but the bending is compared.
    """
    linked = built(values)
    simulation = Simulation(linked)
    n = 3 * len(linked.bodies)
    read, time, states, rates = [], [], [], []
    for step in range(steps):
        if step:
            simulation.advance(step * 2 * math.pi / values["speed"] / steps)
        read.append(simulation.read())
        time.append(simulation.time)
        states.append(simulation.field("y_at")[: 2 * n].copy())
        rates.append(simulation.field("dy_at")[: 2 * n].copy())
    y, dy = np.array(states), np.array(rates)
    names = tuple(f"{body.name}.{c}" for body in linked.bodies for c in ("x", "y", "angle"))
    motion = KinematicMotion(names, np.array(time), y[:, :n], y[:, n:], dy[:, n:])
    table = {name: np.array([one[name] for one in read]) for name in read[0]}
    return table, quasi_static(configurations(linkage(linked), motion))


MODEL = Model(
    name="PathGenerator",
    description="Four-bar path generator with elastic members",
    parameters=tuple(Parameter(name, value, name) for name, value in SI.items()),
    mechanism=mechanism,
    stop_time=0.12,
    step_size=1e-3,
)

"""The bending four-bar path generator in motion: the engine against the paper's case and the flexibility approach."""

import math

import numpy as np
import pytest

from mechanism_fmu.elastodynamics import configurations, inertia_forces, linkage, system_forces
from mechanism_fmu.kinematics import KinematicMotion
from mechanism_fmu.model import Output
from mechanism_fmu.simulation import Simulation
from tests.path_generator import SPEED, path_generator

MEMBERS = ("arm", "crank_bar", "link", "follower_bar")
DEFLECTIONS = ("x_deflection", "y_deflection", "rotation")
SOURCES = [
    *(f"{member}.{end}.{quantity}" for member in MEMBERS for end in ("start", "end") for quantity in DEFLECTIONS),
    *(f"{member}.{effort}" for member in MEMBERS for effort in ("axial_force", "start_moment", "end_moment")),
]
OUTPUTS = tuple(Output(source, source, "") for source in SOURCES)


@pytest.mark.parametrize(
    ("angle", "expected"),
    [
        (30, (0.0577198319228, -0.0239236983318, -0.0127808257008)),
        (60, (0.0197192762558, -0.0126183323705, -0.00389195051505)),
    ],
)
def test_case_2_of_the_paper(angle, expected):
    """Half of each link's mass at each end, and disks, at 500 rpm."""
    simulation = Simulation(path_generator(OUTPUTS))
    simulation.advance(math.radians(angle - 30) / SPEED)
    found = simulation.read()
    assert [found[f"arm.end.{q}"] for q in DEFLECTIONS] == pytest.approx(expected, rel=1e-8)


@pytest.fixture(scope="module")
def cycle():
    """Outputs every 10 deg of a cycle, and the motion that the engine had there."""
    mechanism = path_generator(OUTPUTS)
    simulation = Simulation(mechanism)
    n = 3 * len(mechanism.bodies)
    read, time, states, rates = [], [], [], []
    for step in range(36):
        if step:
            simulation.advance(step * math.radians(10) / SPEED)
        read.append(simulation.read())
        time.append(simulation.time)
        states.append(simulation.field("y_at")[: 2 * n].copy())
        rates.append(simulation.field("dy_at")[: 2 * n].copy())
    y, dy = np.array(states), np.array(rates)
    names = tuple(f"{body.name}.{c}" for body in mechanism.bodies for c in ("x", "y", "angle"))
    return read, configurations(
        linkage(mechanism), KinematicMotion(names, np.array(time), y[:, :n], y[:, n:], dy[:, n:])
    )


def test_the_engine_agrees_with_the_flexibility_approach_over_a_cycle(cycle):
    """Two ways to the same: all nodes with three displacements each here, released rotations eliminated there."""
    read, found = cycle
    load = system_forces(found, inertia_forces(found))
    force = np.einsum("tnm,tm->tn", found.transfer, load)
    displacement = np.einsum("tnm,tn->tm", found.transfer, force @ found.linkage.flexibility)
    ends = np.einsum("tekm,tm->tek", found.ends, displacement)
    for number, element in enumerate(found.linkage.elements):
        name = element.member.name
        angle = found.pose.position[:, found.pose.bodies.index(element.member.body), 2]
        (x, y), (x_end, y_end) = element.member.start, element.member.end
        angle = angle + math.atan2(y_end - y, x_end - x)
        cosine, sine = np.cos(angle), np.sin(angle)
        for end, first in (("start", 0), ("end", 3)):
            dx, dy, turn = (np.array([one[f"{name}.{end}.{q}"] for one in read]) for q in DEFLECTIONS)
            mine = np.stack([cosine * dx + sine * dy, cosine * dy - sine * dx, turn], 1)
            np.testing.assert_allclose(mine, ends[:, number, first : first + 3], rtol=1e-10, atol=1e-13)
        axial = np.array([one[f"{name}.axial_force"] for one in read])
        if "axial" in element.coordinates:
            column = next(iter(_columns(found, number)))
            np.testing.assert_allclose(axial, force[:, column], rtol=1e-10, atol=1e-10)


def _columns(found, number):
    before = sum(len(element.coordinates) for element in found.linkage.elements[:number])
    return range(before, before + len(found.linkage.elements[number].coordinates))

"""Sharp corners that meet sharp corners: the smallest cases from random worlds, with answers by hand."""

import math

import numpy as np
import pytest

from mechanism_fmu.model import GROUND, Body, Mechanism, MechanismError, Outline, OutlineContact, Output
from mechanism_fmu.simulation import Simulation
from tests.outlines_depth import Poses, depths, resting

FLOOR = Outline.polygon([(3.0, 0.0), (-3.0, 0.0), (-3.0, -1.0), (3.0, -1.0)])
#: What is above a table whose edge is at the origin, 1 m high.
TABLE = Outline.polygon([(0.0, 0.0), (-3.0, 0.0), (-3.0, -1.0), (0.0, -1.0)])


def moved(bodies: tuple[Body, ...], contacts: tuple, until: float, gravity: float) -> tuple[dict, Simulation]:
    """Numbers of a motion, seen at 400 times."""
    names = [f"{body.name}.{c}" for body in bodies for c in ("x", "y", "angle", "x_rate", "y_rate", "speed")]
    outputs = tuple(Output(name, name, "") for name in names)
    simulation = Simulation(Mechanism(bodies, contacts=contacts, gravity=(0.0, -gravity), outputs=outputs))
    rows = [simulation.read()]
    for k in range(1, 401):
        simulation.advance(until * k / 400)
        rows.append(simulation.read())
    return {name: np.array([row[name] for row in rows]) for name in names}, simulation


def poses(seen: dict, name: str) -> Poses:
    return Poses(seen[f"{name}.x"] + 1j * seen[f"{name}.y"], np.exp(1j * seen[f"{name}.angle"]))


def wedge() -> tuple[Outline, tuple[float, float]]:
    """A triangle that points to the right, with its tip down and its lower side off the floor; where its middle is."""
    corners = [0j, -0.15 + 0.15j, -0.2 + 0.02j]
    middle = sum(corners) / 3
    outline = Outline(tuple(((p - middle).real, (p - middle).imag, 0.0) for p in corners))
    return outline, (middle.real, middle.imag)


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("speed", [0.3, 3.0])
def test_tilted_tips_on_one_floor_do_not_pass_each_other(restitution: float, speed: float) -> None:
    """Two tips slide along a floor towards each other, tilted so that neither is ever inside the other body."""
    one, (x, y) = wedge()
    # the mirror image
    other = Outline(tuple((-vx, vy, 0.0) for vx, vy, _ in one.vertices[::-1]))
    gap = 0.05
    bodies = (
        Body("left", 1.0, 0.004, start=(x - gap, y, 0.0), start_rate=(speed, 0.0, 0.0)),
        Body("right", 1.0, 0.004, start=(gap - x, y, 0.0), start_rate=(-speed, 0.0, 0.0)),
    )
    contacts = (
        OutlineContact("a", bodies[0], GROUND, outline_i=one, outline_j=FLOOR, restitution=restitution, points=4),
        OutlineContact("b", bodies[1], GROUND, outline_i=other, outline_j=FLOOR, restitution=restitution, points=4),
        OutlineContact("c", *bodies, outline_i=one, outline_j=other, restitution=restitution, points=4),
    )
    seen, _ = moved(bodies, contacts, 0.2, 0.0)
    assert depths(one, poses(seen, "left"), other, poses(seen, "right")).max() < 1e-9
    tip = seen["left.x"] - (np.exp(1j * seen["left.angle"]) * complex(x, y)).real
    assert -speed * 0.2 / 400 < tip.max() <= 0.0
    # mirror images of each other all the time, and what they had to each other is turned round
    np.testing.assert_allclose(seen["left.x"], -seen["right.x"], atol=1e-7)
    # of both: where a tip slides along the other body, rounding says which of them it is
    energy = sum(
        seen[f"{body}.x_rate"] ** 2 + seen[f"{body}.y_rate"] ** 2 + 0.004 * seen[f"{body}.speed"] ** 2
        for body in ("left", "right")
    )
    assert (np.diff(energy) < 1e-9 * speed**2).all()
    if restitution == 1.0:
        np.testing.assert_allclose(energy, 2.0 * speed**2, rtol=1e-7)


def test_a_block_slides_flat_over_an_edge() -> None:
    """No impact where its front corner leaves the edge; it begins to turn when its middle is beyond that."""
    half = 0.1
    block = Outline.polygon([(half, half), (-half, half), (-half, -half), (half, -half)])
    speed = 0.5
    body = Body("block", 1.0, 2.0 / 3.0 * half**2, start=(-0.2, half, 0.0), start_rate=(speed, 0.0, 0.0))
    contact = OutlineContact("touch", body, GROUND, outline_i=block, outline_j=TABLE, restitution=0.5, points=4)
    seen, simulation = moved((body,), (contact,), 0.4, 9.81)
    flat = seen["block.x"] < 0.0
    np.testing.assert_allclose(seen["block.x"][flat], -0.2 + speed * np.linspace(0.0, 0.4, 401)[flat], atol=1e-9)
    np.testing.assert_allclose(seen["block.angle"][flat], 0.0, atol=1e-9)
    assert simulation.counters[0] == 0
    # no wider than its overhang, it has not turned
    assert seen["block.x"][-1] == pytest.approx(0.0, abs=1e-6)


def test_a_block_falls_over_an_edge() -> None:
    """Beyond its middle it turns about the edge, slides off it, and nothing is lost."""
    half = 0.1
    block = Outline.polygon([(half, half), (-half, half), (-half, -half), (half, -half)])
    body = Body("block", 1.0, 2.0 / 3.0 * half**2, start=(-0.2, half, 0.0), start_rate=(1.0, 0.0, 0.0))
    contact = OutlineContact("touch", body, GROUND, outline_i=block, outline_j=TABLE, points=4)
    seen, _ = moved((body,), (contact,), 0.5, 9.81)
    assert depths(block, poses(seen, "block"), TABLE, resting(401)).max() < 1e-9
    assert seen["block.angle"][-1] < -0.1
    energy = 0.5 * (seen["block.x_rate"] ** 2 + seen["block.y_rate"] ** 2) + 9.81 * seen["block.y"]
    energy = energy + half**2 / 3.0 * seen["block.speed"] ** 2
    np.testing.assert_allclose(energy, energy[0], rtol=1e-8)


def test_elements_that_cross_are_refused_where_no_corner_is_inside() -> None:
    """Two bars that lie across each other, one of them an open chain, have no corner inside."""
    bar = Outline.polygon([(0.5, 0.05), (-0.5, 0.05), (-0.5, -0.05), (0.5, -0.05)])
    body = Body("bar", 1.0, 0.1, start=(0.0, 0.0, math.pi / 2))
    for line in (bar, Outline(((0.5, 0.0, 0.0), (-0.5, 0.0, 0.0)), closed=False)):
        contact = OutlineContact("touch", body, GROUND, outline_i=bar, outline_j=line, points=4)
        with pytest.raises(MechanismError, match=r"inside|into"):
            Simulation(Mechanism((body,), contacts=(contact,)))

"""What goes around a corner, lies in a hollow, or comes off beside one: the smallest cases from random worlds."""

import math

import numpy as np
import pytest

from mechanism_fmu.model import GROUND, Body, Mechanism, Outline, OutlineContact, Output
from mechanism_fmu.simulation import Simulation
from tests.outlines_apart import Pose, nearest
from tests.outlines_depth import Poses, depths, resting

FLOOR = Outline.polygon([(3.0, 0.0), (-3.0, 0.0), (-3.0, -1.0), (3.0, -1.0)])


def run(
    outline: Outline, around: Outline, start: tuple[float, ...], rate: tuple[float, ...], until: float, **more: float
) -> tuple[dict[str, np.ndarray], Simulation]:
    """A body of 1 kg and 0.02 kg m2 against what is fixed, seen at 200 times; nothing is in anything."""
    body = Body("body", 1.0, 0.02, start=start, start_rate=rate)
    gravity = more.pop("gravity", 9.81)
    touch = OutlineContact("touch", body, GROUND, outline_i=outline, outline_j=around, points=4, **more)
    names = ("x", "y", "angle", "x_rate", "y_rate", "speed")
    outputs = tuple(Output(name, f"body.{name}", "") for name in names)
    simulation = Simulation(Mechanism((body,), contacts=(touch,), gravity=(0.0, -gravity), outputs=outputs))
    rows = [simulation.read()]
    for k in range(1, 201):
        simulation.advance(until * k / 200)
        rows.append(simulation.read())
    seen = {name: np.array([row[name] for row in rows]) for name in names}
    poses = Poses(seen["x"] + 1j * seen["y"], np.exp(1j * seen["angle"]))
    assert depths(outline, poses, around, resting(len(rows))).max() < 1e-9
    return seen, simulation


def test_a_body_rolls_from_its_corner_onto_the_arc_beside_it() -> None:
    """A Reuleaux triangle is as high in every position; on its corner it turns about that, on its arcs it rolls."""
    width = 0.2
    corners = [width / math.sqrt(3) * np.exp(1j * (math.pi / 2 + k * math.tau / 3)) for k in range(3)]
    bulge = math.tan(math.pi / 12)  # arcs of 60 degrees about the corner across
    outline = Outline(tuple((float(p.real), float(p.imag), bulge) for p in corners))
    # it stands on the corner that is 30 degrees off, and turns
    angle = math.pi / 3 - 0.2
    lowest = min((np.exp(1j * angle) * p).imag for p in corners)
    speed = 6.0
    centre = (0.0, -lowest)
    foot = min((np.exp(1j * angle) * p for p in corners), key=lambda p: p.imag)
    rate = (foot.imag * speed, -foot.real * speed, speed)  # the foot rests
    seen, simulation = run(outline, FLOOR, (*centre, angle), rate, 1.0, friction=5.0)
    energy = 0.5 * (seen["x_rate"] ** 2 + seen["y_rate"] ** 2) + 0.01 * seen["speed"] ** 2 + 9.81 * seen["y"]
    np.testing.assert_allclose(energy, energy[0], rtol=1e-8)
    for x, y, turned in zip(seen["x"], seen["y"], seen["angle"], strict=True):
        assert nearest(outline, Pose(x, y, turned), FLOOR, Pose()).distance < 1e-9
    assert simulation.counters[0] == 0
    assert np.ptp(seen["angle"]) > 2.0 * math.pi / 3


@pytest.mark.parametrize("restitution", [0.0, 0.5])
def test_a_flat_arc_bridges_the_hollow_beside_a_floor(restitution: float) -> None:
    """A nearly flat arc on a floor; its end meets the rounding between floor and wall while it is on the floor."""
    box = Outline.polygon([(-0.5, -0.5), (-0.5, 0.5), (0.5, 0.5), (0.5, -0.5)], 0.2, hole=True)
    blade = Outline(((-0.2, 0.0, math.tan(0.1 / 4)), (0.2, 0.0, 0.0), (0.0, 0.1, 0.0)))
    low = 0.2 * math.tan(0.1 / 4)
    seen, simulation = run(
        blade, box, (0.0, low - 0.5, 0.0), (-1.0, 0.0, 0.0), 1.0, restitution=restitution, friction=0.0
    )
    energy = 0.5 * (seen["x_rate"] ** 2 + seen["y_rate"] ** 2) + 0.01 * seen["speed"] ** 2 + 9.81 * seen["y"]
    assert (np.diff(energy) < 1e-8).all()
    assert simulation.counters[0] > 0


@pytest.mark.parametrize("turn", [0.0, 1.0, math.pi / 2, 2.5])
def test_a_pin_that_leaves_a_side_meets_the_round_end_with_its_other_half(turn: float) -> None:
    """It comes off the side of a slot right before its end, with another of its two arcs in front."""
    hole = Outline(((-0.1, -0.03, -1.0), (-0.1, 0.03, 0.0), (0.1, 0.03, -1.0), (0.1, -0.03, 0.0)), hole=True)
    pin = Outline.circle(0.025).moved(angle=turn)
    for place in np.linspace(0.06, 0.099, 14):
        seen, simulation = run(
            pin, hole, (place, -0.003, 0.0), (3.0, -3.0, 0.0), 0.1, restitution=1.0, gravity=0.0, friction=0.0
        )
        speed = np.hypot(seen["x_rate"], seen["y_rate"])
        np.testing.assert_allclose(speed, math.hypot(3.0, 3.0), rtol=1e-9)
        assert simulation.counters[0] > 2


@pytest.mark.parametrize("corner", [0.002, 0.02])
def test_a_rounded_block_comes_to_lie_flat(corner: float) -> None:
    """From one rounding it tilts onto the other: what strikes is that, and not the place where it begins."""
    half = 0.1
    block = Outline.polygon([(half, half), (-half, half), (-half, -half), (half, -half)], corner)
    for tilt in (1e-3, 3.7e-3, 0.02, 0.1):
        inner = half - corner
        lift = inner * (math.sin(tilt) + math.cos(tilt)) + corner
        seen, _ = run(block, FLOOR, (0.0, lift, tilt), (0.0, 0.0, 0.0), 0.5, restitution=0.3)
        assert seen["y"][-1] == pytest.approx(half, abs=1e-9)
        assert math.remainder(seen["angle"][-1], math.pi / 2) == pytest.approx(0.0, abs=1e-8)


@pytest.mark.parametrize("corner", [0.006, 0.012])
def test_a_rounded_block_slides_along_a_slot_to_its_end(corner: float) -> None:
    """Flat on the side, with the place where the side ends in front of its face, until it strikes the round end."""
    hole = Outline(((-0.1, -0.03, -1.0), (-0.1, 0.03, 0.0), (0.1, 0.03, -1.0), (0.1, -0.03, 0.0)), hole=True)
    half = 0.018
    block = Outline.polygon([(half, half), (-half, half), (-half, -half), (half, -half)], corner)
    seen, _ = run(block, hole, (-0.02, half - 0.03, 0.0), (0.3, 0.0, 0.0), 1.0)
    energy = 0.5 * (seen["x_rate"] ** 2 + seen["y_rate"] ** 2) + 0.01 * seen["speed"] ** 2 + 9.81 * seen["y"]
    assert (np.diff(energy) < 1e-8).all()
    assert max(seen["x"]) > 0.09


def test_a_disc_leaves_an_edge_once() -> None:
    """Where nothing presses any more; there, dense output and true step differ, and it once let go twice."""
    table = Outline.chain([(0.0, -1.0), (0.0, 0.0), (-1.0, 0.0)])
    radius, speed, gravity = 0.1, 0.3, 9.81
    body = Body("disc", 1.0, 0.005, start=(-0.2, radius, 0.0), start_rate=(speed, 0.0, 0.0))
    touch = OutlineContact("touch", body, GROUND, outline_i=Outline.circle(radius), outline_j=table)
    simulation = Simulation(
        Mechanism((body,), contacts=(touch,), gravity=(0.0, -gravity), outputs=(Output("y", "disc.y", ""),))
    )
    simulation.advance(0.96)
    hands_over, leaves = simulation.events_in_step()
    assert (hands_over.guard, leaves.guard) == ("touch.handover", "touch.force")
    assert hands_over.time == pytest.approx(0.2 / speed, abs=1e-10)
    # speed^2 + 2 g r (1 - cos) = g r cos, where the disc slides without friction about the edge
    again = Simulation(simulation._mechanism)
    again.advance(leaves.time)
    cosine = (speed**2 / (gravity * radius) + 2.0) / 3.0
    assert again.read()["y"] == pytest.approx(radius * cosine, abs=1e-9)

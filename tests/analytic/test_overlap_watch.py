"""The watch for overlaps against separating axes at special numbers: equal sizes, sides on sides, lattice places.

It is asked at the start, where nothing else decides, and in a motion whose state is written from outside.
"""

import random

import numpy as np
import pytest

from mechanism_fmu.model import GROUND, Body, Mechanism, MechanismError, Outline, OutlineContact
from mechanism_fmu.moving import SimulationError
from mechanism_fmu.simulation import Simulation
from tests.analytic.lattice_worlds import ANGLES, LATTICE, SIZES, Solid, box, teeth, trapezoid, triangle
from tests.separating_axes import Placed, deepest

#: Depth from which on an overlap is refused, and up to which there is none but for rounding [m].
REFUSED, NONE = 1.01e-9, 1e-12
POSES = 40


def draw(chance: random.Random) -> Solid:
    width, height = chance.choice(SIZES), chance.choice(SIZES)
    kinds = (  # a ring is an open chain, which has no inside
        box(width, height),
        triangle(width, height, chance.choice((0.0, width / 2, width))),
        trapezoid(width, height, chance.choice((0.25, -0.25)) * width),
        teeth(width, height),
    )
    return chance.choice(kinds)


def pair(one: Solid, other: Solid, points: int = 20) -> Simulation:
    """A body far from a fixed one."""
    body = Body("body", 1.0, 1.0, start=(100.0, 0.0, 0.0), start_rate=(0.0, -0.1, 0.0))
    contact = OutlineContact(
        "pair", body, GROUND, outline_i=one.outline, outline_j=other.outline, restitution=0.5, points=points
    )
    return Simulation(Mechanism((body,), contacts=(contact,)))


def refuses(simulation: Simulation, pose: tuple[float, float, float]) -> bool:
    simulation.field("body_start")[0] = pose
    try:
        simulation.begin(0.0)
    except MechanismError as error:
        return "inside" in str(error)
    return False


def compare(seed: int, pairs: int) -> tuple[int, int]:
    """So many pairs, each at `POSES` poses of the lattice; the numbers of poses apart and overlapping."""
    chance = random.Random(seed)
    apart = overlapping = 0
    for _ in range(pairs):
        one, other = draw(chance), draw(chance)
        simulation = pair(one, other)
        fixed = Placed(other.pieces, 0j, 1.0 + 0j)
        low = np.concatenate(other.pieces)
        corner = complex(low.real.min(), low.imag.min())
        for _ in range(POSES):
            angle = chance.choice(ANGLES)
            turn = complex(np.cos(angle), np.sin(angle))
            rotated = turn * np.concatenate(one.pieces)
            offset = LATTICE * complex(chance.randint(-7, 7), chance.randint(-7, 7))
            offset += 1j * chance.choice((0.0, 0.0, 1e-6, -1e-6, 2e-9, -2e-9))
            origin = corner + offset - complex(rotated.real.min(), rotated.imag.min())
            depth = deepest(Placed(one.pieces, origin, turn), fixed)
            says = refuses(simulation, (origin.real, origin.imag, angle))
            where = f"{one.kind} at {origin.real!r}, {origin.imag!r}, {angle} in {other.kind}: {depth:.3g} m"
            if depth > REFUSED:
                overlapping += 1
                assert says, where
            elif depth < NONE:
                apart += 1
                assert not says, where
    return apart, overlapping


def test_poses_of_the_lattice() -> None:
    apart, overlapping = compare(1, 20)
    assert apart > 200
    assert overlapping > 200


@pytest.mark.slow
def test_four_thousand_poses_of_the_lattice() -> None:
    compare(2, 100)


def test_a_shape_in_its_own_place() -> None:
    for solid in (box(0.2, 0.2), triangle(0.2, 0.2, 0.1), trapezoid(0.2, 0.2, 0.05)):
        assert refuses(pair(solid, solid), (0.0, 0.0, 0.0))
    whole = Solid("disc", Outline.circle(0.1), ())
    assert refuses(pair(whole, whole), (0.0, 0.0, 0.0))


@pytest.mark.parametrize("depth", [2e-9, 1e-6, 0.01, 0.05])
def test_sides_on_sides_in_a_motion(depth: float) -> None:
    """An overlap with no corner inside and no crossing ends the next step, whatever is bound."""
    solid = box(0.1, 0.1)
    simulation = pair(solid, solid)
    simulation.field("body_start")[0] = (0.0, 0.2, 0.0)
    simulation.begin(0.0)
    simulation.field("y_end")[1] = 0.1 - depth
    with pytest.raises(SimulationError, match="gone into each other") as caught:
        simulation.advance(1e-3)
    assert "'pair'" in str(caught.value)

"""The gap of two outlines against an independent distance, at random poses of random outlines."""

import math
import random

import pytest

from mechanism_fmu.model import GROUND, Body, CircularCopies, Mechanism, MechanismError, Outline, OutlineContact, Output
from mechanism_fmu.simulation import Simulation
from tests.outlines_apart import Pose, nearest, overlap

POSES = 50


def random_outline(chance: random.Random) -> Outline:
    """A star of three to eight corners about a random centre, some of its edges arcs, some hollow."""
    count = chance.randint(3, 8)
    size = 10 ** chance.uniform(-3.0, 0.5)
    turn, x, y = chance.uniform(0.0, math.tau), chance.uniform(-1.0, 1.0) * size, chance.uniform(-1.0, 1.0) * size
    vertices = []
    for k in range(count):
        angle, radius = turn + math.tau * (k + chance.uniform(-0.2, 0.2)) / count, size * chance.uniform(0.5, 1.0)
        bulge = chance.choice((0.0, 0.0, chance.uniform(-0.15, -0.02), chance.uniform(0.02, 0.35)))
        vertices.append((x + radius * math.cos(angle), y + radius * math.sin(angle), bulge))
    return Outline(tuple(vertices))


def gap_of(one: Outline, other: Outline, **more: object) -> Simulation:
    body = Body("body", 1.0, 1.0, start=(100.0, 0.0, 0.0))
    contact = OutlineContact("pair", body, GROUND, outline_i=one, outline_j=other, **more)
    return Simulation(Mechanism((body,), contacts=(contact,), outputs=(Output("gap", "pair.gap", ""),)))


def reach(outline: Outline) -> float:
    return max(math.hypot(x, y) for x, y, _ in outline.vertices)


def compare(seed: int, pairs: int) -> tuple[int, int]:
    """So many pairs, each at `POSES` poses; how many were apart, and how many overlapped."""
    chance = random.Random(seed)
    apart = inside = 0
    for _ in range(pairs):
        one, other = random_outline(chance), random_outline(chance)
        simulation = gap_of(one, other)
        far = reach(one) + reach(other)
        for _ in range(POSES):
            pose = Pose(chance.uniform(-far, far), chance.uniform(-far, far), chance.uniform(-4.0, 4.0))
            simulation.field("body_start")[0] = pose
            asked = nearest(one, pose, other, Pose())
            if asked.distance == 0.0 or overlap(one, pose, other, Pose()):
                inside += 1
                with pytest.raises(MechanismError, match="starts with a contact point inside"):
                    simulation.begin(0.0)
                continue
            apart += 1
            simulation.begin(0.0)
            assert simulation.read()["gap"] == pytest.approx(asked.distance, rel=1e-12, abs=1e-12 * max(far, 1.0))
    return apart, inside


def test_gaps_of_random_pairs() -> None:
    apart, inside = compare(1, 12)
    assert apart > 100
    assert inside > 50


@pytest.mark.slow
def test_gaps_of_ten_thousand_random_pairs() -> None:
    apart, inside = compare(2, 400)
    assert apart > 10_000
    assert inside > 1_000


@pytest.mark.parametrize("count", [1, 7, 30])
def test_a_copy_is_what_it_would_be_written_out(count: int) -> None:
    chance = random.Random(count)
    tooth = Outline.polygon([(1.0, -0.02), (1.08, 0.0), (1.0, 0.02)], corner_radius=(0.0, 0.003, 0.0))
    pin = Outline.circle(0.03)
    of_copies = gap_of(pin, tooth, copies=CircularCopies(count))
    for _ in range(100):
        far, angle = chance.uniform(1.12, 1.5), chance.uniform(-math.pi, math.pi)
        pose = Pose(far * math.cos(angle), far * math.sin(angle), chance.uniform(-4.0, 4.0))
        of_copies.field("body_start")[0] = pose
        of_copies.begin(0.0)
        written = min(nearest(pin, pose, tooth, Pose(0, 0, math.tau * k / count)).distance for k in range(count))
        assert of_copies.read()["gap"] == pytest.approx(written, rel=1e-12, abs=1e-12)

"""Bodies of random outlines that tumble in a box: nothing goes into anything, and no energy comes from anywhere."""

import math
import random
from itertools import combinations

import pytest

from mechanism_fmu.model import GROUND, Body, Mechanism, Outline, OutlineContact, Output
from mechanism_fmu.simulation import Simulation
from tests.outlines_apart import Pose, overlap

BOX = Outline.polygon([(0.0, 0.0), (0.0, 1.0), (1.0, 1.0), (1.0, 0.0)], hole=True)
#: How deep a body may be in another one [m].
TOLERANCE = 1e-9


def tumbler(chance: random.Random) -> Outline:
    """A body of about 0.1 m: a star with hollow corners, a rounded polygon, or one of arcs."""
    kind = chance.choice(("star", "rounded", "arcs"))
    count = chance.randint(3, 6)
    turn = chance.uniform(0.0, math.tau)
    points, bulges = [], []
    for k in range(count):
        angle = turn + math.tau * k / count
        radius = 0.1 * (chance.uniform(0.5, 1.0) if kind == "star" else 1.0)
        points.append((radius * math.cos(angle), radius * math.sin(angle)))
        bulges.append(chance.uniform(-0.2, 0.2) if kind == "arcs" else 0.0)
    if kind == "rounded":
        return Outline.polygon(points, corner_radius=0.01)
    return Outline(tuple((*point, bulge) for point, bulge in zip(points, bulges, strict=True)))


def world(seed: int, bodies: int, restitution: float, **more: float) -> Simulation:
    """A box with some bodies, thrown."""
    chance = random.Random(seed)
    made, outlines = [], []
    for k in range(bodies):
        outline = tumbler(chance)
        made.append(
            Body(
                f"body_{k}",
                *(1.0, 0.003),
                start=(0.25 + 0.5 * (k % 2), 0.25 + 0.5 * (k // 2), chance.uniform(0.0, math.tau)),
                start_rate=(chance.uniform(-3.0, 3.0), chance.uniform(-3.0, 3.0), chance.uniform(-20.0, 20.0)),
            )
        )
        outlines.append(outline)
    contacts = [
        OutlineContact(
            f"wall_{k}", body, GROUND, outline_i=outline, outline_j=BOX, restitution=restitution, points=4, **more
        )
        for k, (body, outline) in enumerate(zip(made, outlines, strict=True))
    ]
    for (k, one), (m, other) in combinations(enumerate(made), 2):
        contacts.append(
            OutlineContact(
                f"pair_{k}_{m}",
                one,
                other,
                outline_i=outlines[k],
                outline_j=outlines[m],
                restitution=restitution,
                **more,
            )
        )
    shown = [Output(f"{b.name}.{c}", f"{b.name}.{c}", "") for b in made for c in ("x", "y", "angle")]
    shown += [Output(f"energy.{e}", f"energy.{e}", "") for e in ("kinetic", "work", "lost")]
    mechanism = Mechanism(tuple(made), contacts=tuple(contacts), gravity=(0.0, -9.81), outputs=tuple(shown))
    simulation = Simulation(mechanism)
    simulation.outlines = outlines
    return simulation


def poses(simulation: Simulation) -> list[Pose]:
    seen = simulation.read()
    return [Pose(*(seen[f"body_{k}.{c}"] for c in ("x", "y", "angle"))) for k in range(len(simulation.outlines))]


def deepest(simulation: Simulation) -> float:
    """How deep any body is in another one or in a wall, by an independent look [m]."""
    placed = [*zip(simulation.outlines, poses(simulation), strict=True), (BOX, Pose())]
    found = (overlap(*one, *other) for one, other in combinations(placed, 2))
    return max((one.depth for one in found if one is not None), default=0.0)


def check(seed: int, bodies: int, restitution: float, until: float, **more: float) -> int:
    """Let it tumble, look into it sixty times; the number of impacts."""
    simulation = world(seed, bodies, restitution, **more)
    first = total = simulation.read()["energy.kinetic"]
    for k in range(1, 61):
        simulation.advance(until * k / 60)
        assert deepest(simulation) < TOLERANCE
        seen = simulation.read()
        now = seen["energy.kinetic"] - seen["energy.work"]
        assert now <= total + 1e-7 * first
        total = now
        assert seen["energy.lost"] >= -1e-12 * first
        assert now + seen["energy.lost"] == pytest.approx(first, rel=1e-6)
    if restitution == 1.0:
        assert total == pytest.approx(first, rel=1e-6)
    return int(simulation.counters[0])


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("seed", range(4))
def test_bodies_tumble_in_a_box(seed: int, restitution: float) -> None:
    assert check(seed, 1 + seed % 3, restitution, 0.6) > 0


@pytest.mark.parametrize("seed", range(3))
def test_bodies_tumble_with_friction(seed: int) -> None:
    assert check(seed, 2, 0.3, 0.6, friction=0.3) > 0

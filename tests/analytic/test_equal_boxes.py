"""Boxes of equal width: corners that stand on corners exactly rest, slide past each other, and fall over.

Depths are those of an independent separating-axis test at every communication point.
"""

from __future__ import annotations

import math
import random
from itertools import pairwise

import numpy as np
import pytest

from mechanism_fmu.model import GROUND, Body, Force, Mechanism, Outline, OutlineContact
from mechanism_fmu.simulation import Result, simulate
from tests.separating_axes import Placed, deepest

GRAVITY = 9.81
WIDTH, HEIGHT = 0.2, 0.1
FLOOR = Outline.chain([(5.0, 0.0), (-5.0, 0.0)])


def rectangle(width: float = WIDTH, height: float = HEIGHT) -> list[tuple[float, float]]:
    """Return the corners of a rectangle about its middle."""
    u, v = width / 2, height / 2
    return [(-u, -v), (u, -v), (u, v), (-u, v)]


def placed(result: Result, name: str, corners: list[tuple[float, float]]) -> Placed:
    """Return a body at all times of a run."""
    x, y, angle = (np.asarray(result[f"{name}_{c}"]) for c in ("x", "y", "angle"))
    return Placed((np.array([complex(*p) for p in corners]),), x + 1j * y, np.exp(1j * angle))


def stack(
    count: int, friction: float, drop: float = 0.0, push: float = 0.0, restitution: float = 0.0
) -> tuple[Mechanism, list[str]]:
    """Return blocks of 1 kg on each other, `drop` [m] apart; a force `push` [N] acts on the one in the middle."""
    inertia = (WIDTH**2 + HEIGHT**2) / 12
    blocks = [
        Body(f"block_{k}", 1.0, inertia, start=(0.0, (k + 0.5) * HEIGHT + (k + 1) * drop, 0.0)) for k in range(count)
    ]
    outline = Outline.polygon(rectangle())
    law = {"friction": friction, "restitution": restitution}
    contacts = [
        OutlineContact(f"floor_{k}", block, GROUND, outline_i=outline, outline_j=FLOOR, **law)
        for k, block in enumerate(blocks)
        if k == 0 or push
    ]
    contacts += [
        OutlineContact(f"joint_{k}", upper, lower, outline_i=outline, outline_j=outline, **law)
        for k, (lower, upper) in enumerate(pairwise(blocks))
    ]
    forces = (Force("push", blocks[count // 2], force=(push, 0.0)),) if push else ()
    mechanism = Mechanism(tuple(blocks), forces=forces, contacts=tuple(contacts), gravity=(0.0, -GRAVITY))
    return mechanism, [block.name for block in blocks]


def run(mechanism: Mechanism, names: list[str], until: float, *more: str) -> Result:
    """Return places, and how deep no two neighbours overlap."""
    outputs = tuple(f"{name}.{c}" for name in names for c in ("x", "y", "angle")) + more
    return simulate(mechanism, until, step=until / 50, outputs=outputs)


def overlap(result: Result, names: list[str]) -> float:
    """Return the deepest overlap of equal blocks that stood on each other, and of any with the floor [m]."""
    blocks = [placed(result, name, rectangle()) for name in names]
    lowest = min(float((b.origin[:, None] + b.turn[:, None] * b.pieces[0]).imag.min()) for b in blocks)
    return max(-lowest, *(deepest(a, b) for a, b in pairwise(blocks)))


@pytest.mark.parametrize(
    ("count", "until"), [(3, 10.0), (10, 1.0), pytest.param(30, 10.0, marks=pytest.mark.slow)], ids=str
)
@pytest.mark.parametrize("friction", [0.0, 0.5])
def test_equal_blocks_stand_on_each_other(count: int, until: float, friction: float) -> None:
    mechanism, names = stack(count, friction)
    result = run(mechanism, names, until, "energy.kinetic", "floor_0.force")
    for k, name in enumerate(names):
        assert np.abs(result[f"{name}_y"] - (k + 0.5) * HEIGHT).max() < 1e-9
        assert np.abs(result[f"{name}_x"]).max() < 1e-9
    assert np.max(result["kinetic_energy"]) < 1e-18
    # Without friction nothing holds a block aside: rounding moves it by some 1e-10 m in 10 s, which a corner passes.
    assert not [event for event in result.events if friction > 0.0 or not event.guard.endswith(".handover")]


@pytest.mark.parametrize("count", [3, 10, pytest.param(30, marks=pytest.mark.slow)])
@pytest.mark.parametrize("friction", [0.0, 0.5])
def test_equal_blocks_settle_from_a_millimetre(count: int, friction: float) -> None:
    mechanism, names = stack(count, friction, drop=1e-3)
    result = run(mechanism, names, 0.2 if count < 30 else 0.5, "energy.kinetic")
    heights = [result[f"{name}_y"][-1] for name in names]
    np.testing.assert_allclose(heights, [(k + 0.5) * HEIGHT for k in range(count)], rtol=0.0, atol=1e-9 * count)
    assert result["kinetic_energy"][-1] < 1e-15
    assert overlap(result, names) < 1e-9
    # each falls on what has come to rest below it, its own millimetres deeper
    first = {event.guard: event.time for event in result.events[::-1]}
    assert first["floor_0.gap"] == pytest.approx(math.sqrt(2e-3 / GRAVITY), abs=1e-9)


@pytest.mark.parametrize(
    "count", [3, pytest.param(10, marks=pytest.mark.slow), pytest.param(30, marks=pytest.mark.slow)]
)
def test_equal_blocks_fall_over_when_pushed(count: int) -> None:
    """A force that overturns what is above the floor, and does not let it slide."""
    # about the edge below: force times its height against weight times half a width
    height = (count // 2 + 0.5) * HEIGHT
    push = 1.3 * count * GRAVITY * WIDTH / 2 / height
    assert push < 0.8 * count * GRAVITY or count == 3
    mechanism, names = stack(count, 0.8 if count > 3 else 2.0, push=push)
    # 30 turn by 0.02 (cosh(2.2 t) - 1) rad, t in s: beyond 0.13 rad their weight overturns them, too. From 0.4 rad on
    # too many of their contacts are at the bound of friction for a choice.
    until, turned = (1.0, 0.5) if count < 30 else (1.65, 0.3)
    result = run(mechanism, names, until)
    assert overlap(result, names) < 1e-9
    assert min(result[f"{name}_angle"].min() for name in names) < -turned


@pytest.mark.parametrize("restitution", [0.0, 0.2, 1.0])
@pytest.mark.parametrize("friction", [0.0, 0.4, 0.8])
@pytest.mark.parametrize("free", [False, True])
def test_an_equal_box_slides_off_without_going_in(free: bool, friction: float, restitution: float) -> None:
    """At rest, to either side, turned by a right angle; on a pedestal and on a box."""
    for speed in (0.0, 0.5, -1.0):
        for angle in (0.0, math.pi / 2):
            square = rectangle(0.2, 0.2)
            outline = Outline.polygon(square)
            lower = Body("lower", 1.0, 1.0 / 150, start=(0.0, 0.1, angle))
            upper = Body("upper", 1.0, 1.0 / 150, start=(0.0, 0.3, 0.0), start_rate=(speed, 0.0, 0.0))
            law = {"friction": friction, "restitution": restitution}
            fixed = Outline.polygon([(x, y + 0.1) for x, y in square])
            contacts = [OutlineContact("between", upper, lower, outline_i=outline, outline_j=outline, **law)]
            contacts += [
                OutlineContact(f"{body.name}_floor", body, GROUND, outline_i=outline, outline_j=FLOOR, **law)
                for body in (lower, upper)
            ]
            bodies, names = (lower, upper), ["lower", "upper"]
            if not free:
                contacts = [OutlineContact("between", upper, GROUND, outline_i=outline, outline_j=fixed, **law)]
                bodies, names = (upper,), ["upper"]
            mechanism = Mechanism(bodies, contacts=tuple(contacts), gravity=(0.0, -GRAVITY))
            # what is elastic and rubs ends in bounces without number
            until = 0.6 if restitution < 1.0 or friction == 0.0 else 0.05
            result = run(mechanism, names, until, "energy.kinetic")
            boxes = [placed(result, name, square) for name in names]
            if not free:
                boxes.append(Placed((np.array([complex(x, y + 0.1) for x, y in square]),), 0j, 1.0 + 0j))
            assert deepest(*boxes) < 1e-9
            energy = result["kinetic_energy"] + sum(GRAVITY * np.asarray(result[f"{name}_y"]) for name in names)
            assert (energy - np.minimum.accumulate(energy)).max() < 1e-7
            if not free and friction == 0.0:  # level until its middle is beyond the edge
                time = np.asarray(result["time"])
                level = np.abs(speed) * time < 0.1 - 1e-9
                np.testing.assert_allclose(result["upper_x"][level], speed * time[level], atol=1e-9)
                np.testing.assert_allclose(result["upper_y"][level], 0.3, atol=1e-9)
                np.testing.assert_allclose(result["upper_angle"][level], 0.0, atol=1e-9)
                assert speed == 0.0 or result["upper_y"][-1] < 0.3 - 1e-3


@pytest.mark.parametrize("speed", [0.0, 0.5, -1.0])
@pytest.mark.parametrize("beside", [0.2, -0.2])
def test_a_box_falls_along_an_equal_one(beside: float, speed: float) -> None:
    """From corner at corner, flat along the side: free fall, until it comes to rest on the floor."""
    square = rectangle(0.2, 0.2)
    outline = Outline.polygon(square)
    box = Body("box", 1.0, 1.0 / 150, start=(beside, 0.3, 0.0), start_rate=(0.0, min(speed, 0.0), 0.0))
    fixed = Outline.polygon([(x, y + 0.1) for x, y in square])
    contacts = (
        OutlineContact("side", box, GROUND, outline_i=outline, outline_j=fixed),
        OutlineContact("floor", box, GROUND, outline_i=outline, outline_j=FLOOR),
    )
    result = run(Mechanism((box,), contacts=contacts, gravity=(0.0, -GRAVITY)), ["box"], 0.5)
    time, start = np.asarray(result["time"]), min(speed, 0.0)
    solid = Placed((np.array([complex(x, y + 0.1) for x, y in square]),), 0j, 1.0 + 0j)
    assert deepest(placed(result, "box", square), solid) < 1e-9
    if not result.events or result.events[0].guard != "side.gap" or result["box_angle"][-1] == 0.0:
        fall = np.maximum(0.3 + start * time - 0.5 * GRAVITY * time**2, 0.1)
        np.testing.assert_allclose(result["box_y"], fall, atol=1e-8)


def random_polygon(chance: random.Random) -> list[tuple[float, float]]:
    """Return a convex polygon that stands on a side from (-0.1, 0) to (0.1, 0), or a narrower one."""
    half = chance.choice((0.1, 0.1, 0.1, 0.05, chance.uniform(0.05, 0.1)))
    top = chance.choice((half, 0.5 * half, 0.1))
    height = chance.choice((0.1, 0.2, chance.uniform(0.05, 0.2)))
    return [(-half, 0.0), (half, 0.0), (top, height), (-top, height)]


def test_any_two_polygons_land_flat_on_each_other() -> None:
    """Of equal and other widths, centred and aligned at a corner, from any height: each comes to rest where it is."""
    chance = random.Random(46)
    for case in range(40):
        lower, upper = random_polygon(chance), random_polygon(chance)
        half, own = lower[2][0], upper[1][0]
        aside = chance.choice((0.0, half - own, own - half))
        drop = chance.choice((0.0, 1e-3, chance.uniform(0.0, 0.2)))
        height = lower[2][1]
        area = Outline.polygon(upper).area()
        centre = area.first[1] / area.area
        outline = Outline.polygon(upper).moved(0.0, -centre)
        body = Body("body", 1.0, 0.01, start=(aside, height + drop + centre, 0.0))
        contact = OutlineContact(
            "c", body, GROUND, outline_i=outline, outline_j=Outline.polygon(lower), friction=chance.choice((0.0, 0.5))
        )
        result = run(Mechanism((body,), contacts=(contact,), gravity=(0.0, -GRAVITY)), ["body"], 0.5)
        assert abs(aside) > half or result["body_y"][-1] == pytest.approx(height + centre, abs=1e-9), case
        assert abs(aside) > half or result["body_angle"][-1] == pytest.approx(0.0, abs=1e-9), case

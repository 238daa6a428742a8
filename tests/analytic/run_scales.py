"""Mechanisms in other scales, over the full range: python -m tests.analytic.run_scales [draws] [first].

The 16 models and random mechanisms, with masses 4^k times larger, and with lengths 4^k and times 2^k times larger, k
from -10 to 10: the same bits. By other factors, masses 1e-12 to 1e12, lengths 1e-6 to 1e4: 1e-8 times an amplification,
which is measured by lengths that are 1e-9 larger than times and masses say.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import numpy as np

from mechanism_fmu.model import (
    GROUND,
    AngleStop,
    Body,
    Brake,
    Contact,
    Mechanism,
    OutlineContact,
    PointLineContact,
    Revolute,
    SpringDamper,
    Torque,
    TorsionSpringDamper,
    Translational,
    disc,
    rigid_body,
)
from mechanism_fmu.model.outlines import Outline
from mechanism_fmu.simulation import Result, simulate

if __package__:
    from .scaled import Scales, compare
else:
    from scaled import Scales, compare

MODELS = sorted(path.parent.name for path in (Path(__file__).parents[2] / "models").glob("*/model.py"))
#: Powers of 4 for masses and lengths, of 2 for times with them.
POWERS = (-10, -7, -4, -1, 1, 4, 7, 10)


def exact_scales(powers: tuple[int, ...] = POWERS) -> Iterator[Scales]:
    """Scales that round nothing."""
    for k in powers:
        yield Scales(mass=4.0**k)
        yield Scales(length=4.0**k, time=2.0**k)


def any_scales(rng: np.random.Generator) -> Scales:
    """Scales that round, with gravity as it is."""
    length = 10.0 ** rng.uniform(-6, 4)
    return Scales(10.0 ** rng.uniform(-12, 12), length, math.sqrt(length))


def of_model(name: str, part: float) -> tuple[Mechanism, float]:
    """A model of the library, and a part of the time in which it runs [s]."""
    model = import_module(f"models.{name}.model").MODEL
    return model.build(model.values()), model.stop_time * part


def of_draw(seed: int) -> tuple[Mechanism, float]:
    """A random mechanism, and a time in which some things happen [s]."""
    rng = np.random.default_rng(seed)
    kind = (_chain, _lever, _box, _slider, _discs)[seed % 5]
    return kind(rng), float(rng.uniform(0.3, 1.0))


def _of_contacts(rng: np.random.Generator) -> dict[str, float]:
    return {"restitution": float(rng.choice([0.0, 0.3, 0.7])), "friction": float(rng.choice([0.0, 0.3]))}


def _chain(rng: np.random.Generator) -> Mechanism:
    """A pendulum of one to four links, whose tip strikes a wall."""
    bodies: list[Body] = []
    joints: list[Revolute] = []
    x = y = 0.0
    end, point = GROUND, (0.0, 0.0)
    for k in range(rng.integers(1, 5)):
        long, angle = rng.uniform(0.1, 0.4), rng.uniform(-2.5, -0.6)
        mass = rng.uniform(0.2, 2.0)
        middle = (x + 0.5 * long * math.cos(angle), y + 0.5 * long * math.sin(angle))
        body = Body(f"link{k}", mass, mass * long**2 / 12, (*middle, angle))
        joints.append(Revolute(f"pin{k}", body.name, (-0.5 * long, 0.0), end, point))
        bodies.append(body)
        end, point = body.name, (0.5 * long, 0.0)
        x, y = x + long * math.cos(angle), y + long * math.sin(angle)
    wall = PointLineContact(
        "wall", end, point, GROUND, (x - rng.uniform(0.02, 0.2), 0.0), (1.0, 0.0), **_of_contacts(rng)
    )
    held = tuple(body.angle for body in bodies)
    return Mechanism(tuple(bodies), tuple(joints), contacts=(wall,), gravity=(0.0, -9.81), held=held)


def _lever(rng: np.random.Generator) -> Mechanism:
    """A lever between two stops, by a torque against a spring and a brake."""
    body = rigid_body("lever", (0, 0), mass=rng.uniform(0.1, 1.0), inertia=rng.uniform(1e-3, 1e-2))
    torque = rng.uniform(0.05, 0.5)
    forces = (
        Torque("motor", body, torque=torque),
        TorsionSpringDamper("spring", body, stiffness=rng.uniform(0, 1), damping=rng.uniform(0, 0.01)),
        Brake("brake", body, limit=rng.uniform(0, 1.5) * torque),
    )
    stops = (
        AngleStop("low", body, GROUND, angle=0.0, restitution=float(rng.choice([0.0, 0.5]))),
        AngleStop("high", GROUND, body, angle=-rng.uniform(0.1, 0.5), restitution=float(rng.choice([0.0, 0.5]))),
    )
    return Mechanism((body,), (Revolute("pin", body.at(0, 0), GROUND.at(0, 0)),), forces, stops)


def _box(rng: np.random.Generator) -> Mechanism:
    """A block that is thrown on a floor with a step."""
    a, b = rng.uniform(0.05, 0.2, 2)
    corners = Outline.polygon([(-a, -b), (a, -b), (a, b), (-a, b)])
    mass = rng.uniform(0.2, 2.0)
    start = (0.0, rng.uniform(0.25, 0.4), rng.uniform(0, 3))
    rates = (rng.uniform(-1, 1), 0.0, rng.uniform(-3, 3))
    body = Body("box", mass, mass * (a * a + b * b) / 3, start, rates)
    floor = Outline.polygon([(-9, -1), (9, -1), (9, 0), (0.5, 0), (0.5, 0.05), (-9, 0.05)])
    contact = OutlineContact("floor", body, GROUND, outline_i=corners, outline_j=floor, points=3, **_of_contacts(rng))
    return Mechanism((body,), contacts=(contact,), gravity=(0.0, -9.81))


def _slider(rng: np.random.Generator) -> Mechanism:
    """A slider with friction between a damped spring and a bumper."""
    body = rigid_body("slider", (0, 0), mass=rng.uniform(0.2, 2.0), inertia=1e-3, velocity=(rng.uniform(-2, 2), 0.0))
    guide = Translational("guide", GROUND.line((0, 0), (1, 0)), body.line((0, 0), (1, 0)), friction=rng.uniform(0, 0.3))
    spring = SpringDamper(
        "spring", body.at(0, 0), GROUND.at(-0.5, 0), stiffness=rng.uniform(5, 50), damping=rng.uniform(0, 1),
        free_length=rng.uniform(0.3, 0.7),
    )  # fmt: skip
    side = PointLineContact("wall", body.at(0, 0), GROUND.line((0.1, 0), (0, 1)), restitution=0.5)
    return Mechanism((body,), (guide,), (spring,), (side,), gravity=(0.0, -9.81))


def _discs(rng: np.random.Generator) -> Mechanism:
    """Two or three discs that fall on a slope, of very different masses."""
    bodies: list[Body] = []
    contacts: list[Contact] = []
    ground = Outline.chain([(9.0, rng.uniform(-1, 1)), (-9.0, 0.0)])
    for k in range(rng.integers(2, 4)):
        radius = rng.uniform(0.02, 0.1)
        body = disc(f"disc{k}", (0.3 * k, rng.uniform(0.7, 0.9)), radius=radius, mass=10.0 ** rng.uniform(-3, 1))
        circle = Outline.circle(radius)
        contacts.append(
            OutlineContact(f"floor{k}", body, GROUND, outline_i=circle, outline_j=ground, **_of_contacts(rng))
        )
        bodies.append(body)
    return Mechanism(tuple(bodies), contacts=tuple(contacts), gravity=(0.0, -9.81))


def run(mechanism: Mechanism, until: float, step: float) -> Result:
    """The motion with all default outputs."""
    return simulate(mechanism, until=until, step=step)


def deviations(mechanism: Mechanism, until: float, scales: Iterator[Scales]) -> Iterator[tuple[Scales, float, str]]:
    """How far a motion is another one in other scales, and where."""
    for one in scales:
        off, where = compare(mechanism, one, until, until / 20, run)
        yield one, off, where


def amplification(mechanism: Mechanism, until: float) -> float:
    """How much the motion changes when its numbers do, over that change."""
    off, _ = compare(mechanism, Scales(length=1.0 + 1e-9), until, until / 20, run)
    return max(off / 1e-9, 1.0)


def main(draws: int, first: int) -> None:
    """Print what deviates."""
    cases = [(name, *of_model(name, 0.1)) for name in MODELS]
    cases += [(f"draw {seed}", *of_draw(seed)) for seed in range(first, first + draws)]
    exact = inexact = beyond = 0
    for name, mechanism, until in cases:
        for scales, off, where in deviations(mechanism, until, exact_scales()):
            exact += off == 0.0
            inexact += off != 0.0
            if off:
                print(f"{name}: {scales}: {off:.2g} {where}", flush=True)
        rng = np.random.default_rng(len(name) + int(1000 * until))
        for scales, off, where in deviations(mechanism, until, (any_scales(rng) for _ in range(3))):
            if off > 1e-8:
                most = amplification(mechanism, until)
                print(f"{name}: {scales}: {off:.2g} {where}, amplification {most:.2g}", flush=True)
                beyond += off > 1e-8 * most
    print(f"{len(cases)} mechanisms: {exact} runs have the same bits, {inexact} not; {beyond} are off by more")


if __name__ == "__main__":
    main(*(int(text) for text in [*sys.argv[1:], "200", "0"][:2]))

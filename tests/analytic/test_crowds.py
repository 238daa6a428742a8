"""Mechanisms that have nothing to do with each other move in a crowd as each does alone: to the number of its bounces.

Their events fall into each other's last hops, which are as low as what counts as touching.
"""

import numpy as np
import pytest

from mechanism_fmu.model import (
    GROUND,
    Brake,
    Mechanism,
    Output,
    PointLineContact,
    Revolute,
    Settings,
    Translational,
    rigid_body,
)
from mechanism_fmu.simulation import simulate
from mechanism_fmu.tolerances import ROOT_TOLERANCE

FLOOR = GROUND.line((0.0, 0.0), (1.0, 0.0))
#: The last of them comes to rest before this [s].
UNTIL = 1.5


def ball(name, random, height, restitution, friction):
    """A ball that is thrown along a floor."""
    body = rigid_body(name, (0.0, height), mass=random.uniform(0.1, 5.0), inertia=0.01, velocity=(0.3, 0.0))
    contact = PointLineContact(f"{name}_floor", body.at(0.0, 0.0), FLOOR, restitution=restitution, friction=friction)
    return (body,), (), (contact,), ()


def pendulum(name, random, height, restitution, friction):
    """A bar on a pin that falls against a stop below it, and rests there."""
    length = 0.2 + height
    pin = GROUND.at(0.0, 0.0)
    bar = rigid_body(name, mass=1.0, inertia=length**2 / 12, centre=(length / 2, 0.0), angle=0.5)
    slope = GROUND.line((0.0, -0.05), (1.0, -0.05))
    contact = PointLineContact(f"{name}_stop", bar.at(length, 0.0), slope, restitution=restitution, friction=friction)
    return (bar,), (Revolute(f"{name}_pin", bar.at(0.0, 0.0), pin),), (contact,), ()


def pair(name, random, height, restitution, friction):
    """A ball that falls on a ball that falls on the floor: their impacts are not independent."""
    low = rigid_body(f"{name}_low", (0.0, height), mass=random.uniform(1.0, 5.0), inertia=1.0)
    high = rigid_body(f"{name}_high", (0.0, height + 0.1), mass=random.uniform(0.1, 0.9), inertia=1.0)
    contacts = (
        PointLineContact(f"{name}_floor", low.at(0.0, 0.0), FLOOR, restitution=restitution, friction=friction),
        PointLineContact(
            f"{name}_between", high.at(0.0, 0.0), low.line((0.0, 0.05), (1.0, 0.05)), restitution=restitution
        ),
    )
    return (low, high), (), contacts, ()


def rod(name, random, height, restitution, friction):
    """A rod thrown on the floor: it rattles on its ends, slides, and comes to rest."""
    rod = rigid_body(name, (0.0, 0.5 + height), mass=1.0, inertia=0.083, angle=0.5, velocity=(2.0, 0.0), speed=-1.0)
    contacts = (
        PointLineContact(f"{name}_{end}", rod.at(x, 0.0), FLOOR, restitution=restitution, friction=friction)
        for end, x in (("left", -0.5), ("right", 0.5))
    )
    return (rod,), (), tuple(contacts), ()


def braked(name, random, height, restitution, friction):
    """A disc that a brake stops, and holds."""
    disc = rigid_body(name, (0.0, 0.0), mass=1.0, inertia=0.05, speed=8.0 * random.uniform(0.5, 1.5))
    joints = (Revolute(f"{name}_shaft", disc.at(0.0, 0.0), GROUND.at(0.0, 0.0)),)
    return (disc,), joints, (), (Brake(f"{name}_brake", disc, limit=0.6),)


def stiff(name, random, height, restitution, friction):
    """A pendulum whose pin rubs, until it sticks."""
    bar = rigid_body(name, mass=1.0, inertia=0.01, centre=(0.2, 0.0), angle=random.uniform(-0.5, 0.5))
    pin = Revolute(f"{name}_pin", bar.at(0.0, 0.0), GROUND.at(0.0, 0.0), friction_radius=0.05)
    return (bar,), (pin,), (), ()


def carriage(name, random, height, restitution, friction):
    """A carriage that rubs along its guide, until it sticks."""
    body = rigid_body(name, mass=1.0, inertia=0.01, velocity=(random.uniform(1.0, 3.0), 0.0))
    guide = Translational(
        f"{name}_guide", GROUND.line((0.0, 0.0), (1.0, 0.0)), body.line((0.0, 0.0), (1.0, 0.0)), friction=0.3
    )
    return (body,), (guide,), (), ()


def mechanism(parts, law):
    """Parts side by side, or one of them."""
    bodies, joints, contacts, forces = (tuple(one for part in parts for one in part[k]) for k in range(4))
    return Mechanism(
        bodies,
        joints,
        contacts=contacts,
        forces=forces,
        gravity=(0.0, -9.81),
        outputs=tuple(
            Output(f"{body.name}_{q}", f"{body.name}.{q}", "", "") for body in bodies for q in ("x", "y", "angle")
        ),
        settings=Settings(relative_tolerance=1e-12),
        impact_law=law,
    )


def impacts_of(model):
    """Time, contact and closing speed of each impact."""
    found = simulate(model, UNTIL, outputs=[], step=UNTIL).impacts
    return [(hit.time, hit.contact, hit.closing_speed) for hit in found]


@pytest.mark.parametrize("spread", [0.0, 1e-12, 1e-6, 1e-3])
@pytest.mark.parametrize(("friction", "law"), [(0.0, "newton"), (0.3, "newton"), (0.3, "poisson"), (0.3, "stronge")])
def test_each_mechanism_of_a_crowd_bounces_as_it_does_alone(spread, friction, law):
    """Number, order, times and closing speeds; heights are equal, or differ by up to `spread` [m]."""
    random = np.random.default_rng([int(1e12 * spread), int(10 * friction), len(law)])
    kinds = random.permutation([ball, ball, ball, ball, pendulum, pendulum, pair])
    restitution = round(random.uniform(0.2, 0.5), 3)
    parts = [
        kind(f"{kind.__name__}{k}", random, 0.1 + spread * random.uniform(), restitution, friction)
        for k, kind in enumerate(kinds)
    ]
    crowd = impacts_of(mechanism(parts, law))
    for part in parts:
        names = {contact.name for contact in part[2]}
        alone = impacts_of(mechanism([part], law))
        together = [hit for hit in crowd if hit[1] in names]
        assert [name for _, name, _ in together] == [name for _, name, _ in alone]
        for k in (0, 2):
            np.testing.assert_allclose([hit[k] for hit in together], [hit[k] for hit in alone], rtol=1e-9, atol=1e-9)
        if len(part[0]) + len(part[1]) == 1:  # nothing that drifts: but for the tolerance of instants, and rounding
            speeds = np.array([hit[2] for hit in alone])
            off = 3.0 * 9.81 * ROOT_TOLERANCE + 9.81 * 4.0 * np.spacing(0.1) / speeds  # of heights, from 0.1 m on
            assert np.all(np.abs([hit[2] for hit in together] - speeds) <= off)


@pytest.mark.parametrize("law", ["newton", "poisson", "stronge"])
@pytest.mark.parametrize("draw", range(4))
def test_what_rubs_beside_impacts_of_others_moves_as_it_does_alone(law, draw):
    """Brakes, pins and guides that slip while something else strikes: an impact is none of theirs."""
    random = np.random.default_rng([draw, len(law)])
    kinds = random.permutation([rod, braked, stiff, carriage, pendulum, ball])
    parts = [kind(kind.__name__, random, random.uniform(0.05, 0.3), 0.3, 0.35) for kind in kinds]
    crowd = simulate(mechanism(parts, law), UNTIL, step=0.05).table
    for part in parts:
        alone = simulate(mechanism([part], law), UNTIL, step=0.05).table
        for name in alone.columns:
            np.testing.assert_allclose(crowd[name], alone[name], rtol=0, atol=1e-8, err_msg=name)

"""Mechanisms that have nothing to do with each other move in a crowd as each does alone: to the number of its bounces.

Their events fall into each other's last hops, which are as low as what counts as touching.
"""

import numpy as np
import pytest

from mechanism_fmu.model import GROUND, Mechanism, PointLineContact, Revolute, Settings, rigid_body
from mechanism_fmu.simulation import simulate

FLOOR = GROUND.line((0.0, 0.0), (1.0, 0.0))
#: The last of them comes to rest before this [s].
UNTIL = 1.5


def ball(name, random, height, restitution, friction):
    """A ball that is thrown along a floor."""
    body = rigid_body(name, (0.0, height), mass=random.uniform(0.1, 5.0), inertia=0.01, velocity=(0.3, 0.0))
    contact = PointLineContact(f"{name}_floor", body.at(0.0, 0.0), FLOOR, restitution=restitution, friction=friction)
    return (body,), (), (contact,)


def pendulum(name, random, height, restitution, friction):
    """A bar on a pin that falls against a stop below it, and rests there."""
    length = 0.2 + height
    pin = GROUND.at(0.0, 0.0)
    bar = rigid_body(name, mass=1.0, inertia=length**2 / 12, centre=(length / 2, 0.0), angle=0.5)
    slope = GROUND.line((0.0, -0.05), (1.0, -0.05))
    contact = PointLineContact(f"{name}_stop", bar.at(length, 0.0), slope, restitution=restitution, friction=friction)
    return (bar,), (Revolute(f"{name}_pin", bar.at(0.0, 0.0), pin),), (contact,)


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
    return (low, high), (), contacts


def mechanism(parts, law):
    """Parts side by side, or one of them."""
    bodies, joints, contacts = (tuple(one for part in parts for one in part[k]) for k in range(3))
    settings = Settings(relative_tolerance=1e-12)
    return Mechanism(bodies, joints, contacts=contacts, gravity=(0.0, -9.81), settings=settings, impact_law=law)


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
        np.testing.assert_allclose([hit[0] for hit in together], [hit[0] for hit in alone], rtol=0, atol=1e-9)
        drifts = len(part[0]) + len(part[1]) > 1
        within = 1e-9 if drifts else 3e-12  # gravity times the tolerance of an instant, thrice
        np.testing.assert_allclose([hit[2] for hit in together], [hit[2] for hit in alone], rtol=1e-9, atol=within)

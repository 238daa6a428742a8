"""The rows of a whole mechanism with its contact coordinates: each part's stand in their place."""

from functools import cache

import numpy as np
import pytest
from textbook import evaluated_rows

from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    AngleStop,
    Body,
    CamFlatFollower,
    CamFollower,
    Curve,
    Mechanism,
    Piece,
    PointFollower,
    RackAndPinion,
    Revolute,
    Term,
)
from mechanism_fmu.model.compile import compile_mechanism
from mechanism_fmu.tables.layout import pack

EGG = Curve((Piece(0.0, (Term((1.0,), 0.2, 2.0),)),))
ROUND = Curve((Piece(0.0, (Term((0.25,)),)),))
SWING = Curve((Piece(0.0, (Term((0.5, 1.0), 0.3, 4.0),)),))
BODIES = (Body("a", 1.0, 1.0), Body("b", 1.0, 1.0))
JOINTS = (
    Revolute("pin", "a", (0.1, 0.2), GROUND, (0.3, 0.4)),
    AngleDriver("turn", "b", SWING, "a"),
    RackAndPinion("rack", "a", (0.1, 0.2), (0.3, 0.4), 0.5, "b", 0.6),
)
CONTACTS = (
    PointFollower("slot", "a", (0.1, 0.2), "b", EGG, (0.3, 0.4)),
    AngleStop("stop", "b", GROUND, 0.0),
    CamFlatFollower("absent", "a", EGG, "b", (0.1, 0.2), (1.0, 0.0), enabled=False),
    CamFollower("roller", "b", EGG, "a", ROUND, (0.1, 0.2), (0.3, 0.4)),
)
#: Of each contact: its rows behind those of the joints, and its contact coordinates.
PLACES = {"slot": (slice(0, 2), [0]), "stop": (slice(2, 3), []), "roller": (slice(5, 8), [2, 3])}
JOINT_ROWS = 5
Q, QD = np.random.default_rng(1).uniform(-1, 1, (2, 6 + 4))
TIME = 0.7


def rows_of(joints, contacts, alphas):
    """Rows with the contact coordinates of the given numbers."""
    block = pack(compile_mechanism(Mechanism(bodies=BODIES, joints=joints, contacts=contacts)))
    chosen = [*range(6), *(6 + k for k in alphas)]
    return evaluated_rows(block, Q[chosen], QD[chosen], TIME)


@cache
def all_rows():
    """Of all parts together; the first in a process compiles the engine's rows."""
    return rows_of(JOINTS, CONTACTS, range(4))


def assert_stands(alone, place, alphas):
    """The rows of one part stand at `place` among all, and have entries in the columns of its own coordinates only."""
    for name in ("phi", "rate", "gamma", "nu"):
        np.testing.assert_array_equal(getattr(all_rows(), name)[place], getattr(alone, name), name)
    expected = np.zeros((len(alone.phi), 10))
    expected[:, [*range(6), *(6 + k for k in alphas)]] = alone.jacobian
    np.testing.assert_array_equal(all_rows().jacobian[place], expected)


@pytest.mark.parametrize(("joint", "place"), list(zip(JOINTS, [slice(0, 2), slice(2, 3), slice(3, 5)], strict=True)))
def test_joints_come_first(joint, place):
    assert_stands(rows_of((joint,), (), []), place, [])


@pytest.mark.parametrize("name", PLACES)
def test_contacts_follow_open_or_closed_with_columns_for_their_coordinates(name):
    (contact,) = (c for c in CONTACTS if c.name == name)
    rows, alphas = PLACES[name]
    assert_stands(rows_of((), (contact,), alphas), slice(JOINT_ROWS + rows.start, JOINT_ROWS + rows.stop), alphas)


def test_only_drivers_depend_on_time():
    assert np.flatnonzero(all_rows().nu).tolist() == [2]
    later = evaluated_rows(pack(compile_mechanism(Mechanism(BODIES, JOINTS, contacts=CONTACTS))), Q, QD, TIME + 0.1)
    assert np.flatnonzero(later.phi - all_rows().phi).tolist() == [2]

"""Constraint rows against automatic differentiation of Phi, stated here once more, and against the oracle."""

import json
import os
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from jet import Jet, cos, sin

from mechanism_fmu.engine.kinematics import place_bodies
from mechanism_fmu.engine.layout import field_of
from mechanism_fmu.engine.pack import pack
from mechanism_fmu.engine.rows import active_rows
from mechanism_fmu.engine.subset import entry
from mechanism_fmu.model import GROUND, Body, Mechanism, PointLineContact, Revolute, Translational


def turned(angle, vector):
    c, s = cos(angle), sin(angle)
    return c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]


def point(body, local):
    x, y = turned(body[2], local)
    return body[0] + x, body[1] + y


def difference(u, v):
    return u[0] - v[0], u[1] - v[1]


def dot(u, v):
    return u[0] * v[0] + u[1] * v[1]


def quarter_turn(v):
    return v[1] * -1.0, v[0]


def revolute(i, j, data):
    return difference(point(i, data[0:2]), point(j, data[2:4]))


def translational(i, j, data):
    normal = quarter_turn(turned(i[2], data[4:6]))
    d = difference(point(j, data[2:4]), point(i, data[0:2]))
    return dot(normal, d), dot(normal, turned(j[2], data[6:8]))


def point_line(i, j, data):
    """Distance along the normal from the line's point to the point."""
    return (dot(turned(j[2], data[4:6]), difference(point(i, data[0:2]), point(j, data[2:4]))),)


class Part(NamedTuple):
    """How a part is stated here and made there; its numbers are then written into its row of `table`."""

    phi: object
    numbers: int
    table: str
    mechanism: object


def with_joint(make):
    return lambda i, j: {"joints": (make(i, j),)}


PARTS = {
    "revolute": Part(revolute, 4, "joint_data", with_joint(lambda i, j: Revolute("part", i, (0, 0), j, (0, 0)))),
    "translational": Part(
        translational,
        8,
        "joint_data",
        with_joint(lambda i, j: Translational("part", i, (0, 0), (1, 0), j, (0, 0), (1, 0))),
    ),
    "point_line": Part(
        point_line,
        6,
        "contact_data",
        lambda i, j: {"contacts": (PointLineContact("part", i, (0, 0), j, (0, 0), (1, 0), closed=True),)},
    ),
}
FIXED = [0.0, 0.0, 0.0]


class Rows(NamedTuple):
    phi: np.ndarray
    rate: np.ndarray
    gamma: np.ndarray
    jacobian: np.ndarray


@entry
def evaluate(block, y):
    place_bodies(block, y)
    return active_rows(block)


def engine_rows(kind, data, q, qd, attached=("a", "b")):
    """By the engine; q and qd are those of two bodies a and b."""
    bodies = (Body("a", 1.0, 1.0), Body("b", 1.0, 1.0))
    block = pack(Mechanism(bodies=bodies, **PARTS[kind].mechanism(*attached)).compile())
    field_of(block, PARTS[kind].table)[0, : len(data)] = data
    count = evaluate(block, np.array([*q, *qd, 0.0]))
    phi, rate, gamma, jacobian = (
        field_of(block, name)[:count] for name in ("residual", "residual_rate", "gamma", "jacobian")
    )
    return Rows(phi, rate, gamma, jacobian[:, :6])


def differentiated_rows(kind, data, q, qd, attached=("a", "b")):
    """By differentiation: Phi_q along each coordinate, gamma = -(Phi_q qd)_q qd as the second derivative along qd."""

    def along(direction):
        state = [Jet(value, first) for value, first in zip(q, direction, strict=True)]
        frames = {"a": state[:3], "b": state[3:], GROUND: [Jet(0.0)] * 3}
        return PARTS[kind].phi(*(frames[name] for name in attached), data)

    motion = along(qd)
    return Rows(
        np.array([phi.value for phi in motion]),
        np.array([phi.first for phi in motion]),
        np.array([-phi.second for phi in motion]),
        np.transpose([[phi.first for phi in along(direction)] for direction in np.eye(6)]),
    )


def same_rows(found, expected, relative):
    for name, value in expected._asdict().items():
        size = max(1.0, np.abs(value).max())
        np.testing.assert_allclose(getattr(found, name), value, rtol=0, atol=relative * size, err_msg=name)


def numbers(count):
    return st.lists(st.floats(-3, 3), min_size=count, max_size=count)


@settings(deadline=None, max_examples=50)
@given(st.data())
@pytest.mark.parametrize("attached", [("a", "b"), ("b", "a"), ("a", GROUND), (GROUND, "b")])
@pytest.mark.parametrize("kind", PARTS)
def test_rows_are_the_derivatives_of_phi(kind, attached, data):
    q, qd, part_data = (data.draw(numbers(count)) for count in (6, 6, PARTS[kind].numbers))
    if kind == "point_line":  # the engine leaves out n'.n' = 1, which only the line's own point would see
        angle = data.draw(st.floats(-3, 3))
        part_data[4:6] = [np.cos(angle), np.sin(angle)]
    found = engine_rows(kind, part_data, q, qd, attached)
    same_rows(found, differentiated_rows(kind, part_data, q, qd, attached), 1e-13)
    np.testing.assert_allclose(found.rate, found.jacobian @ qd, rtol=0, atol=1e-12)


ORACLE = Path(os.environ.get("JOINT_ORACLE", Path(__file__).parents[2] / "data" / "joints.json"))
#: In the order of the engine's table row, the oracle's names for a joint's numbers.
NAMES = {
    "revolute": ("siP_x", "siP_y", "sjP_x", "sjP_y"),
    "translational": ("siP_x", "siP_y", "sjP_x", "sjP_y", "vi_x", "vi_y", "vj_x", "vj_y"),
}
CASES = [
    pytest.param(kind, case, id=f"{kind}-{k}")
    for kind, joint in json.loads(ORACLE.read_text())["joints"].items()
    if kind in NAMES
    for k, case in enumerate(joint["cases"])
]


@pytest.mark.parametrize(("kind", "case"), CASES)
def test_rows_agree_with_the_oracle(kind, case):
    """40-digit arithmetic; another file of the same schema may be given as environment variable JOINT_ORACLE."""
    data = [case["attrs"][name] for name in NAMES[kind]]
    found = engine_rows(kind, data, case["q"], case["qd"])
    for name, value in (("phi", "Phi"), ("gamma", "gamma"), ("jacobian", "Phi_q")):
        np.testing.assert_allclose(getattr(found, name), case[value], rtol=1e-11, atol=1e-13, err_msg=name)
    assert not np.any(case["nu"])
    np.testing.assert_allclose(found.rate, np.array(case["Phi_q"]) @ case["qd"], rtol=1e-11, atol=1e-13)


def test_the_oracle_has_joints_to_look_at():
    assert {case.values[0] for case in CASES} == set(NAMES)

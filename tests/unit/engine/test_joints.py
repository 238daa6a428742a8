"""Constraint rows against automatic differentiation of an independent statement of Phi, and against the oracle."""

import json
import os
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from stated_joints import STATEMENTS, Rows, differentiated_rows

from mechanism_fmu import codes
from mechanism_fmu.engine.kinematics import place_bodies
from mechanism_fmu.engine.layout import field_of
from mechanism_fmu.engine.pack import pack
from mechanism_fmu.engine.rows import active_rows, spare_row, tangent_row
from mechanism_fmu.engine.subset import entry
from mechanism_fmu.engine.views import strikes
from mechanism_fmu.model import GROUND, AngleStop, Body, Mechanism, PointLineContact, Revolute, Translational

NAMES = ("a", "b", GROUND)


#: How many numbers each part has; a contact's point stands in `contact_data`, its line or angle in `contact_line`.
WIDTHS = {"revolute": 4, "translational": 8, "point_line": 6, "along_line": 6, "angle": 1}


@entry
def evaluate(block, y):
    place_bodies(block, y)
    return active_rows(block)


@entry
def evaluate_tangent(block, y):
    place_bodies(block, y)
    tangent_row(block, 0, strikes(block).line)
    return spare_row(block)


@cache
def block_with(kind, frames):
    """A block of two bodies and one part, whose numbers are still to be written."""
    i, j = (NAMES[frame] for frame in frames)
    parts = {
        "revolute": {"joints": (Revolute("part", i, (0, 0), j, (0, 0)),)},
        "translational": {"joints": (Translational("part", i, (0, 0), (1, 0), j, (0, 0), (1, 0)),)},
        "point_line": {"contacts": (PointLineContact("part", i, (0, 0), j, (0, 0), (1, 0)),)},
        "angle": {"contacts": (AngleStop("part", i, j, 0.0),)},
    }
    parts["along_line"] = parts["point_line"]
    block = pack(Mechanism(bodies=(Body("a", 1.0, 1.0), Body("b", 1.0, 1.0)), **parts[kind]).compile())
    field_of(block, "contact_mode")[:] = codes.CLOSED
    return block


def engine_rows(kind, data, frames, q, qd):
    block = block_with(kind, frames)
    if kind in ("revolute", "translational"):
        field_of(block, "joint_data")[0, : len(data)] = data
    elif kind == "angle":
        field_of(block, "contact_line")[0, 0] = data[0]
    else:
        field_of(block, "contact_data")[0, :2] = data[:2]
        field_of(block, "contact_line")[0] = data[2:]
    y = np.array([*q, *qd, 0.0, 0.0])
    wanted = slice(0, evaluate(block, y))
    if kind == "along_line":
        spare = evaluate_tangent(block, y)
        wanted = slice(spare, spare + 1)
    fields = ("residual", "residual_rate", "gamma", "jacobian")
    phi, rate, gamma, jacobian = (field_of(block, name)[wanted] for name in fields)
    return Rows(phi, rate, gamma, jacobian[:, : len(q)])


@settings(deadline=None, max_examples=30)
@given(numbers=arrays(float, 20, elements=st.floats(-3, 3)))
@pytest.mark.parametrize("frames", [(0, 1), (1, 0), (0, 2), (2, 1)], ids=str)
@pytest.mark.parametrize("kind", STATEMENTS)
def test_rows_are_the_derivatives_of_phi(kind, frames, numbers):
    q, qd, data = np.split(numbers, [6, 12])
    found = engine_rows(kind, data[: WIDTHS[kind]], frames, q, qd)
    expected = differentiated_rows(kind, data, frames, q, qd)
    for name, value in expected._asdict().items():
        within = 1e-12 * max(1.0, np.abs(value).max())
        np.testing.assert_allclose(getattr(found, name), value, rtol=0, atol=within, err_msg=name)
    np.testing.assert_allclose(found.rate, found.jacobian @ qd, rtol=0, atol=1e-12)


ORACLE = Path(os.environ.get("JOINT_ORACLE", Path(__file__).parents[2] / "data" / "joints.json"))
#: The oracle's names of a joint's numbers, in the order of the engine's tables.
ATTRIBUTES = {
    "revolute": ("siP_x", "siP_y", "sjP_x", "sjP_y"),
    "translational": ("siP_x", "siP_y", "sjP_x", "sjP_y", "vi_x", "vi_y", "vj_x", "vj_y"),
}
CASES = [
    pytest.param(kind, case, id=f"{kind}-{k}")
    for kind, joint in json.loads(ORACLE.read_text(encoding="utf-8"))["joints"].items()
    if kind in ATTRIBUTES
    for k, case in enumerate(joint["cases"])
]


@pytest.mark.parametrize(("kind", "case"), CASES)
def test_rows_agree_with_the_oracle(kind, case):
    """40-digit arithmetic; another file of the same schema may be named by the environment variable JOINT_ORACLE."""
    data = [case["attrs"][name] for name in ATTRIBUTES[kind]]
    found = engine_rows(kind, data, (0, 1), case["q"], case["qd"])
    for name, oracle_name in (("phi", "Phi"), ("gamma", "gamma"), ("jacobian", "Phi_q")):
        np.testing.assert_allclose(getattr(found, name), case[oracle_name], rtol=1e-11, atol=1e-14, err_msg=name)
    # these joints do not depend on time: Phi' = Phi_q qd - nu with nu = 0
    assert not np.any(case["nu"])
    np.testing.assert_allclose(found.rate, np.dot(case["Phi_q"], case["qd"]), rtol=1e-11, atol=1e-14)


def test_the_oracle_has_something_to_say():
    assert CASES

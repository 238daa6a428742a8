"""Constraint rows against automatic differentiation of an independent statement of Phi."""

from functools import cache

import numpy as np
import pytest
from hypothesis import example, given, settings, strategies as st
from hypothesis.extra.numpy import arrays
from stated_joints import DRIVERS, JOINTS, PAIRS, STATEMENTS, State, differentiated_rows
from textbook import evaluated_rows, written_rows

from mechanism_fmu.engine.compiler.subset import entry
from mechanism_fmu.engine.constraints.point_line import spare_row, tangent_row
from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    AngleStop,
    Body,
    CamFlatFollower,
    CamFollower,
    Curve,
    Distance,
    DistanceDriver,
    Gears,
    InternalGears,
    Mechanism,
    Piece,
    PointFollower,
    PointLineContact,
    RackAndPinion,
    Revolute,
    RevoluteTranslational,
    Term,
    Translational,
    TranslationalDriver,
    XDriver,
    YDriver,
)
from mechanism_fmu.model.compile import compile_mechanism
from mechanism_fmu.tables.layout import field_of, pack
from mechanism_fmu.tables.motion import Pose, Strikes

NAMES = ("a", "b", GROUND)
ORIGIN = (0.0, 0.0)
ALONG_X = (1.0, 0.0)


@entry
def evaluate_tangent(block):
    tangent_row(block, Pose(block), 0, Strikes(block).tangent_line)
    return spare_row(block)


def a_curve():
    """A curve with a place of its own in the tables."""
    return Curve((Piece(0.0, (Term((1.0,)),)),))


#: A part of each kind between bodies i and j; its numbers are still to be written into the tables.
PARTS = {
    "revolute": lambda i, j: Revolute("part", i, ORIGIN, j, ORIGIN),
    "translational": lambda i, j: Translational("part", i, ORIGIN, ALONG_X, j, ORIGIN, ALONG_X),
    "distance": lambda i, j: Distance("part", i, ORIGIN, j, ORIGIN, 1.0),
    "revolute_translational": lambda i, j: RevoluteTranslational("part", i, ORIGIN, ALONG_X, j, ORIGIN),
    "gears": lambda i, j: Gears("part", i, 1.0, 0.0, j, 1.0, 0.0),
    "internal_gears": lambda i, j: InternalGears("part", i, 2.0, 0.0, j, 1.0, 0.0),
    "rack_and_pinion": lambda i, j: RackAndPinion("part", i, ORIGIN, ORIGIN, 0.0, j, 1.0),
    "x_driver": lambda i, j: XDriver("part", j, ORIGIN, a_curve(), i),
    "y_driver": lambda i, j: YDriver("part", j, ORIGIN, a_curve(), i),
    "angle_driver": lambda i, j: AngleDriver("part", j, a_curve(), i),
    "distance_driver": lambda i, j: DistanceDriver("part", j, ORIGIN, a_curve(), i),
    "translational_driver": lambda i, j: TranslationalDriver("part", j, ORIGIN, ALONG_X, a_curve(), i),
    "point_line": lambda i, j: PointLineContact("part", i, ORIGIN, j, ORIGIN, ALONG_X),
    "along_line": lambda i, j: PointLineContact("part", i, ORIGIN, j, ORIGIN, ALONG_X),
    "angle": lambda i, j: AngleStop("part", i, j, 0.0),
    "cam_follower": lambda i, j: CamFollower("part", i, a_curve(), j, a_curve()),
    "cam_flat_follower": lambda i, j: CamFlatFollower("part", i, a_curve(), j, ORIGIN, ALONG_X),
    "point_follower": lambda i, j: PointFollower("part", i, ORIGIN, j, a_curve()),
}


@cache
def block_with(kind, frames):
    """A block of two bodies and one part."""
    part = PARTS[kind](*(NAMES[frame] for frame in frames))
    place = {"joints": (part,)} if kind in JOINTS | DRIVERS else {"contacts": (part,)}
    return pack(compile_mechanism(Mechanism(bodies=(Body("a", 1.0, 1.0), Body("b", 1.0, 1.0)), **place)))


def engine_rows(kind, data, curves, frames, state):
    block = block_with(kind, frames)
    if kind in JOINTS | DRIVERS:
        field_of(block, "joint_data")[0] = data
    elif kind in PAIRS:
        field_of(block, "contact_data")[0] = data[:6]
    elif kind == "angle":
        field_of(block, "contact_line")[0, 0] = data[0]
    else:  # a contact's point stands in `contact_data`, its line in `contact_line`
        field_of(block, "contact_data")[0, :2] = data[:2]
        field_of(block, "contact_line")[0] = data[2:6]
    terms = field_of(block, "term_data")
    terms[:] = curves[: len(terms)]
    rows = evaluated_rows(block, *state)
    return written_rows(block, evaluate_tangent(block), 1) if kind == "along_line" else rows


def sensible(kind, data, curves):
    """Positive radii, the ring's larger than the gear's; polynomials whose terms are of a size."""
    data, curves = data.copy(), curves.copy()
    if kind in ("gears", "internal_gears"):
        data[[4, 6]] = 0.5 + np.abs(data[[4, 6]])
    if kind == "internal_gears":
        data[4] += data[6]
    curves[:, :6] /= 3.0 ** np.arange(6)
    return data, curves


@settings(deadline=None, max_examples=10)  # for each kind, four times
@given(numbers=arrays(float, 44, elements=st.floats(-3, 3)))
@example(numbers=np.full(44, 3.0))  # two bodies at one place, whose parts cancel
@pytest.mark.parametrize("frames", [(0, 1), (1, 0), (0, 2), (2, 1)], ids=str)
@pytest.mark.parametrize("kind", STATEMENTS)
def test_rows_are_the_derivatives_of_phi(kind, frames, numbers):
    q, qd, data, curves, time = np.split(numbers, [8, 16, 25, 43])
    data, curves = sensible(kind, data, curves.reshape(2, 9))
    count = 6 + {"cam_follower": 2, "cam_flat_follower": 1, "point_follower": 1}.get(kind, 0)
    state = State(q[:count], qd[:count], time.item())
    found = engine_rows(kind, data, curves, frames, state)
    expected = differentiated_rows(kind, data, curves, frames, state)
    for name, value in expected._asdict().items():
        size = max(1.0, np.abs(value).max())
        if np.abs(getattr(found, name) - value).max() > 1e-12 * size:
            # what each body contributes against the ground: the two may cancel, and leave the rounding of their size
            pairs = {(frames[0], 2), (2, frames[1])} - {(2, 2)}
            parts = [differentiated_rows(kind, data, curves, pair, state) for pair in pairs]
            size = max(size, *(np.abs(getattr(part, name)).max() for part in parts))
        np.testing.assert_allclose(getattr(found, name), value, rtol=0, atol=1e-12 * size, err_msg=name)
    within = 1e-11 * max(1.0, np.abs(expected.jacobian).max())
    np.testing.assert_allclose(found.rate, found.jacobian @ state.qd - expected.nu, rtol=0, atol=within)

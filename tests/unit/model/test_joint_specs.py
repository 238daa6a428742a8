"""Joints, drivers and higher pairs as tables, and what is refused of them."""

import inspect
import math
from dataclasses import replace
from typing import get_args

import numpy as np
import pytest
from hypothesis import example, given, settings, strategies as st
from recorded import said

from mechanism_fmu import codes
from mechanism_fmu.engine.constraints import rows
from mechanism_fmu.engine.dynamics.forces import ELEMENTS
from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Body,
    Brake,
    CamFlatFollower,
    CamFollower,
    Curve,
    Distance,
    DistanceDriver,
    Gears,
    InternalGears,
    Mechanism,
    MechanismError,
    Model,
    Parameter,
    Piece,
    PointFollower,
    RackAndPinion,
    RevoluteTranslational,
    Term,
    Translational,
    TranslationalDriver,
    XDriver,
    YDriver,
    characteristic,
)
from mechanism_fmu.model.checks.check_numbers import number_findings
from mechanism_fmu.model.compile import compile_mechanism, compile_tables
from mechanism_fmu.model.findings import messages
from mechanism_fmu.model.forces import (
    Bushing,
    CompliantShaft,
    Damper,
    DCMotor,
    Force,
    ForceElement,
    Marker,
    NonlinearSpring,
    NonlinearTorsionSpring,
    Oscillation,
    PointForce,
    SpringDamper,
    Torque,
    TorsionSpring,
    TorsionSpringDamper,
)
from mechanism_fmu.model.joints import Joint
from mechanism_fmu.model.trace import trace
from mechanism_fmu.tables.kinds import FORCES, JOINTS

RAMP = Curve((Piece(0.0, (Term((1.0, 2.0)),)),))
HILL = Piece(1.0, (Term((9.0, 3.0, -18.0, 12.0)), Term((), -5.0, 2 * math.pi, math.pi / 2)))
SWING = Curve((Piece(0.0, (Term((1.0, 3.0)),)), HILL), 0.0, 2.0, True)
EGG = Curve((Piece(0.0, (Term((1.0,), 0.1, 2.0),)),), 0.0, 2 * math.pi, True)
ROUND = Curve((Piece(0.0, (Term((0.25,)),)),), 0.0, 2 * math.pi, True)

ROD = Distance("rod", "a", (1.0, 2.0), "b", (3.0, 4.0), 5.0)
GUIDE = RevoluteTranslational("guide", "a", (1.0, 2.0), (3.0, 4.0), "b", (5.0, 6.0), -0.5)
PAIR = Gears("pair", "a", 1.0, 2.0, "b", 3.0, 4.0, (5.0, 6.0), (7.0, 8.0))
RING = InternalGears("ring", "a", 3.0, 2.0, "b", 1.0, 4.0)
RACK = RackAndPinion("rack", "a", (1.0, 2.0), (3.0, 4.0), 5.0, "b", 6.0, 7.0, (8.0, 9.0))
DRIVE_X = XDriver("drive_x", "a", (1.0, 2.0), RAMP)
DRIVE_Y = YDriver("drive_y", "b", (1.0, 2.0), SWING, "a", (3.0, 4.0))
TURN = AngleDriver("turn", "a", RAMP)
REEL = DistanceDriver("reel", "b", (1.0, 2.0), SWING, "a", (3.0, 4.0))
PUSH = TranslationalDriver("push", "b", (1.0, 2.0), (0.0, -2.0), RAMP, "a", (3.0, 4.0))
ROLLER = CamFollower("roller", "a", EGG, "b", ROUND, (1.0, 2.0), (3.0, 4.0))
FLAT = CamFlatFollower("flat", "a", EGG, GROUND, (1.0, 2.0), (-3.0, 4.0), (5.0, 6.0), unilateral=True, restitution=0.5)
PIN = PointFollower("pin", "b", (1.0, 2.0), "a", ROUND, (3.0, 4.0), closed=False, enabled=False)
GOOD = Mechanism(
    bodies=(Body("a", 1.0, 1.0), Body("b", 1.0, 1.0)),
    joints=(ROD, GUIDE, PAIR, RING, RACK, DRIVE_X, DRIVE_Y, TURN, REEL, PUSH),
    contacts=(ROLLER, FLAT, PIN),
)
TABLES = compile_mechanism(GOOD)
FORCE_ELEMENTS = (
    Torque("torque", "a"),
    TorsionSpring("spring", "a"),
    Damper("damper", "a"),
    CompliantShaft("shaft", "a"),
    Force("force", "a"),
    Brake("brake", "a"),
    DCMotor("motor", "a"),
    SpringDamper("strut", "a", (0.0, 0.0), "b", (0.0, 0.0)),
    TorsionSpringDamper("stop", "a"),
    PointForce("push", "a"),
    Marker("pen", "a", (0.1, 0.0)),
    Oscillation("beat", "a"),
    Bushing("bushing", "a", (0.0, 0.0), "b", (0.0, 0.0)),
    NonlinearSpring("gas", "a", (0.0, 0.0), "b", (0.0, 0.0), law=lambda x, v: x + v),
    NonlinearTorsionSpring("coil", "a", law=characteristic([(0.0, 0.0), (1.0, 1.0)])),
)


def test_joints():
    assert [list(JOINTS)[number] for number in TABLES.joint_kind] == [
        "distance",
        "revolute_translational",
        "gears",
        "internal_gears",
        "rack_and_pinion",
        "x_driver",
        "y_driver",
        "angle_driver",
        "distance_driver",
        "translational_driver",
    ]
    assert list(TABLES.joint_row) == [0, 1, 2, 3, 4, 6, 7, 8, 9, 10]
    assert TABLES.joint_rows == 11
    np.testing.assert_allclose(
        TABLES.joint_data,
        [
            [1, 2, 3, 4, 5, 0, 0, 0, 0],
            [1, 2, 5, 6, -0.8, 0.6, -0.5, 0, 0],  # the guide's normal, of unit length
            [5, 6, 7, 8, 1, 2, 3, 4, 0],
            [0, 0, 0, 0, 3, 2, 1, 4, 0],
            [1, 2, 3, 4, 5, 8, 9, 6, 7],
            [0, 0, 1, 2, 0, 0, 0, 0, 0],
            [3, 4, 1, 2, 0, 0, 0, 0, 0],
            [0, 0, 0, 0, 0, 0, 0, 0, 0],
            [3, 4, 1, 2, 0, 0, 0, 0, 0],
            [3, 4, 1, 2, 0, -1, 0, 0, 0],
        ],
        rtol=1e-15,
    )
    assert not TABLES.joint_friction.any()


def test_a_driver_is_absolute_unless_a_body_is_given():
    ground = 2
    assert list(TABLES.joint_body_i[5:]) == [ground, 0, ground, 0, 0]
    assert list(TABLES.joint_body_j[5:]) == [0, 1, 0, 1, 1]


def test_higher_pairs_have_rows_and_contact_coordinates_of_their_own():
    assert list(TABLES.contact_kind) == [codes.CAM_FOLLOWER, codes.CAM_FLAT_FOLLOWER, codes.POINT_FOLLOWER]
    assert list(TABLES.contact_row_first) == [0, 3, 5]
    assert TABLES.contact_rows == 7
    assert list(TABLES.contact_alpha) == [0, 2, 3]
    assert TABLES.alphas == 4
    np.testing.assert_allclose(
        TABLES.contact_data,
        [[1, 2, 3, 4, 0, 0], [5, 6, 1, 2, -0.6, 0.8], [1, 2, 3, 4, 0, 0]],
        rtol=1e-15,
    )


def test_a_pair_is_guided_unless_it_is_unilateral():
    columns = ["RESTITUTION", "GUIDED", "ENABLED", "STARTS_CLOSED"]
    values = TABLES.contact_value[:, [getattr(codes, name) for name in columns]]
    np.testing.assert_array_equal(values, [[0, 1, 1, 1], [0.5, 0, 1, 1], [0, 1, 0, 0]])


def test_curves_follow_each_other_in_pieces_and_terms():
    """What several parts share stands in the tables once for each of them; all refer to the first."""
    ramp, swing = 0, 1
    assert list(TABLES.joint_curve) == [codes.NONE] * 5 + [ramp, swing, ramp, swing, ramp]
    assert list(TABLES.curve_piece[:3]) == [0, 1, 3]
    assert list(TABLES.curve_pieces[:2]) == [1, 2]
    assert list(TABLES.curve_periodic[:2]) == [0, 1]
    np.testing.assert_array_equal(TABLES.curve_range[:2], [[0, 0], [0, 2]])
    assert list(TABLES.piece_term[:4]) == [0, 1, 2, 4]
    assert list(TABLES.piece_terms[:3]) == [1, 1, 2]
    np.testing.assert_array_equal(TABLES.piece_start[:3], [0, 0, 1])
    np.testing.assert_array_equal(
        TABLES.term_data[:4],
        [
            [1, 2, 0, 0, 0, 0, 0, 0, 0],
            [1, 3, 0, 0, 0, 0, 0, 0, 0],
            [9, 3, -18, 12, 0, 0, 0, 0, 0],
            [0, 0, 0, 0, 0, 0, -5, 2 * math.pi, math.pi / 2],
        ],
    )
    egg, roller = 5, 6
    assert list(TABLES.contact_curve_i) == [egg, egg, codes.NONE]
    assert list(TABLES.contact_curve_j) == [roller, codes.NONE, roller]


def joint(part, **change):
    return {"joints": (replace(part, **change),)}


def contact(part, **change):
    return {"contacts": (replace(part, **change),)}


BROKEN = Curve((Piece(0.0, (Term((1.0, math.nan)),)),))
REFUSALS = {
    "rod of no length": (joint(ROD, distance=0.0), ["Distance 'rod'", "distance = 0 m", "positive"]),
    "endless rod": (joint(ROD, distance=math.inf), ["'rod'", "distance = inf m", "finite"]),
    "guide without direction": (joint(GUIDE, axis_i=(0.0, 0.0)), ["'guide'", "axis_i = (0, 0)", "no direction"]),
    "guide too long": (joint(GUIDE, axis_i=(1e200, 0.0)), ["'guide'", "axis_i = (1e+200, 0)"]),
    "guide too short": (joint(GUIDE, axis_i=(1e-200, 0.0)), ["'guide'", "axis_i = (1e-200, 0)"]),
    "guide to nowhere": (joint(GUIDE, axis_i=(math.nan, 1.0)), ["'guide'", "axis_i = (nan, 1)"]),
    "push without direction": (joint(PUSH, axis_i=(0.0, 0.0)), ["TranslationalDriver 'push'", "axis_i = (0, 0)"]),
    "slider with an endless axis": (
        {"joints": (Translational("slider", "a", (0.0, 0.0), (math.inf, 0.0), "b", (0.0, 0.0), (1.0, 0.0)),)},
        ["'slider'", "axis_i = (inf, 0)"],
    ),
    "gear of no size": (joint(PAIR, radius_i=0.0), ["Gears 'pair'", "radius_i = 0 m"]),
    "gear inside out": (joint(PAIR, radius_j=-3.0), ["Gears 'pair'", "radius_j = -3 m"]),
    "ring of no size": (joint(RING, radius_i=math.nan), ["InternalGears 'ring'", "radius_i = nan m"]),
    "ring smaller than its gear": (joint(RING, radius_j=4.0), ["'ring'", "radius_i = 3 m", "radius_j = 4 m", "larger"]),
    "ring like its gear": (joint(RING, radius_j=3.0), ["'ring'", "radius_j = 3 m", "larger"]),
    "pinion of no size": (joint(RACK, radius_j=0.0), ["RackAndPinion 'rack'", "radius_j = 0 m"]),
    "rack to nowhere": (joint(RACK, direction_i=math.inf), ["RackAndPinion 'rack'", "not finite"]),
    "motion not a number": (joint(TURN, motion=BROKEN), ["The curve of 'turn'", "not finite"]),
    "motion of nothing": (joint(TURN, motion=Curve(())), ["The curve of 'turn'", "no pieces", "at least one"]),
    "motion that repeats at once": (joint(TURN, motion=replace(SWING, span=0.0)), ["'turn'", "span = 0", "positive"]),
    "motion that turns back in time": (
        joint(TURN, motion=Curve((Piece(1.0, (Term((1.0,)),)), Piece(0.5, (Term((1.0,)),))))),
        ["The curve of 'turn'", "from 0.5 on", "behind one from 1 on", "increasing order"],
    ),
    "motion that repeats too soon": (
        joint(TURN, motion=replace(SWING, span=0.5)),
        ["The curve of 'turn'", "a piece from 1 on", "repeats itself at 0.5", "shorten"],
    ),
    "motion that jumps": (
        joint(TURN, motion=Curve((Piece(0.0, (Term((1.0, 2.0)),)), Piece(2.0, (Term((4.5,)),))))),
        ["The curve of 'turn'", "jumps at 2 from 5 to 4.5", "where the one before it ends"],
    ),
    "profile that does not close": (
        contact(ROLLER, profile_i=Curve((Piece(0.0, (Term((1.0, 0.25)),)),), 0.0, 2.0, True)),
        ["The curve of 'roller'", "jumps at 2 from 1.5 to 1", "where the one before it ends"],
    ),
    "driven against itself": (joint(DRIVE_X, body_i="a"), ["XDriver 'drive_x'", "'a' to itself"]),
    "profile not a number": (contact(ROLLER, profile_j=BROKEN), ["The curve of 'roller'", "not finite"]),
    "cam around nowhere": (contact(ROLLER, centre_i=(math.nan, 0.0)), ["CamFollower 'roller'", "not finite"]),
    "face without direction": (contact(FLAT, direction_j=(0.0, 0.0)), ["Contact 'flat'", "direction_j = (0, 0)"]),
    "neither unilateral nor not": (contact(PIN, unilateral=0.5), ["Contact 'pin'", "unilateral = 0.5", "neither"]),
    "bouncing too much": (contact(FLAT, restitution=1.5), ["Contact 'flat'", "restitution = 1.5"]),
}


@pytest.mark.parametrize(("change", "fragments"), REFUSALS.values(), ids=REFUSALS)
def test_refusal_names_the_part_and_the_limit(change, fragments):
    with pytest.raises(MechanismError) as refusal:
        compile_mechanism(replace(GOOD, **change))
    for fragment in fragments:
        assert fragment in str(refusal.value)


def test_nothing_is_wrong_with_the_good_one():
    assert messages(number_findings(GOOD)) == []


def _mechanism(values):
    size, axis = values.size, (values.axis, 0.0)
    motion = Curve((Piece(0.0, (Term((size, axis[0])),)),))
    pieces = (Piece(0.0, (Term((axis[0],), size, 0.0),)), Piece(size, (Term(axis),)))
    return replace(
        GOOD,
        joints=(
            replace(ROD, distance=size),
            replace(GUIDE, axis_i=axis),
            replace(PAIR, radius_i=size),
            replace(RING, radius_j=size),
            replace(RACK, radius_j=size),
            replace(PUSH, axis_i=axis, motion=motion),
        ),
        contacts=(
            replace(ROLLER, unilateral=values.unilateral, profile_j=Curve(pieces, 0.0, size, True)),
            replace(FLAT, unilateral=values.unilateral, direction_j=axis),
        ),
    )


PARAMETERS = (
    Parameter("size", 1.0, "Sizes", "m"),
    Parameter("axis", 2.0, "Length of directions"),
    Parameter("unilateral", 0.0, "A switch", type="Boolean"),
)
TRACED = trace(Model("Joints", "All that has numbers of its own", PARAMETERS, _mechanism))
ODD = st.sampled_from([0.0, -0.0, 1.0, 3.0, -2.0, 5e-324, 1e-170, 1e200, 1.7976931348623157e308])


@settings(deadline=None)
@given(ODD | st.floats(-5, 5), ODD | st.floats(-5, 5), st.sampled_from([0.0, 1.0]))
@example(1.0, 2.0, 0.0)
def test_numbers_may_be_symbolic(size, axis, unilateral):
    """Traced, mechanisms have the same tables to the last bit, and the same is refused."""
    values = TRACED.model.values(size=size, axis=axis, unilateral=unilateral)
    mechanism = _mechanism(values)
    assert said(TRACED, TRACED.problems, values) == messages(number_findings(mechanism))
    expected, found = compile_tables(mechanism), TRACED.evaluate(values)
    for name in ("joint_data", "contact_data", "contact_value", "curve_range", "term_data"):
        assert getattr(found, name).tobytes() == getattr(expected, name).tobytes(), name


@pytest.mark.parametrize("part", [*GOOD.joints, *FORCE_ELEMENTS], ids=lambda part: type(part).__name__)
def test_a_row_has_as_many_numbers_as_its_kind_has_columns(part):
    kinds = JOINTS if part in GOOD.joints else FORCES
    assert len(part.data()) == len(kinds.columns(part.row))


def test_every_kind_has_a_class_and_every_class_a_kind():
    assert [joint.row for joint in get_args(Joint)] == list(JOINTS)
    assert sorted(force.row for force in get_args(ForceElement)) == sorted(FORCES)


def test_the_engine_has_every_kind():
    assert {*rows.FREQUENT, *rows.OTHERS, *rows.DRIVERS} == set(JOINTS)
    assert set(ELEMENTS) == set(FORCES)
    for force in get_args(ForceElement):
        assert bool(force.quantities) == (ELEMENTS[force.row].read is not None)
        assert (ELEMENTS[force.row].stored is None) == (ELEMENTS[force.row].storing is None)


def test_every_force_element_is_among_the_examples_and_says_how_it_acts():
    assert {type(force) for force in FORCE_ELEMENTS} == set(get_args(ForceElement))
    for force in FORCE_ELEMENTS:
        act = ELEMENTS[force.row].act
        assert (act is None) == (force.acts == "nowhere" or force.rubs)  # a brake is a constraint where it sticks
        if force.rubs:
            continue
        source = "" if act is None else inspect.getsource(getattr(act, "py_func", act))
        assert ("turn(block, k" in source) == (force.acts == "torque" or isinstance(force, Bushing))

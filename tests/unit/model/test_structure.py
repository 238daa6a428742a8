"""Elastic members as tables: nodes, what stands at them, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest

from mechanism_fmu import codes
from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Body,
    Damper,
    Force,
    LumpedMass,
    Mechanism,
    MechanismError,
    Member,
    Output,
    Revolute,
    Section,
    SpringDamper,
    Torque,
    Translational,
    polynomial_motion,
)
from mechanism_fmu.model.compile import compile_mechanism
from mechanism_fmu.model.structure import same_point, structure
from mechanism_fmu.model.symbol import Recorder

SECTION = Section(2e-4, 3e-9, 0.01)
CRANK = Member("bar", "crank", (-0.5, 0.0), (0.5, 0.0), SECTION, 2e11, 1000.0)
ROD = Member("link", "rod", (-1.0, 0.0), (1.0, 0.0), SECTION, 1e11, 0.0)
ARM = Member("arm", "rod", (1.0, 0.0), (1.0, 1.0), SECTION, 1e11, 500.0)
MECHANISM = Mechanism(
    bodies=(Body("crank", 1.0, 1.0), Body("rod", 2.0, 1.0), Body("slider", 3.0, 4.0)),
    joints=(
        Revolute("hinge", "crank", CRANK.start, GROUND, (0.0, 0.0)),
        Revolute("pin", "rod", ROD.start, "crank", CRANK.end),
        Revolute("head", "slider", (0.1, 0.0), "rod", ROD.end),
        Translational("guide", "slider", (0.0, 0.0), (1.0, 0.0), GROUND, (0.0, 0.0), (1.0, 0.0)),
    ),
    forces=(Force("weight", "rod", (0.0, -1.0)), Torque("drive", "crank"), Damper("oil", "rod", "crank", 0.1)),
    members=(CRANK, ROD, ARM),
    lumped_masses=(LumpedMass("knob", "rod", ARM.end, 0.4, 0.02), LumpedMass("part", "slider", (0.0, 0.0), 1.0)),
    held=("crank.angle",),
    outputs=(Output("x", "arm.end.x_deflection", ""), Output("m", "link.start_moment", "")),
)
#: Nodes by number.
HINGE, CRANK_PIN, ROD_PIN, ROD_HEAD, KNOB, SLIDER = range(6)


def test_nodes_are_ends_of_members_and_rigid_bodies():
    made = structure(MECHANISM)
    assert made.nodes == (
        ("crank", CRANK.start),
        ("crank", CRANK.end),
        ("rod", ROD.start),
        ("rod", ROD.end),
        ("rod", ARM.end),
        ("slider", (0.0, 0.0)),
    )
    assert made.ends == ((HINGE, CRANK_PIN), (ROD_PIN, ROD_HEAD), (ROD_HEAD, KNOB))
    assert made.ties == ((0, HINGE), (1, ROD_PIN), (1, CRANK_PIN), (2, SLIDER), (2, ROD_HEAD), (3, SLIDER))
    assert made.locked == (3 * HINGE + 2,)


def test_lumps_are_halves_of_members_disks_and_rigid_bodies_with_their_shares():
    half, quarter = 1000.0 * 2e-4 / 2, 500.0 * 2e-4 / 2
    rod = 2 * quarter + 0.4
    assert structure(MECHANISM).lumps == (
        (HINGE, half, 0.0, 0.5),
        (CRANK_PIN, half, 0.0, 0.5),
        (ROD_PIN, 0.0, 0.0, 0.0),
        (ROD_HEAD, 0.0, 0.0, 0.0),
        (ROD_HEAD, quarter, 0.0, pytest.approx(quarter / rod)),
        (KNOB, quarter, 0.0, pytest.approx(quarter / rod)),
        (KNOB, 0.4, 0.02, pytest.approx(0.4 / rod)),
        (SLIDER, 3.0, 4.0, 1.0),
    )


def test_forces_on_massless_members_are_shared_evenly():
    massless = replace(MECHANISM, members=(CRANK, ROD, replace(ARM, density=0.0)), lumped_masses=())
    assert [share for node, _, _, share in structure(massless).lumps if node in (ROD_PIN, ROD_HEAD, KNOB)] == [0.25] * 4


def test_torques_act_at_the_pin_of_the_two_bodies():
    assert structure(MECHANISM).couples == ((1, HINGE, 1), (2, ROD_PIN, 1), (2, CRANK_PIN, -1))


def test_a_driver_takes_the_place_of_held_coordinates():
    drive = AngleDriver("drive_row", "crank", polynomial_motion(0.0, 1.0))
    made = structure(replace(MECHANISM, joints=(*MECHANISM.joints, drive)))
    assert made.ties[-1] == (4, HINGE)
    assert made.locked == ()


def test_the_tables_hold_it():
    tables = compile_mechanism(MECHANISM)
    np.testing.assert_array_equal(tables.node_body, [0, 0, 1, 1, 1, 2])
    np.testing.assert_array_equal(tables.node_point[KNOB], ARM.end)
    np.testing.assert_allclose(tables.member_data[1], [2.0 / (1e11 * 2e-4), 2.0 / (1e11 * 3e-9), 2e-4, 2 * 3e-9 / 0.01])
    np.testing.assert_array_equal(tables.output_kind, [codes.NODE_DEFLECTION, codes.MEMBER_FORCE])
    np.testing.assert_array_equal(tables.output_index, [3 * KNOB, 3 * 1 + 1])
    np.testing.assert_array_equal(tables.output_value, [0.0, -1.0])


def test_without_outputs_that_read_members_there_are_no_tables_of_them():
    tables = compile_mechanism(replace(MECHANISM, outputs=(Output("angle", "crank.angle", ""),)))
    for name in ("node_body", "member_start", "tie_joint", "lump_node", "couple_force", "locked", "beam_body"):
        assert len(getattr(tables, name)) == 0, name


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"held": ("rod.x",)}, "Held coordinate 'rod.x' is the centre of mass of a body with members"),
        ({"held": ("rod.angle",)}, "Held coordinate 'rod.angle' turns 'rod' against 'ground', which have 0 pins"),
        ({"forces": (Torque("twist", "rod"),)}, "Torque 'twist' turns 'rod' against 'ground', which have 0 pins"),
        (
            {"forces": (SpringDamper("strut", "rod", (0.0, 0.0), GROUND, (0.0, 1.0)),)},
            "SpringDamper 'strut' acts at points of its bodies, which loads no member yet",
        ),
        ({"held": ()}, "18 displacements, but 3 members, 8 rows of joints and 0 held coordinates give 17 conditions"),
        (
            {"lumped_masses": (LumpedMass("off", "rod", (0.0, 0.0), 1.0),)},
            r"LumpedMass 'off' stands at \(0.0, 0.0\) of body 'rod'",
        ),
        ({"outputs": (Output("x", "arm.end.z", ""),)}, "'arm.end.z' is unknown; did you mean 'arm.end.[xy]'"),
        ({"outputs": (Output("x", "arm.middle.x", ""),)}, "'arm.middle.x' is unknown"),
    ],
)
def test_what_makes_no_structure_is_refused_with_the_reason(changed, said):
    with pytest.raises(MechanismError, match=said):
        compile_mechanism(replace(MECHANISM, **changed))


def test_symbolic_points_are_the_same_when_their_expressions_are():
    recorder = Recorder()
    a, b = recorder.parameter(0), recorder.parameter(1)
    assert same_point((a - b, 0.0), (a - b, 0.0))
    assert same_point((-a / 2, b), (-a / 2, b))
    assert not same_point((a - b, 0.0), (b - a, 0.0))
    assert not same_point((a, 0.0), (0.0, 0.0))
    dual = object()
    assert same_point((dual, 0.0), (dual, 0.0))
    assert not same_point((dual, 0.0), (object(), 0.0))

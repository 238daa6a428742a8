import math
from dataclasses import fields

import numpy as np
import pytest

from mechanism_fmu import codes
from mechanism_fmu.model import (
    GROUND,
    Body,
    Calculated,
    Input,
    Mechanism,
    Output,
    PointLineContact,
    Revolute,
    Settings,
    Torque,
    TorsionSpring,
    Translational,
)

TABLES = Mechanism(
    bodies=(Body("arm", 4.0, 0.25, (1.0, 2.0, 3.0), (4.0, 5.0, 6.0)), Body("slider", 16.0, 1.0)),
    joints=(
        Revolute("hinge", "arm", (1.0, 2.0), GROUND, (3.0, 4.0)),
        Translational("guide", "slider", (1.0, 2.0), (3.0, 4.0), "arm", (5.0, 6.0), (7.0, 8.0)),
    ),
    forces=(
        Torque("drive", "slider", reaction="arm", torque=9.0),
        TorsionSpring("spring", "arm", stiffness=1.0, free_angle=2.0, preload=3.0),
    ),
    contacts=(
        PointLineContact("rest", "arm", (1.0, 2.0), "slider", (3.0, 4.0), (0.6, 0.8), closed=True),
        PointLineContact("stop", "arm", (1.0, 2.0), GROUND, (3.0, 4.0), (0.0, 1.0), False, 0.5, 0.02, 7),
    ),
    inputs=(Input("preload", "spring.preload", 0.1, "x"), Input("torque", "drive.torque", 0.2, "x")),
    outputs=(
        Output("angle", "slider.angle", "x"),
        Output("rate", "arm.y_rate", "x"),
        Output("force", "stop.force", "x"),
        Output("gap", "rest.gap", "x"),
        Output("work", "energy.work", "x"),
        Output("count", "impact.count", "x", type="Integer"),
        Output("time", "impact.time", "x"),
        Output("impulse", "impact.impulse:stop", "x"),
        Output("before", "impact.speed_before:slider", "x"),
        Output("after", "impacts[3].speed:arm", "x"),
    ),
    calculated=(Calculated("size", 2.5, "x"),),
    held=("slider.y", "arm.angle"),
    settings=Settings(1e-6, 20.0, 30.0),
).compile()


def test_masses_repeat_for_x_and_y_and_the_ground_has_none():
    np.testing.assert_array_equal(TABLES.inverse_mass, [1 / 4, 1 / 4, 4, 1 / 16, 1 / 16, 1, 0, 0, 0])
    np.testing.assert_array_equal(TABLES.inverse_root_mass, np.sqrt(TABLES.inverse_mass))


def test_start_of_each_body():
    np.testing.assert_array_equal(TABLES.body_start, [[1, 2, 3], [0, 0, 0]])
    np.testing.assert_array_equal(TABLES.body_start_rate, [[4, 5, 6], [0, 0, 0]])


def test_joints_follow_each_other_in_the_rows():
    assert list(TABLES.joint_kind) == [codes.REVOLUTE, codes.TRANSLATIONAL]
    assert list(TABLES.joint_body_i) == [0, 1]
    assert list(TABLES.joint_body_j) == [2, 0]  # the ground has the number behind the last body
    assert list(TABLES.joint_row) == [0, 2]
    assert TABLES.joint_rows == 4
    np.testing.assert_array_equal(TABLES.joint_data, [[1, 2, 3, 4, 0, 0, 0, 0], [1, 2, 5, 6, 3, 4, 7, 8]])


def test_forces():
    assert list(TABLES.force_kind) == [codes.TORQUE, codes.TORSION_SPRING]
    assert list(TABLES.force_body) == [1, 0]
    assert list(TABLES.force_reaction) == [0, 2]
    np.testing.assert_array_equal(TABLES.force_data, [[9, 0, 0], [1, 2, 3]])
    columns = [codes.SPRING_STIFFNESS, codes.SPRING_FREE_ANGLE, codes.SPRING_PRELOAD]
    np.testing.assert_array_equal(TABLES.force_data[1, columns], [1, 2, 3])


def test_contacts():
    assert list(TABLES.contact_start_mode) == [codes.CLOSED, codes.OPEN]
    assert list(TABLES.contact_body_j) == [1, 2]
    assert list(TABLES.contact_tooth) == [0, 7]
    np.testing.assert_array_equal(TABLES.contact_data, [[1, 2, 3, 4, 0.6, 0.8], [1, 2, 3, 4, 0, 1]])
    np.testing.assert_array_equal(TABLES.contact_restitution, [0, 0.5])
    np.testing.assert_array_equal(TABLES.contact_beam_length, [0, 0.02])


def test_inputs_write_entries_of_the_force_table():
    assert list(TABLES.input_force) == [1, 0]
    assert list(TABLES.input_column) == [codes.SPRING_PRELOAD, codes.TORQUE_VALUE]
    np.testing.assert_array_equal(TABLES.input_start, [0.1, 0.2])


def test_outputs_and_calculated_values():
    contacts, bodies = 2, 2
    impulses = codes.RECORD_CONTACT_IMPULSES
    expected = [
        (codes.COORDINATE, 5, 0),
        (codes.RATE, 1, 0),
        (codes.CONTACT_FORCE, 1, 0),
        (codes.CONTACT_GAP, 0, 0),
        (codes.WORK_DONE, 0, 0),
        (codes.IMPACT_COUNT, 0, 0),
        (codes.LAST_IMPACT, codes.RECORD_TIME, 0),
        (codes.LAST_IMPACT, impulses + 1, 0),
        (codes.LAST_IMPACT, impulses + contacts + 5, 0),
        (codes.BUFFERED_IMPACT, impulses + contacts + 3 * bodies + 2, 2),
        (codes.CONSTANT, 0, 0),
    ]
    found = zip(TABLES.output_kind, TABLES.output_index, TABLES.output_slot, strict=True)
    assert [tuple(map(int, row)) for row in found] == expected
    np.testing.assert_array_equal(TABLES.output_value, [0.0] * 10 + [2.5])


def test_held_coordinates_and_settings():
    assert list(TABLES.held) == [4, 2]
    settings = [codes.RELATIVE_TOLERANCE, codes.BAUMGARTE_ALPHA, codes.BAUMGARTE_BETA]
    np.testing.assert_array_equal(TABLES.settings[settings], [1e-6, 20, 30])


def test_structure_is_integer_and_numbers_are_floats():
    for field in fields(TABLES):
        table = getattr(TABLES, field.name)
        if isinstance(table, np.ndarray):
            assert table.dtype in (np.dtype(np.int64), np.dtype(np.float64)), field.name


def test_a_single_free_body_has_tables_of_the_right_width():
    tables = Mechanism(bodies=(Body("stone", 1.0, 1.0, (0.0, 1.0, math.pi)),)).compile()
    assert tables.joint_data.shape == (0, 8)
    assert tables.force_data.shape == (0, 3)
    assert tables.contact_data.shape == (0, 6)
    assert tables.joint_rows == 0
    assert tables.body_start[0, 2] == pytest.approx(math.pi)

import math
from dataclasses import fields, replace

import numpy as np
import pytest

from mechanism_fmu import codes
from mechanism_fmu.model import (
    GROUND,
    AngleLock,
    AngleStop,
    Body,
    Brake,
    Calculated,
    CircularPattern,
    CompliantShaft,
    Damper,
    DCMotor,
    Force,
    Input,
    LogicalFunction,
    Mechanism,
    MechanismError,
    Output,
    PointLineContact,
    Revolute,
    Settings,
    Torque,
    TorsionSpring,
    Translational,
)
from mechanism_fmu.model.compile import compile_mechanism
from mechanism_fmu.tables.kinds import FORCES, JOINTS

TABLES = compile_mechanism(
    Mechanism(
        bodies=(Body("arm", 4.0, 0.25, (1.0, 2.0, 3.0), (4.0, 5.0, 6.0)), Body("slider", 16.0, 1.0, tooth_length=0.04)),
        joints=(
            Revolute("hinge", "arm", (1.0, 2.0), GROUND, (3.0, 4.0), 0.03),
            Translational("guide", "slider", (1.0, 2.0), (3.0, 4.0), "arm", (5.0, 6.0), (7.0, 8.0), 0.2),
        ),
        forces=(
            Torque("drive", "slider", reaction="arm", torque=9.0),
            TorsionSpring("spring", "arm", stiffness=1.0, free_angle=2.0, preload=3.0),
            Damper("oil", "arm", "slider", 0.5),
            CompliantShaft("shaft", "slider", stiffness=7.0, damping=8.0, angle=0.1, speed=0.2),
            Force("weight", "arm", (-3.0, -4.0)),
        ),
        contacts=(
            PointLineContact("rest", "arm", (1.0, 2.0), "slider", (3.0, 4.0), (0.6, 0.8), True, 0.5, 0.1, True),
            PointLineContact(
                "stop",
                "arm",
                (1.0, 2.0),
                GROUND,
                (3.0, 4.0),
                (0.0, 1.0),
                friction=0.3,
                closed_while="not near",
            ),
            PointLineContact(
                "tooth", "slider", (1.0, 2.0), "arm", (3.0, 4.0), (1.0, 0.0), enabled=False, pattern="teeth"
            ),
            AngleStop("click", "arm", GROUND, 0.4, 0.5, 0.25),
            AngleStop("end", "slider", "arm", -0.4),
            AngleLock("lock", "arm", "slider", 0.6, 0.7, "turned"),
        ),
        patterns=(
            CircularPattern("holes", "arm", (1.0, 2.0), GROUND, 0.5, (3.0, 4.0), (0.0, 1.0), enabled=False),
            CircularPattern("teeth", "slider", (5.0, 6.0), "arm", -0.25, (7.0, 8.0), (0.6, -0.8)),
        ),
        functions=(LogicalFunction("turned", "slider.angle", 1.5), LogicalFunction("near", "tooth.along", -0.5)),
        inputs=(Input("preload", "spring.preload", 0.1, "x"), Input("torque", "drive.torque", 0.2, "x")),
        outputs=(
            Output("angle", "slider.angle", "x"),
            Output("rate", "arm.y_rate", "x"),
            Output("force", "stop.force", "x"),
            Output("gap", "rest.gap", "x"),
            Output("closed", "stop.closed", "x", type="Boolean"),
            Output("clicks", "click.clicks", "x", type="Integer"),
            Output("latched", "end.latched", "x"),
            Output("index", "teeth.index", "x", type="Integer"),
            Output("twist", "shaft.torque", "x"),
            Output("events", "event.count", "x", type="Integer"),
            Output("work", "energy.work", "x"),
            Output("count", "impact.count", "x", type="Integer"),
            Output("when", "impact.time", "x"),
            Output("impulse", "impact.impulse:stop", "x"),
            Output("before", "impact.speed_before:slider", "x"),
            Output("after", "impacts[3].speed:arm", "x"),
        ),
        calculated=(Calculated("size", 2.5, "x"),),
        held=("slider.y", "arm.angle"),
        settings=Settings(1e-6, 20.0, 30.0),
    )
)


def test_masses_repeat_for_x_and_y_and_the_ground_has_none():
    np.testing.assert_array_equal(TABLES.inverse_mass, [1 / 4, 1 / 4, 4, 1 / 16, 1 / 16, 1, 0, 0, 0])
    np.testing.assert_array_equal(TABLES.inverse_root_mass, np.sqrt(TABLES.inverse_mass))


def test_start_of_each_body():
    np.testing.assert_array_equal(TABLES.body_start, [[1, 2, 3], [0, 0, 0]])
    np.testing.assert_array_equal(TABLES.body_start_rate, [[4, 5, 6], [0, 0, 0]])


def test_joints_follow_each_other_in_the_rows():
    assert list(TABLES.joint_kind) == [JOINTS.number("revolute"), JOINTS.number("translational")]
    assert list(TABLES.joint_body_i) == [0, 1]
    assert list(TABLES.joint_body_j) == [2, 0]  # the ground has the number behind the last body
    assert list(TABLES.joint_row) == [0, 2]
    assert TABLES.joint_rows == 4
    np.testing.assert_array_equal(TABLES.joint_data, [[1, 2, 3, 4, 0, 0, 0, 0, 0], [1, 2, 5, 6, 3, 4, 7, 8, 0]])


def test_forces():
    assert list(TABLES.force_kind) == [
        FORCES.number(kind) for kind in ("torque", "torsion_spring", "damper", "shaft", "force")
    ]
    assert list(TABLES.force_body) == [1, 0, 0, 1, 0]
    assert list(TABLES.force_reaction) == [0, 2, 1, 2, 2]
    assert TABLES.force_data.shape == (5, FORCES.width)
    np.testing.assert_array_equal(TABLES.force_data[:, 4:], 0.0)
    np.testing.assert_array_equal(
        TABLES.force_data[:, :4],
        [
            [9, 0, 0, 0],
            [1, 2, 3, 0],
            [0.5, 0, 0, 0],
            [7, 8, 0.1, 0.2],
            [-3, -4, 0, 0],
        ],
    )
    columns = FORCES.places("torsion_spring")
    np.testing.assert_array_equal(TABLES.force_data[1, columns], [1, 2, 3])
    assert TABLES.force_data[2, 0] == 0.5
    columns = FORCES.places("shaft")
    np.testing.assert_array_equal(TABLES.force_data[3, columns], [7, 8, 0.1, 0.2])
    np.testing.assert_array_equal(TABLES.force_data[4, FORCES.places("force")], [-3, -4])


def test_contacts():
    assert list(TABLES.contact_kind) == [codes.POINT_LINE] * 3 + [codes.ANGLE_STOP] * 2 + [codes.ANGLE_LOCK]
    assert list(TABLES.contact_body_i) == [0, 0, 1, 0, 1, 0]
    assert list(TABLES.contact_body_j) == [1, 2, 0, 2, 0, 1]
    np.testing.assert_array_equal(
        TABLES.contact_data,
        [
            [1, 2, 3, 4, 0.6, 0.8],
            [1, 2, 3, 4, 0, 1],
            [1, 2, 3, 4, 1, 0],
            [0.4, 0.5, 0, 0, 0, 0],
            [-0.4, 0, 0, 0, 0, 0],  # pitch 0: a plain stop
            [0.6, 0.7, 0, 0, 0, 0],
        ],
    )
    columns = ["RESTITUTION", "FRICTION", "GUIDED", "ENABLED", "STARTS_CLOSED"]
    values = TABLES.contact_value[:, [getattr(codes, name) for name in columns]]
    np.testing.assert_array_equal(
        values,
        [
            [0.5, 0.1, 1, 1, 1],
            [0, 0.3, 0, 1, 0],
            [0, 0, 0, 0, 0],
            [0.25, 0, 0, 1, 0],
            [0, 0, 0, 1, 0],
            [0, 0, 0, 1, 0],
        ],
    )


def test_one_body_with_teeth_has_the_impact_velocity():
    np.testing.assert_array_equal(TABLES.body_tooth_length, [0.0, 0.04])
    toothed, plain = Body("b", 1.0, 1.0, tooth_length=0.1), Body("a", 1.0, 1.0)
    for field in ("impact.velocity", "impacts[3].velocity"):
        output = (Output("v", field, ""),)
        compile_mechanism(Mechanism(bodies=(plain, toothed), outputs=output))
        with pytest.raises(MechanismError, match=r"no body has teeth; give Body\(tooth_length"):
            compile_mechanism(Mechanism(bodies=(plain,), outputs=output))
        with pytest.raises(MechanismError, match=r"several bodies have teeth \(b, c\)"):
            compile_mechanism(Mechanism(bodies=(toothed, replace(toothed, name="c")), outputs=output))


def test_patterns_repeat_the_contacts_that_name_them():
    assert list(TABLES.contact_pattern) == [codes.NONE, codes.NONE, 1, codes.NONE, codes.NONE, codes.NONE]
    assert list(TABLES.pattern_body_i) == [0, 1]
    assert list(TABLES.pattern_body_j) == [2, 0]
    np.testing.assert_array_equal(TABLES.pattern_data, [[1, 2, 3, 4, 0, 1], [5, 6, 7, 8, 0.6, -0.8]])
    np.testing.assert_array_equal(TABLES.pattern_pitch, [0.5, -0.25])
    np.testing.assert_array_equal(TABLES.pattern_enabled, [0, 1])


def test_logical_functions_switch_the_contacts_that_name_them():
    assert list(TABLES.function_kind) == [codes.ANGLE, codes.ALONG]
    assert list(TABLES.function_subject) == [1, 2]
    np.testing.assert_array_equal(TABLES.function_limit, [1.5, -0.5])
    none = codes.NONE
    assert list(TABLES.contact_function) == [none, 1, none, none, none, 0]
    assert [TABLES.contact_closes_when[c] for c in (1, 5)] == [0, 1]


def test_friction_of_joints():
    np.testing.assert_array_equal(TABLES.joint_friction, [0.03, 0.2])


def test_inputs_write_entries_of_the_force_table():
    assert list(TABLES.input_force) == [1, 0]
    assert list(TABLES.input_column) == [2, 0]
    np.testing.assert_array_equal(TABLES.input_start, [0.1, 0.2])


def test_states_of_forces_own():
    assert list(TABLES.force_own) == [codes.NONE] * 5
    assert TABLES.own == 0
    mechanism = Mechanism(
        bodies=(Body("rotor", 1.0, 1.0),),
        forces=(
            Brake("brake", "rotor", limit=3.0),
            Torque("load", "rotor"),
            DCMotor("motor", "rotor", GROUND, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0),
            DCMotor("second", "rotor"),
        ),
        inputs=(Input("wanted", "motor.speed", 0.0, ""), Input("hold", "brake.limit", 0.0, "")),
        outputs=(
            Output("torque", "motor.torque", ""),
            Output("current", "motor.current", ""),
            Output("voltage", "motor.voltage", ""),
            Output("held", "brake.friction_force", ""),
        ),
    )
    tables = compile_mechanism(mechanism)
    assert list(tables.force_own) == [codes.NONE, codes.NONE, 0, 2]
    assert tables.own == 4
    np.testing.assert_array_equal(tables.force_data[0], [3] + [0] * (FORCES.width - 1))
    np.testing.assert_array_equal(tables.force_data[2, :8], [1, 2, 3, 4, 5, 6, 7, 8])
    assert list(tables.input_column) == [7, 0]
    assert list(tables.output_kind) == [codes.FORCE_READING] * 3 + [codes.FRICTION_FORCE]
    assert list(tables.output_index) == [2, 2, 2, 0]
    assert list(tables.output_slot) == [0, 1, 2, 0]
    with pytest.raises(MechanismError, match=r"did you mean 'motor\.current'"):
        compile_mechanism(replace(mechanism, outputs=(Output("current", "motor.curent", ""),)))


def test_outputs_and_calculated_values():
    contacts, bodies = 6, 2
    impulses = codes.RECORD_CONTACT_IMPULSES
    expected = [
        (codes.UNKNOWN, 5, 0),
        (codes.UNKNOWN, 3 * bodies + 1, 0),
        (codes.CONTACT_FORCE, 1, 0),
        (codes.CONTACT_GAP, 0, 0),
        (codes.CONTACT_CLOSED, 1, 0),
        (codes.STOP_CLICKS, 3, 0),
        (codes.STOP_REFERENCE, 4, 0),
        (codes.PATTERN_INDEX, 1, 0),
        (codes.FORCE_READING, 3, 0),
        (codes.COUNTER, codes.COUNT_EVENTS, 0),
        (codes.UNKNOWN, 6 * bodies, 0),
        (codes.COUNTER, codes.COUNT_IMPACTS, 0),
        (codes.LAST_IMPACT, codes.RECORD_TIME, 0),
        (codes.LAST_IMPACT, impulses + 1, 0),
        (codes.LAST_IMPACT, impulses + contacts + 5, 0),
        (codes.BUFFERED_IMPACT, impulses + contacts + 3 * bodies + 2, 2),
        (codes.CONSTANT, 0, 0),
    ]
    found = zip(TABLES.output_kind, TABLES.output_index, TABLES.output_slot, strict=True)
    assert [tuple(map(int, row)) for row in found] == expected
    np.testing.assert_array_equal(TABLES.output_value, [0.0] * 16 + [2.5])


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
    tables = compile_mechanism(Mechanism(bodies=(Body("stone", 1.0, 1.0, (0.0, 1.0, math.pi)),)))
    assert tables.joint_data.shape == (0, 9)
    assert tables.force_data.shape == (0, FORCES.width)
    assert tables.contact_data.shape == (0, 6)
    assert tables.contact_value.shape == (0, codes.CONTACT_VALUES)
    assert tables.pattern_data.shape == (0, 6)
    assert tables.function_limit.shape == (0,)
    assert tables.curve_range.shape == (0, 2)
    assert tables.term_data.shape == (0, codes.TERM_COLUMNS)
    assert tables.joint_rows == tables.contact_rows == tables.alphas == 0
    assert tables.body_start[0, 2] == pytest.approx(math.pi)

import math

import pytest
from fake_slave import fake_description
from hypothesis import given, strategies as st

from harness.errors import UsageError
from harness.run.experiment import start_values


@pytest.mark.parametrize(
    ("assignment", "expected"),
    [
        ("tooth_slope_angle=95deg", math.radians(95)),
        ("tooth_slope_angle = 1.6", 1.6),
        ("drive_torque=2 N.mm", 2e-3),
        ("drive_torque=-.5e-3", -0.5e-3),
        ("oil_temperature=20 degC", 293.15),
        ("restitution=0.5", 0.5),
        ("tooth_count=20", 20),
        ("guided=False", False),
        ("brake=1", True),
        ("note=a = b", "a = b"),
    ],
)
def test_settings(assignment: str, expected: float | str) -> None:
    ((_, value),) = start_values([assignment], fake_description()).items()
    assert value == pytest.approx(expected, rel=1e-15) if isinstance(expected, float) else value == expected
    assert type(value) is type(expected)


@given(st.floats(allow_nan=False, allow_infinity=False, min_value=-1e300, max_value=1e300))
def test_every_number_arrives_as_it_was_written(number: float) -> None:
    assert start_values([f"drive_torque={number!r}"], fake_description()) == {"drive_torque": number}


@pytest.mark.parametrize(
    ("assignments", "message"),
    [
        (["drive_torque"], "is not a setting; write name=value"),
        (["drive_torqe=1"], r"no variable 'drive_torqe'\. Did you mean drive_torque"),
        (
            ["wheel_angel=1"],
            r"no variable 'wheel_angel'\. Its inputs and parameters: drive_torque, gear, brake, tooth_",
        ),
        (["tooth_pich=9"], r"Did you mean tooth_count\?$"),
        (["wheel_angle=1"], "causality output and cannot be set; inputs and parameters can: drive_torque, gear"),
        (["tooth_pitch=1"], "causality calculatedParameter and cannot be set"),
        (["drive_torque=1", "drive_torque=2"], "'drive_torque' is set twice"),
        (["drive_torque=fast"], "'fast' is not a number, with or without a unit"),
        (["drive_torque=nan"], "'nan' is not a number"),
        (["drive_torque=inf"], "'inf' is not a number"),
        (["drive_torque=1e999"], "too large for a number"),
        (["drive_torque="], "'' is not a number"),
        (["drive_torque=2 mm"], "'mm' does not measure the same quantity; these fit: N.m"),
        (["restitution=0.5 m"], "has no unit; give the number alone"),
        (["restitution=1.5"], "above its limit; give at most 1"),
        (["tooth_count=2"], r"below its limit; give at least 3\.$"),
        (
            ["tooth_slope_angle=95"],
            r"above its limit; give at most 3 rad \(171.887 deg\)\. A number without a unit is in rad\.$",
        ),
        (["tooth_slope_angle=190deg"], r"'190deg' is above its limit; give at most 3 rad \(171.887 deg\)\.$"),
        (["tooth_count=2.5"], "not a whole number"),
        (["tooth_count=5000000000"], r"does not fit its type \(Integer, from -2147483648 to 2147483647\)"),
        (["guided=perhaps"], "not a Boolean; give true or false"),
    ],
)
def test_settings_that_cannot_be_used_are_refused(assignments: list[str], message: str) -> None:
    with pytest.raises(UsageError, match=message):
        start_values(assignments, fake_description())

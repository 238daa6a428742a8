import math
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given, settings, strategies as st
from ratchet_cases import PAPER, gap, paper_values, refused

from docs.drawings import ratchet_drawing
from mechanism_fmu.model import MechanismError
from mechanism_fmu.model.compile import compile_mechanism
from mechanism_fmu.model.sawtooth import sawtooth
from models.ratchet.model import MODEL
from models.ratchet.start import crank_pin, pawl_angle, tip_distance, tooth


@pytest.mark.parametrize(("teeth", "angle"), PAPER)
def test_no_case_of_the_paper_is_refused(teeth, angle):
    values = paper_values(teeth, angle)
    assert MODEL.refused(values) == []
    compile_mechanism(MODEL.build(values))


@pytest.mark.parametrize(("teeth", "angle"), PAPER)
def test_start_puts_the_tip_on_the_slope_before_the_face(teeth, angle):
    values = paper_values(teeth, angle)
    tooth = sawtooth(teeth, math.radians(angle), 0.1, 1.115)
    assert gap(values, tooth.slope_normal) == pytest.approx(0, abs=1e-16)
    expected = tip_distance(values) * math.sin(tooth.pitch + tooth.apex_angle)
    assert gap(values, tooth.face_normal) == pytest.approx(expected, abs=1e-15)
    assert expected > 0.01


def test_start_angle_of_the_paper_holds_between_90_and_95_degrees():
    angles = [math.degrees(pawl_angle(paper_values(10, angle))) for angle in (90, 92.4, 95)]
    assert angles[0] > 190 > angles[2]
    assert angles[1] == pytest.approx(190, abs=0.03)


@pytest.mark.parametrize(("teeth", "angle"), PAPER)
def test_only_the_wheels_with_25_teeth_start_beyond_the_apex(teeth, angle):
    warnings = MODEL.warned(paper_values(teeth, angle))
    assert len(warnings) == (1 if teeth == 25 else 0)


def test_warning_says_by_how_much_the_tip_is_beyond_the_apex():
    (warning,) = MODEL.warned(paper_values(25, 90))
    # tip 31.7268 mm from the root, slope 1.115 * 0.2 m sin(7.2 deg) = 27.9493 mm
    for fragment in ("0.00377749 m beyond the apex", "0.0317268 m", "0.0279493 m", "fewer", "slope_ratio"):
        assert fragment in warning


def test_a_solid_steel_wheel_of_the_base_case_has_the_mass_of_table_2():
    found = calculated_of(paper_values(10, 90))
    assert found["solid_wheel_mass"] == pytest.approx(5.6264, abs=5e-5)
    assert found["solid_wheel_inertia"] == pytest.approx(32.7948e-3, rel=1.5e-4)


@pytest.mark.parametrize(("teeth", "angle"), PAPER)
def test_a_solid_wheel_is_its_outline_without_the_bore(teeth, angle):
    """Green's theorem over the whole outline, point by point."""
    found = calculated_of(paper_values(teeth, angle))
    turns = -np.repeat(np.arange(teeth), 2) * found["tooth_pitch"]
    corner = np.tile([0.1, found["tooth_apex_radius"]], teeth) * np.exp(
        1j * (turns + np.tile([0.0, found["tooth_apex_offset"]], teeth))
    )
    following = np.roll(corner, -1)
    cross = -(corner.conj() * following).imag
    second = cross / 12 * (abs(corner) ** 2 + (corner.conj() * following).real + abs(following) ** 2)
    bore = 6.5e-3
    assert found["solid_wheel_mass"] == pytest.approx(157 * (sum(cross) / 2 - math.pi * bore**2), rel=1e-12)
    assert found["solid_wheel_inertia"] == pytest.approx(157 * (sum(second) - math.pi * bore**4 / 2), rel=1e-12)


def calculated_of(values):
    return {one.name: float(one.value) for one in MODEL.build(values).calculated}


def test_flat_teeth_are_refused_with_the_flattest_slope():
    _, message = refused(tooth_count=100, tooth_slope_angle=math.radians(85))
    assert "tooth_slope_angle = 85 deg" in message
    assert "more than 88.2 deg" in message  # 90 deg - 180 deg / 100


def test_blunt_teeth_are_refused_with_the_least_slope_ratio():
    _, message = refused(slope_ratio=0.9)
    assert "slope_ratio = 0.9" in message
    assert "more than 0.951057" in message  # cos 18 deg
    assert MODEL.refused(MODEL.values(slope_ratio=0.952)) == []


def test_teeth_without_a_notch_are_refused_with_the_least_slope_ratio():
    """Three teeth, whose apex has less than 90 deg, but whose roots stick out: 206 deg are free there."""
    values, message = refused(tooth_count=3, slope_ratio=0.5575)
    assert gap(values, tooth(values).face_normal) == pytest.approx(-0.014, abs=1e-5)
    for fragment in ("slope_ratio = 0.5575 leaves no notch", "206.201 deg", "tooth_count = 3 give more than 1, or"):
        assert fragment in message
    assert MODEL.refused(MODEL.values(tooth_count=3, slope_ratio=1.001)) == []
    # with four teeth, the face is at a right angle to the slope where both limits meet
    _, message = refused(tooth_count=4, slope_ratio=0.7)
    assert "blunt teeth" in message


def test_short_pawl_is_refused_with_the_missing_length():
    height = crank_pin(MODEL.values()).height
    _, message = refused(pawl_length=height - 0.01)
    assert "0.01 m too short" in message
    assert "at crank_length = 0.11 m, crank_angle_start = 77 deg and wheel_angle_start = 75 deg." in message
    assert f"at least {height:.6g} m" in message
    assert MODEL.refused(MODEL.values(pawl_length=height + 1e-9)) == []


def test_long_pawl_is_refused_with_the_excess_and_the_depth_behind_the_face():
    pin = crank_pin(MODEL.values())
    longest = math.hypot(pin.height, pin.distance)
    values, message = refused(pawl_length=longest + 0.02)
    tooth = sawtooth(10, math.pi / 2, 0.1, 1.115)
    assert "0.02 m too long" in message
    assert f"{-gap(values, tooth.face_normal):.6g} m behind the face" in message
    assert f"less than {longest:.6g} m" in message
    assert MODEL.refused(MODEL.values(pawl_length=longest - 1e-9)) == []


@pytest.mark.parametrize(
    ("changes", "length"),
    [
        ({"crank_length": 0.05}, "crank_length"),
        ({"wheel_inner_radius": 0.2}, "crank_length"),
        ({"crank_angle_start": math.radians(160)}, "hinge_distance"),
    ],
)
def test_pin_behind_the_slope_is_refused_and_the_way_out_leads_out(changes, length):
    values, message = refused(**changes)
    assert f"{-crank_pin(values).height:.6g} m behind the slope" in message
    assert f"{length} = {getattr(values, length):.6g} m is" in message
    advised = float(message.split("give more than ")[1].split(" m")[0])
    assert crank_pin(MODEL.values(**changes | {length: advised + 1e-6})).height == pytest.approx(0, abs=3e-6)


def test_pin_behind_the_root_is_refused_although_the_slope_is_in_reach():
    values, message = refused(wheel_angle_start=0.0)
    assert f"{-crank_pin(values).distance:.6g} m behind the root" in message
    assert "change crank_angle_start or wheel_angle_start" in message


@pytest.mark.parametrize(
    ("changes", "fragments"),
    [
        ({"tooth_count": 2}, ["tooth_count = 2", "at least 3"]),
        ({"tooth_count": 10.5}, ["tooth_count = 10.5", "whole number"]),
        ({"guided": 0.5}, ["guided = 0.5", "true (1)", "false (0)"]),
        ({"pawl_mass": -1.0}, ["pawl_mass = -1 kg", "at least 1e-18 kg"]),
        ({"restitution": 1.1}, ["restitution = 1.1", "at most 1"]),
        ({"pawl_length": math.nan}, ["pawl_length = nan", "finite", " m"]),
        ({"crank_length": math.inf}, ["crank_length = inf"]),
        ({"relative_tolerance": 1e-20}, ["relative_tolerance = 1e-20", "1e-13"]),
        ({"tooth_number": 10}, ["no parameter 'tooth_number'", "tooth_count"]),
    ],
)
def test_single_values_outside_their_limits_are_refused(changes, fragments):
    with pytest.raises(MechanismError) as refusal:
        MODEL.values(**changes)
    for fragment in fragments:
        assert fragment in str(refusal.value)


def any_within_limits():
    geometry = (
        "tooth_slope_angle",
        "slope_ratio",
        "pawl_length",
        "crank_length",
        "hinge_distance",
        "wheel_inner_radius",
    )
    limits = {p.name: p for p in MODEL.parameters}
    near = {name: st.floats(0.5, 2.0).map(lambda f, start=limits[name].start: f * start) for name in geometry}
    far = {name: st.floats(limits[name].minimum, limits[name].maximum) for name in geometry}
    angles = {name: st.floats(-10, 10) for name in ("crank_angle_start", "wheel_angle_start")}
    choices = {name: near[name] | far[name] for name in geometry} | angles
    return st.fixed_dictionaries({"tooth_count": st.integers(3, 1000)}, optional=choices)


@settings(deadline=None)
@given(any_within_limits())
@example({"tooth_count": 3, "slope_ratio": 0.5575})
def test_values_within_limits_are_refused_in_words_or_start_on_the_slope(changes):
    try:
        values = MODEL.values(**changes)
    except MechanismError:
        return
    objections = MODEL.refused(values)
    if objections:
        assert all(objection.endswith(".") for objection in objections)
        return
    compile_mechanism(MODEL.build(values))
    assert all("beyond the apex" in warning for warning in MODEL.warned(values))
    size = max(values.hinge_distance, values.crank_length, values.pawl_length, values.wheel_inner_radius)
    assert gap(values, tooth(values).slope_normal) == pytest.approx(0, abs=1e-12 * size)
    assert gap(values, tooth(values).face_normal) > -1e-12 * size
    assert tooth(values).beam_length > 0


def test_variable_names_are_unique_over_all_causalities():
    mechanism = MODEL.build(MODEL.values())
    ports = (*mechanism.inputs, *mechanism.outputs, *MODEL.parameters, *mechanism.calculated)
    names = [port.name for port in ports]
    assert len(set(names)) == len(names)
    assert all(port.description for port in ports)


def test_defaults_are_within_their_limits_and_are_those_of_the_paper():
    values = MODEL.values()
    assert (values.hinge_distance, values.crank_length) == (0.130, 0.110)
    assert (values.pawl_length, values.wheel_inner_radius) == (0.100, 0.100)
    np.testing.assert_allclose(
        [values.crank_angle_start, values.wheel_angle_start, values.spring_free_angle], np.radians([77, 75, 75])
    )


def test_drawing_is_that_of_the_defaults():
    written = (Path(ratchet_drawing.__file__).parents[2] / "models/ratchet/drawing.svg").read_text(encoding="utf-8")
    assert written == ratchet_drawing.drawing(MODEL.values()), "run python -m docs.drawings.ratchet_drawing"
    ElementTree.fromstring(written)


@pytest.mark.parametrize(("teeth", "angle"), PAPER)
def test_every_case_of_the_paper_can_be_drawn(teeth, angle):
    text = ratchet_drawing.drawing(paper_values(teeth, angle))
    ElementTree.fromstring(text)
    assert "nan" not in text

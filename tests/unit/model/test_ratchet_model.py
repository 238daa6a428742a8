import cmath
import math
import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mechanism_fmu.model import MechanismError
from mechanism_fmu.model.sawtooth import sawtooth
from mechanism_fmu.simulation import Simulation
from models.ratchet import drawing
from models.ratchet.model import MODEL
from models.ratchet.start import crank_pin, pawl_angle, tip_distance, tooth

PAPER = [(teeth, angle) for teeth in (10, 15, 20, 25) for angle in (85, 90, 95, 100, 105)]


def paper_values(teeth, angle):
    return MODEL.values(tooth_count=teeth, tooth_slope_angle=math.radians(angle))


def gap(values, normal):
    """n . (R(-psi) tip - root), from the global position of the pawl's tip at the start [m]."""
    pin, gamma, psi = crank_pin(values), pawl_angle(values), values.wheel_angle_start
    x, y = pin.x + values.pawl_length * math.cos(gamma), pin.y + values.pawl_length * math.sin(gamma)
    seen = (math.cos(psi) * x + math.sin(psi) * y, math.cos(psi) * y - math.sin(psi) * x)
    return normal[0] * (seen[0] - values.wheel_inner_radius) + normal[1] * seen[1]


@pytest.mark.parametrize(("teeth", "angle"), PAPER)
def test_no_case_of_the_paper_is_refused(teeth, angle):
    values = paper_values(teeth, angle)
    assert MODEL.refused(values) == []
    MODEL.build(values).compile()


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


def refused(**changes):
    values = MODEL.values(**changes)
    with pytest.raises(MechanismError) as refusal:
        MODEL.build(values)
    return values, str(refusal.value)


def free_start(**changes):
    """The free ratchet's parameters and where its pawl's tip starts, in the axes of the wheel [m]."""
    values = MODEL.values(guided=0, **changes)
    simulation = Simulation(MODEL.build(values))
    return values, seen_from_the_wheel(values, *simulation.field("y_end")[3:6])


def seen_from_the_wheel(values, x, y, angle):
    """The tip of a pawl with this centre and angle, turned back by psi [m]."""
    half, psi = values.pawl_length / 2, values.wheel_angle_start
    x, y = x + half * math.cos(angle), y + half * math.sin(angle)
    return np.array([math.cos(psi) * x + math.sin(psi) * y, math.cos(psi) * y - math.sin(psi) * x])


def outline(values):
    """Corners of the wheel, shape (corners, 2), in its own axes [m]: built of roots and turned copies of one apex."""
    beta, theta, r = values.tooth_slope_angle, 2 * math.pi / values.tooth_count, values.wheel_inner_radius
    slope = values.slope_ratio * 2 * r * math.sin(theta / 2)
    corners = []
    for k in range(int(values.tooth_count)):
        turn = cmath.exp(-1j * k * theta)
        for corner in (r, r + slope * complex(-math.cos(beta), -math.sin(beta))):
            corners.append(((corner * turn).real, (corner * turn).imag))
    return np.array(corners)


def distance_to(corners, point):
    """Distance of a point from a closed polygon's edges [m]."""
    ends = np.roll(corners, -1, axis=0)
    along = np.clip(np.sum((point - corners) * (ends - corners), 1) / np.sum((ends - corners) ** 2, 1), 0, 1)
    return np.linalg.norm(corners + along[:, None] * (ends - corners) - point, axis=1).min()


def is_inside(corners, point):
    """Whether the polygon winds round the point."""
    angles = np.unwrap([math.atan2(y, x) for x, y in [*(corners - point), corners[0] - point]])
    return abs(angles[-1] - angles[0]) > math.pi


def slopes_in_reach(values):
    """How many slopes a tip that turns counter-clockwise about the crank pin comes down on from outside."""
    pin, psi, b = crank_pin(values), values.wheel_angle_start, values.pawl_length
    centre = [math.cos(psi) * pin.x + math.sin(psi) * pin.y, math.cos(psi) * pin.y - math.sin(psi) * pin.x]
    roots, apexes = outline(values)[::2] - centre, outline(values)[1::2] - centre
    count = 0
    for root, apex in zip(roots, apexes, strict=True):
        along = apex - root
        square, half = along @ along, root @ along
        rest = half**2 - square * (root @ root - b**2)
        for sign in (1, -1) if rest > 0 else ():
            share = (-half + sign * math.sqrt(rest)) / square
            x, y = root + share * along
            # the corners run clockwise: outside is to the left of an edge; the tip moves along (-y, x)
            sinks = -y * -along[1] + x * along[0] < -1e-6 * b * math.sqrt(square)
            count += 1e-6 < share < 1 - 1e-6 and sinks
    return count


@settings(deadline=None, max_examples=200)
@given(
    st.fixed_dictionaries(
        {},
        optional={
            "tooth_count": st.integers(6, 40),
            "tooth_slope_angle": st.floats(80, 110).map(math.radians),
            "slope_ratio": st.floats(1.0, 1.6),
            "pawl_length": st.floats(0.07, 0.14),
            "crank_length": st.floats(0.09, 0.13),
            "wheel_inner_radius": st.floats(0.06, 0.11),
            "crank_angle_start": st.floats(40, 120).map(math.radians),
            "wheel_angle_start": st.floats(-200, 200).map(math.radians),
        },
    )
)
def test_a_free_pawl_starts_with_its_tip_on_the_profile_wherever_it_reaches_a_slope(changes):
    if MODEL.refused(MODEL.values(guided=0, **changes)):
        return
    try:
        values, tip = free_start(**changes)
    except MechanismError:
        assert not slopes_in_reach(MODEL.values(guided=0, **changes))
        return
    assert distance_to(outline(values), tip) < 1e-9


@pytest.mark.parametrize("wheel_angle", [0, 20, 75, 91.7, 100])
def test_a_free_pawl_starts_on_a_slope_whatever_the_wheels_angle(wheel_angle):
    """Turned by one pitch, the wheel looks the same: the tip stands where it stood, on the next tooth."""
    angle = math.radians(wheel_angle)
    simulations = [
        Simulation(MODEL.build(MODEL.values(guided=0, wheel_angle_start=start)))
        for start in (angle, angle + 2 * math.pi / 10)
    ]
    first, next_ = (simulation.field("y_end")[3:6] for simulation in simulations)
    np.testing.assert_allclose(first, next_, rtol=0, atol=1e-12)
    indices = [simulation.read()["tooth_index"] for simulation in simulations]
    assert indices[1] == indices[0] + 1
    assert all(simulation.mode()[0] == "slope" for simulation in simulations)


def test_a_free_pawl_too_short_for_the_teeth_is_refused_with_the_missing_length():
    pin, tips = crank_pin(MODEL.values()), math.hypot(*tooth(MODEL.values()).apex)
    shortest = math.hypot(pin.x, pin.y) - tips
    _, message = refused(guided=0, pawl_length=shortest - 0.01)
    assert "0.01 m too short" in message
    assert f"more than {shortest:.6g} m" in message
    assert MODEL.refused(MODEL.values(guided=0, pawl_length=shortest + 0.01)) == []


@pytest.mark.parametrize(
    "changes",
    [{"pawl_length": 0.5}, {"crank_angle_start": math.radians(180), "wheel_inner_radius": 0.3}],
    ids=["pawl too long", "pin inside the wheel"],
)
def test_a_free_pawl_that_cannot_come_to_the_roots_is_refused_with_the_lengths_that_do(changes):
    values, message = refused(guided=0, **changes)
    assert f"pawl_length = {values.pawl_length:.6g} m does not fit" in message
    least, most = map(float, re.findall(r"between ([\d.e-]+) m and ([\d.e-]+) m", message)[0])
    pin = crank_pin(values)
    distance = math.hypot(pin.x, pin.y)
    assert least == pytest.approx(abs(distance - values.wheel_inner_radius), rel=1e-5)
    assert most == pytest.approx(distance + values.wheel_inner_radius, rel=1e-5)
    for length in (least + 1e-4, most - 1e-4):
        assert MODEL.refused(MODEL.values(**changes | {"guided": 0, "pawl_length": length})) == []


def test_a_given_pawl_angle_above_the_teeth_is_kept():
    solved = Simulation(MODEL.build(MODEL.values(guided=0))).field("y_end")[5]
    angle = solved - math.radians(10)
    values, tip = free_start(pawl_angle_start=angle)
    simulation = Simulation(MODEL.build(values))
    assert simulation.field("y_end")[5] == pytest.approx(angle, abs=1e-15)
    assert simulation.mode() == ("holding_pawl",)
    assert distance_to(outline(values), tip) > 1e-3
    assert not is_inside(outline(values), tip)


@pytest.mark.parametrize("degrees", [0.5, 1.0, 2.0, 4.0])
def test_a_given_pawl_angle_inside_a_tooth_is_refused_with_the_depth(degrees):
    solved = Simulation(MODEL.build(MODEL.values(guided=0))).field("y_end")[5]
    values = MODEL.values(guided=0, pawl_angle_start=solved + math.radians(degrees))
    pin, gamma = crank_pin(values), values.pawl_angle_start
    half = values.pawl_length / 2
    centre = (pin.x + half * math.cos(gamma), pin.y + half * math.sin(gamma))
    tip = seen_from_the_wheel(values, *centre, gamma)
    assert is_inside(outline(values), tip)
    with pytest.raises(MechanismError, match=r"Contact 'slope': the point of 'pawl' is ([\d.e-]+) m behind") as refusal:
        Simulation(MODEL.build(values))
    depth = float(re.findall(r"is ([\d.e-]+) m behind", str(refusal.value))[0])
    assert depth == pytest.approx(distance_to(outline(values), tip), rel=1e-5)


def test_flat_teeth_are_refused_with_the_flattest_slope():
    _, message = refused(tooth_count=100, tooth_slope_angle=math.radians(85))
    assert "tooth_slope_angle = 85 deg" in message
    assert "more than 88.2 deg" in message  # 90 deg - 180 deg / 100


def test_blunt_teeth_are_refused_with_the_least_slope_ratio():
    _, message = refused(slope_ratio=0.9)
    assert "slope_ratio = 0.9" in message
    assert "more than 0.951057" in message  # cos 18 deg
    assert MODEL.refused(MODEL.values(slope_ratio=0.952)) == []


def test_short_pawl_is_refused_with_the_missing_length():
    height = crank_pin(MODEL.values()).height
    _, message = refused(pawl_length=height - 0.01)
    assert "0.01 m too short" in message
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
        ({"pawl_mass": -1.0}, ["pawl_mass = -1 kg", "at least 1e-12 kg"]),
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
def test_values_within_limits_are_refused_in_words_or_start_on_the_slope(changes):
    try:
        values = MODEL.values(**changes)
    except MechanismError:
        return
    objections = MODEL.refused(values)
    if objections:
        assert all(objection.endswith(".") for objection in objections)
        return
    MODEL.build(values).compile()
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
    written = (Path(drawing.__file__).parent / "drawing.svg").read_text(encoding="utf-8")
    assert written == drawing.drawing(MODEL.values()), "run python -m models.ratchet.drawing"
    ElementTree.fromstring(written)


@pytest.mark.parametrize(("teeth", "angle"), PAPER)
def test_every_case_of_the_paper_can_be_drawn(teeth, angle):
    text = drawing.drawing(paper_values(teeth, angle))
    ElementTree.fromstring(text)
    assert "nan" not in text

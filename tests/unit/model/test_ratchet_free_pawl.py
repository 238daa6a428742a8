"""Where the free pawl of the ratchet starts: on the teeth, seen from the wheel, or not at all."""

import cmath
import math
import re

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from ratchet_cases import refused

from mechanism_fmu.model import MechanismError
from mechanism_fmu.simulation import Simulation
from models.ratchet.model import MODEL
from models.ratchet.start import crank_pin, tooth


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

"""Markers: what is read of a point of a body."""

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from single_element import POINT, read

from mechanism_fmu.model import Body, Marker, Mechanism, Output, PointForce
from mechanism_fmu.simulation import Simulation


@given(
    pose=st.tuples(*[st.floats(-3.0, 3.0)] * 3), rate=st.tuples(*[st.floats(-5.0, 5.0)] * 3), point=POINT, pull=POINT
)
@settings(max_examples=30, deadline=None)
def test_a_marker_reads_place_velocity_and_acceleration_of_its_point(pose, rate, point, pull):
    """By complex numbers: r = z + s e^(i phi); and it does nothing to the motion."""
    body = Body("body", 2.0, 0.3, pose, rate)
    push = PointForce("push", "body", (0.1, 0.2), pull)
    pen = (Marker("pen", "body", point),)
    outputs = read("pen", "x", "y", "x_rate", "y_rate")
    simulation = Simulation(Mechanism((body,), forces=(push,), markers=pen, outputs=outputs))
    found, rates = simulation.read(), simulation.read_rates()
    turn = np.exp(1j * pose[2])
    arm = complex(*point) * turn
    place = complex(*pose[:2]) + arm
    velocity = complex(*rate[:2]) + 1j * rate[2] * arm
    lever = (0.1 + 0.2j) * turn
    torque = (lever.conjugate() * complex(*pull)).imag
    acceleration = complex(*pull) / 2.0 + (1j * torque / 0.3 - rate[2] ** 2) * arm
    expected = (place.real, place.imag, velocity.real, velocity.imag)
    assert [*found.values()] == pytest.approx(expected, abs=1e-13)
    expected = (velocity.real, velocity.imag, acceleration.real, acceleration.imag)
    assert [*rates.values()] == pytest.approx(expected, rel=1e-12, abs=1e-11)
    motion = read("body", "x", "angle", "speed")
    both = [Simulation(Mechanism((body,), forces=(push,), markers=marks, outputs=motion)) for marks in ((), pen)]
    for one in both:
        one.advance(0.3)
    assert both[0].read() == both[1].read()


def test_a_marker_in_the_centre_of_mass_reads_what_the_body_does_under_the_same_names():
    body = Body("body", 2.0, 0.3, (0.3, -0.2, 0.5), (1.5, -0.4, 2.0))
    pen = Marker("pen", "body", (0.0, 0.0))
    names = [name for part in (body, pen) for name in (part.x, part.y, part.x_rate, part.y_rate)]
    outputs = tuple(Output(name, name, "") for name in names)
    found = list(Simulation(Mechanism((body,), markers=(pen,), outputs=outputs)).read().values())
    assert found == [0.3, -0.2, 1.5, -0.4] * 2

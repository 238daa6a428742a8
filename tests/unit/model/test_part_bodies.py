"""Bodies from parameters: where links and rotors start, and how fast."""

import math
from types import SimpleNamespace

import pytest
from hypothesis import given, strategies as st

from mechanism_fmu.model import Body
from mechanism_fmu.model.body import MovingPoint, link_body, rotor_body

VALUES = SimpleNamespace(wheel_mass=2.0, wheel_inertia=0.3, rod_mass=0.5, rod_inertia=0.01, rod_centre=0.25)


def test_a_rotor_turns_about_its_hinge():
    assert rotor_body(VALUES, "wheel", (1.0, 2.0), 0.5, 3.0) == Body(
        "wheel", 2.0, 0.3, (1.0, 2.0, 0.5), (0.0, 0.0, 3.0)
    )
    assert rotor_body(VALUES, "wheel", (1.0, 2.0), 0.5) == Body("wheel", 2.0, 0.3, (1.0, 2.0, 0.5))


def test_a_link_by_hand():
    """It points upwards from a pin that goes to the right at 2 m/s, and turns to the left: its centre stands still."""
    rod = link_body(VALUES, "rod", MovingPoint(1.0, 2.0, 2.0, 0.0), math.pi / 2, 8.0)
    assert (rod.name, rod.mass, rod.inertia) == ("rod", 0.5, 0.01)
    assert rod.start == pytest.approx((1.0, 2.25, math.pi / 2), abs=1e-15)
    assert rod.start_rate == pytest.approx((0.0, 0.0, 8.0), abs=1e-15)


@given(*(st.floats(-3.0, 3.0) for _ in range(5)))
def test_rates_are_the_derivatives_of_places(first, first_speed, second, second_speed, x):
    """Of a link on a link, by central differences in time."""

    def centre(time):
        pin = MovingPoint(x, -x).along(0.7, first + first_speed * time, first_speed)
        return link_body(VALUES, "rod", pin, second + second_speed * time, second_speed)

    step = 1e-5
    ahead, behind, now = centre(step).start, centre(-step).start, centre(0.0).start_rate
    difference = [(a - b) / (2 * step) for a, b in zip(ahead, behind, strict=True)]
    assert now == pytest.approx(difference, abs=1e-8)

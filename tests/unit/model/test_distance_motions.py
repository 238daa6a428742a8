"""A driven distance that comes to 0 is refused where that is certain, and never elsewhere."""

import math
from types import SimpleNamespace

import pytest
from hypothesis import assume, given, strategies as st
from recorded import said

from mechanism_fmu.model import (
    GROUND,
    Body,
    Curve,
    DistanceDriver,
    Mechanism,
    Model,
    Parameter,
    Piece,
    constant,
    cosine,
    harmonic_motion,
    polynomial_motion,
    table_motion,
)
from mechanism_fmu.model.checks.check_numbers import number_findings
from mechanism_fmu.model.findings import messages
from mechanism_fmu.model.trace import trace


def driven(motion: Curve) -> Mechanism:
    return Mechanism((Body("bob", 1.0, 1.0),), (DistanceDriver("pull", "bob", (0.0, 0.0), motion, GROUND),))


def refusals(motion: Curve) -> list[str]:
    return [text for text in messages(number_findings(driven(motion))) if "must stay above 0" in text]


@pytest.mark.parametrize(
    ("motion", "least"),
    [
        (polynomial_motion(0.0, 0.1), "0"),
        (polynomial_motion(-0.1), "-0.1"),
        (harmonic_motion(0.1, 0.1, 2.0), "0"),
        (harmonic_motion(0.1, -0.25, 2.0, 0.5), "-0.15"),
        (table_motion([(0.0, 0.1), (1.0, 0.0), (2.0, 0.1)]), "0"),
        (table_motion([(0.0, 0.1), (1.0, 0.1), (2.0, -0.2), (3.0, 0.1)]), None),
        # Between its points, a spline may come to less than at any of them.
        (table_motion([(0.0, 1.0), (1.0, 0.02), (2.0, 0.02), (3.0, 1.0)]), None),
    ],
)
def test_a_distance_that_comes_to_zero_is_refused(motion, least):
    (text,) = refusals(motion)
    assert text.startswith("DistanceDriver 'pull': its motion comes to a distance of ")
    assert least is None or f"of {least} m," in text


@pytest.mark.parametrize(
    "motion",
    [
        polynomial_motion(0.2, -0.05),  # in 4 s; whether the motion goes on so long is not known
        harmonic_motion(0.1, 0.099, 2.0),
        harmonic_motion(0.1, 0.2, 0.0, 1.0),  # at rest
        table_motion([(0.0, 0.1), (1.0, 0.01), (2.0, 0.1)]),
        Curve((Piece(0.0, (constant(0.3), cosine(0.4, 1.0))),), 0.0, 1.5, periodic=True),  # to 0.33 and back
    ],
)
def test_a_distance_that_need_not_is_not(motion):
    assert refusals(motion) == []


MEAN, AMPLITUDE, FREQUENCY = (
    Parameter(name, start, "Of the distance") for name, start in (("mean", 1.0), ("amplitude", 0.5), ("frequency", 1.0))
)


def swing(values: SimpleNamespace) -> Mechanism:
    return driven(harmonic_motion(values.mean, values.amplitude, values.frequency, 0.3))


TRACED = trace(Model("Swing", "A swinging distance", (MEAN, AMPLITUDE, FREQUENCY), swing))
number = st.floats(-2.0, 2.0)


@given(number, number, number)
def test_a_swing_is_refused_exactly_where_it_comes_to_zero_and_native_fmus_say_the_same(mean, amplitude, frequency):
    values = TRACED.model.values(mean=mean, amplitude=amplitude, frequency=frequency)
    least = mean + amplitude * math.sin(0.3)
    if frequency != 0.0:
        least = mean - abs(amplitude)
    assume(abs(least) > 1e-12)
    assert (refusals(swing(values).joints[0].motion) == []) == (least > 0.0)
    assert said(TRACED, TRACED.problems, values) == messages(number_findings(swing(values)))

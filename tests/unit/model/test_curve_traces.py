"""Curves whose radii, lifts, widths and motions are parameters: traced, they give the same tables bit for bit."""

import math
from types import SimpleNamespace

import pytest
from hypothesis import given, settings, strategies as st
from recorded import said

from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Body,
    CamFollower,
    Mechanism,
    MechanismError,
    Model,
    Move,
    Parameter,
    PointFollower,
    circle,
    constant,
    cosine,
    dwell,
    harmonic_motion,
    harmonic_profile,
    modified_sine,
    motion_profile,
    piecewise_profile,
    polynomial_345,
    polynomial_motion,
    slot,
    spline_profile,
    table_motion,
)
from mechanism_fmu.model.checks.check_numbers import number_findings
from mechanism_fmu.model.compile import compile_tables
from mechanism_fmu.model.findings import messages
from mechanism_fmu.model.trace import trace

PARAMETERS = (
    Parameter("radius", 1.1, "Of the base", "m"),
    Parameter("lift", 0.2, "Of the cam", "m"),
    Parameter("width", 1.25, "Of its moves", "rad"),
)


def mechanism(values: SimpleNamespace) -> Mechanism:
    radius, lift, width = values.radius, values.lift, values.width
    top = Move(lift, width, dwell)
    moves = motion_profile(radius, [Move(lift, width), top, Move(lift / 3, width, modified_sine)], polynomial_345)
    wave = (0.0, [constant(radius + lift), cosine(-lift, 2 * math.pi / width)])
    profiles = (
        circle(radius),
        harmonic_profile(radius, [lift, 0.1], [0.0, lift]),
        piecewise_profile(wave, (width, [constant(radius)])),
        spline_profile([radius, 1.0, lift + 1, 1.2], None, 3),
        spline_profile([radius, 1.0, lift + 1, 1.2, radius], None, 5),
        moves,
    )
    opened = slot([(0.0, radius), (1.0, lift), (1.5, 1.0)])
    motions = (
        polynomial_motion(radius, lift),
        harmonic_motion(radius, lift, width, 0.5),
        table_motion([(0.0, radius), (1.0, lift), (2.5, 0.5)]),
    )
    return Mechanism(
        bodies=(Body("cam", 1.0, 1.0), Body("roller", 1.0, 1.0)),
        joints=tuple(AngleDriver(f"driver_{k}", "cam", motion) for k, motion in enumerate(motions)),
        contacts=(
            *(CamFollower(f"pair_{k}", "cam", cam, "roller", circle(lift)) for k, cam in enumerate(profiles)),
            PointFollower("pin", "roller", (0.0, 0.0), GROUND, opened),
        ),
    )


TRACED = trace(Model("Curves", "All makers of curves", PARAMETERS, mechanism))


@settings(deadline=None)
@given(st.floats(-2.0, 5.0), st.floats(-2.0, 5.0), st.floats(0.1, 2.0))
def test_traced_curves_have_the_same_tables_and_findings(radius: float, lift: float, width: float) -> None:
    values = TRACED.model.values(radius=radius, lift=lift, width=width)
    plain = mechanism(values)
    expected, found = compile_tables(plain), TRACED.evaluate(values)
    for name in ("curve_range", "piece_start", "term_data"):
        assert getattr(found, name).tobytes() == getattr(expected, name).tobytes(), name
    assert said(TRACED, TRACED.problems, values) == messages(number_findings(plain))


WAY = ((0.0, 1.0), (1.0, 1.2), (1.5, 1.0))


@pytest.mark.parametrize(
    ("make", "what"),
    [
        (lambda width: slot([*WAY, (width, 1.0)]), "angle of point 4"),
        (lambda width: spline_profile([1.0, 1.2, 1.0], [0.0, width, 2.0]), "angle of point 2"),
        (lambda width: table_motion([(width - 2.0, 0.0), *WAY]), "time of point 1"),
    ],
    ids=["slot", "spline", "table"],
)
def test_a_spline_at_places_of_a_parameter_says_so_and_the_way_out(make, what: str) -> None:
    """Nothing branches there: the message is about the points, and says in which line of the user's they stand."""

    def mechanism(values: SimpleNamespace) -> Mechanism:
        motion = make(values.width)
        return Mechanism((Body("cam", 1.0, 1.0),), (AngleDriver("driver", "cam", motion),))

    parameters = (Parameter("width", 1.7, "Of the way", "rad"),)
    with pytest.raises(MechanismError) as refusal:
        trace(Model("Way", "A way", parameters, mechanism))
    said_of_it = str(refusal.value)
    assert "must not branch" not in said_of_it
    assert f"The {what} of a spline depends on a parameter" in said_of_it
    assert "Let only the values there depend on parameters, or make a Curve of Pieces" in said_of_it
    assert "test_curve_traces.py, line" in said_of_it

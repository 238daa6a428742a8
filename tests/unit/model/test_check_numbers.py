import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import example, given, settings, strategies as st
from recorded import said

from mechanism_fmu.model import Finding, MechanismError, Parameter, findings as c
from mechanism_fmu.model.checks.check_numbers import number_findings
from mechanism_fmu.model.compile import compile_mechanism
from mechanism_fmu.model.findings import literal, messages
from mechanism_fmu.model.symbol import Limits, Recorder
from mechanism_fmu.model.trace import trace
from tests.unlimited import MODEL, STARTS

TRACED = trace(MODEL)
#: Numbers at which conditions change, or whose products overflow or vanish.
ODD = [0.0, -0.0, 1.0, 0.5, -1.0, 2.0, -3.0, 5e-324, -5e-324, 1e-13, 1e-3, 1e200, -1e200, 1.7976931348623157e308]

perturbed = st.builds(
    lambda changes, friction, guided: MODEL.values(**changes, friction=friction, guided=guided),
    st.dictionaries(
        st.sampled_from(list(STARTS)),
        st.sampled_from(ODD) | st.floats(allow_nan=False, allow_infinity=False),
        max_size=3,
    ),
    st.sampled_from([0.0, 0.3, 1e308]),
    st.sampled_from([0.0, 1.0]),
)


def said_by_check(values):
    try:
        compile_mechanism(MODEL.mechanism(values))
    except MechanismError as error:
        return str(error)
    return ""


@settings(deadline=None, max_examples=400)
@given(perturbed)
@example(MODEL.values())
@example(MODEL.values(scale=1e200))
@example(MODEL.values(mass=-1.0))
@example(MODEL.values(friction=1.7976931348623157e308, scale=-1.0))
def test_the_trace_says_of_a_mechanism_what_its_check_says(values):
    assert " ".join(said(TRACED, TRACED.problems, values)) == said_by_check(values)


@pytest.mark.parametrize("name", [name for name in STARTS if name != "start"])
def test_every_number_of_the_model_can_be_refused(name):
    values = MODEL.values(**{name: -7.5})
    assert said_by_check(values) or name in ("scale", "point", "limit", "axis")
    if name not in ("mass", "restitution", "tolerance", "scale"):
        assert said_by_check(MODEL.values(**{"scale": 9.0, name: 1.5e308}))


def test_what_depends_on_no_parameter_or_is_within_its_limits_is_not_asked():
    texts = [finding.text for finding in TRACED.problems]
    assert texts
    assert not any("its friction" in text or "guided =" in text for text in texts)
    assert all("start =" not in text for text in texts)
    limited = replace(
        MODEL, parameters=tuple(replace(p, minimum=0.5) if p.name == "mass" else p for p in MODEL.parameters)
    )
    kept = [finding.text for finding in trace(limited).problems]
    dropped = set(texts) - set(kept)
    assert dropped == {
        "Body 'arm': mass = {:g} kg, but it must be positive and finite.",
        "Body 'slider {{100 %}}': inertia = {:g} kg.m2, but it must be positive and finite.",
    }


def test_objections_are_no_problems():
    values = MODEL.values(mass=-2000.0)
    assert (
        said(TRACED, TRACED.objections, values)
        == MODEL.refused(values)
        == ["mass = -2000 kg is what the model objects to."]
    )
    assert (
        said(TRACED, TRACED.problems, values)[0] == "Body 'arm': mass = -2000 kg, but it must be positive and finite."
    )


def test_a_start_that_is_not_finite_is_shown():
    mechanism = MODEL.mechanism(MODEL.values())
    body = replace(mechanism.bodies[1], start=(0.5, math.nan, 0.0), start_rate=(0.0, -math.inf, 2.0))
    (said,) = messages(number_findings(replace(mechanism, bodies=(mechanism.bodies[0], body))))
    assert said == "Body 'slider {100 %}': start (0.5, nan, 0) or start_rate (0, -inf, 2) is not finite."


def test_names_stand_as_they_are():
    assert Finding(1.0, literal("{} of {a:b}") + " {:g}", (1.0,)).message == "{} of {a:b} 1"


anything = st.floats() | st.sampled_from([*ODD, math.nan, math.inf, -math.inf])
CONDITIONS = {
    "finite": (c.finite, math.isfinite),
    "positive": (c.positive, lambda x: x > 0),
    "not_negative": (c.not_negative, lambda x: x >= 0),
    "finite_positive": (c.finite_positive, lambda x: math.isfinite(x) and x > 0),
    "finite_not_negative": (c.finite_not_negative, lambda x: math.isfinite(x) and x >= 0),
    "not_zero": (c.not_zero, lambda x: x > 0 or x < 0),
    "is_zero": (c.is_zero, lambda x: x == 0),
    "within": (lambda x: c.within(x, 1e-13, 1e-3), lambda x: 1e-13 <= x <= 1e-3),
    "true_or_false": (c.true_or_false, lambda x: x in (0, 1)),
}


@pytest.mark.parametrize(("condition", "expected"), CONDITIONS.values(), ids=CONDITIONS)
@given(x=anything)
def test_a_condition_holds_where_it_should_and_never_for_nan(condition, expected, x):
    for number in (x, np.float64(x)):
        assert (condition(number) > 0) == expected(x)
        assert (c.unless(condition(number)) > 0) == (not expected(x))


@given(anything, anything)
def test_conditions_of_two(a, b):
    assert (c.both(a, b) > 0) == (a > 0 and b > 0)
    assert (c.finite(a, b) > 0) == (math.isfinite(a) and math.isfinite(b))


@pytest.mark.parametrize(("condition", "_"), CONDITIONS.values(), ids=CONDITIONS)
@pytest.mark.parametrize(
    "limits", [Limits(-1, 1), Limits(0, 1), Limits(0, 1, whole=True), Limits(1e-9, 1e-4), Limits(-math.inf, math.inf)]
)
def test_only_what_limits_exclude_is_known(condition, _, limits):
    holds = condition(Recorder().parameter(0, limits))
    inside = {limits.low, limits.high, 0.0, 1.0, *([] if limits.whole else [1e-6, 0.5])}
    values = [x for x in inside if limits.low <= x <= limits.high and math.isfinite(x)]
    assert not isinstance(holds, float) or (holds == 1.0 and all(condition(x) > 0 for x in values))


def test_booleans_of_numpy_are_numbers():
    assert c.true_or_false(np.bool_(True)) > 0
    assert c.is_zero(np.bool_(False)) > 0


def test_a_switch_is_known_to_be_one():
    parameters = (*MODEL.parameters[:-1], Parameter("guided", 0.0, "Not a switch"))
    assert any("guided =" in finding.text for finding in trace(replace(MODEL, parameters=parameters)).problems)

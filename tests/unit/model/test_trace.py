import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings, strategies as st
from recorded import said

import models
from mechanism_fmu.model import (
    Body,
    CircularHole,
    Finding,
    Mechanism,
    MechanismError,
    Model,
    Parameter,
    dyad,
    plate,
)
from mechanism_fmu.model.compile import compile_tables
from mechanism_fmu.model.functions import atan2, cos, sin, sqrt, tan, where_positive
from mechanism_fmu.model.symbol import Operation, Recorder
from mechanism_fmu.model.trace import _limits, trace
from models.ratchet.model import MODEL as RATCHET
from tests.parameter_sets import near_defaults, within_limits
from tests.reaching import MODEL as REACHING, REFUSED

TRACES = [pytest.param(trace(models.load(name).MODEL), id=name) for name in models.available()]


def assert_same_bits(found, expected):
    assert found.numbers == expected.numbers
    assert found.columns.keys() == expected.columns.keys()
    for name, b in expected.columns.items():
        a = found.columns[name]
        assert (a.dtype, a.shape, a.tobytes()) == (b.dtype, b.shape, b.tobytes()), name


@pytest.mark.parametrize("traced", TRACES)
def test_defaults_give_the_tables_of_the_model(traced):
    assert_same_bits(
        traced.evaluate(traced.model.values()), compile_tables(traced.model.mechanism(traced.model.values()))
    )


@pytest.mark.slow
@pytest.mark.parametrize("traced", TRACES)
@settings(deadline=None, suppress_health_check=[HealthCheck.filter_too_much])
@given(st.data())
def test_recorded_operations_give_the_tables_of_the_model_to_the_last_bit(traced, data):
    values = data.draw(near_defaults(traced.model))
    assume(not traced.model.refused(values))
    assert_same_bits(traced.evaluate(values), compile_tables(traced.model.mechanism(values)))


@pytest.mark.slow
@pytest.mark.parametrize("traced", TRACES)
@settings(deadline=None)
@given(st.data())
def test_recorded_findings_say_what_the_model_says(traced, data):
    values = data.draw(within_limits(traced.model) | near_defaults(traced.model))
    assert said(traced, traced.objections, values) == traced.model.refused(values)
    assert said(traced, traced.warnings, values) == traced.model.warned(values)


@pytest.mark.parametrize("traced", TRACES)
def test_every_parameter_is_in_a_table(traced):
    numbers = [x for column in traced.tables.columns.values() for x in column.flat]
    used = {int(o.value) for o in map(traced.operations.__getitem__, traced.needed(numbers)) if o.name == "parameter"}
    assert used == set(range(len(traced.model.parameters)))


def _mechanism(values):
    # Sums that rounding makes different from their rearrangements, a product with a constant 1, and signs of zero.
    a, b = values.a, values.b
    start = (0.1 + a - 0.1, 1 * a - -0.0 * b, where_positive(a - b, tan(a), -b))
    return Mechanism((Body("body", sqrt(4 + a * a), 2.0, start, (sin(a) / 3, 7 - cos(b), atan2(0.5, b))),))


MODEL = Model(
    "Model", "", (Parameter("a", 0.3, "", minimum=-9, maximum=9), Parameter("b", 0.1, "")), _mechanism, drawing=()
)


@settings(deadline=None)
@given(st.floats(-9, 9), st.floats(-9, 9))
def test_nothing_is_simplified(a, b):
    values = SimpleNamespace(a=a, b=b)
    assert_same_bits(trace(MODEL).evaluate(values), compile_tables(MODEL.mechanism(values)))


def test_an_operation_is_recorded_once():
    recorder = Recorder()
    x = recorder.parameter(0)
    assert (x * x + 2).number == (x * x + 2.0).number
    assert (x + 0.0).number != (x + -0.0).number
    assert recorder.operations[:4] == [
        Operation("parameter"),
        Operation("multiply", (0, 0)),
        Operation("constant", (), 2.0),
        Operation("add", (1, 2)),
    ]


def test_numpys_numbers_are_numbers():
    x = Recorder().parameter(0)
    assert (np.float64(2) * x).number == (2 * x).number
    assert (x - np.int64(2)).number == (x - 2).number


@pytest.mark.parametrize(
    "look",
    [
        lambda x: 1 if x else 0,
        lambda x: x > 0,
        lambda x: x <= 0.0,
        lambda x: np.float64(0) < x,
        lambda x: x == 1,
        lambda x: x in (0, 1),
        lambda x: max(x, 1),
        lambda x: abs(x),
        float,
        int,
        range,
        round,
        math.floor,
        math.sin,
        lambda x: math.hypot(x, 1.0),
        lambda x: f"{x:g}",
    ],
)
def test_looking_at_a_symbol_is_refused_with_the_way_out(look):
    with pytest.raises(MechanismError, match=r"must not branch on a parameter.*where_positive"):
        look(Recorder().parameter(0))


@pytest.mark.parametrize("power", [lambda x: x**2, lambda x: 2**x, lambda x: x % 1, lambda x: x // 1])
def test_powers_are_refused_with_the_way_out(power):
    with pytest.raises(MechanismError, match=r"Write x \* x"):
        power(Recorder().parameter(0))


def test_a_model_that_branches_is_not_traced():
    branching = replace(MODEL, objections=lambda values: [Finding(1.0, "Bad.")] if values.a > 1 else [])
    with pytest.raises(MechanismError, match="must not branch"):
        trace(branching)


def test_a_symbol_of_another_trace_is_refused():
    with pytest.raises(MechanismError, match="keep no parameter values"):
        Recorder().parameter(0) + Recorder().parameter(0)


def test_symbolic_structure_is_refused_by_the_name_of_its_table():
    def mechanism(values):
        made = RATCHET.mechanism(RATCHET.values())
        object.__setattr__(made.contacts[0], "kind", values.a)
        return made

    model = replace(MODEL, mechanism=mechanism, parameters=(replace(MODEL.parameters[0], start=1),))
    with pytest.raises(MechanismError, match="the table contact_kind holds structure, but depends on a parameter"):
        trace(model)


def test_structure_that_is_not_the_same_at_every_call_is_refused():
    calls = []

    def mechanism(values):
        calls.append(values)
        made = _mechanism(values)
        return made if len(calls) == 1 else replace(made, bodies=(*made.bodies, Body("more", 1.0, 1.0)))

    with pytest.raises(MechanismError, match="is not the same at every call"):
        trace(replace(MODEL, mechanism=mechanism))


def test_a_model_that_looks_at_types_is_refused():
    def mechanism(values):
        factor = 2.0 if isinstance(values.mass, float) else 1.0
        return Mechanism(bodies=(Body("one", values.mass * factor, 1.0),))

    model = Model("Sly", "Looks at types.", (Parameter("mass", 1.0, "Mass", "kg", 0.1, 10.0),), mechanism)
    with pytest.raises(MechanismError, match="the table inverse_mass comes out differently"):
        trace(model)


def test_what_cannot_be_traced_is_shown_with_its_line():
    def mechanism(values):
        return Mechanism(bodies=(Body("one", np.exp(values.mass), 1.0),))

    model = Model("Numpy", "Uses numpy.", (Parameter("mass", 1.0, "Mass", "kg", 0.1, 10.0),), mechanism)
    with pytest.raises(MechanismError, match=r"Numpy cannot be traced, .*test_trace\.py, line \d+ \(return Mechanism"):
        trace(model)


@pytest.mark.parametrize("least", [None, -2.0])
@pytest.mark.parametrize("largest", [None, 3.0])
def test_limits_of_a_parameter_that_is_traced(least, largest):
    found = _limits(Parameter("x", 1.0, "", minimum=least, maximum=largest))
    assert (found.low, found.high) == (-math.inf if least is None else least, math.inf if largest is None else largest)
    assert not found.whole
    assert _limits(Parameter("n", 1, "", type="Integer")).whole
    assert _limits(Parameter("b", 1, "", type="Boolean")) == _limits(
        Parameter("b", 0, "", minimum=5.0, maximum=7.0, type="Boolean")
    )


@pytest.mark.parametrize("values", REFUSED.values(), ids=REFUSED)
def test_what_helpers_refuse_is_said_in_the_words_and_the_turn_of_the_model(values):
    """Links that do not reach each other were a wall of numbers that are not finite."""
    given = REACHING.values(**values)
    with pytest.raises(MechanismError) as refusal:
        REACHING.build(given)
    traced = trace(REACHING)
    assert said(traced, traced.objections, given) == [str(refusal.value)]
    assert said(traced, traced.objections, REACHING.values()) == []
    assert_same_bits(traced.evaluate(REACHING.values(crank=0.07)), tables_of(REACHING.values(crank=0.07)))


def tables_of(values):
    return compile_tables(REACHING.mechanism(values))


def test_what_is_refused_within_the_objections_comes_before_them():
    def objections(values):
        dyad((0.0, 0.0), (1.0, 0.0), from_a=values.rod, from_b=0.9)
        return (Finding(0.1 - values.rod, "rod = {:g} m is too short.", (values.rod,)),)

    model = replace(REACHING, objections=objections)
    given = model.values(rod=0.05, coupler=0.02)
    with pytest.raises(MechanismError, match=r"links of 0.05 m and 0.9 m do not reach") as refusal:
        model.build(given)
    traced = trace(model)
    assert said(traced, traced.objections, given) == [str(refusal.value)]


def test_a_plate_of_parameters_without_area_is_refused_by_its_name():
    def mechanism(values):
        return Mechanism(
            (plate("{x}", [(0, 0), (1, 0), (0, values.high)], holes=[CircularHole((0.2, 0.2), 0.1)], mass=1),)
        )

    model = Model("Plate", "", (Parameter("high", 1.0, "Height", "m", 1e-3, 10.0),), mechanism)
    with pytest.raises(MechanismError, match=r"plate '\{x\}' has an area of -0\.0264159 m2") as refusal:
        model.build(model.values(high=0.01))
    traced = trace(model)
    assert said(traced, traced.objections, model.values(high=0.01)) == [str(refusal.value)]

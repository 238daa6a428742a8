"""Bad values and illegal calls: a message that helps, an error status, and an instance that lives on."""

import math
from copy import copy
from ctypes import c_char
from pathlib import Path

import pytest
from fmpy.fmi1 import FMICallException

from tests.fmu.conformance.host import Fmu, Instance

REFERENCE_TIME = pytest.approx(0.9399211769, rel=1e-9)

BAD_PARAMETERS = [
    ({"crank_mass": -0.1}, "crank_mass = -0.1 kg is below its limit"),
    ({"wheel_inertia": 0.0}, "wheel_inertia = 0 kg.m2 is below its limit"),
    ({"tooth_count": 2}, "tooth_count = 2 is below its limit; give at least 3"),
    ({"restitution": 1.5}, "restitution = 1.5 is above its limit; give at most 1"),
    ({"crank_length": math.nan}, "crank_length = nan is not a finite number"),
    ({"hinge_distance": math.inf}, "hinge_distance = inf is not a finite number"),
    ({"relative_tolerance": 0.5}, "relative_tolerance = 0.5 is above its limit"),
    ({"drive_torque": math.nan}, "drive_torque = nan is not a finite number"),
    ({"spring_preload": -math.inf}, "spring_preload = -inf is not a finite number"),
]

BAD_GEOMETRY = [
    ({"pawl_length": 0.03}, "pawl_length = 0.03 m is 0.0"),
    ({"pawl_length": 0.2}, "too long: its tip would start inside the tooth"),
    ({"crank_length": 0.01}, "crank_length = 0.01 m is"),
    ({"tooth_slope_angle": math.radians(60)}, "gives teeth without height"),
    ({"slope_ratio": 0.5}, "gives blunt teeth"),
    ({"guided": False, "pawl_length": 0.03}, "pawl_length = 0.03 m is 0.0"),
    ({"guided": False, "pawl_angle_start": 3.5}, "starts with a contact point inside the other body"),
]


def text_of(one, since=0):
    return " ".join(message.text for message in one.log[since:])


def assert_lives_on(one):
    """A reset instance reproduces the reference run."""
    one.reset().begin()
    one.run(1.0, 0.01)
    assert one["impact_time"] == REFERENCE_TIME


@pytest.mark.parametrize(("values", "message"), BAD_PARAMETERS, ids=lambda v: str(v)[:30])
def test_bad_value_is_refused_when_it_is_set(instance, values, message):
    one = instance()
    with pytest.raises(FMICallException):
        one.set(values)

    assert message in text_of(one)
    assert any(m.category == "logStatusError" for m in one.log)
    assert_lives_on(one)


@pytest.mark.parametrize(("values", "message"), BAD_GEOMETRY, ids=lambda v: str(v)[:30])
def test_geometry_that_cannot_be_is_refused_when_initialization_ends(instance, values, message):
    one = instance()
    with pytest.raises(FMICallException):
        one.begin(values)

    assert message in text_of(one)
    assert_lives_on(one)


@pytest.mark.parametrize(
    ("time", "size", "message"),
    [
        (0.5, -0.1, "step size -0.1 s must be positive"),
        (0.5, 0.0, "step size 0 s must be positive"),
        (0.5, math.nan, "is not a finite number"),
        (0.5, math.inf, "is not a finite number"),
        (math.nan, 0.1, "is not a finite number"),
        (0.4, 0.1, "the communication point 0.4 s is not the time reached, 0.5 s"),
        (0.6, 0.1, "the communication point 0.6 s is not the time reached, 0.5 s"),
        (0.5, 1e-300, "is lost in rounding"),
    ],
)
def test_impossible_step_is_refused_and_changes_nothing(instance, time, size, message):
    one = instance().begin()
    one.run(0.5, 0.1)
    before = one.outputs()
    with pytest.raises(FMICallException):
        one.slave.doStep(time, size)

    assert message in text_of(one)
    assert one.outputs() == before
    one.run(1.0, 0.1)
    assert one["impact_time"] == REFERENCE_TIME


def setup(one, **arguments):
    return one.slave.setupExperiment(**arguments)


def illegal_calls():
    yield "doStep before initialization", "fmi2DoStep is not allowed now", lambda one: one.slave.doStep(0.0, 0.1)
    yield (
        "enter before setup",
        "not allowed before fmi2SetupExperiment",
        lambda one: one.slave.enterInitializationMode(),
    )
    yield (
        "setup at NaN",
        "the start time nan s must be finite",
        lambda one: one.slave.setupExperiment(startTime=math.nan),
    )
    yield "setup too late", "where the clock still", lambda one: one.slave.setupExperiment(startTime=1e12)
    yield (
        "stop before start",
        "not before the start time 2 s",
        lambda one: one.slave.setupExperiment(startTime=2.0, stopTime=1.0),
    )
    yield (
        "negative tolerance",
        "the tolerance -1e-06 must be positive",
        lambda one: one.slave.setupExperiment(tolerance=-1e-6),
    )
    yield "set a String", "is of type Real, not String", lambda one: one.slave.setString([1], ["fast"])
    yield "exit before enter", "not allowed now", lambda one: one.slave.exitInitializationMode()
    yield "terminate before begin", "not allowed now", lambda one: one.slave.terminate()
    yield "unknown reference", "no variable with value reference 999999", lambda one: one.slave.getReal([999999])
    yield "unknown reference to set", "no variable with value", lambda one: one.slave.setReal([4294967295], [1.0])
    yield (
        "Integer as Real",
        "is of type Integer, not Real",
        lambda one: one.slave.getReal([one.reference("tooth_count")]),
    )
    yield (
        "Real as Integer",
        "is of type Real, not Integer",
        lambda one: one.slave.setInteger([one.reference("drive_torque")], [1]),
    )
    yield "Real as Boolean", "is of type Real", lambda one: one.slave.getBoolean([one.reference("wheel_angle")])
    yield "Real as String", "is of type Real", lambda one: one.slave.getString([one.reference("wheel_angle")])
    yield "set an output", "wheel_angle is of causality output", lambda one: one.set({"wheel_angle": 1.0})
    yield "set a calculated parameter", "causality calculatedParameter", lambda one: one.set({"tooth_length": 1.0})


@pytest.mark.parametrize(("message", "call"), [c[1:] for c in illegal_calls()], ids=[c[0] for c in illegal_calls()])
def test_illegal_call_before_the_run(instance, message, call):
    one = instance()
    with pytest.raises(FMICallException):
        call(one)

    assert message in text_of(one)
    assert_lives_on(one)


def late_calls():
    yield "parameter", "Setting parameter tooth_count is not allowed now", lambda one: one.set({"tooth_count": 12})
    yield "setup", "fmi2SetupExperiment is not allowed now", lambda one: one.slave.setupExperiment()
    yield "enter", "fmi2EnterInitializationMode is not allowed now", lambda one: one.slave.enterInitializationMode()
    yield "exit", "fmi2ExitInitializationMode is not allowed now", lambda one: one.slave.exitInitializationMode()


@pytest.mark.parametrize(("message", "call"), [c[1:] for c in late_calls()], ids=[c[0] for c in late_calls()])
def test_illegal_call_during_the_run(instance, message, call):
    one = instance().begin()
    one.run(0.5, 0.1)
    with pytest.raises(FMICallException):
        call(one)

    assert message in text_of(one)
    one.run(1.0, 0.1)
    assert one["impact_time"] == REFERENCE_TIME


def test_no_step_leads_past_the_stop_time(instance):
    one = instance().begin(stop_time=1.0)
    one.run(0.9, 0.1)
    with pytest.raises(FMICallException):
        one.slave.doStep(one.time, 0.2)

    assert "leads past the stop time 1 s" in text_of(one)
    one.run(1.0, 0.1)
    assert one["impact_time"] == REFERENCE_TIME


def test_steps_follow_each_other_at_late_times_too(instance):
    one = instance().begin(start_time=1e6)
    one.run(1e6 + 0.5, 0.1)
    for gap in (-5e-4, 5e-4):
        with pytest.raises(FMICallException):
            one.slave.doStep(one.time + gap, 0.1)
    one.run(1e6 + 1, 0.1)

    assert one["impact_time"] - 1e6 == pytest.approx(0.9399211769, abs=1e-9)


@pytest.mark.parametrize("when", ["before", "during"])
def test_a_refused_value_leaves_the_others_unset(instance, when):
    one = instance()
    if when == "during":
        one.begin().run(0.5, 0.1)
        good, bad = "drive_torque", "load_torque"
    else:
        good, bad = "tooth_slope_angle", "crank_length"
    before = one[good]
    with pytest.raises(FMICallException):
        one.set({good: 1.7 * before, bad: math.nan})

    assert one[good] == before
    if when == "before":
        one.begin()
    one.run(1.0, 0.1)
    assert one["impact_time"] == REFERENCE_TIME


def test_what_was_read_before_the_setup_does_not_stay(instance):
    one = instance()
    assert one["wheel_angle"] == pytest.approx(math.radians(75))
    one.begin(start_time=100.0)
    one.run(101.0, 0.1)

    assert one["impact_time"] - 100 == pytest.approx(0.9399211769, abs=1e-9)


def test_a_parameter_can_be_read_while_the_geometry_is_not_complete(instance):
    one = instance()
    one.set({"pawl_length": 0.03})
    assert one["pawl_length"] == 0.03
    one.set({"pawl_length": 0.1})
    one.begin().run(1.0, 0.1)

    assert one["impact_time"] == REFERENCE_TIME


def test_the_wrapper_accepts_any_guid(ratchet):
    """Documented in docs/reference/fmu.md: pythonfmu does not look at it."""
    assert "accepted" in Path(__file__).parents[2].joinpath("docs/reference/fmu.md").read_text(encoding="utf-8")
    stranger = copy(ratchet.description)
    stranger.guid = "{00000000-0000-0000-0000-000000000000}"
    with Instance(Fmu(ratchet.folder, stranger)) as one:
        one.begin().run(1.0, 0.1)
        assert one["impact_time"] == REFERENCE_TIME


def test_a_serialization_buffer_that_is_too_small_gives_bytes_that_are_refused(instance):
    one = instance().begin()
    state = one.save()
    few = (c_char * 100)()
    one.slave.fmi2SerializeFMUstate(one.slave.component, state, few, 100)
    one.slave.freeFMUstate(state)
    with pytest.raises(FMICallException):
        one.restore_bytes(bytes(few), 0.0)


def test_no_step_after_the_end(instance):
    one = instance().begin()
    one.run(0.5, 0.1)
    one.slave.terminate()
    with pytest.raises(FMICallException):
        one.step(0.1)

    assert one["wheel_angle"] == pytest.approx(1.309, abs=1e-3)
    assert_lives_on(one)


def test_empty_lists_are_legal(instance):
    one = instance().begin()
    one.slave.setReal([], [])

    assert one.slave.getReal([]) == one.slave.getInteger([]) == one.slave.getBoolean([]) == []


HOSTILE = [1e308, -1e308, 5e-324, -5e-324, 1e-300, math.nan, math.inf, -math.inf, 0.0, -1.0, 1e6, 1e18]


@pytest.mark.parametrize("when", ["before", "during"])
def test_hostile_values_are_refused_or_leave_every_output_finite(instance, when):
    one = instance()
    for variable in one.fmu.description.modelVariables:
        if variable.causality not in ("input", "parameter") or (when == "during" and variable.causality != "input"):
            continue
        for value in HOSTILE if variable.type == "Real" else [-(2**31), 2**31 - 1, 0, -1]:
            one.reset()
            said = len(one.log)
            try:
                if when == "during":
                    one.begin().run(0.1, 0.1)
                    one.set({variable.name: value})
                else:
                    one.begin({variable.name: value})
                one.run(one.time + 0.02, 0.01)
            except FMICallException:
                refusals = [m for m in one.log[said:] if m.category in ("logStatusError", "logStatusDiscard")]
                assert any(len(m.text) > 20 for m in refusals), variable.name
            else:
                assert all(math.isfinite(v) for v in one.outputs().values()), (variable.name, value)
    assert_lives_on(one)

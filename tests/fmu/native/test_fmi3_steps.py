"""FMI 3.0: event mode, early return, the clock of impacts, arrays, intermediate updates, states, refusals."""

import math
from ctypes import c_bool, c_double, c_size_t

import fmpy
import numpy as np
import pytest
from fmpy import simulate_fmu
from fmpy.fmi1 import FMICallException
from fmpy.fmi3 import FMU3Model, FMU3ScheduledExecution
from fmpy.validation import validate_fmu

from tests.fmu.conformance.host import Instance
from tests.fmu.native.host3 import Instance3

#: The paper's base case, with the digits that the table has.
IMPACT = pytest.approx(0.9399211769, abs=5.1e-11)
AFTER = {"impact_crank_speed": 0.0191482997, "impact_pawl_speed": -0.0069073680, "impact_wheel_speed": 0.0227388573}
#: A bouncing pawl: eighteen impacts within two seconds.
ROUGH = {"guided": False, "restitution": 0.5, "tooth_count": 15, "drive_torque": 5e-3}
#: Outputs that speak of the last communication step alone.
OF_STEP = ("impacts", "events")


def lasting(outputs):
    return {name: value for name, value in outputs.items() if not name.startswith(OF_STEP)}


def impact_at(instance3):
    """Time of the base case's impact, to the last bit."""
    one = instance3(event_mode=True, early_return=True).begin()
    return next(step.reached for step in one.run(1.0, 10) if step.event)


# --- fmpy as the host ---


def test_fmpy_finds_no_problem(ratchet_fmi3):
    assert validate_fmu(str(ratchet_fmi3)) == []


def test_fmpy_simulates_it(ratchet_fmi3):
    outputs = ["wheel_angle", "impact_count", "impact_time", "impacts.time"]
    result = simulate_fmu(str(ratchet_fmi3), stop_time=2, output_interval=0.01, output=outputs)

    assert result["time"][-1] == pytest.approx(2)
    assert result["impact_count"][-1] == 1
    assert result["impact_time"][-1] == IMPACT
    assert result["impacts.time"].max() == result["impact_time"][-1]


def test_fmpy_simulates_it_with_events(ratchet_fmi3):
    outputs = ["wheel_angle", "wheel_speed", "impact_count"]
    options = {"use_event_mode": True, "early_return_allowed": True}
    result = simulate_fmu(str(ratchet_fmi3), stop_time=2, output_interval=0.01, output=outputs, **options)

    (row,) = np.flatnonzero(np.diff(result["impact_count"])) + 1
    assert result["time"][row] == IMPACT
    assert result["wheel_speed"][row] == pytest.approx(AFTER["impact_wheel_speed"], rel=1e-7)
    assert result["time"][-1] == pytest.approx(2)


# --- stepping ---


def test_without_event_mode_steps_are_whole(instance3):
    for early_return in (False, True):
        steps = instance3(early_return=early_return).begin().run(1.0, 10)
        assert [step.reached for step in steps] == [k / 10 for k in range(1, 11)]
        assert not any(step.event or step.early or step.terminate for step in steps)


def test_the_motion_is_bit_equal_to_that_of_fmi_2(instance3, native_ratchet):
    plain = instance3().begin(ROUGH)
    stopping = instance3(event_mode=True, early_return=True).begin(ROUGH)
    watched = instance3(event_mode=True, early_return=True, on_update=lambda _: None).begin(ROUGH)
    with Instance(native_ratchet) as two:
        two.begin(ROUGH)
        for point in (k / 10 for k in range(1, 21)):
            two.step(point - two.time)
            two.time = point
            expected = two.outputs()
            del expected["impact"]
            plain.step_to(point)
            assert plain.outputs() == expected
            for one in (stopping, watched):
                one.run(point, 1)
                assert lasting(one.outputs()) == lasting(expected)
    assert plain["impact_count"] > 10


def test_an_impact_ends_a_step(instance3):
    one = instance3(event_mode=True, early_return=True).begin()
    one.run(0.9, 9)
    step = one.step(0.1)

    assert step.reached == IMPACT
    assert (step.event, step.early, step.terminate) == (True, True, False)
    assert not one["impact"]
    one.slave.enterEventMode()
    assert one["impact"]
    assert one["time"] == one["impact_time"] == step.reached
    assert one.get(AFTER) == pytest.approx(AFTER, rel=1e-7)
    assert one["wheel_speed"] == pytest.approx(one["impact_wheel_speed"], rel=1e-9)
    one.slave.updateDiscreteStates()
    assert not one["impact"]
    one.slave.enterStepMode()
    assert one.step_to(1.0) == (False, False, False, 1.0)
    assert one["impact_time"] == step.reached


def test_every_impact_ends_a_step(instance3):
    one = instance3(event_mode=True, early_return=True).begin(ROUGH)
    steps, seen = [], 0
    while one.time < 2.0:
        steps.append(one.step_to(2.0))
        if steps[-1].event:
            one.slave.enterEventMode()
            assert one["impact"]
            assert one["impact_count"] > seen
            seen = one["impact_count"]
            assert one["impact_time"] == steps[-1].reached
            one.leave_event_mode()
    assert seen > 10
    assert [step.event for step in steps[:-1]] == [True] * (len(steps) - 1)


def test_an_impact_at_the_very_end_is_no_early_return(instance3):
    when = impact_at(instance3)
    one = instance3(event_mode=True, early_return=True).begin()

    assert one.step(when) == (True, False, False, when)
    one.slave.enterEventMode()
    assert one["impact"]


def test_a_host_without_early_return_learns_of_impacts_at_the_end(instance3):
    one = instance3(event_mode=True).begin()
    steps = one.run(0.9, 9)
    assert not any(step.event or step.early for step in steps)
    assert one.step_to(1.0) == (True, False, False, 1.0)
    one.slave.enterEventMode()
    assert one["impact"]
    assert one["impacts_in_step"] == 1
    assert one["impacts.time"][0] == one["impact_time"] == IMPACT
    one.slave.enterStepMode()
    assert not one["impact"]
    assert one.step(0.1).event is False


def test_the_clock_does_not_tick_in_other_event_modes(instance3):
    one = instance3(event_mode=True, early_return=True)
    one.slave.enterInitializationMode()
    one.slave.exitInitializationMode()
    assert not one["impact"]
    one.leave_event_mode()
    one.step(0.1)
    one.slave.enterEventMode()
    assert not one["impact"]
    one.set({"drive_torque": 2e-3})
    one.leave_event_mode()
    one.step(0.1)
    assert one["crank_speed"] > 0


# --- intermediate updates ---


def test_the_host_is_told_of_each_internal_step(instance3):
    seen = []

    def look(update):
        seen.append((update, one["time"], one["wheel_angle"], one["kinetic_energy"]))

    one = instance3(on_update=look, intermediate=["wheel_angle", "kinetic_energy"]).begin()
    one.run(1.0, 2)
    times = [time for _, time, *_ in seen]

    assert len(seen) > 4
    assert times == sorted(times) == [update.time for update, *_ in seen]
    assert all(update[1:] == (False, True, True, False) for update, *_ in seen)
    assert seen[-1][1:] == (1.0, one["wheel_angle"], one["kinetic_energy"])


def test_an_impact_ends_a_step_of_a_host_that_looks_on(instance3):
    times = []
    one = instance3(event_mode=True, early_return=True, on_update=lambda u: times.append(u.time)).begin()
    step = one.step(1.0)

    assert (step.event, step.early, step.reached) == (True, True, impact_at(instance3))
    assert times[-1] == step.reached


def test_the_host_can_have_it_back_at_once_or_at_a_later_time(instance3):
    wanted = []
    one = instance3(early_return=True, on_update=lambda update: wanted[0](update)).begin()

    wanted[:] = [lambda update: update.time]
    first = one.step(0.5)
    assert first.early
    assert 0 < first.reached < 0.5
    assert not first.event
    wanted[:] = [lambda update: -math.inf]
    assert first.reached < one.step_to(0.5).reached < 0.5
    wanted[:] = [lambda update: 0.6]
    assert one.step_to(0.7) == (False, False, True, 0.6)
    wanted[:] = [lambda update: 0.7]
    assert one.step_to(0.7) == (False, False, False, 0.7)
    assert one["time"] == 0.7


def test_a_host_that_cannot_have_it_back_is_not_asked(instance3):
    asked = []
    one = instance3(on_update=lambda update: asked.append(update.can_return_early) or update.time).begin()

    assert one.step(0.5) == (False, False, False, 0.5)
    assert set(asked) == {False}


def test_at_an_intermediate_update_nothing_but_reading_is_allowed(instance3):
    said = []

    def meddle(_update):
        if said:
            return
        slave = one.slave
        for call in (
            lambda: one.set({"drive_torque": 1.0}),
            lambda: slave.doStep(one.time, 0.1),
            slave.getFMUState,
            slave.reset,
            slave.terminate,
            slave.enterEventMode,
            slave.enterStepMode,
        ):
            said.append(one.refusal(call))
        slave.fmi3FreeInstance(slave.component)
        said.append(one.log[-1].text)
        assert one["time"] > 0

    one = instance3(event_mode=True, on_update=meddle).begin()
    reference = instance3().begin()
    one.step(0.5)
    reference.step(0.5)

    assert len(said) == 8
    assert all("intermediate update" in text for text in said)
    assert one.outputs() == reference.outputs()


def test_derivatives_of_outputs(instance3):
    rates = []

    def derivatives(names):
        return one.slave.getOutputDerivatives([one.reference(name) for name in names], [1] * len(names))

    one = instance3(on_update=lambda _: rates.append(derivatives(["wheel_angle"])[0] - one["wheel_speed"])).begin()
    one.step(0.5)

    assert rates == [0.0] * len(rates)
    assert derivatives(["wheel_angle", "crank_angle"]) == [one["wheel_speed"], one["crank_speed"]]
    for name in ("time", "drive_torque"):
        assert name in one.refusal(derivatives, [name])
    with pytest.raises(FMICallException):
        derivatives(["impact_time"])
    assert one.log[-1].category == "logStatusDiscard"
    assert "impact_time has no derivative" in one.log[-1].text
    assert "order 2" in one.refusal(one.slave.getOutputDerivatives, [one.reference("wheel_angle")], [2])


# --- values ---


def test_arrays_and_scalars_in_one_call(instance3):
    one = instance3().begin(ROUGH)
    while one["impacts_in_step"] < 2:
        one.step(0.1)
    names = ["impact_time", "impacts.time", "time", "impacts.impulse"]
    values = one.slave.getFloat64([one.reference(name) for name in names], nValues=18)

    assert values == [one["impact_time"], *one["impacts.time"], one.time, *one["impacts.impulse"]]
    times = one["impacts.time"][: one["impacts_in_step"]]
    assert times == sorted(times)
    assert times[-1] == one["impact_time"]
    assert one["impacts.contact"][: len(times)][-1] == one["impact_contact"]
    struck = [time for time, impulse in zip(one["events.time"], one["events.impulse"], strict=True) if impulse > 0]
    assert set(times) <= set(struck)


def test_values_of_the_wrong_number_or_type_are_refused(instance3):
    one = instance3().begin()
    times, crank = one.reference("impacts.time"), one.reference("crank_angle")
    slave = one.slave

    assert "8 values together, and 7 were given" in one.refusal(slave.getFloat64, [times], 7)
    assert "1 values together, and 2 were given" in one.refusal(slave.getFloat64, [crank], 2)
    assert "There is no variable" in one.refusal(slave.getFloat64, [times + 7], 1)
    assert "There is no variable" in one.refusal(slave.getFloat64, [2**32 - 1])
    assert "There is no variable" in one.refusal(slave.getBoolean, [one.reference("impact_time") - 1])
    assert "of type Float64, not Int32" in one.refusal(slave.getInt32, [crank])
    assert "time is the independent variable" in one.refusal(slave.setFloat64, [one.reference("time")], [1.0])
    assert "causality output" in one.refusal(slave.setFloat64, [crank], [1.0])


def test_types_that_no_variable_has(instance3):
    one = instance3().begin()
    kinds = ("Float32", "Int8", "UInt8", "Int16", "UInt16", "UInt32", "Int64", "UInt64", "String")
    for kind in kinds:
        assert f"type {kind}" in one.refusal(getattr(one.slave, f"get{kind}"), [0])
        value = "" if kind == "String" else 0
        assert f"type {kind}" in one.refusal(getattr(one.slave, f"set{kind}"), [0], [value])
    none = one.slave.fmi3GetInt8
    none(one.slave.component, None, 0, None, 0)


def test_the_clock_is_read_only_and_has_no_interval(instance3):
    one = instance3(event_mode=True).begin()
    slave, component = one.slave, one.slave.component
    references = (fmpy.fmi3.fmi3ValueReference * 1)(one.reference("impact"))
    other = (fmpy.fmi3.fmi3ValueReference * 1)(0)
    values = (c_bool * 1)(True)

    assert "is an output" in one.refusal(slave.fmi3SetClock, component, references, 1, values)
    assert "no clock with value reference 0" in one.refusal(slave.fmi3GetClock, component, other, 1, values)
    intervals = (fmpy.fmi3.fmi3Float64 * 1)()
    assert "triggered by impacts" in one.refusal(slave.fmi3SetIntervalDecimal, component, references, 1, intervals)


# --- states ---


@pytest.mark.parametrize("elsewhere", [False, True], ids=["in the same instance", "in another one"])
def test_a_state_saved_in_event_mode_goes_back_into_it(instance3, elsewhere):
    one = instance3(event_mode=True, early_return=True).begin(ROUGH)
    while not one.step_to(2.0).event:
        pass
    one.slave.enterEventMode()
    saved, there = one.save_bytes(), one.outputs()
    one.leave_event_mode()
    one.run(2.0, 3)
    end = one.outputs()

    again = instance3(event_mode=True, early_return=True) if elsewhere else one
    again.restore_bytes(saved)
    assert again["impact"]
    assert again.outputs() == there
    assert "event" in again.refusal(again.slave.doStep, again.time, 0.1)
    again.leave_event_mode()
    assert not again["impact"]
    again.run(2.0, 3)
    assert again.outputs() == end


def test_a_state_saved_before_event_mode_still_leads_into_it(instance3):
    one = instance3(event_mode=True, early_return=True).begin()
    assert one.step(1.0).event
    saved = one.save_bytes()
    one.slave.enterEventMode()
    one.leave_event_mode()
    one.restore_bytes(saved)
    one.slave.enterEventMode()

    assert one["impact"]


def test_reset_begins_anew(instance3):
    one = instance3(event_mode=True, early_return=True).begin()
    first = one.run(1.2, 3), one.outputs()
    one.slave.reset()
    one.begin()

    assert (one.run(1.2, 3), one.outputs()) == first


# --- the log and refusals ---


def test_each_impact_is_told_once(instance3):
    for options in ({}, {"event_mode": True, "early_return": True}, {"on_update": lambda _: None}):
        one = instance3(**options).begin(ROUGH)
        one.run(2.0, 4)
        told = [message for message in one.log if message.text.startswith("Impact on ")]
        assert len(told) == one["impact_count"] - one["impacts_lost"]
        assert {message.category for message in told} == {"logEvents"}


def test_a_number_sign_in_a_message_is_no_value_reference(instance3):
    one = instance3(name="ratchet#1")

    assert one.refusal(one.slave.terminate).startswith("ratchet##1: ")


def test_logging_is_off_until_it_is_switched_on(instance3):
    one = instance3(logging=False).begin()
    with pytest.raises(FMICallException):
        one.slave.enterEventMode()
    one.step(0.5)
    assert one.log == []
    one.slave.setDebugLogging(True, ["logEvents"])
    one.step(0.5)
    assert {message.category for message in one.log} == {"logEvents"}


def test_the_stop_time_ends_it(instance3):
    one = instance3().begin(stopTime=0.5, tolerance=1e-8)
    one.step(0.5)

    assert "past the stop time" in one.refusal(one.slave.doStep, 0.5, 0.1)


def test_another_token_is_refused(ratchet3, instance3, capfd):
    with pytest.raises(Exception, match="Failed to instantiate"):
        Instance3(ratchet3, token="{other}")


@pytest.mark.parametrize("kind", [FMU3Model, FMU3ScheduledExecution])
def test_other_interface_types_are_refused(ratchet3, kind):
    told = []
    description = ratchet3.description
    slave = kind(
        guid=description.guid,
        unzipDirectory=ratchet3.folder,
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="other",
    )
    with pytest.raises(Exception, match="Failed to instantiate"):
        slave.instantiate(logMessage=lambda _, status, category, text: told.append(text))
    assert b"co-simulation only" in told[0]


def test_what_no_intermediate_update_can_give_is_refused(ratchet3):
    for name in ("drive_torque", "impact_count", "impacts.time", "impact"):
        with pytest.raises(Exception, match="Failed to instantiate"):
            Instance3(ratchet3, on_update=lambda _: None, intermediate=[name])


def test_calls_out_of_order_are_refused(instance3):
    one = instance3()
    slave, no_events = one.slave, "eventModeUsed = false"
    assert "initialization" in one.refusal(slave.exitInitializationMode)
    assert "stepping" in one.refusal(slave.doStep, 0.0, 0.1)
    assert "stepping" in one.refusal(slave.terminate)
    one.begin()
    assert "instantiated" in one.refusal(slave.enterInitializationMode)
    assert no_events in one.refusal(slave.enterEventMode)
    assert "event" in one.refusal(slave.updateDiscreteStates)
    assert "event" in one.refusal(slave.enterStepMode)
    assert "is not the time reached" in one.refusal(slave.doStep, 0.5, 0.1)
    assert "must be positive" in one.refusal(slave.doStep, 0.0, 0.0)
    assert "cannot be set" in one.refusal(one.set, {"tooth_pitch": 1.0})
    assert "structural" in one.refusal(slave.enterConfigurationMode)
    count = c_size_t()
    assert "those of elements" in one.refusal(slave.fmi3GetNumberOfVariableDependencies, slave.component, 0, count)
    one.step(0.1)
    slave.terminate()
    assert "terminated" in one.refusal(slave.doStep, one.time, 0.1)
    assert one["wheel_angle"] > 0


def test_version(instance3):
    assert instance3().slave.fmi3GetVersion() == b"3.0"


def test_null_pointers_are_refused(instance3):
    one = instance3().begin()
    slave, component = one.slave, one.slave.component
    references, values = (fmpy.fmi3.fmi3ValueReference * 1)(0), (c_double * 1)()

    for call in (
        lambda: slave.fmi3DoStep(component, 0.0, 0.1, True, None, None, None, None),
        lambda: slave.fmi3GetFloat64(component, None, 1, values, 1),
        lambda: slave.fmi3GetFloat64(component, references, 1, None, 1),
        lambda: slave.fmi3SetFloat64(component, None, 1, values, 1),
        lambda: slave.fmi3SetFloat64(component, references, 1, None, 1),
        lambda: slave.fmi3GetClock(component, None, 1, None),
        lambda: slave.fmi3GetOutputDerivatives(component, references, 1, None, values, 1),
        lambda: slave.fmi3GetFMUState(component, None),
        lambda: slave.fmi3SetFMUState(component, None),
        lambda: slave.fmi3SerializedFMUStateSize(component, None, None),
    ):
        assert "null" in one.refusal(call)
    slave.fmi3GetFloat64(component, None, 0, None, 0)
    slave.fmi3FreeFMUState(component, None)
    one.step(0.1)

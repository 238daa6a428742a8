"""FMI 3.0 with a clock of impacts: what it clocks, and arrays."""

from ctypes import c_bool

import fmpy
import pytest

from tests.fmu.native.host3 import Instance3
from tests.fmu.native.scenes3 import AFTER, IMPACT, ROUGH, impact_at


def stopping(make, start=None):
    return make(event_mode=True, early_return=True).begin(start)


def test_the_clock_ticks_at_an_impact_until_the_discrete_states_are_updated(clocked3):
    one = stopping(clocked3)
    one.run(0.9, 9)
    step = one.step(0.1)

    assert step.reached == IMPACT
    assert not one["impact.clock"]
    one.slave.enterEventMode()
    assert one["impact.clock"]
    assert one["impact_count"] == 0
    one.slave.updateDiscreteStates()
    assert not one["impact.clock"]
    assert one["impact_count"] == 1


def test_what_it_clocks_is_of_this_impact_and_the_plain_ones_hold_the_last(clocked3):
    one = stopping(clocked3, ROUGH)
    last = -1.0
    for _ in range(5):
        while not one.step(0.5).event:
            pass
        one.slave.enterEventMode()
        assert one["impact_time"] == last
        last = one["impact.tick.time"]
        assert last == one.time
        ticked = one.get(name for name in one.fmu.variables if name.startswith("impact.tick."))
        one.slave.updateDiscreteStates()
        assert ticked == {name: one[name.replace("impact.tick.", "impact_")] for name in ticked}
        one.slave.enterStepMode()
    assert {"impact.tick.wheel_speed_before", "impact.tick.velocity", "impact.tick.tooth"} <= set(ticked)


def test_what_it_clocks_is_read_in_event_mode_only(clocked3):
    one = stopping(clocked3)

    told = one.refusal(lambda: one["impact.tick.velocity"])
    assert (
        told == "one: fmi3GetFloat64: impact.tick.velocity is clocked; read it in event mode, or read impact_velocity."
    )
    assert "fmi3GetInt32: impact.tick.tooth is clocked" in one.refusal(lambda: one["impact.tick.tooth"])


def test_it_does_not_tick_in_other_event_modes(clocked3):
    one = clocked3(event_mode=True, early_return=True)
    one.slave.enterInitializationMode()
    one.slave.exitInitializationMode()
    assert not one["impact.clock"]
    one.leave_event_mode()
    one.step(0.1)
    one.slave.enterEventMode()
    assert not one["impact.clock"]
    one.leave_event_mode()


def test_a_host_without_early_return_has_it_at_the_end_of_the_step(clocked3):
    one = clocked3(event_mode=True).begin()
    assert one.step(1.0).event
    one.slave.enterEventMode()
    assert one["impact.clock"]
    assert one["impact.tick.time"] == one["impacts.time"][0] == IMPACT


def test_without_event_mode_there_is_no_instance(clocked_ratchet3, capfd):
    with pytest.raises(Exception, match="Failed to instantiate"):
        Instance3(clocked_ratchet3)


def test_the_motion_is_that_without_a_clock(clocked3, instance3):
    with_clock, plain = stopping(clocked3, ROUGH), stopping(instance3, ROUGH)
    with_clock.run(2.0, 10)
    plain.run(2.0, 10)

    outputs = plain.outputs()
    assert outputs["impact_count"] > 10
    assert {name: value for name, value in with_clock.outputs().items() if name in outputs} == outputs
    assert impact_at(clocked3) == impact_at(instance3)


def test_arrays_and_scalars_in_one_call(clocked3):
    one = clocked3(event_mode=True).begin(ROUGH)
    while one["impacts_in_step"] < 2:
        one.step(0.1)
    names = ["impact_time", "impacts.time", "time", "impacts.impulse"]
    values = one.slave.getFloat64([one.reference(name) for name in names], nValues=18)

    assert values == [one["impact_time"], *one["impacts.time"], one.time, *one["impacts.impulse"]]
    arrays = [name for name, variable in one.fmu.variables.items() if variable.dimensions]
    assert {"impacts.time", "impacts.contact", "impacts.crank_speed_before", "events.guard"} <= set(arrays)
    for name in arrays:
        group, field = name.split(".")
        assert one[name] == [one[f"{group}[{k}].{field}"] for k in range(1, len(one[name]) + 1)]


def test_values_of_the_wrong_number_are_refused(clocked3):
    one = clocked3(event_mode=True).begin()
    times, crank = one.reference("impacts.time"), one.reference("crank_angle")

    assert "8 values together, and 7 were given" in one.refusal(one.slave.getFloat64, [times], 7)
    assert "1 values together, and 2 were given" in one.refusal(one.slave.getFloat64, [crank], 2)
    assert "impacts.time is of causality output" in one.refusal(one.slave.setFloat64, [times], [1.0] * 8)
    last = max(variable.valueReference for variable in one.fmu.variables.values())
    assert f"references run from 1 to {last}" in one.refusal(one.slave.getFloat64, [last + 1])


def test_an_array_has_no_derivative(clocked3):
    one = clocked3(event_mode=True).begin()
    assert "8 values together" in one.refusal(one.slave.getOutputDerivatives, [one.reference("impacts.time")], [1])


def test_what_no_intermediate_update_can_give_is_refused(clocked_ratchet3):
    for name in (
        "drive_torque",
        "impact_count",
        "impacts.time",
        "impact.tick.time",
        "impact.clock",
        "impact_time",
        "time",
    ):
        with pytest.raises(Exception, match="Failed to instantiate"):
            Instance3(clocked_ratchet3, event_mode=True, on_update=lambda _: None, intermediate=[name])


def test_use_without_event_mode_is_refused_in_words(clocked_ratchet3):
    """The standard wants eventModeUsed = true of FMUs with clocks (fmi3InstantiateCoSimulation)."""
    told = []
    slave = fmpy.fmi3.FMU3Slave(
        guid=clocked_ratchet3.description.guid,
        unzipDirectory=clocked_ratchet3.folder,
        modelIdentifier=clocked_ratchet3.description.coSimulation.modelIdentifier,
        instanceName="one",
    )
    with pytest.raises(Exception, match="Failed to instantiate"):
        slave.instantiate(eventModeUsed=False, logMessage=lambda _, status, category, text: told.append(text))
    assert told == [
        b"one: fmi3InstantiateCoSimulation: this FMU has a clock; use event mode (eventModeUsed = true), or build it "
        b"without --clocks."
    ]


def test_the_clock_is_read_only_and_has_no_interval(clocked3):
    one = clocked3(event_mode=True).begin()
    slave, component = one.slave, one.slave.component
    references = (fmpy.fmi3.fmi3ValueReference * 1)(one.reference("impact.clock"))
    other = (fmpy.fmi3.fmi3ValueReference * 1)(1)
    values = (c_bool * 1)(True)

    assert "is an output" in one.refusal(slave.fmi3SetClock, component, references, 1, values)
    assert "no clock with value reference 1" in one.refusal(slave.fmi3GetClock, component, other, 1, values)
    intervals = (fmpy.fmi3.fmi3Float64 * 1)()
    assert "triggered by impacts" in one.refusal(slave.fmi3SetIntervalDecimal, component, references, 1, intervals)


def test_left_limits_are_those_without_a_clock(clocked3, instance3):
    ends = []
    for make in (clocked3, instance3):
        one = stopping(make)
        one.run(0.9, 9)
        one.step(0.1)
        ends.append((one["wheel_speed"], one["impact_wheel_speed"]))
        one.slave.enterEventMode()
        one.slave.updateDiscreteStates()
        ends[-1] += tuple(one.get(AFTER).values())
    assert ends[0] == ends[1]

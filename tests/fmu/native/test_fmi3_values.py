"""FMI 3.0: arrays, the types of variables, and the clock as a variable."""

from ctypes import c_bool

import fmpy

from tests.fmu.native.scenes3 import ROUGH


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
    assert "There is no variable" in one.refusal(slave.getFloat64, [times + 10], 1)  # impacts[2].time: of the array
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

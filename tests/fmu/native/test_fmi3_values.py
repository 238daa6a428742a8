"""FMI 3.0: types and references of variables."""

from ctypes import c_bool

import fmpy


def test_values_of_the_wrong_number_or_type_are_refused(ratchet3, instance3):
    one = instance3().begin()
    crank, slave = one.reference("crank_angle"), one.slave

    assert "1 values together, and 2 were given" in one.refusal(slave.getFloat64, [crank], 2)
    assert "There is no variable" in one.refusal(slave.getFloat64, [2**32 - 1])
    assert "There is no variable" in one.refusal(slave.getFloat64, [0])
    last, time = ratchet3.description.modelVariables[-1].valueReference, one.reference("time")
    assert f"references run from 1 to {last}" in one.refusal(slave.getFloat64, [last + 1])
    assert "of type Boolean, not Float64" in one.refusal(slave.getFloat64, [one.reference("impact")])
    assert "of type Float64, not Int32" in one.refusal(slave.getInt32, [crank])
    assert "time is the independent variable" in one.refusal(slave.setFloat64, [time], [1.0])
    assert "set all at once, by fmi3SetContinuousStates" in one.refusal(slave.setFloat64, [last], [1.0])
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


def test_there_is_no_clock(instance3):
    one = instance3(event_mode=True).begin()
    references = (fmpy.fmi3.fmi3ValueReference * 1)(one.reference("time") + 1)
    values = (c_bool * 1)(True)

    assert "no clock" in one.refusal(one.slave.fmi3GetClock, one.slave.component, references, 1, values)

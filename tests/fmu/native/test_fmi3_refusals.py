"""FMI 3.0: what the log says, and calls that are refused."""

from ctypes import c_double, c_size_t

import fmpy
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi3 import FMU3ScheduledExecution

from tests.fmu.native.host3 import Instance3
from tests.fmu.native.scenes3 import ROUGH


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


def test_scheduled_execution_is_refused(ratchet3):
    told = []
    description = ratchet3.description
    slave = FMU3ScheduledExecution(
        guid=description.guid,
        unzipDirectory=ratchet3.folder,
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="other",
    )
    with pytest.raises(Exception, match="Failed to instantiate"):
        slave.instantiate(logMessage=lambda _, status, category, text: told.append(text))
    assert b"built for co-simulation and Model Exchange; it has no Scheduled Execution interface" in told[0]


def test_what_no_intermediate_update_can_give_is_refused(ratchet3):
    for name in ("drive_torque", "impact_count", "impacts[1].time", "impact", "time"):
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
    references, values = (fmpy.fmi3.fmi3ValueReference * 1)(1), (c_double * 1)()

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

"""FMI 3.0: steps, early return, event mode and the clock of impacts."""

import pytest

from tests.fmu.conformance.host import Instance
from tests.fmu.native.scenes3 import AFTER, IMPACT, ROUGH, impact_at

#: Outputs that speak of the last communication step alone.
OF_STEP = ("impacts", "events")


def lasting(outputs):
    return {name: value for name, value in outputs.items() if not name.startswith(OF_STEP)}


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

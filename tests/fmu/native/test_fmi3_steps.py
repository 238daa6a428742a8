"""FMI 3.0: steps, early return, event mode, limits on both sides of an impact."""

import pytest
from fmpy.fmi1 import FMICallException

from tests.fmu.conformance.host import Instance
from tests.fmu.native.scenes3 import AFTER, IMPACT, ROUGH, impact_at


def lasting(outputs):
    return {
        name: value
        for name, value in outputs.items()
        if not name.startswith(("impacts", "events")) and name != "impact"
    }


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
    one.slave.enterEventMode()
    one.slave.updateDiscreteStates()
    assert one["impact"]
    assert one["time"] == one["impact_time"] == one["impacts[1].time"] == step.reached
    assert one.get(AFTER) == pytest.approx(AFTER, rel=1e-7)
    assert one["wheel_speed"] == pytest.approx(one["impact_wheel_speed"], rel=1e-9)
    one.slave.enterStepMode()
    assert one["impact"]
    assert one.step_to(1.0) == (False, False, False, 1.0)
    assert not one["impact"]
    assert one["impact_time"] == step.reached


def test_every_impact_ends_a_step(instance3):
    one = instance3(event_mode=True, early_return=True).begin(ROUGH)
    steps, seen = [], 0
    while one.time < 2.0:
        steps.append(one.step_to(2.0))
        if steps[-1].event:
            one.slave.enterEventMode()
            assert one["impact_count"] == seen
            one.slave.updateDiscreteStates()
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
    assert one["impact_count"] == 0
    one.slave.enterEventMode()
    one.slave.updateDiscreteStates()
    assert one["impact_count"] == 1


def test_a_host_without_early_return_learns_of_impacts_at_the_end(instance3):
    one = instance3(event_mode=True).begin()
    steps = one.run(0.9, 9)
    assert not any(step.event or step.early for step in steps)
    assert one.step_to(1.0) == (True, False, False, 1.0)
    assert one["impacts_in_step"] == 1
    assert one["impacts[1].time"] == one["impact_time"] == IMPACT
    one.slave.enterEventMode()
    one.leave_event_mode()
    assert one.step(0.1).event is False


# --- limits ---


def stopped_at_impact(make, start=None):
    """An instance right after the return from the step that an impact has ended."""
    one = make(event_mode=True, early_return=True).begin(start)
    while not one.step(0.1).early:
        pass
    return one


def test_outputs_are_left_limits_until_the_discrete_states_are_updated(instance3):
    one = stopped_at_impact(instance3)
    before = one.outputs()
    one.slave.enterEventMode()
    assert one.outputs() == before
    one.slave.updateDiscreteStates()
    after = one.outputs()
    one.slave.enterStepMode()
    assert one.outputs() == after

    assert before["impact_count"] == 0
    assert after["impact_count"] == 1
    assert not before["face_active"]
    assert after["face_active"]
    for body in ("wheel", "crank", "pawl"):
        assert before[f"{body}_angle"] == pytest.approx(after[f"{body}_angle"], abs=1e-9)
        assert (
            before[f"{body}_speed"] == after[f"impact_{body}_speed_before"] == after[f"impacts[1].{body}_speed_before"]
        )
        assert after[f"{body}_speed"] == after[f"impact_{body}_speed"] == after[f"impacts[1].{body}_speed"]
    lost = after["energy_lost"] - before["energy_lost"]
    assert before["kinetic_energy"] - after["kinetic_energy"] == pytest.approx(lost, rel=1e-9)
    assert lost == pytest.approx(after["impact_energy_lost"], rel=1e-9)


def test_without_event_mode_only_right_limits_are_seen(instance3):
    when = impact_at(instance3)
    one = instance3(early_return=True).begin()
    one.step(when)

    assert one["impact_time"] == when
    assert one["wheel_speed"] == one["impact_wheel_speed"]


def test_left_limits_end_with_the_next_step_or_the_step_mode(instance3):
    careless = stopped_at_impact(instance3)
    careless.step(0.01)
    assert careless["impact_count"] == 1
    hasty = stopped_at_impact(instance3)
    hasty.slave.enterEventMode()
    hasty.slave.enterStepMode()
    assert hasty["impact_count"] == 1


def test_left_limits_are_saved_with_the_state(instance3):
    one = stopped_at_impact(instance3, ROUGH)
    before, saved = one.outputs(), one.save_bytes()
    one.slave.enterEventMode()
    one.leave_event_mode()
    after = one.outputs()
    assert after != before
    other = instance3(event_mode=True, early_return=True)
    other.restore_bytes(saved)
    assert other.outputs() == before
    other.slave.enterEventMode()
    other.leave_event_mode()
    assert other.outputs() == after
    plain = instance3()
    plain.restore_bytes(saved)
    assert plain.outputs() == after


def test_an_input_set_in_event_mode_acts_behind_the_impact(instance3):
    one = stopped_at_impact(instance3)
    one.slave.enterEventMode()
    before = one["contact_force"]
    one.set({"drive_torque": 2e-3})
    assert one["contact_force"] == before
    one.slave.updateDiscreteStates()
    other = stopped_at_impact(instance3)
    other.slave.enterEventMode()
    other.slave.updateDiscreteStates()
    assert one["contact_force"] != other["contact_force"]


def test_at_an_impact_there_are_no_derivatives_of_outputs(instance3):
    one = stopped_at_impact(instance3)
    with pytest.raises(FMICallException):
        one.slave.getOutputDerivatives([one.reference("wheel_angle")], [1])
    assert "until fmi3UpdateDiscreteStates" in one.log[-1].text
    one.slave.enterEventMode()
    one.slave.updateDiscreteStates()
    assert one.slave.getOutputDerivatives([one.reference("wheel_angle")], [1]) == [one["wheel_speed"]]


def test_an_impact_at_the_end_of_a_step_has_both_sides_without_early_return(instance3):
    when = impact_at(instance3)
    one = instance3(event_mode=True).begin()
    assert one.step(when) == (True, False, False, when)
    before = one.outputs()
    assert before["impact_count"] == 0
    one.slave.enterEventMode()
    one.slave.updateDiscreteStates()
    assert one["wheel_speed"] == one["impact_wheel_speed"] != before["wheel_speed"]


def test_left_limits_do_not_outlive_the_run(instance3):
    one = stopped_at_impact(instance3)
    one.slave.terminate()
    assert one["impact_count"] == 1

"""FMI 3.0: states saved in and around event mode, and reset."""

import pytest

from tests.fmu.native.scenes3 import ROUGH


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
    assert again.outputs() == there
    assert "event" in again.refusal(again.slave.doStep, again.time, 0.1)
    again.leave_event_mode()
    assert again["impact_count"] > there["impact_count"]
    again.run(2.0, 3)
    assert again.outputs() == end


def test_a_state_saved_before_event_mode_still_leads_into_it(clocked3):
    one = clocked3(event_mode=True, early_return=True).begin()
    assert one.step(1.0).event
    saved = one.save_bytes()
    one.slave.enterEventMode()
    one.leave_event_mode()
    one.restore_bytes(saved)
    one.slave.enterEventMode()

    assert one["impact.clock"]


def test_reset_begins_anew(instance3):
    one = instance3(event_mode=True, early_return=True).begin()
    first = one.run(1.2, 3), one.outputs()
    one.slave.reset()
    one.begin()

    assert (one.run(1.2, 3), one.outputs()) == first

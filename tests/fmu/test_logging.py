"""What an instance says through the FMI logger."""

import math

from fmpy.fmi2 import fmi2OK, fmi2Warning


def said(one, category):
    return [message for message in one.log if message.category == category]


def test_an_impact_is_told_and_so_is_the_event(instance):
    one = instance().begin()
    one.run(2.0, 0.1)

    impact, event = said(one, "logEvents")
    assert impact.status == event.status == fmi2OK
    assert "Impact on face at t = 0.9399211769" in impact.text
    assert "closing speed 0.0675769 m/s, impulse 0.00778959 N.s" in impact.text
    assert "Event face.gap at t = 0.9399211769" in event.text
    assert "slope -> slope+face, total impulse 0.00778959 N.s" in event.text


def test_events_beyond_the_buffer_are_counted_and_not_told(instance):
    one = instance().begin({"restitution": 0.5})
    one.step(3.0)

    told = [message.text for message in said(one, "logEvents") if "vent" in message.text]
    assert len(told) == 17
    assert "events of the step to t = 3 s are not listed one by one; the last 16 follow." in told[0]
    assert int(told[0].split()[0]) + 16 == one["event_count"]
    assert one["events_in_step"] == 16


def test_events_are_among_the_outputs(instance):
    one = instance().begin()
    assert [one[f"events[1].{field}"] for field in ("time", "guard", "subject", "new_mode")] == [-1, -1, -1, 0]
    one.step(2.0)
    assert one["events_in_step"] == 1
    assert abs(one["events[1].time"] - 0.9399211769) < 1e-9
    assert [one[f"events[1].{field}"] for field in ("guard", "subject", "old_mode", "new_mode")] == [0, 1, 1, 3]
    assert abs(one["events[1].impulse"] - 7.7895902699e-3) < 1e-9
    assert one["events[2].time"] == -1


def test_a_guided_contact_that_pulls_is_a_warning_once(instance):
    one = instance().begin({"tooth_slope_angle": math.radians(95)})
    one.run(6.0, 0.1)

    (warning,) = said(one, "logStatusWarning")
    assert warning.status == fmi2Warning
    assert "From t = 3.76884 s the guided contact slope pulls" in warning.text


def test_it_pulls_before_the_impact_at_105_degrees(instance):
    one = instance().begin({"tooth_slope_angle": math.radians(105)})
    one.run(0.9, 0.1)

    assert one["impact_count"] == 0
    assert "From t = 0.816526 s" in said(one, "logStatusWarning")[0].text


def test_a_tip_beyond_the_apex_is_a_warning(instance):
    one = instance().begin({"tooth_count": 25})

    assert "beyond the apex" in said(one, "logStatusWarning")[0].text


def test_restoring_does_not_repeat_the_news(instance):
    one = instance().begin({"tooth_slope_angle": math.radians(95)})
    one.run(4.0, 0.1)
    state = one.save()
    before = len(one.log)
    one.restore(state, 4.0)
    one.run(5.0, 0.1)
    one.slave.freeFMUstate(state)

    assert len(one.log) == before


def test_silence_when_logging_is_off(instance):
    one = instance(logging=False).begin({"tooth_count": 25})
    one.run(2.0, 0.1)

    assert one.log == []

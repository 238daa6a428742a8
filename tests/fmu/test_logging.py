"""What an instance says through the FMI logger."""

import math

from fmpy.fmi2 import fmi2OK, fmi2Warning


def said(one, category):
    return [message for message in one.log if message.category == category]


def test_an_impact_is_an_event(instance):
    one = instance().begin()
    one.run(2.0, 0.1)

    (event,) = said(one, "logEvents")
    assert event.status == fmi2OK
    assert "Impact on face at t = 0.9399211769" in event.text
    assert "closing speed 0.0675769 m/s, impulse 0.00778959 N.s" in event.text


def test_a_guided_contact_that_pulls_is_a_warning_once(instance):
    one = instance().begin({"tooth_slope_angle": math.radians(95)})
    one.run(6.0, 0.1)

    (warning,) = said(one, "logStatusWarning")
    assert warning.status == fmi2Warning
    assert "From t = 3.76885 s the guided contact slope pulls" in warning.text


def test_it_pulls_before_the_impact_at_105_degrees(instance):
    one = instance().begin({"tooth_slope_angle": math.radians(105)})
    one.run(0.9, 0.1)

    assert one["impact_count"] == 0
    assert "From t = 0.816527 s" in said(one, "logStatusWarning")[0].text


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

"""What reaches the host's logger, and what does not."""

import pytest
from fmpy.fmi1 import FMICallException


def refuse(one):
    with pytest.raises(FMICallException):
        one.step(-1.0)


def test_every_category_that_is_used_is_declared(subject, instance):
    one = instance().begin(subject.rough)
    one.step(subject.until)
    one.step(10.0)
    refuse(one)
    declared = {category.name for category in subject.fmu.description.logCategories}
    used = {message.category for message in one.log}
    assert {*subject.event_categories, "logStatusError"} <= used
    # The wrapper's own line after a refusal has no category.
    assert used - declared <= {""}


def test_nothing_is_said_with_logging_off(subject, instance):
    one = instance(logging=False).begin(subject.rough)
    one.run(subject.until, 0.05)
    refuse(one)
    subject.assert_struck(one)
    assert one.log == []


def test_logging_can_be_switched_while_it_runs(subject, instance):
    one = instance(logging=False).begin(subject.rough)
    refuse(one)
    one.slave.setDebugLogging(True, [])
    refuse(one)
    said = len(one.log)
    assert said
    one.slave.setDebugLogging(False, [])
    refuse(one)
    assert len(one.log) == said


def test_categories_are_obeyed(subject, instance):
    one = instance(logging=False)
    one.slave.setDebugLogging(True, ["logEvents"])
    one.begin(subject.rough).run(subject.until, 0.05)
    refuse(one)
    assert {message.category for message in one.log} == subject.event_categories


def test_a_refusal_names_the_instance_that_refused(subject, instance):
    one, other = instance("left"), instance("right")
    one.begin()
    refuse(one)
    assert any("left" in message.text for message in one.log)
    assert other.log == []

"""Getting and setting, at every moment at which a host may do it."""

import pytest
from fmpy.fmi1 import FMICallException

from tests.fmu.conformance.host import Instance


def middle(subject):
    return {name: (low + high) / 2 for name, (low, high) in subject.inputs.items()}


def test_what_was_set_is_read_back_before_during_and_after_initialization(subject, instance):
    one, values = instance(), middle(subject)
    one.set({**values, **subject.rough})
    assert one.get([*values, *subject.rough]) == {**values, **subject.rough}
    one.slave.setupExperiment()
    one.slave.enterInitializationMode()
    assert one.get([*values, *subject.rough]) == {**values, **subject.rough}
    one.slave.exitInitializationMode()
    one.step(0.01)
    assert one.get([*values, *subject.rough]) == {**values, **subject.rough}


def test_values_set_in_initialization_mode_count_as_if_set_before(subject, instance):
    early, late = instance(), instance("late")
    early.begin({**subject.rough, **middle(subject)})
    late.slave.setupExperiment()
    late.slave.enterInitializationMode()
    late.outputs()
    late.set({**subject.rough, **middle(subject)})
    late.slave.exitInitializationMode()
    assert late.outputs() == early.outputs()
    for one in (early, late):
        one.run(subject.until, 0.05)
    assert late.outputs() == early.outputs()


def test_outputs_can_be_read_before_the_start_and_do_not_change_by_it(subject, instance):
    one = instance()
    one.set(subject.rough)
    before = one.outputs()
    one.begin()
    assert one.outputs() == before


def test_reading_disturbs_nothing(subject, instance):
    quiet, read = instance().begin(subject.rough), instance("read").begin(subject.rough)
    for _ in range(40):
        quiet.step(0.05)
        read.step(0.05)
        read.outputs()
        read.get(subject.fmu.named("calculatedParameter"))
    assert read.outputs() == quiet.outputs()


def test_one_getter_may_ask_for_a_variable_twice_and_in_any_order(subject, instance):
    one = instance().begin()
    reals = [v for v in subject.fmu.description.modelVariables if v.type == "Real"]
    references = [v.valueReference for v in reversed(reals)] + [reals[0].valueReference] * 2
    values = one.slave.getReal(references)
    assert values[: len(reals)] == [one[v.name] for v in reversed(reals)]
    assert values[-2:] == [one[reals[0].name]] * 2


def test_a_refused_call_sets_nothing_at_all(subject, instance):
    """Otherwise the instance would run with a value that was never accepted."""
    one = instance().begin(subject.rough)
    expected = subject.reference(instance("reference"))
    first, second = list(subject.inputs)[:2]
    before = one[first]
    with pytest.raises(FMICallException):
        one.slave.setReal([one.reference(first), one.reference(second)], [subject.inputs[first][1], float("nan")])
    assert one[first] == before
    one.run(subject.until, 0.05)
    assert one[first] == before
    assert one.outputs() == expected


def test_parameters_can_be_read_while_they_do_not_fit_together_yet(refusing):
    """Hosts set and read back one by one; what is impossible now may be mended by the next value."""
    with Instance(refusing.fmu) as one, Instance(refusing.fmu, "reference") as other:
        one.set(refusing.impossible)
        assert one.get(refusing.impossible) == refusing.impossible
        assert one.get(refusing.inputs) == {name: one.fmu.start(name) for name in refusing.inputs}
        one.set({name: one.fmu.start(name) for name in refusing.impossible})
        assert refusing.reference(one) == refusing.reference(other)


def test_impossible_parameters_are_refused_with_advice_when_initialization_ends(refusing):
    with Instance(refusing.fmu) as one, Instance(refusing.fmu, "reference") as other:
        with pytest.raises(FMICallException):
            one.begin(refusing.impossible)
        (message,) = [m.text for m in one.log if m.category == "logStatusError"]
        assert all(name in message for name in refusing.impossible)
        assert "give " in message.lower()
        assert refusing.reference(one.reset()) == refusing.reference(other)

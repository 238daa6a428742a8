"""Saved states at every moment of an instance's life, and what goes with them."""

from ctypes import c_size_t, create_string_buffer
from functools import partial

import pytest
from fmpy.fmi1 import FMICallException

from tests.fmu.conformance.alone import refused


def test_a_state_holds_start_time_and_tolerance(subject, instance):
    one = instance().begin(subject.rough, start_time=-3.5, tolerance=1e-11)
    one.run(-3.0, 0.05)
    saved, time = one.save_bytes(), one.time
    one.run(-1.0, 0.05)
    other = instance("other").begin()
    other.restore_bytes(saved, time)
    other.run(-1.0, 0.05)
    assert other.outputs() == one.outputs()
    subject.assert_struck(one)
    if subject.impacts:
        assert one["impact_time"] < 0


def test_a_state_saved_in_initialization_mode_goes_back_into_it(subject, instance):
    one = instance()
    one.slave.setupExperiment()
    one.slave.enterInitializationMode()
    state = one.save()
    one.set(subject.rough)
    one.slave.exitInitializationMode()
    one.run(subject.until, 0.05)
    first = one.outputs()
    one.restore(state, 0.0)
    with pytest.raises(FMICallException):
        one.step(0.05)
    assert "initialization" in one.refusal
    assert one.get(subject.rough) == {name: one.fmu.start(name) for name in subject.rough}
    one.set(subject.rough)
    one.slave.exitInitializationMode()
    one.run(subject.until, 0.05)
    assert one.outputs() == first
    one.slave.freeFMUstate(state)


def test_a_state_outlives_reset_and_termination(subject, instance):
    one = instance().begin(subject.rough)
    one.run(0.5, 0.05)
    state, time = one.save(), one.time
    one.run(subject.until, 0.05)
    expected = one.outputs()
    one.slave.terminate()
    one.restore(state, time)
    one.run(subject.until, 0.05)
    assert one.outputs() == expected
    one.reset()
    one.restore(state, time)
    one.run(subject.until, 0.05)
    assert one.outputs() == expected
    one.slave.freeFMUstate(state)


def test_a_state_brings_its_inputs_with_it(subject, instance):
    one = instance().begin(subject.rough)
    one.set({name: high for name, (_, high) in subject.inputs.items()})
    saved = one.save_bytes()
    one.run(subject.until, 0.05)
    other = instance("other").begin()
    other.restore_bytes(saved, 0.0)
    assert other.get(subject.inputs) == {name: high for name, (_, high) in subject.inputs.items()}
    other.run(subject.until, 0.05)
    assert other.outputs() == one.outputs()


def test_a_state_mends_an_instance_that_has_refused(subject, instance):
    one = instance().begin(subject.rough)
    one.run(0.5, 0.05)
    state, time = one.save(), one.time
    one.run(subject.until, 0.05)
    expected = one.outputs()
    one.restore(state, time)
    for bad in (lambda: one.step(-1.0), lambda: one.slave.deSerializeFMUstate(b"no state"), lambda: one.begin()):
        with pytest.raises(FMICallException):
            bad()
    one.restore(state, time)
    one.run(subject.until, 0.05)
    assert one.outputs() == expected
    one.slave.freeFMUstate(state)


def test_what_is_replayed_is_told_again(subject, instance):
    one = instance().begin(subject.rough)
    state = one.save()
    told = []
    for _ in range(2):
        since = len(one.log)
        one.restore(state, 0.0)
        one.run(subject.until, 0.05)
        told.append(one.log[since:])
    assert told[0] == told[1]
    assert {message.category for message in told[0]} >= subject.event_categories
    one.slave.freeFMUstate(state)


def test_equal_states_have_equal_bytes(subject, instance):
    saved = []
    for name in ("one", "two"):
        one = instance(name).begin(subject.rough)
        one.run(subject.until, 0.05)
        saved.append(one.save_bytes())
    assert saved[0] == saved[1]


def test_a_buffer_that_is_too_small_is_not_overrun_and_gives_no_state(subject, instance):
    """That the call itself is fmi2OK is the decision of pythonfmu's wrapper."""
    one = instance().begin(subject.rough)
    one.run(0.5, 0.05)
    state, size = one.save(), c_size_t()
    one.slave.fmi2SerializedFMUstateSize(one.slave.component, state, size)
    buffer = create_string_buffer(b"\xee" * size.value, size.value)
    too_small = partial(one.slave.fmi2SerializeFMUstate, one.slave.component, state, buffer, size.value - 100)
    assert refused(too_small) == subject.native
    assert buffer.raw[-100:] == b"\xee" * 100
    with pytest.raises(FMICallException):
        one.slave.deSerializeFMUstate(buffer.raw[:-100])
    # The wrapper has filled the buffer as far as it goes, the native surface has left it alone.
    assert ("are not a saved state" if subject.native else "cut off") in one.log[-1].text
    one.slave.freeFMUstate(state)

import struct

import pytest
from hypothesis import given, strategies as st

from mechanism_fmu.fmu.instance.protocol import Experiment, Phase
from mechanism_fmu.fmu.instance.saved_state import SavedState, SavedStateError, check, decode, encode, fingerprint

MARK = fingerprint(["Ratchet", "a", "b"])
numbers = st.lists(st.floats(allow_nan=False), max_size=6).map(tuple)
times = st.floats(-1e6, 1e6)
experiments = st.builds(
    Experiment, times, times | st.just(float("inf")), st.floats(1e-13, 1e-3) | st.just(float("inf"))
)
words = st.binary(max_size=64).map(lambda b: b[: len(b) // 8 * 8])
states = st.builds(SavedState, st.sampled_from(Phase), st.none() | experiments, numbers, numbers, words)


@given(states)
def test_what_is_written_is_read(state):
    assert decode(encode(state, MARK), MARK) == state


@given(states, st.data())
def test_any_changed_byte_is_noticed(state, data):
    saved = bytearray(encode(state, MARK))
    saved[data.draw(st.integers(0, len(saved) - 1))] ^= data.draw(st.integers(1, 255))
    with pytest.raises(SavedStateError):
        check(bytes(saved), MARK)


@given(states, st.data())
def test_any_other_length_is_noticed(state, data):
    saved = encode(state, MARK)
    short = saved[: data.draw(st.integers(0, len(saved) - 1))]
    with pytest.raises(SavedStateError):
        check(short, MARK)
    with pytest.raises(SavedStateError, match="cut off or extended"):
        check(saved + b"x", MARK)


def test_state_of_another_model_is_refused():
    saved = encode(SavedState(Phase.INSTANTIATED, None, (), (), struct.pack("d", 1.0)), MARK)
    with pytest.raises(SavedStateError, match="another model"):
        check(saved, fingerprint(["Ratchet", "ab", ""]))

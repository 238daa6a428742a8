"""What the process of a component writes is data: whatever it is, nothing runs here, and an error comes in time."""

import gc
import json
import os
import pickle
import socket
import struct
import time as clock
from array import array
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, strategies as st

from harness.errors import FmuError, HarnessError
from harness.fmu.description import Description, Variable
from harness.fmu.instances.message_log import MessageHandler
from harness.fmu.processes import MOST_BYTES, BrokenFrameError, LateFrameError, Wire
from harness.fmu.remote import remote
from harness.fmu.remote.protocol import Numbers, Question, Types, packed_answer, question, read_error, read_messages
from tests.harness.machine.fakes import Wheel, description


def frame(data: Any, tail: bytes = b"") -> bytes:
    text = data if isinstance(data, bytes) else json.dumps(data).encode()
    return struct.pack("<II", len(text), len(tail)) + text + tail


@dataclass(frozen=True)
class Command:
    """Runs a command where it is unpickled."""

    text: str

    def __reduce__(self) -> tuple[Any, ...]:
        return os.system, (self.text,)


@dataclass(frozen=True)
class ForgerOpener:
    """Makes a wheel that writes bytes of its own to the one that leads, in its first step, and then stands still."""

    forged: bytes

    @property
    def description(self) -> Description:
        return description(restores=True)

    @contextmanager
    def __call__(self, _on_message: MessageHandler) -> Iterator[Wheel]:
        yield Forger(self.forged)


class Forger(Wheel):
    def __init__(self, forged: bytes) -> None:
        super().__init__("forger")
        self._forged = forged

    def advance(self, time: float, size: float) -> float:
        ends = [one for one in gc.get_objects() if isinstance(one, socket.socket) and one.fileno() >= 0]
        ends[0].sendall(self._forged)
        clock.sleep(60.0)
        return time + size


GOOD = [True, 0.1, [], []]
FORGED = {
    "half a frame": (frame(GOOD)[:-3], "not answered for 1 s"),
    "half of the lengths": (b"\x10\x00", "not answered for 1 s"),
    "a gigantic text": (struct.pack("<II", 2**32 - 1, 0) + b"[", "announces 4294967295 bytes, more than"),
    "a gigantic tail": (struct.pack("<II", 2, 2**32 - 1) + b"[]", "announces 4294967297 bytes, more than"),
    "no JSON": (frame(b"[1, 2"), "no JSON"),
    "no text": (frame(b"\xff\xfe"), "no JSON"),
    "deep nesting": (frame(b"[" * 50_000), "no JSON"),
    "a number without end": (frame(b"9" * 60_000), "no JSON"),
    "more than one value": (frame(b"[] []"), "behind the JSON"),
    "two frames": (frame(GOOD) * 2, "more behind it"),
    "no reply": (frame({"well": True}), "no reply"),
    "three parts": (frame([True, 0.1, []]), "no reply"),
    "no truth value": (frame([1, 0.1, [], []]), "no reply"),
    "a time that is a text": (frame([True, "0.1", [], []]), "type str where a number"),
    "a time that is true": (frame([True, True, [], []]), "type bool where a number"),
    "a time without end": (frame([True, 10**400, [], []]), "too large"),
    "answers that nobody wants": (frame([True, 0.1, [[True, []]], []]), "not the answers"),
    "doubles that nobody wants": (frame(GOOD, bytes(8)), "doubles"),
    "half a double": (frame(GOOD, bytes(5)), "no list of doubles"),
    "messages that are none": (frame([True, 0.1, [], "hello"]), "messages"),
    "a message without text": (frame([True, 0.1, [], [["a", 0.0, 1, "", None]]]), "NoneType where one of str"),
    "an error of another kind": (frame([False, ["SystemExit", "x", "", None, 0, []], [], []]), "refuses in a way"),
    "an error that is a text": (frame([False, "os.system", [], []]), "six parts"),
}


@pytest.mark.parametrize("kind", FORGED)
def test_a_forged_reply_is_an_error_in_time(kind: str) -> None:
    forged, said = FORGED[kind]
    with remote("forger", ForgerOpener(forged), time_limit=1.0) as forger:
        forger.initialize(0.0, 1.0)
        began = clock.monotonic()
        with pytest.raises(FmuError, match=rf"forger failed at t = 0 s \(advance\): .*{said}"):
            forger.advance(0.0, 0.1)
        assert clock.monotonic() - began < 3.0
    assert not forger.process.is_alive()


@pytest.mark.parametrize("framed", [False, True])
def test_a_pickle_runs_nothing(framed: bool, tmp_path: Path) -> None:
    witness = tmp_path / "was_here"
    pickled = pickle.dumps(Command(f"touch {witness}"))
    forged = frame(pickled) if framed else struct.pack("!i", len(pickled)) + pickled
    with remote("forger", ForgerOpener(forged), time_limit=1.0) as forger:
        forger.initialize(0.0, 1.0)
        with pytest.raises(FmuError, match="forger failed at t = 0 s"):
            forger.advance(0.0, 0.1)
    assert not witness.exists()
    pickle.loads(pickled)  # so it would have been seen
    assert witness.exists()


def test_the_deadline_is_one_for_the_whole_frame() -> None:
    """One byte after the other is no way around it."""
    here, there = socket.socketpair()
    with here, there:
        wire, parts = Wire(here), iter(frame(GOOD))
        began = clock.monotonic()

        class Dripping(socket.socket):
            def recv_into(self, room: Any, *_: Any) -> int:
                clock.sleep(0.05)
                there.send(bytes([next(parts)]))
                return super().recv_into(room)

        wire._end = Dripping(fileno=os.dup(here.fileno()))
        with wire._end, pytest.raises(LateFrameError):
            wire.receive(0.3)
        assert clock.monotonic() - began < 1.0


def test_one_that_does_not_read_is_late() -> None:
    here, there = socket.socketpair()
    with here, there, pytest.raises(LateFrameError):
        Wire(here).send("x" * 10**7, limit=0.2)


def test_what_is_too_large_is_not_sent() -> None:
    here, there = socket.socketpair()
    with here, there, pytest.raises(BrokenFrameError, match=str(MOST_BYTES)):
        Wire(here).send("", bytes(MOST_BYTES))


plain = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=6) | st.dictionaries(st.text(max_size=3), inner, max_size=3),
    max_leaves=12,
)
VARIABLES = [
    Variable(kind.lower(), k, kind, "output") for k, kind in enumerate(("Real", "Integer", "Boolean", "String"))
]


@given(plain, st.binary(max_size=40), st.sampled_from(["get", "read", "read_slopes"]))
def test_any_plain_data_is_an_answer_or_refused(data: Any, tail: bytes, kind: str) -> None:
    asked: Question = question(1, kind, VARIABLES if kind == "get" else VARIABLES[:1])
    try:
        asked.learn(data, Numbers(tail))
    except BrokenFrameError:
        return
    assert asked.answer is not None
    well, values = asked.answer
    if not well:
        assert isinstance(values, HarnessError)
    elif kind == "get":
        assert [type(value) for value in values] == [float, int, bool, str]


@given(plain)
def test_any_plain_data_is_messages_and_an_error_or_refused(data: Any) -> None:
    for read in (read_messages, read_error):
        try:
            found = read(data)
        except BrokenFrameError:
            continue
        assert isinstance(found, list | HarnessError)


@given(st.floats(), st.integers(-(2**63), 2**64 - 1), st.booleans(), st.text())
def test_values_come_as_they_went(real: float, whole: int, truth: bool, text: str) -> None:
    tail = array("d")
    values = [real, whole, truth, text]
    said = json.loads(json.dumps(packed_answer("get", Types.of(VARIABLES), values, tail)))
    found = Types.of(VARIABLES).unpacked(said, Numbers(tail.tobytes()))
    assert struct.pack("d", found[0]) == struct.pack("d", real)  # type: ignore[arg-type]
    assert found[1:] == values[1:]

"""Server of a remote component: its process answers the machine's process (`remote`) until that says "end".

A request is plain data (`wire`, `plain`) of

- orders: what is to be done first, as (name, arguments ...); no reply is sent to each of them;
- call: "enter_initialization", "exit_initialization", "advance", "terminate", "look", "end", ..., with its arguments;
- wanted: numbers of the questions that are to be answered with the reply.

A reply is (whether all went well, result or error, answers, messages); an answer is (whether it went well, values or
error). Values of Reals go as doubles in the tail of the frame, in the order in which they are mentioned. So a step
costs one request and one reply, whatever is written before it and read after it.
"""

from __future__ import annotations

import base64
import signal
import socket
from array import array
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any, Protocol

from ...errors import LogMessage
from ..description import Description
from ..instances.message_log import MessageHandler
from ..interface import Component, Reals
from ..processes import BrokenFrameError, Wire, serve_only
from .protocol import Numbers, Types, packed_answer, packed_error, packed_messages

#: (orders, call, arguments of the call, numbers of wanted answers).
Request = tuple[Sequence[tuple[Any, ...]], str, tuple[Any, ...], Sequence[int]]

#: Orders with numbers, which go in the tail.
WRITES = ("write", "write_slopes")


class Opener(Protocol):
    """Makes a component in its process; can be pickled, for the way there."""

    @property
    def description(self) -> Description:
        """Of the component: known here, and not asked of it."""

    def __call__(self, on_message: MessageHandler, /) -> AbstractContextManager[Component]:
        """A component that passes its messages to the given function."""


def serve(end: socket.socket, name: str, opener: Opener, folder: Path | None) -> None:
    """Have a component until the other side says "end", or is gone.

    Args:
        end: of the connection to the other side.
        name: of the component, for messages.
        opener: makes it.
        folder: to be removed when the other side's process was killed.
    """
    leader = serve_only(folder)
    signal.signal(signal.SIGTERM, signal.SIG_IGN)  # sent to all of a group: the one that leads ends this one
    try:
        _have_component(Wire(end), name, opener)
    except (EOFError, ConnectionError):  # the client is gone
        leader.join()


def _have_component(wire: Wire, name: str, opener: Opener) -> None:
    messages: list[LogMessage] = []
    try:
        with opener(messages.append) as component:
            _send(wire, True, None, [], messages)
            _obey(wire, _Servant(component), messages)
        _send(wire, True, None, [], messages)
    except (EOFError, ConnectionError):
        raise
    except Exception as error:
        _send(wire, False, packed_error(error, name), [], messages)


def _obey(wire: Wire, servant: _Servant, messages: list[LogMessage]) -> None:
    while True:
        (orders, call, arguments, wanted), tail = wire.receive()
        if call == "end":
            return
        try:
            numbers = Numbers(tail)
            for order, *details in orders:
                if order in WRITES:
                    number, count = details
                    details = [number, numbers.take(count)]
                getattr(servant, order)(*details)
            result = getattr(servant, call)(*arguments)
        except Exception as error:
            _send(wire, False, packed_error(error, servant.component.name), [], messages)
        else:
            answered = array("d")
            answers = [servant.answer(number, answered) for number in wanted]
            _send(wire, True, result, answers, messages, answered.tobytes())


class _Servant:
    """Does what is asked; its public methods are the orders and calls."""

    def __init__(self, component: Component) -> None:
        self.component = component
        self.set = component.set
        self.enter_initialization = component.enter_initialization
        self.exit_initialization = component.exit_initialization
        self.advance = component.advance
        self.terminate = component.terminate
        self._bound: dict[int, Reals] = {}
        self._questions: dict[int, tuple[str, Types, Callable[[], Any]]] = {}
        self._states: dict[int, Any] = {}

    def bind(self, number: int, names: Sequence[str]) -> None:
        self._bound[number] = self.component.reals(names)

    def write(self, number: int, values: Sequence[float]) -> None:
        reals = self._bound[number]
        reals.values[:] = values
        reals.write()

    def write_slopes(self, number: int, values: Sequence[float]) -> None:
        reals = self._bound[number]
        reals.values[:] = values
        reals.write_slopes()

    def save(self, number: int) -> None:
        self._states[number] = self.component.save(self._states.get(number))

    def restore(self, number: int) -> None:
        self.component.restore(self._states[number])

    def free_state(self, number: int) -> None:
        self.component.free_state(self._states.pop(number))

    def ask(self, number: int, kind: str, names: Sequence[str]) -> None:
        """Learn a question, for `answer`."""
        types = Types.of([self.component.description.variable(name) for name in names])
        if kind == "get":
            self._questions[number] = kind, types, lambda: self.component.get(names)
            return
        reals = self.component.reals(names)

        def read() -> Sequence[float]:
            reals.read()
            return reals.values

        def read_slopes() -> tuple[bool, Sequence[float]]:
            known = reals.read_slopes()
            return known, reals.values

        self._questions[number] = kind, types, read if kind == "read" else read_slopes

    def answer(self, number: int, tail: array[float]) -> tuple[bool, Any]:
        """Whether a question can be answered, and the answer, or why not: that matters to those who ask it only."""
        kind, types, find = self._questions[number]
        before = len(tail)
        try:
            return True, packed_answer(kind, types, find(), tail)
        except Exception as error:
            del tail[before:]
            return False, packed_error(error, self.component.name)

    def event(self, name: str, *arguments: Any) -> Any:
        """Something of the component's event mode."""
        return getattr(self._fmu.event_mode, name)(*arguments)

    def advance_to_event(self, time: float, size: float) -> tuple[float, bool]:
        """As `advance`, and whether there is an event."""
        return self.component.advance(time, size), self._fmu.event_mode.pending

    def reset(self) -> None:
        """As `FmuSlave.reset`."""
        self._fmu.reset()

    def serialize(self, number: int) -> str:
        """A snapshot as bytes, in base 64."""
        return base64.b64encode(self._fmu.serialize(self._states[number])).decode("ascii")

    def deserialize(self, number: int, data: str) -> None:
        """A snapshot from bytes."""
        self._states[number] = self._fmu.deserialize(base64.b64decode(data))

    @property
    def _fmu(self) -> Any:
        """The component, which must be an instance of an FMU here."""
        return self.component

    def look(self) -> None:
        """Nothing but orders and answers."""


def _send(
    wire: Wire, well: bool, result: Any, answers: Sequence[Any], messages: list[LogMessage], tail: bytes = b""
) -> None:
    said = packed_messages(messages)
    messages.clear()
    try:
        wire.send((well, result, answers, said), tail)
    except BrokenFrameError as error:
        wire.send((False, packed_error(error, "it"), [], []))

"""What a process does that has one component: it obeys the machine's process (`remote`) until that says "end".

A request is a tuple of

- orders: what is to be done first, as (name, arguments ...); nobody waits for each of them;
- call: "enter_initialization", "exit_initialization", "advance", "terminate", "look" or "end", with its arguments;
- wanted: numbers of the questions that are to be answered with the reply.

A reply is a tuple (whether all went well, result or exception, answers, messages); an answer is (whether it went well,
values or exception). So a step costs one request and one reply, whatever is written before it and read after it.
"""

from __future__ import annotations

import pickle
import signal
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from multiprocessing.connection import Connection as Pipe
from pathlib import Path
from typing import Any

from ...errors import FmuError, HarnessError
from ...fmu.slave import MessageHandler
from ...messages import LogMessage
from ...processes import serve_only
from ..component import Component, Reals

#: Makes a component that tells its messages to the given function; can be pickled.
Opener = Callable[[MessageHandler], AbstractContextManager[Component]]

#: (orders, call, arguments of the call, numbers of wanted answers).
Request = tuple[Sequence[tuple[Any, ...]], str, tuple[Any, ...], Sequence[int]]


def serve(pipe: Pipe, name: str, opener: Opener, folder: Path | None) -> None:
    """Have a component until the other side says "end", or is gone.

    Args:
        pipe: to the other side.
        name: of the component, for messages.
        opener: makes it.
        folder: to be removed when the other side's process was killed.
    """
    end = serve_only(folder)
    signal.signal(signal.SIGTERM, signal.SIG_IGN)  # sent to all of a group: the one that leads ends this one
    try:
        _have_component(pipe, name, opener)
    except (EOFError, ConnectionError):  # nobody is there any more
        end.join()


def _have_component(pipe: Pipe, name: str, opener: Opener) -> None:
    messages: list[LogMessage] = []
    try:
        with opener(messages.append) as component:
            _send(pipe, True, component.description, [], messages)
            _obey(pipe, _Servant(component), messages)
        _send(pipe, True, None, [], messages)
    except (EOFError, ConnectionError):
        raise
    except Exception as error:
        _send(pipe, False, _told(error, name), [], messages)


def _obey(pipe: Pipe, servant: _Servant, messages: list[LogMessage]) -> None:
    while True:
        orders, call, arguments, wanted = pickle.loads(pipe.recv_bytes())
        if call == "end":
            return
        try:
            for order, *details in orders:
                getattr(servant, order)(*details)
            result = getattr(servant, call)(*arguments)
        except Exception as error:
            _send(pipe, False, _told(error, servant.component.name), [], messages)
        else:
            _send(pipe, True, result, [servant.answer(number) for number in wanted], messages)


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
        self._questions: dict[int, Callable[[], Any]] = {}
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
        if kind == "get":
            self._questions[number] = lambda: self.component.get(names)
            return
        reals = self.component.reals(names)

        def read() -> list[float]:
            reals.read()
            return list(reals.values)

        def read_slopes() -> tuple[bool, list[float]]:
            told = reals.read_slopes()
            return told, list(reals.values)

        self._questions[number] = read if kind == "read" else read_slopes

    def answer(self, number: int) -> tuple[bool, Any]:
        """Whether a question can be answered, and the answer, or why not: that matters to those who ask it only."""
        try:
            return True, self._questions[number]()
        except Exception as error:
            return False, _told(error, self.component.name)

    def look(self) -> None:
        """Nothing but orders and answers."""


def _told(error: Exception, name: str) -> HarnessError:
    """What the other side can raise in its turn."""
    if isinstance(error, HarnessError):
        return error
    return FmuError(f"{name} failed in its process: {type(error).__name__}: {error}", instance=name)


def _send(pipe: Pipe, well: bool, result: Any, answers: Sequence[Any], messages: list[LogMessage]) -> None:
    said = tuple(messages)
    messages.clear()
    pipe.send_bytes(pickle.dumps((well, result, answers, said), pickle.HIGHEST_PROTOCOL))

"""The pipe to the process of a component: requests go, replies come, and its trouble is told."""

from __future__ import annotations

import pickle
import signal
from collections.abc import Sequence
from multiprocessing.connection import Connection as Pipe
from multiprocessing.process import BaseProcess
from typing import Any

from ...errors import FmuError, HarnessError
from ...fmu.slave import MessageHandler
from ...messages import LogMessage, Status
from .far_side import Request

#: How long a process has for its end [s].
_PATIENCE = 5.0


class Link:
    """The near side of the pipe.

    Attributes:
        name: of the part.
        process: its process.
        messages: everything the component has said so far.
        time: of the step that the component is in [s]; None before the first.
    """

    def __init__(self, name: str, process: BaseProcess, pipe: Pipe, on_message: MessageHandler) -> None:
        """`on_message` receives each message with the reply that brings it."""
        self.name = name
        self.process = process
        self.messages: list[LogMessage] = []
        self.time: float | None = None
        self._pipe = pipe
        self._on_message = on_message

    def ask(self, request: Request, limit: float) -> tuple[Any, Sequence[tuple[bool, Any]]]:
        """Send a request and wait for the reply, up to `limit` [s].

        Returns:
            The result of the call, and an answer for each wanted one: (whether there is one, values or exception).

        Raises:
            HarnessError: the component refuses.
            FmuError: there is no reply in time (the process is then ended), or the process has ended.
        """
        self.send(request)
        return self.receive(request[1], limit)

    def send(self, request: Request) -> None:
        """The first half of `ask`."""
        try:
            self._pipe.send_bytes(pickle.dumps(request, pickle.HIGHEST_PROTOCOL))
        except OSError:
            raise self._gone(request[1]) from None

    def receive(self, call: str, limit: float) -> tuple[Any, Sequence[tuple[bool, Any]]]:
        """The other half; the first reply comes unasked: the component's description."""
        try:
            if not self._pipe.poll(limit):
                self.process.kill()
                raise self._error(call, f"it has not answered for {limit:g} s, the time limit; its process was ended.")
            well, result, answers, messages = pickle.loads(self._pipe.recv_bytes())
        except (EOFError, OSError):
            raise self._gone(call) from None
        for message in messages:
            self.messages.append(message)
            self._on_message(message)
        if not well:
            raise result
        return result, answers

    def end(self) -> None:
        """Let the component be freed and the process end; one that does not is left to be killed."""
        try:
            self.ask(((), "end", (), ()), _PATIENCE)
        except HarnessError:
            return  # it comes too late to matter
        self.process.join(_PATIENCE)

    def _gone(self, call: str) -> FmuError:
        self.process.join(_PATIENCE)
        code = self.process.exitcode
        how = "ended" if code is None else f"ended with exit code {code}"
        if code is not None and code < 0:
            how = f"was ended by {_signal(-code)}"
        return self._error(call, f"its process {how}: it crashed, or somebody killed it.")

    def _error(self, call: str, problem: str) -> FmuError:
        where = "before the first step" if self.time is None else f"at t = {self.time:.9g} s"
        text = f"{self.name} failed {where} ({call}): {problem}"
        return FmuError(text, instance=self.name, time=self.time, status=Status.FATAL)


def _signal(number: int) -> str:
    try:
        return f"the signal {signal.Signals(number).name}"
    except ValueError:
        return f"signal {number}"

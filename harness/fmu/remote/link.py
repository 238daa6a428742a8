"""Connection to the process of a component: requests go, replies come, and its failures are reported."""

from __future__ import annotations

import signal
from array import array
from collections.abc import Sequence
from multiprocessing.process import BaseProcess
from typing import Any

from ...errors import FmuError, HarnessError, LogMessage, Status
from ..instances.message_log import MessageHandler
from ..processes import BrokenFrameError, LateFrameError, Wire
from .far_side import WRITES, Request
from .protocol import Numbers, Question, read_error, read_messages

#: How long a process has for its end [s].
_PATIENCE = 5.0


class Link:
    """The client's end of the connection.

    Attributes:
        name: of the part.
        process: its process.
        messages: everything the component has said so far.
        time: of the step that the component is in [s]; None before the first.
    """

    def __init__(self, name: str, process: BaseProcess, wire: Wire, on_message: MessageHandler) -> None:
        """`on_message` receives each message with the reply that brings it."""
        self.name = name
        self.process = process
        self.messages: list[LogMessage] = []
        self.time: float | None = None
        self._wire = wire
        self._on_message = on_message

    def ask(self, request: Request, limit: float, wanted: Sequence[Question] = ()) -> Any:
        """Send a request and wait for the reply, up to `limit` [s] for the whole of it.

        Args:
            request: it.
            limit: [s].
            wanted: the questions whose numbers are in the request; they learn their answers.

        Returns:
            The result of the call, as plain data.

        Raises:
            HarnessError: the component refuses.
            FmuError: there is no reply in time, or one that is none (the process is then ended), or the process has
                ended.
        """
        self.send(request, limit)
        return self.receive(request[1], limit, wanted)

    def send(self, request: Request, limit: float = _PATIENCE) -> None:
        """The first half of `ask`."""
        orders, call, arguments, wanted = request
        tail = array("d")
        plain: list[Sequence[Any]] = []
        for order in orders:
            if order[0] in WRITES:
                tail.extend(order[2])
                plain.append((*order[:2], len(order[2])))
            else:
                plain.append(order)
        try:
            self._wire.send((plain, call, arguments, wanted), tail.tobytes(), limit)
        except LateFrameError:
            raise self._late(call, limit) from None
        except BrokenFrameError as error:
            raise self._error(call, f"what is to be sent cannot be: {error}.") from None
        except OSError:
            raise self._gone(call) from None

    def receive(self, call: str, limit: float, wanted: Sequence[Question] = ()) -> Any:
        """The other half; the first reply comes unasked, when the component is there."""
        try:
            data, tail = self._wire.receive(limit)
            if type(data) is not list or len(data) != 4 or type(data[0]) is not bool:
                raise BrokenFrameError("it is no reply")
            well, result, answers, messages = data
            said, numbers = read_messages(messages), Numbers(tail)
            if type(answers) is not list or len(answers) != (len(wanted) if well else 0):
                raise BrokenFrameError("it has not the answers that were asked for")
            for place, answer in enumerate(answers):
                wanted[place].learn(answer, numbers)
            numbers.finish()
            refused = None if well else read_error(result)
        except LateFrameError:
            raise self._late(call, limit) from None
        except BrokenFrameError as error:
            self.process.kill()
            raise self._error(call, f"its process has sent what is no reply: {error}; it was ended.") from None
        except (EOFError, OSError):
            raise self._gone(call) from None
        for message in said:
            self.messages.append(message)
            self._on_message(message)
        if refused is not None:
            raise refused
        return result

    def broken(self, call: str, problem: str) -> FmuError:
        """What to raise for a result of a call that cannot be; the process is ended."""
        self.process.kill()
        return self._error(call, f"its process has sent what is no reply: {problem}; it was ended.")

    def end(self) -> None:
        """Let the component be freed and the process end; one that does not is left to be killed."""
        try:
            self.ask(((), "end", (), ()), _PATIENCE)
        except HarnessError:
            return  # it comes too late to matter
        self.process.join(_PATIENCE)

    def _late(self, call: str, limit: float) -> FmuError:
        self.process.kill()
        return self._error(call, f"it has not answered for {limit:g} s, the time limit; its process was ended.")

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

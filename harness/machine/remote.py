"""A component in a process of its own: what crashes or hangs there ends the run here, and names do not clash.

Two FMUs of pythonfmu whose scripts have the same name, for instance, cannot be in one process.
"""

from __future__ import annotations

import pickle
import signal
from collections.abc import Collection, Iterator, Mapping, MutableSequence, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing.connection import Connection as Pipe
from multiprocessing.process import BaseProcess
from pathlib import Path
from typing import Any

from ..description import Description, Value, Variable
from ..errors import FmuError, HarnessError
from ..fmu import Fmu
from ..fmu.slave import MessageHandler, discard_message
from ..messages import LogMessage, Status
from ..processes import starting_from
from . import far_side
from .far_side import Opener

#: How long a call may take [s].
TIME_LIMIT = 60.0

#: So many times longer may the start and the initialization take: an engine may be compiled.
_START = 10.0

#: How long a process has for its end [s].
_PATIENCE = 5.0


@contextmanager
def in_own_process(
    fmu: Fmu,
    name: str,
    on_message: MessageHandler = discard_message,
    time_limit: float = TIME_LIMIT,
    early_return: bool = False,
) -> Iterator[RemoteComponent]:
    """A new instance of an FMU in a new process; both are ended afterwards.

    Args:
        fmu: extracted; both processes read its folder.
        name: of the part.
        on_message: receives its messages.
        time_limit: of a call [s].
        early_return: as in `Fmu.instantiate`.

    Raises:
        FmuError: the library cannot be loaded, the FMU refuses, or the process ends.
    """
    opener = _FmuOpener(fmu, name, early_return)
    with remote(name, opener, on_message, time_limit, fmu.folder) as component:
        yield component


@dataclass(frozen=True)
class _FmuOpener:
    """How the other process makes an instance of an FMU that this one has extracted."""

    fmu: Fmu
    name: str
    early_return: bool

    def __call__(self, on_message: MessageHandler) -> Any:
        return self.fmu.instantiate(self.name, on_message, self.early_return)


@contextmanager
def remote(
    name: str,
    opener: Opener,
    on_message: MessageHandler = discard_message,
    time_limit: float = TIME_LIMIT,
    folder: Path | None = None,
) -> Iterator[RemoteComponent]:
    """A component in a new process, which ends afterwards.

    Args:
        name: of the part.
        opener: makes the component there; must be such that it can be pickled.
        on_message: receives its messages, with the reply to the call during which they came.
        time_limit: of a call [s]; ten times as much for the start and the initialization.
        folder: that the component lives in; the process removes it when this one is killed.

    Raises:
        FmuError: the component cannot be made, or the process ends.
    """
    context = starting_from(far_side.__name__)
    here, there = context.Pipe()
    process = context.Process(target=far_side.serve, args=(there, name, opener, folder), name=name, daemon=True)  # type: ignore[attr-defined]
    try:
        process.start()
        there.close()  # so that the end of the process is the end of the pipe
        component = RemoteComponent(name, process, here, on_message, time_limit)
        try:
            yield component
        finally:
            component.end()
    finally:
        if process.is_alive():
            process.kill()
            process.join()
        here.close()


class _Question:
    """Something to be read, with the answer as long as that holds.

    Attributes:
        number: by which the other side knows it.
        of_slopes: whether slopes of inputs change the answer, too.
        follows: variables whose setting changes the answer; None: any may.
        answer: (whether it could be answered, values or exception); None: it must be asked for.
    """

    def __init__(self, number: int, of_slopes: bool, follows: frozenset[str] | None) -> None:
        self.number = number
        self.of_slopes = of_slopes
        self.follows = follows
        self.answer: tuple[bool, Any] | None = None


class RemoteComponent:
    """The near side of a component in another process (a `component.Component`).

    What is written, saved or restored goes with the next call that needs a reply. What was read after one step is
    answered at once with the next step, without being asked for. So a step costs one round trip. A refusal of what
    was written is therefore told with the step.

    Attributes:
        description: of the component.
        name: of the part.
        messages: everything the component has said so far.
        process: its process.
    """

    def __init__(
        self, name: str, process: BaseProcess, pipe: Pipe, on_message: MessageHandler, time_limit: float
    ) -> None:
        """Wait for the component."""
        self.name = name
        self.process = process
        self.messages: list[LogMessage] = []
        self._pipe = pipe
        self._on_message = on_message
        self._limit = time_limit
        self._start = 0.0
        self._time: float | None = None
        self._orders: list[tuple[Any, ...]] = []
        self._questions: dict[tuple[str, tuple[str, ...]], _Question] = {}
        self._asked: dict[_Question, None] = {}
        self._asked_before: dict[_Question, None] = {}
        self._numbers = 0
        self.description: Description = self._receive("start", _START * time_limit)[0]

    def reals(self, names: Sequence[str]) -> RemoteReals:
        """Bind Real variables."""
        return RemoteReals(self, tuple(names))

    def set(self, values: Mapping[str, Value]) -> None:
        """Set variables by name, before the next call."""
        self.order("set", dict(values))
        self._forget(values if self._initialized else None)

    def set_slopes(self, slopes: Mapping[str, float]) -> None:
        """Let inputs change linearly in the next step."""
        self.order("set_slopes", dict(slopes))
        self._forget_slopes()

    def get(self, names: Sequence[str]) -> list[Value]:
        """Values of variables, in the order of `names`."""
        values: list[Value] = self.answer(self.question("get", tuple(names)))
        return list(values)

    def initialize(self, start_time: float, stop_time: float) -> None:
        """Go through the initialization mode."""
        self.enter_initialization(start_time, stop_time)
        self.exit_initialization()

    def enter_initialization(self, start_time: float, stop_time: float) -> None:
        """The first half of it."""
        self._call("enter_initialization", (start_time, stop_time), _START * self._limit)
        self._start = start_time

    def exit_initialization(self) -> None:
        """The other half."""
        self._call("exit_initialization", (), _START * self._limit)
        self._time = self._start

    def step(self, time: float, size: float) -> None:
        """Advance by `size` [s] from `time`, however often the component returns early."""
        reached, end = time, time + size
        while reached < end:
            reached = self.advance(reached, end - reached)

    def advance(self, time: float, size: float) -> float:
        """As `step`, but the component may return early; the time reached [s]."""
        self._time = time
        self._asked_before, self._asked = self._asked, {}
        reached: float = self._call("advance", (time, size), self._limit, tuple(self._asked_before))
        return reached

    def terminate(self) -> None:
        """End the run."""
        self._call("terminate", (), self._limit)

    def save(self, state: Any = None) -> Any:
        """A snapshot, which stays in the other process; what is returned stands for it."""
        number = self.number() if state is None else state
        self.order("save", number)
        return number

    def restore(self, state: Any) -> None:
        """Be again as when the snapshot was taken."""
        self.order("restore", state)
        self._forget()

    def free_state(self, state: Any) -> None:
        """Release a snapshot."""
        self.order("free_state", state)

    def number(self) -> int:
        """One by which both sides know something."""
        self._numbers += 1
        return self._numbers

    def order(self, name: str, *arguments: Any) -> None:
        """Have something done before the next call."""
        self._orders.append((name, *arguments))

    def bind(self, names: tuple[str, ...]) -> int:
        """A number for variables that are to be written."""
        number = self.number()
        self.order("bind", number, names)
        return number

    def write(self, number: int, names: tuple[str, ...], values: list[float]) -> None:
        """Set bound variables before the next call."""
        self.order("write", number, values)
        self._forget(names if self._initialized else None)

    def write_slopes(self, number: int, slopes: list[float]) -> None:
        """Let bound inputs change linearly in the next step."""
        self.order("write_slopes", number, slopes)
        self._forget_slopes()

    def question(self, kind: str, names: tuple[str, ...]) -> _Question:
        """What can be asked: "get", "read" or "read_slopes" of some variables."""
        if (kind, names) not in self._questions:
            variables = [self.description.variable(name) for name in names]
            of_slopes = kind == "read_slopes"
            question = _Question(self.number(), of_slopes, None if of_slopes else _follows(variables))
            self.order("ask", question.number, kind, names)
            self._questions[kind, names] = question
        return self._questions[kind, names]

    def answer(self, question: _Question) -> Any:
        """The answer of now.

        Raises:
            FmuError: there is none.
        """
        self._asked[question] = None
        if question.answer is None:
            likely = self._asked_before | self._asked
            limit = self._limit if self._initialized else _START * self._limit
            self._call("look", (), limit, tuple(q for q in likely if q.answer is None), keeps=True)
        assert question.answer is not None
        well, values = question.answer
        if not well:
            raise values
        return values

    def end(self) -> None:
        """Let the component be freed and the process end; one that does not is left to be killed."""
        try:
            self._send("end", (), ())
            self._receive("end", _PATIENCE)
        except HarnessError:
            return  # it comes too late to matter
        self.process.join(_PATIENCE)

    def _call(
        self,
        call: str,
        arguments: tuple[Any, ...],
        limit: float,
        wanted: tuple[_Question, ...] = (),
        *,
        keeps: bool = False,
    ) -> Any:
        """Have a call done, and the answers to questions; but for calls that keep everything, others hold no more."""
        if not keeps:
            self._forget()
        self._send(call, arguments, [question.number for question in wanted])
        result, answers = self._receive(call, limit)
        for question, answer in zip(wanted, answers, strict=True):
            question.answer = answer
        return result

    @property
    def _initialized(self) -> bool:
        """Until then, outputs may follow all that is set: a state starts where an input is."""
        return self._time is not None

    def _forget(self, changed: Collection[str] | None = None) -> None:
        """Answers do not hold any more when variables have changed; None: all may have."""
        for question in self._questions.values():
            if changed is None or question.follows is None or not question.follows.isdisjoint(changed):
                question.answer = None

    def _forget_slopes(self) -> None:
        for question in self._questions.values():
            if question.of_slopes:
                question.answer = None

    def _send(self, call: str, arguments: tuple[Any, ...], wanted: Sequence[int]) -> None:
        orders, self._orders = self._orders, []
        try:
            self._pipe.send_bytes(pickle.dumps((orders, call, arguments, wanted), pickle.HIGHEST_PROTOCOL))
        except OSError:
            raise self._gone(call) from None

    def _receive(self, call: str, limit: float) -> tuple[Any, Sequence[tuple[bool, Any]]]:
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

    def _gone(self, call: str) -> FmuError:
        self.process.join(_PATIENCE)
        code = self.process.exitcode
        how = "ended" if code is None else f"ended with exit code {code}"
        if code is not None and code < 0:
            how = f"was ended by {_signal(-code)}"
        return self._error(call, f"its process {how}: it crashed, or somebody killed it.")

    def _error(self, call: str, problem: str) -> FmuError:
        where = "before the first step" if self._time is None else f"at t = {self._time:.9g} s"
        text = f"{self.name} failed {where} ({call}): {problem}"
        return FmuError(text, instance=self.name, time=self._time, status=Status.FATAL)


class RemoteReals:
    """Real variables of a component in another process (a `component.Reals`)."""

    def __init__(self, component: RemoteComponent, names: tuple[str, ...]) -> None:
        self.values: MutableSequence[float] = [0.0] * len(names)
        self._component, self._names = component, names
        self._number = 0

    def read(self) -> None:
        """Fill `values` with those of now."""
        self.values[:] = self._component.answer(self._component.question("read", self._names))

    def read_slopes(self) -> bool:
        """Fill `values` with derivatives of outputs [unit/s]; False where the component does not tell some of them."""
        told, slopes = self._component.answer(self._component.question("read_slopes", self._names))
        self.values[:] = slopes
        return bool(told)

    def write(self) -> None:
        """Set the variables to `values`, before the next call."""
        if self._names:
            self._component.write(self._bound(), self._names, list(self.values))

    def write_slopes(self) -> None:
        """Let inputs change by `values` [unit/s] in the next step."""
        if self._names:
            self._component.write_slopes(self._bound(), list(self.values))

    def _bound(self) -> int:
        if not self._number:
            self._number = self._component.bind(self._names)
        return self._number


def _follows(variables: Sequence[Variable]) -> frozenset[str] | None:
    """The variables whose setting changes some of these; None: nobody says, so any may."""
    names: set[str] = set()
    for variable in variables:
        if variable.settable:
            names.add(variable.name)
        elif variable.causality == "output" and variable.depends_on is not None:
            names |= variable.depends_on
        else:
            return None
    return frozenset(names)


def _signal(number: int) -> str:
    try:
        return f"the signal {signal.Signals(number).name}"
    except ValueError:
        return f"signal {number}"

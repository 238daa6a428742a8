"""Client (proxy) of a component in another process, with as few round trips as can be: one a step."""

from __future__ import annotations

import base64
from collections.abc import Collection, Mapping, MutableSequence, Sequence
from itertools import count
from typing import Any

from ...errors import LogMessage
from ..description import Description, Value
from ..interface import whole_step
from ..processes import BrokenFrameError
from .link import Link
from .protocol import Question, number, question

# Calls of a component in another process, with as few round trips as can be: one a step.

#: So many times longer may the start and the initialization take: an engine may be compiled.
_START = 10.0


class RoundTrips:
    """What is sent to a component, and what is known of it here.

    Orders go with the next call, which waits for a reply. What was read after one step is answered at once with the
    next, without being asked for.

    Attributes:
        description: of the component.
    """

    def __init__(self, link: Link, description: Description, time_limit: float) -> None:
        """Wait for the component; `time_limit` of a call [s]."""
        self._link = link
        self._limit = time_limit
        self._orders: list[tuple[Any, ...]] = []
        self._questions: dict[tuple[str, tuple[str, ...]], Question] = {}
        self._asked: dict[Question, None] = {}
        self._asked_before: dict[Question, None] = {}
        self._numbers = count(1)
        self.description = description
        link.receive("start", self._patience)

    def number(self) -> int:
        """A new one, by which both sides know something."""
        return next(self._numbers)

    def order(self, name: str, *arguments: Any) -> None:
        """Have something done before the next call."""
        self._orders.append((name, *arguments))

    def changed(self, names: Collection[str] | None) -> None:
        """The orders change some variables, or all (None): answers that follow them do not hold any more.

        Before the first step, no answer does: a state starts where an input is.
        """
        for asked in self._questions.values():
            asked.forget(None if self._link.time is None else names)

    def slopes_changed(self) -> None:
        """Slopes of inputs are changed by the orders."""
        for asked in self._questions.values():
            if asked.of_slopes:
                asked.answer = None

    def call(self, name: str, *arguments: Any) -> Any:
        """Have something done that changes all variables, and wait for what it returns."""
        self.changed(None)
        return self._call(name, arguments, ())

    def step(self, name: str, time: float, size: float) -> Any:
        """As `call`, of a step from `time` [s]; what was asked since the last one is answered at once."""
        self._link.time = time
        self._asked_before, self._asked = self._asked, {}
        self.changed(None)
        return self._call(name, (time, size), tuple(self._asked_before))

    def ask(self, kind: str, names: tuple[str, ...]) -> Any:
        """The answer of now, to "get", "read" or "read_slopes" of some variables.

        Raises:
            HarnessError: there is none.
        """
        asked = self._question(kind, names)
        self._asked[asked] = None
        if asked.answer is None:
            likely = self._asked_before | self._asked
            self._call("look", (), tuple(q for q in likely if q.answer is None))
        assert asked.answer is not None
        well, values = asked.answer
        if not well:
            raise values
        return values

    @property
    def _patience(self) -> float:
        return self._limit if self._link.time is not None else _START * self._limit

    def _call(self, name: str, arguments: tuple[Any, ...], wanted: tuple[Question, ...]) -> Any:
        orders, self._orders = self._orders, []
        request = orders, name, arguments, [q.number for q in wanted]
        return self._link.ask(request, self._patience, wanted)

    def _question(self, kind: str, names: tuple[str, ...]) -> Question:
        if (kind, names) not in self._questions:
            variables = [self.description.variable(name) for name in names]
            asked = question(self.number(), kind, variables)
            self.order("ask", asked.number, kind, names)
            self._questions[kind, names] = asked
        return self._questions[kind, names]


# Real variables of a component in another process.


class RemoteReals:
    """Some of them, bound once (a `machine.component.Reals`)."""

    def __init__(self, trips: RoundTrips, names: tuple[str, ...]) -> None:
        self.values: MutableSequence[float] = [0.0] * len(names)
        self._trips, self._names = trips, names
        self._number = 0

    def read(self) -> None:
        """Fill `values` with those of now."""
        self.values[:] = self._trips.ask("read", self._names)

    def read_slopes(self) -> bool:
        """Fill `values` with derivatives of outputs [unit/s]; False where some of them are not returned."""
        known, slopes = self._trips.ask("read_slopes", self._names)
        self.values[:] = slopes
        return bool(known)

    def write(self) -> None:
        """Set the variables to `values`, before the next call."""
        if self._names:
            self._trips.order("write", self._bound(), list(self.values))
            self._trips.changed(self._names)

    def write_slopes(self) -> None:
        """Let inputs change by `values` [unit/s] in the next step."""
        if self._names:
            self._trips.order("write_slopes", self._bound(), list(self.values))
            self._trips.slopes_changed()

    def _bound(self) -> int:
        """By what the other side knows them; only those that are written need it."""
        if not self._number:
            self._number = self._trips.number()
            self._trips.order("bind", self._number, self._names)
        return self._number


# The event mode of a component in another process.


class RemoteEventMode:
    """What a machine has of it (a `machine.events.EventMode`).

    Attributes:
        pending: whether there is an event that is not yet handled.
    """

    def __init__(self, link: Link, trips: RoundTrips) -> None:
        self._link = link
        self._trips = trips
        self.pending = False

    def advance(self, time: float, size: float) -> float:
        """Take a step as `RemoteComponent.advance`, and learn whether it ended with an event."""
        reply = self._trips.step("advance_to_event", time, size)
        try:
            if type(reply) is not list or len(reply) != 2 or type(reply[1]) is not bool:
                raise BrokenFrameError("it does not say where its step has ended, and whether with an event")
            reached = number(reply[0])
        except BrokenFrameError as error:
            raise self._link.broken("advance", str(error)) from None
        self.pending = reply[1]
        return reached

    def share(self) -> None:
        """Leave events to the machine."""
        self._trips.order("event", "share")

    def enter(self) -> None:
        """Enter it."""
        self._order("enter")

    def update(self) -> bool:
        """Update the discrete states; whether one more update is needed."""
        again = self._trips.call("event", "update")
        if type(again) is not bool:
            raise self._link.broken("update", "it does not say whether it needs one more update")
        return again

    def leave(self) -> None:
        """Go back to the step mode."""
        self._order("leave")
        self.pending = False

    def active(self, clocks: Sequence[str]) -> list[str]:
        """Which of some output clocks tick now."""
        if not clocks:
            return []
        reply = self._trips.call("event", "active", list(clocks))
        if type(reply) is not list or not set(map(str, reply)) <= set(clocks):
            raise self._link.broken("active", "it names clocks that were not asked for")
        return [clock for clock in clocks if clock in reply]

    def activate(self, clocks: Sequence[str]) -> None:
        """Let input clocks tick."""
        self._order("activate", list(clocks))

    def _order(self, name: str, *arguments: list[str]) -> None:
        self._trips.order("event", name, *arguments)
        self._trips.changed(None)


class RemoteComponent:
    """Client (proxy) of a remote component (an `interface.Component`).

    What is written, saved or restored goes with the next call that needs a reply; a refusal of it is therefore raised
    by that call.

    Attributes:
        description: of the component.
        name: of the part.
        messages: everything the component has said so far.
        process: its process.
        event_mode: None where it is not used.
    """

    def __init__(self, link: Link, description: Description, time_limit: float, has_event_mode: bool = False) -> None:
        """Wait for the component, which uses its event mode or not; `time_limit` of a call [s].

        Raises:
            FmuError: it cannot be made, or its process ends.
        """
        self.name = link.name
        self.process = link.process
        self.messages: list[LogMessage] = link.messages
        self._link = link
        self.description = description
        self._trips = RoundTrips(link, description, time_limit)
        self._start = 0.0
        self.event_mode = RemoteEventMode(link, self._trips) if has_event_mode else None

    def reals(self, names: Sequence[str]) -> RemoteReals:
        """Bind Real variables."""
        return RemoteReals(self._trips, tuple(names))

    def set(self, values: Mapping[str, Value]) -> None:
        """Set variables by name, before the next call."""
        self._trips.order("set", dict(values))
        by_event = self.event_mode is not None and self._link.time is not None
        if by_event and not all(self.description.variable(name).continuous for name in values):
            self._trips.changed(None)
            self.event_mode.pending = True  # type: ignore[union-attr]
        else:
            self._trips.changed(values)

    def get(self, names: Sequence[str]) -> list[Value]:
        """Values of variables, in the order of `names`."""
        return list(self._trips.ask("get", tuple(names)))

    def initialize(self, start_time: float, stop_time: float) -> None:
        """Go through the initialization mode."""
        self.enter_initialization(start_time, stop_time)
        self.exit_initialization()

    def enter_initialization(self, start_time: float, stop_time: float) -> None:
        """The first half of it."""
        self._trips.call("enter_initialization", start_time, stop_time)
        self._start = start_time

    def exit_initialization(self) -> None:
        """The other half."""
        self._trips.call("exit_initialization")
        self._link.time = self._start
        if self.event_mode is not None:
            self.event_mode.pending = True

    def step(self, time: float, size: float) -> None:
        """Advance by `size` [s] from `time`, however often the component returns early."""
        whole_step(self.advance, time, size)

    def advance(self, time: float, size: float) -> float:
        """As `step`, but the component may return early; the time reached [s]."""
        if self.event_mode is not None:
            return self.event_mode.advance(time, size)
        reached = self._trips.step("advance", time, size)
        try:
            return number(reached)
        except BrokenFrameError as error:
            raise self._link.broken("advance", str(error)) from None

    def terminate(self) -> None:
        """End the run."""
        self._trips.call("terminate")

    def save(self, state: Any = None) -> Any:
        """A snapshot, which stays in the other process; what is returned stands for it."""
        number = self._trips.number() if state is None else state
        self._trips.order("save", number)
        return number

    def restore(self, state: Any) -> None:
        """Be again as when the snapshot was taken."""
        self._trips.order("restore", state)
        self._trips.changed(None)
        if self.event_mode is not None:
            self.event_mode.pending = False  # a machine takes snapshots where nothing is

    def free_state(self, state: Any) -> None:
        """Release a snapshot."""
        self._trips.order("free_state", state)

    def reset(self) -> None:
        """Be as just after the instantiation (FMUs only)."""
        self._link.time = None
        self._trips.call("reset")

    def serialize(self, state: Any) -> bytes:
        """A snapshot as bytes (FMUs only)."""
        try:
            return base64.b64decode(self._trips.call("serialize", state), validate=True)
        except (TypeError, ValueError) as error:
            raise self._link.broken("serialize", f"a state that is none ({error})") from None

    def deserialize(self, data: bytes) -> Any:
        """A snapshot from bytes (FMUs only)."""
        number = self._trips.number()
        self._trips.call("deserialize", number, base64.b64encode(data).decode("ascii"))
        return number

"""What a machine has of a component in another process."""

from __future__ import annotations

import base64
from collections.abc import Mapping, Sequence
from typing import Any

from ...description import Description, Value
from ...messages import LogMessage
from ...slave import whole_step
from ...wire import BrokenFrameError
from .event_mode import RemoteEventMode
from .link import Link
from .plain import number
from .reals import RemoteReals
from .round_trips import RoundTrips


class RemoteComponent:
    """The near side of it (a `machine.component.Component`).

    What is written, saved or restored goes with the next call that needs a reply; a refusal of it is therefore told
    with that call.

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

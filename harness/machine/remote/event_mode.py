"""The event mode of a component in another process."""

from __future__ import annotations

from collections.abc import Sequence

from ...wire import BrokenFrameError
from .link import Link
from .plain import number
from .round_trips import RoundTrips


class RemoteEventMode:
    """What a machine has of it (a `machine.events.EventMode`).

    Attributes:
        pending: whether there is an event that nobody has handled.
    """

    def __init__(self, link: Link, trips: RoundTrips) -> None:
        self._link = link
        self._trips = trips
        self.pending = False

    def advance(self, time: float, size: float) -> float:
        """Take a step as `RemoteComponent.advance`, and learn whether it ended with an event."""
        told = self._trips.step("advance_to_event", time, size)
        try:
            if type(told) is not list or len(told) != 2 or type(told[1]) is not bool:
                raise BrokenFrameError("it does not say where its step has ended, and whether with an event")
            reached = number(told[0])
        except BrokenFrameError as error:
            raise self._link.broken("advance", str(error)) from None
        self.pending = told[1]
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
        told = self._trips.call("event", "active", list(clocks))
        if type(told) is not list or not set(map(str, told)) <= set(clocks):
            raise self._link.broken("active", "it names clocks that were not asked for")
        return [clock for clock in clocks if clock in told]

    def activate(self, clocks: Sequence[str]) -> None:
        """Let input clocks tick."""
        self._order("activate", list(clocks))

    def _order(self, name: str, *arguments: list[str]) -> None:
        self._trips.order("event", name, *arguments)
        self._trips.changed(None)

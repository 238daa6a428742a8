"""The event mode of an instance of FMI 3.0: who handles an event, and when (FMI 3.0, section 4.2.1)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Protocol

from ..description import Description
from ..errors import FmuError

#: So often an FMU may ask for one more update of its discrete states.
MOST_UPDATES = 1000
#: So near to an announced event is at it [s].
_AT_IT = 1e-9


def uses_event_mode(description: Description, early_return: bool) -> bool:
    """Whether instances use it: FMUs with clocks must, others only to end steps at their own events."""
    return description.has_event_mode and (early_return or description.has_clocks)


class Owner(Protocol):
    """The instance whose event mode it is."""

    @property
    def description(self) -> Description:
        """What the FMU says about itself."""

    def call(self, name: str, *arguments: Any) -> Any:
        """Call a function "fmi3<Name>" by way of fmpy."""

    def failure(self, function: str, reason: str) -> FmuError:
        """What to raise for an answer that cannot be used."""


class EventMode:
    """Of one instance (a `machine.events.EventMode`).

    An event is handled when it happens, unless the mode is shared: then the machine does it, among all its components,
    and the instance only if it is to go on before that.

    Attributes:
        shared: whether a machine handles events.
        pending: whether there is one that nobody has handled.
        inside: whether the instance is in event mode.
        announced: when the FMU wants event mode next [s]; None: it has not said so (nextEventTime).
    """

    def __init__(self, owner: Owner) -> None:
        self._owner = owner
        self.shared = self.pending = self.inside = False
        self.announced: float | None = None

    def share(self) -> None:
        """Leave events to a machine."""
        self.shared = True

    def forget(self) -> None:
        """The instance is as it was instantiated."""
        self.pending = self.inside = False
        self.announced = None

    def memory(self) -> tuple[bool, bool, float | None]:
        """What a snapshot of the instance needs."""
        return self.pending, self.inside, self.announced

    def remember(self, memory: tuple[bool, bool, float | None]) -> None:
        """The instance is as it was then."""
        self.pending, self.inside, self.announced = memory

    def size_to(self, begin: float, size: float) -> float:
        """The part of a step that goes to the announced event, or the whole of it where none is inside [s]."""
        if self.announced is not None and begin < self.announced < begin + size - _AT_IT:
            return self.announced - begin
        return size

    def reached(self, time: float, by_itself: bool) -> None:
        """A step has ended at `time` [s]: handle the event that the FMU has said is there, or had announced."""
        if by_itself or (self.announced is not None and time >= self.announced - _AT_IT):
            self.happened()

    def begun(self) -> None:
        """The instance has left the initialization mode, and is in event mode."""
        self.inside = True
        self.happened()

    def happened(self) -> None:
        """There is an event: handle it, or leave it to the machine."""
        self.pending = True
        if not self.shared:
            self.settle()

    def settle(self) -> None:
        """Handle what is pending alone: update the discrete states until they stay as they are."""
        if not self.pending:
            return
        self.enter()
        for _ in range(MOST_UPDATES):
            if not self.update():
                self.leave()
                return
        reason = f"its discrete states do not settle in {MOST_UPDATES} updates"
        raise self._owner.failure("fmi3UpdateDiscreteStates", reason)

    def change(self, change: Callable[[], None]) -> None:
        """Do something that may be done in event mode only: an event of its own."""
        self.enter()
        change()
        self.happened()

    def enter(self) -> None:
        """Enter the event mode, if the instance is not in it."""
        if not self.inside:
            self._owner.call("EnterEventMode")
            self.inside = True

    def update(self) -> bool:
        """Update the discrete states; whether the FMU asks for one more update."""
        again, ends, _, _, announces, when = self._owner.call("UpdateDiscreteStates")
        self.announced = when if announces else None
        if ends:
            raise self._owner.failure("fmi3UpdateDiscreteStates", "it asks to end the simulation")
        return bool(again)

    def leave(self) -> None:
        """Go back to the step mode."""
        self._owner.call("EnterStepMode")
        self.inside = self.pending = False

    def active(self, clocks: Sequence[str]) -> list[str]:
        """Which of some output clocks tick now; each is read once, as reading may stop it (FMI 3.0, section 2.2.9)."""
        references = [self._owner.description.variable(name).reference for name in clocks]
        ticks = self._owner.call("GetClock", references) if references else []
        return [name for name, tick in zip(clocks, ticks, strict=True) if tick]

    def activate(self, clocks: Sequence[str]) -> None:
        """Let input clocks tick."""
        variables: Mapping[str, Any] = self._owner.description.variables
        self._owner.call("SetClock", [variables[name].reference for name in clocks], [True] * len(clocks))

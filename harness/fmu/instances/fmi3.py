"""Instances of FMUs of FMI 3.0, by way of fmpy, and their event mode."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from ctypes import byref, c_bool, c_double, c_size_t, c_void_p
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, Protocol

from ...errors import FmuError
from ..description import Description, Value
from .common import FmuSlave, SavedState
from .loading import FMU3SlaveLoaded
from .message_log import MessageHandler
from .reals import Batch, ElementReals, RawReals

# The event mode of an instance of FMI 3.0: who handles an event, and when (FMI 3.0, section 4.2.1).

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
        pending: whether there is one that is not yet handled.
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


#: So often in a row an FMU may return early for no event.
_MOST_SHORT = 100
#: Types that have no functions of their own.
_NAMES = {"Enumeration": "Int64"}


def _bytes(value: Any) -> bytes:
    """Those of a Binary variable: as they came from the FMU, or in hexadecimal."""
    return value or b"" if value is None or isinstance(value, bytes) else bytes.fromhex(str(value))


class Fmi3Slave(FmuSlave):
    """One instance of an FMU of FMI 3.0.

    With early return, and always where there are clocks, events are handled by the rules of the event mode, if the FMU
    has one; else it handles them by itself.

    Attributes:
        event_mode: None where it is not used.
    """

    _FMI, _STATE = "fmi3", "FMUState"

    def __init__(
        self, description: Description, folder: Path, name: str, on_message: MessageHandler, early_return: bool
    ) -> None:
        """As of `FmuSlave`; with `early_return`, `advance` may end at an event of the FMU's own."""
        self.event_mode = EventMode(self) if uses_event_mode(description, early_return) else None
        self._may_return = early_return and description.returns_early
        self._event, self._ends, self._early_return = c_bool(), c_bool(), c_bool()
        self._reached = c_double()
        super().__init__(description, folder, name, on_message)

    def set(self, values: Mapping[str, Value]) -> None:
        """Set variables by name: one FMI call for each type.

        Inputs that are not continuous change in event mode only, where there is one (FMI 3.0, section 4.2.1.3).
        """
        mode = self.event_mode if self._initialized else None
        if mode is None or mode.inside or all(self.description.variable(name).continuous for name in values):
            super().set(values)
        else:
            mode.change(lambda: super(Fmi3Slave, self).set(values))

    def reals(self, names: Sequence[str]) -> RawReals | ElementReals:
        """Bind Real variables."""
        variables = [self.description.variable(name) for name in names]
        if any(variable.elements > 1 or variable.fmi_type != "Float64" for variable in variables):
            return ElementReals(self, names)
        return self._raw_reals(
            names, ("fmi3GetFloat64", "fmi3SetFloat64", "fmi3GetOutputDerivatives", ""), c_size_t(len(names))
        )

    def save(self, state: SavedState | None = None) -> SavedState:
        """A snapshot, and whether it was taken in event mode."""
        saved = super().save(state)
        return saved if self.event_mode is None else replace(saved, event_mode=self.event_mode.memory())

    def restore(self, state: SavedState) -> None:
        """Continue from a snapshot."""
        super().restore(state)
        if self.event_mode is not None:
            self.event_mode.remember(state.event_mode)

    def reset(self) -> None:
        """Back to the state just after the instantiation."""
        super().reset()
        if self.event_mode is not None:
            self.event_mode.forget()

    def call(self, name: str, *arguments: Any) -> Any:
        """Call a function "fmi3<Name>" by way of fmpy.

        Raises:
            FmuError: the FMU refuses.
        """
        return self._call(f"fmi3{name}", getattr(self._instance, name[0].lower() + name[1:]), *arguments)

    def _load(self, **where: str) -> Any:
        return FMU3SlaveLoaded(**where)

    def _instantiate(self) -> None:
        self._instance.instantiate(
            visible=False,
            loggingOn=True,
            eventModeUsed=self.event_mode is not None,
            earlyReturnAllowed=self._may_return,
            logMessage=self._log,
        )
        step = self.raw("fmi3DoStep", c_void_p, c_double, c_double, c_bool, *[c_void_p] * 4)
        self._step = partial(step, c_void_p(self._instance.component))
        results = self._event, self._ends, self._early_return, self._reached
        # Without saved states, no step is taken back.
        self._rest: tuple[Any, ...] = not self.description.saves_state, *(byref(result) for result in results)

    def _enter(self, start_time: float, stop_time: float) -> None:
        self._call("fmi3EnterInitializationMode", self._instance.enterInitializationMode, None, start_time, stop_time)

    def _exit(self) -> None:
        """Leave it; the event mode is behind it."""
        self._call("fmi3ExitInitializationMode", self._instance.exitInitializationMode)
        self._initialized = True
        if self.event_mode is not None:
            self.event_mode.begun()

    def _do_step(self, begin: float, size: float) -> float | None:
        mode = self.event_mode
        if mode is None:
            return self._stepped(begin, size)
        mode.settle()
        part = mode.size_to(begin, size) if self.description.varies_step else size
        reached = self._stepped(begin, part)
        if reached is None and part < size:
            reached = begin + part
        self._time = begin + size if reached is None else reached
        mode.reached(self._time, self._event.value)
        return reached

    def _stepped(self, begin: float, size: float) -> float | None:
        """Take a step; None when it was completed, else the time reached."""
        said = len(self.messages)
        status = self._step(begin, size, *self._rest)
        if status > 1:
            raise self.refusal("fmi3DoStep", status, said)
        if self._ends:
            raise self.failure("fmi3DoStep", "it asks to end the simulation")
        reached = self._reached.value if self._early_return else None
        if reached is not None and reached < begin + size and not self._event:
            self._count_short(begin + size, _MOST_SHORT)
        return reached

    def _log(self, _environment: Any, status: int, category: bytes | None, text: bytes | None) -> None:
        self._logged(status, category, text, "#")

    def _get(self, batch: Batch) -> list[Any]:
        name = _NAMES.get(batch.kind, batch.kind)
        get = getattr(self._instance, f"get{name}")
        try:
            numbers: list[Any] = self._call(f"fmi3Get{name}", get, batch.references, batch.count)
        except (AttributeError, UnicodeDecodeError) as error:  # of fmpy, for a String that is null or not UTF-8
            raise self.failure(f"fmi3Get{name}", "a String that it gives is null, or not in UTF-8") from error
        return numbers

    def _set(self, batch: Batch, numbers: Sequence[Value]) -> None:
        name = _NAMES.get(batch.kind, batch.kind)
        values = [_bytes(number) for number in numbers] if name == "Binary" else numbers
        self._call(f"fmi3Set{name}", getattr(self._instance, f"set{name}"), batch.references, values)

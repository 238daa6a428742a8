"""Instances of FMUs for Model Exchange: to those around them components like all others, which take steps."""

from __future__ import annotations

import math
import struct
from abc import abstractmethod
from collections.abc import Mapping
from ctypes import POINTER, c_double, cast
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from fmpy.fmi1 import FMICallException

from ...errors import FmuError, Status, UsageError
from ..description import Description, Value
from .common import FmuSlave, SavedState
from .fmi2 import Fmi2Slave
from .fmi3 import MOST_UPDATES, Fmi3Slave
from .integration import Integration, Integrator, Numbers
from .loading import FMU2ModelLoaded, FMU3ModelLoaded
from .message_log import MessageHandler

#: Of a snapshot as bytes: whether it is in event mode, whether buffers are empty, when the next event by time is [s].
_MODE = struct.Struct("<??d")


class _ModelExchange(FmuSlave):
    """What both versions of FMI do alike; the equations of its `Integration`.

    Between steps an instance is in continuous-time mode. Inputs that are set in between are an event: they may jump.

    Attributes:
        integration: of its motion.
    """

    #: How the call is named that gives derivatives.
    _DERIVATIVES: str

    def __init__(
        self, description: Description, folder: Path, name: str, on_message: MessageHandler, integrator: Integrator
    ) -> None:
        """As of `FmuSlave`, with the way in which it is integrated."""
        self.integration = Integration(self, integrator)
        self._in_events = False
        self._stale = True
        self._emptied = True
        self._next = math.inf
        self._open(description, folder, name, on_message)

    @abstractmethod
    def _open(self, description: Description, folder: Path, name: str, on_message: MessageHandler) -> None:
        """Load the library and make an instance, as `FmuSlave` does."""

    @abstractmethod
    def _counts(self) -> tuple[int, int]:
        """How many states and event indicators there are."""

    def set(self, values: Mapping[str, Value]) -> None:
        """Set variables by name; once it runs, in event mode."""
        if self._initialized and values:
            self._empty()
            self._enter_events()
        super().set(values)

    def advance(self, time: float, size: float) -> float:
        """Take a step."""
        return FmuSlave.advance(self, time, size)

    def save(self, state: SavedState | None = None) -> SavedState:
        """A snapshot, and in which mode it was taken."""
        return replace(super().save(state), event_mode=(self._in_events, self._emptied, self._next))

    def restore(self, state: SavedState) -> None:
        """Continue from a snapshot: what was integrated ahead is forgotten."""
        super().restore(state)
        self._in_events, self._emptied, announced = state.event_mode
        self._next = math.inf if announced is None else announced
        self._stale = True

    def serialize(self, state: SavedState) -> bytes:
        """A snapshot as bytes, behind the mode in which it was taken."""
        inside, emptied, announced = state.event_mode
        return _MODE.pack(inside, emptied, math.inf if announced is None else announced) + super().serialize(state)

    def deserialize(self, data: bytes) -> SavedState:
        """A snapshot from bytes."""
        inside, emptied, announced = _MODE.unpack_from(data)
        return replace(super().deserialize(data[_MODE.size :]), event_mode=(inside, emptied, announced))

    # what `Integration` asks for

    def nominals(self) -> Numbers:
        """Typical magnitudes of the states."""
        return self._numbers("getNominalsOfContinuousStates", self._state_buffer)

    def derivatives(self, time: float, states: Numbers) -> Numbers:
        """Derivatives of the states; not numbers where the FMU discards them."""
        try:
            self._go_to(time, states)
            return self._numbers(self._DERIVATIVES, self._state_buffer)
        except FMICallException as refusal:
            if refusal.status != Status.DISCARD:
                raise
            return np.full(len(states), math.nan)

    def indicators(self, time: float, states: Numbers) -> Numbers:
        """Event indicators."""
        if len(self._indicator_buffer) == 0:
            return np.zeros(0)
        self._go_to(time, states)
        return self._numbers("getEventIndicators", self._indicator_buffer)

    def completed(self, time: float, states: Numbers) -> bool:
        """A step is accepted; whether the FMU wants event mode."""
        self._go_to(time, states)
        if not self.description.needs_completed:
            return False
        wants, ends = self._instance.completedIntegratorStep()
        if ends:
            raise self.failure(f"{self._FMI}CompletedIntegratorStep", "it asks to end the simulation")
        return bool(wants)

    def happen(self) -> tuple[Numbers, float]:
        """Let events happen where it stands; the states behind them, and when the next is by time [s]."""
        self._enter_events()
        self._settle()
        self._instance.enterContinuousTimeMode()
        self._in_events, self._emptied = False, False
        return self._numbers("getContinuousStates", self._state_buffer), self._next

    # the life of the instance

    def _begun(self) -> None:
        """It has been initialized, and is in event mode."""
        states, indicators = self._counts()
        self._state_buffer = np.zeros(states)
        self._indicator_buffer = np.zeros(indicators)
        self._in_events, self._stale, self._emptied = True, True, True
        self.integration.time = self._time
        self.integration.events = self.integration.most_at_once = 0

    def _do_step(self, begin: float, size: float) -> float | None:
        self._time = begin
        said = len(self.messages)
        try:
            self._empty()
            if self._in_events:
                self.integration.begin(begin, *self.happen())
                self._emptied, self._stale = True, False
            elif self._stale:
                self.integration.begin(begin, self._numbers("getContinuousStates", self._state_buffer), self._next)
                self._stale = False
            self.integration.advance(begin + size)
            self._go_to(self.integration.time, self.integration.states)
        except FMICallException as refusal:
            self._time = self.integration.time
            raise self.refusal(f"{self._FMI} Model Exchange", refusal.status, said) from refusal
        except UsageError as error:
            raise FmuError(f"{self.name} failed: {error}", instance=self.name, time=self.integration.time) from error
        return None

    def _empty(self) -> None:
        """After events: an event mode in which nothing is due empties the buffers of this project's FMUs."""
        if not self._emptied:
            self._enter_events()
            self._settle()
            self._emptied = True

    def _enter_events(self) -> None:
        if not self._in_events:
            self._instance.enterEventMode()
            self._in_events = True

    def _settle(self) -> None:
        """Update the discrete states until they stay as they are."""
        for _ in range(MOST_UPDATES):
            again, ends, _, _, announces, when = self._update()
            if ends:
                raise self.failure(f"{self._FMI} Model Exchange", "it asks to end the simulation")
            if not again:
                self._next = when if announces else math.inf
                return
        raise self.failure(
            f"{self._FMI} Model Exchange", f"its discrete states do not settle in {MOST_UPDATES} updates"
        )

    @abstractmethod
    def _update(self) -> Any:
        """Update the discrete states once: needs one more, ends, nominals and states changed, announces, when [s]."""

    def _go_to(self, time: float, states: Numbers) -> None:
        self._instance.setTime(time)
        if len(states):
            values = np.ascontiguousarray(states)
            self._instance.setContinuousStates(_pointer(values), len(values))

    def _numbers(self, function: str, buffer: Numbers) -> Numbers:
        if len(buffer):
            getattr(self._instance, function)(_pointer(buffer), len(buffer))
        return buffer.copy()


def _pointer(numbers: Numbers) -> Any:
    return cast(numbers.ctypes.data, POINTER(c_double))


class Fmi2Model(_ModelExchange, Fmi2Slave):
    """One instance of an FMU for Model Exchange of FMI 2.0."""

    _DERIVATIVES = "getDerivatives"

    def _open(self, description: Description, folder: Path, name: str, on_message: MessageHandler) -> None:
        Fmi2Slave.__init__(self, description, folder, name, on_message)

    def _load(self, **where: str) -> Any:
        return FMU2ModelLoaded(**where)

    def _instantiate(self) -> None:
        self._instance.instantiate(visible=False, callbacks=self._callbacks(), loggingOn=True)

    def _exit(self) -> None:
        super()._exit()
        self._begun()

    def _counts(self) -> tuple[int, int]:
        return self.description.states, self.description.indicators

    def _update(self) -> Any:
        return self._instance.newDiscreteStates()


class Fmi3Model(_ModelExchange, Fmi3Slave):
    """One instance of an FMU for Model Exchange of FMI 3.0."""

    _DERIVATIVES = "getContinuousStateDerivatives"

    def _open(self, description: Description, folder: Path, name: str, on_message: MessageHandler) -> None:
        Fmi3Slave.__init__(self, description, folder, name, on_message, False)

    def _load(self, **where: str) -> Any:
        return FMU3ModelLoaded(**where)

    def _instantiate(self) -> None:
        self._instance.instantiate(visible=False, loggingOn=True, logMessage=self._log)

    def _exit(self) -> None:
        super()._exit()
        self._begun()

    def _counts(self) -> tuple[int, int]:
        return self._instance.getNumberOfContinuousStates(), self._instance.getNumberOfEventIndicators()

    def _update(self) -> Any:
        return self._instance.updateDiscreteStates()

"""Co-simulation slave of an FMU, in common for FMI 2.0 and 3.0: values, initialization, steps, states, errors."""

from __future__ import annotations

import math
import os
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from ctypes import c_int, c_void_p
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

from fmpy.fmi1 import FMICallException

from ...errors import FmuError, LogMessage, Status
from ..description import Description, Value
from ..interface import whole_step
from ..values import integer_range
from .message_log import MessageHandler, MessageLog, reason_in
from .reals import FROM_C, Batch, ElementReals, RawReals, batches, raw_reals
from .workspace import libraries_in, listed

#: So often in a row an FMU may return from a step without having moved.
_MOST_RETURNS = 100


@dataclass(frozen=True)
class SavedState:
    """A snapshot of an instance.

    Attributes:
        handle: the FMU's own.
        early: of the slave at that time.
        initialized: likewise.
        event_mode: of FMI 3.0, as of `EventMode.memory`.
    """

    handle: Any
    early: float | None
    initialized: bool
    event_mode: tuple[bool, bool, float | None] = (False, False, None)


class FmuSlave(ABC):
    """One instance of an FMU (a `machine.component.Component`).

    Attributes:
        description: of the FMU.
        name: of the instance.
        messages: everything the FMU has logged so far.
    """

    #: How the functions of this version of FMI begin, and what the state is called in them.
    _FMI: ClassVar[str]
    _STATE: ClassVar[str]

    def __init__(self, description: Description, folder: Path, name: str, on_message: MessageHandler) -> None:
        """Load the library of an FMU that is extracted in `folder`, and make an instance.

        Raises:
            FmuError: the library cannot be loaded, or the FMU refuses.
        """
        self.description = description
        self.name = name
        self._message_log = MessageLog(name, on_message)
        self.messages = self._message_log.messages
        self._time = 0.0
        self._early: float | None = None
        self._returns = 0
        self._short_of: float | None = None
        self._shorts = 0
        self._initialized = False
        self._fatal = False
        self._known_batches: dict[tuple[str, ...], list[Batch]] = {}
        self._instance = self._loaded(folder)
        self._make_instance()

    def set(self, values: Mapping[str, Value]) -> None:
        """Set variables by name: one FMI call for each type."""
        given = list(values.values())
        for batch in self._batches(tuple(values)):
            numbers: list[Value] = [0.0] * batch.count if batch.is_whole else self._get(batch)
            for place, offset in zip(batch.places, batch.offsets, strict=True):
                numbers[offset] = given[place]
            if batch.type == "Integer":
                self._require_range(batch, numbers)
            self._set(batch, numbers)

    def get(self, names: Sequence[str]) -> list[Value]:
        """Values of variables, in the order of `names`: one FMI call for each type."""
        values: list[Value] = [0.0] * len(names)
        for batch in self._batches(tuple(names)):
            numbers, convert = self._get(batch), FROM_C[batch.type]
            for place, offset in zip(batch.places, batch.offsets, strict=True):
                values[place] = convert(numbers[offset])
        return values

    @abstractmethod
    def reals(self, names: Sequence[str]) -> RawReals | ElementReals:
        """Bind Real variables."""

    def initialize(self, start_time: float, stop_time: float) -> None:
        """Go through the initialization mode."""
        self.enter_initialization(start_time, stop_time)
        self.exit_initialization()

    def enter_initialization(self, start_time: float, stop_time: float) -> None:
        """Enter the initialization mode; what the FMU says in it is shown when it ends.

        What belongs to a refused call there is forgotten: it is in the error, and the FMU repeats what matters.
        """
        self._time, self._early = start_time, None
        self._enter(start_time, stop_time)
        self._message_log.hold()

    def exit_initialization(self) -> None:
        """Leave the initialization mode."""
        self._message_log.show_held()
        self._exit()

    def step(self, time: float, size: float) -> None:
        """Advance from `time` by `size` [s], going on where the FMU returns early."""
        whole_step(self.advance, time, size)

    def advance(self, time: float, size: float) -> float:
        """Take a step, or a part of it where the FMU returns early; the time reached [s].

        After an early return the FMU is asked to go on from the very time that it returned, though the master may have
        rounded it to its clock.
        """
        end = time + size
        if self._early is None:
            self._time = begin = time
            reached = self._do_step(time, size)
        elif self._early >= end:
            return end
        else:
            self._time = begin = self._early
            reached = self._do_step(begin, end - begin)
        if reached is None:
            self._early, self._time, self._returns = None, end, 0
            return end
        return self._returned(begin, reached, end)

    def terminate(self) -> None:
        """End the run; a failed one cannot be terminated, only freed or reset."""
        if self._initialized:
            self._initialized = False
            self._call(f"{self._FMI}Terminate", self._instance.terminate)
            self._message_log.report_left_out(self._time)

    def reset(self) -> None:
        """Back to the state just after the instantiation."""
        self._call(f"{self._FMI}Reset", self._instance.reset)
        self._initialized, self._early = False, None
        self._message_log.end_hold()

    def save(self, state: SavedState | None = None) -> SavedState:
        """A snapshot of the whole state, in the place of one that is given; give it back with `free_state`.

        An old one is freed rather than handed to the FMU again: pythonfmu's would never free it then.
        """
        if state is not None:
            self.free_state(state)
        handle = self._call(f"{self._FMI}Get{self._STATE}", self._instance.getFMUState)
        return SavedState(handle, self._early, self._initialized)

    def restore(self, state: SavedState) -> None:
        """Continue from a snapshot."""
        self._call(f"{self._FMI}Set{self._STATE}", self._instance.setFMUState, state.handle)
        self._early, self._initialized = state.early, state.initialized

    def free_state(self, state: SavedState) -> None:
        """Release a snapshot; after the status Fatal, nothing may be asked any more, not even this."""
        if self._fatal:
            return
        self._call(f"{self._FMI}Free{self._STATE}", self._instance.freeFMUState, state.handle)

    def serialize(self, state: SavedState) -> bytes:
        """A snapshot as bytes."""
        data: bytes = self._call(f"{self._FMI}Serialize{self._STATE}", self._instance.serializeFMUState, state.handle)
        return data

    def deserialize(self, data: bytes) -> SavedState:
        """A snapshot from bytes."""
        handle = self._call(f"{self._FMI}DeSerialize{self._STATE}", self._instance.deserializeFMUState, data)
        return SavedState(handle, None, self._initialized)

    def free(self) -> None:
        """Terminate if need be, free the instance and unload the library.

        After the status Fatal nothing more may be asked of an FMU (FMI 2.0, section 2.1.3), and an FMU of pythonfmu
        0.7.0 that does not repair its wrapper, as this project's do, crashes the process then. A little memory
        is lost instead.
        """
        if not self._fatal:
            with suppress(FmuError):
                self.terminate()
        if not self._fatal:
            self._instance.freeInstance()

    def refusal(self, function: str, status: int, said: int) -> FmuError:
        """What to raise for a call that was answered by `status`, with what the FMU has said since message `said`."""
        answer = Status(status)
        self._fatal = self._fatal or answer is Status.FATAL
        self._message_log.report_left_out(self._time)
        error = self._error(f"{function}, status {answer.name.lower()}", answer, self.messages[said:])
        self._message_log.forget_held(said)
        return error

    def failure(self, function: str, reason: str) -> FmuError:
        """What to raise for an answer that the FMU finds good, but from which the run cannot go on."""
        text = f"{self.name} failed {self._when()} ({function}): {reason}."
        return FmuError(text, instance=self.name, time=self._time if self._initialized else None)

    def quietly(self, call: Callable[[], int]) -> int:
        """Call a function of the FMU; what it says is kept, but not shown."""
        return self._message_log.quietly(call)

    @abstractmethod
    def _load(self, **where: str) -> Any:
        """The library as fmpy knows it."""

    @abstractmethod
    def _instantiate(self) -> None:
        """Make the instance; fmpy raises a bare Exception when the FMU refuses."""

    @abstractmethod
    def _enter(self, start_time: float, stop_time: float) -> None:
        """Enter the initialization mode."""

    @abstractmethod
    def _exit(self) -> None:
        """Leave it."""

    def _raw_reals(self, names: Sequence[str], functions: tuple[str, str, str, str], *last: Any) -> RawReals:
        """As `raw_reals`."""
        return raw_reals(self, c_void_p(self._instance.component), names, functions, last)

    def _returned(self, begin: float, reached: float, end: float) -> float:
        """Note where the FMU has returned from a step; the time reached."""
        if reached >= end:
            self._early, self._time, self._returns = None, end, 0
            return end
        self._returns = 0 if reached > begin else self._returns + 1
        if self._returns > _MOST_RETURNS:
            raise self.failure(f"{self._FMI}DoStep", "it returns early again and again, and its time stands still")
        self._early = self._time = reached
        return reached

    def _count_short(self, end: float, most: int) -> None:
        """Count the steps in a row that ended before `end` [s] for no event.

        Raises:
            FmuError: there have been more than `most`: each may take seconds, as of a stiff mechanism.
        """
        again = self._short_of is not None and math.isclose(end, self._short_of, rel_tol=1e-12)
        self._short_of, self._shorts = end, self._shorts + 1 if again else 1
        if self._shorts > most:
            said = next((m.text.strip() for m in reversed(self.messages) if m.needs_attention), "it gave no reason.")
            reason = f"{most} times it ended a step early that was to reach {end:.9g} s; it says: {said}"
            raise self.failure(f"{self._FMI}DoStep", reason.removesuffix("."))

    @abstractmethod
    def _get(self, batch: Batch) -> list[Any]:
        """The numbers of variables of one type."""

    def _require_range(self, batch: Batch, numbers: Sequence[Value]) -> None:
        """Refuse what C would make another number of without a word.

        Raises:
            FmuError: a number does not fit the type of its variable.
        """
        least, most = integer_range(batch.kind)
        for number in numbers:
            if not least <= int(number) <= most:
                raise self.failure(f"{self._FMI}Set{batch.kind}", f"{number} does not fit, from {least} to {most}")

    @abstractmethod
    def _set(self, batch: Batch, numbers: Sequence[Value]) -> None:
        """Set variables of one type."""

    @abstractmethod
    def _do_step(self, begin: float, size: float) -> float | None:
        """Take a step; None when it was completed, else the time reached."""

    def _loaded(self, folder: Path) -> Any:
        working_folder = os.getcwd()
        try:
            return self._load(
                guid=self.description.guid,
                modelIdentifier=self.description.identifier,
                unzipDirectory=str(folder),
                instanceName=self.name,
            )
        except Exception as error:  # fmpy raises a bare Exception for whatever the loader says
            there = f"the FMU has {listed(libraries_in(folder))}"
            raise self._error(f"its library cannot be loaded; {error}; {there}", Status.FATAL, []) from error
        finally:
            os.chdir(working_folder)  # fmpy does not return from the library's folder when loading fails

    def _make_instance(self) -> None:
        try:
            self._instantiate()
        except Exception as error:
            self._instance.freeLibrary()
            raise self._error(f"{self._FMI}Instantiate", Status.ERROR, self.messages) from error

    def _batches(self, names: tuple[str, ...]) -> list[Batch]:
        if names not in self._known_batches:
            self._known_batches[names] = batches(names, self.description)
        return self._known_batches[names]

    def raw(self, name: str, *types: Any) -> Callable[..., int]:
        """A function of the library, called without detour; without `types`, for arguments that are of C already."""
        function = self._instance.dll[name]
        function.restype = c_int
        if types:
            function.argtypes = types
        raw: Callable[..., int] = function
        return raw

    def _logged(self, status: int, category: bytes | None, raw: bytes | None, escaped: str) -> None:
        """Keep a message of the FMU, unless there have been too many; `escaped` is what is doubled in it."""
        self._message_log.add(self._time, status, category, raw, escaped)

    def _call(self, name: str, function: Callable[..., Any], *arguments: Any) -> Any:
        said = len(self.messages)
        try:
            return function(*arguments)
        except FMICallException as refusal:
            status = refusal.status
        raise self.refusal(name, status, said)

    def _when(self) -> str:
        return f"at t = {self._time:.9g} s" if self._initialized else "before the first step"

    def _error(self, problem: str, status: Status, messages: Sequence[LogMessage]) -> FmuError:
        time = self._time if self._initialized else None
        text = f"{self.name} failed {self._when()} ({problem}): {reason_in(messages)}"
        return FmuError(text, instance=self.name, time=time, status=status, messages=messages)

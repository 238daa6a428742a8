"""FMUs by way of fmpy: extract, instantiate, call, and always clean up."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import fmpy
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave, defaultCallbacks, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE

from .description import Description, Value, read_description
from .errors import FmuError, UsageError
from .messages import LogMessage, Status
from .workspace import temporary_folder

#: Receives every message of an FMU at once.
MessageHandler = Callable[[LogMessage], None]

#: What pythonfmu adds to the FMU's own message when it turns a Python exception into the status Fatal.
_WRAPPER_SAYS = "Fatal py exception encountered"


def discard_message(_message: LogMessage) -> None:
    """Leave a message to those who read `FmuSlave.messages`."""


@dataclass(frozen=True)
class Fmu:
    """An extracted FMU.

    Attributes:
        path: the file it came from.
        description: what it says about itself.
        folder: where it is extracted.
    """

    path: Path
    description: Description
    folder: Path

    @contextmanager
    def instantiate(self, name: str, on_message: MessageHandler = discard_message) -> Iterator[FmuSlave]:
        """A new instance; it is freed afterwards.

        Raises:
            FmuError: the library cannot be loaded, or the FMU refuses; with its messages.
        """
        slave = FmuSlave(self, name, on_message)
        try:
            yield slave
        finally:
            slave.free()


@contextmanager
def open_fmu(path: Path) -> Iterator[Fmu]:
    """Extract the FMU file `path` into a temporary folder; it is removed afterwards.

    For a `with`: `with open_fmu(Path("build/Ratchet.fmu")) as fmu, fmu.instantiate("ratchet") as ratchet:`.

    Raises:
        UsageError: not a file, not an FMU that can be run, or made for other platforms only.
    """
    description = read_description(path)
    platforms = fmpy.supported_platforms(str(path))
    if fmpy.platform not in platforms:
        raise UsageError(
            f"'{path}' has no library for {fmpy.platform}; it runs on {', '.join(platforms) or 'no platform'}."
        )
    with temporary_folder() as folder:
        fmpy.extract(str(path), unzipdir=str(folder))
        yield Fmu(path, description, folder)


class FmuSlave:
    """One instance of an FMU (a `slave.Slave`), with saving and restoring of its state.

    Attributes:
        messages: everything the FMU has logged so far.
    """

    def __init__(self, fmu: Fmu, name: str, on_message: MessageHandler) -> None:
        self.description = fmu.description
        self.name = name
        self.messages: list[LogMessage] = []
        self._on_message = on_message
        self._time = 0.0
        self._initialized = False
        self._fatal = False
        self._known_batches: dict[tuple[str, ...], list[tuple[str, list[int], list[int]]]] = {}
        self._instance = self._load(fmu.folder)
        self._instantiate()

    def set(self, values: Mapping[str, Value]) -> None:
        """Set variables by name: one FMI call for each type."""
        given = list(values.values())
        for kind, references, places in self._batches(tuple(values)):
            self._call(f"fmi2Set{kind}", getattr(self._instance, f"set{kind}"), references, [given[i] for i in places])

    def set_slopes(self, slopes: Mapping[str, float]) -> None:
        """Let inputs change linearly in the next step, by so much in a second; for FMUs that take slopes."""
        references = [self.description.variable(name).reference for name in slopes]
        values, first = list(slopes.values()), [1] * len(slopes)
        self._call("fmi2SetRealInputDerivatives", self._instance.setRealInputDerivatives, references, first, values)

    def get(self, names: Sequence[str]) -> list[Value]:
        """Values of variables, in the order of `names`: one FMI call for each type."""
        values: list[Value] = [0.0] * len(names)
        for kind, references, places in self._batches(tuple(names)):
            numbers = self._call(f"fmi2Get{kind}", getattr(self._instance, f"get{kind}"), references)
            for place, number in zip(places, map(_FROM_C[kind], numbers), strict=True):
                values[place] = number
        return values

    def initialize(self, start_time: float, stop_time: float) -> None:
        """Go through the initialization mode."""
        self._time = start_time
        self._call("fmi2SetupExperiment", self._instance.setupExperiment, None, start_time, stop_time)
        self._call("fmi2EnterInitializationMode", self._instance.enterInitializationMode)
        self._call("fmi2ExitInitializationMode", self._instance.exitInitializationMode)
        self._initialized = True

    def step(self, time: float, size: float) -> None:
        """Advance from `time` by `size` [s]."""
        self._time = time
        self._call("fmi2DoStep", self._instance.doStep, time, size)

    def terminate(self) -> None:
        """End the run; a failed one cannot be terminated, only freed or reset."""
        if self._initialized:
            self._initialized = False
            self._call("fmi2Terminate", self._instance.terminate)

    def reset(self) -> None:
        """Back to the state just after the instantiation."""
        self._call("fmi2Reset", self._instance.reset)
        self._initialized = False

    def save(self) -> Any:
        """A snapshot of the whole state; give it back with `free_state`."""
        return self._call("fmi2GetFMUstate", self._instance.getFMUstate)

    def restore(self, state: Any) -> None:
        """Continue from a snapshot."""
        self._call("fmi2SetFMUstate", self._instance.setFMUstate, state)

    def free_state(self, state: Any) -> None:
        """Release a snapshot."""
        self._call("fmi2FreeFMUstate", self._instance.freeFMUstate, state)

    def serialize(self, state: Any) -> bytes:
        """A snapshot as bytes."""
        data: bytes = self._call("fmi2SerializeFMUstate", self._instance.serializeFMUstate, state)
        return data

    def deserialize(self, data: bytes) -> Any:
        """A snapshot from bytes."""
        return self._call("fmi2DeSerializeFMUstate", self._instance.deSerializeFMUstate, data)

    def free(self) -> None:
        """Terminate if need be, free the instance and unload the library.

        After the status Fatal nothing more may be asked of an FMU (FMI 2.0, section 2.1.3), and an FMU of pythonfmu
        0.7.0 that does not repair its wrapper, as ours do, crashes the process then. A little memory is lost instead.
        """
        if not self._fatal:
            with suppress(FmuError):
                self.terminate()
        if not self._fatal:
            self._instance.freeInstance()

    def _load(self, folder: Path) -> Any:
        working_folder = os.getcwd()
        try:
            return FMU2Slave(
                guid=self.description.guid,
                modelIdentifier=self.description.identifier,
                unzipDirectory=str(folder),
                instanceName=self.name,
            )
        except Exception as error:  # fmpy raises a bare Exception for whatever the loader says
            raise self._error(f"its library cannot be loaded; {error}", Status.FATAL, []) from error
        finally:
            os.chdir(working_folder)  # fmpy does not return from the library's folder when loading fails

    def _instantiate(self) -> None:
        try:
            self._instance.instantiate(visible=False, callbacks=self._callbacks(), loggingOn=True)
        except Exception as error:  # fmpy raises a bare Exception when the FMU returns no instance
            self._instance.freeLibrary()
            raise self._error("fmi2Instantiate", Status.ERROR, self.messages) from error

    def _callbacks(self) -> Any:
        """The functions an FMU calls back.

        Without fmpy's logger proxy, which would treat a message as a printf format: pythonfmu passes plain text, and
        a "%s" in it would crash the process. It also has one receiver for all instances.
        """
        callbacks = fmi2CallbackFunctions()
        callbacks.logger = fmi2CallbackLoggerTYPE(self._log)
        callbacks.allocateMemory = defaultCallbacks.allocateMemory
        callbacks.freeMemory = defaultCallbacks.freeMemory
        return callbacks

    def _log(self, _environment: Any, _instance: Any, status: int, category: bytes | None, text: bytes | None) -> None:
        message = LogMessage(
            instance=self.name,
            time=self._time,
            status=Status(status),
            category=(category or b"").decode("utf-8", errors="replace"),
            text=(text or b"").decode("utf-8", errors="replace").replace("%%", "%"),
        )
        self.messages.append(message)
        self._on_message(message)

    def _call(self, name: str, function: Callable[..., Any], *arguments: Any) -> Any:
        said = len(self.messages)
        try:
            return function(*arguments)
        except FMICallException as refusal:
            status = Status(refusal.status)
            self._fatal = self._fatal or status is Status.FATAL
            raise self._error(f"{name}, status {status.name.lower()}", status, self.messages[said:]) from None

    def _error(self, problem: str, status: Status, messages: Sequence[LogMessage]) -> FmuError:
        time = self._time if self._initialized else None
        where = f"at t = {time:.9g} s" if time is not None else "before the first step"
        said = [message.text.strip() for message in messages if message.needs_attention]
        own = [text for text in said if not text.startswith(_WRAPPER_SAYS)] or said
        text = f"{self.name} failed {where} ({problem}): {' '.join(own) or 'it gave no reason.'}"
        return FmuError(text, instance=self.name, time=time, status=status, messages=messages)

    def _batches(self, names: tuple[str, ...]) -> list[tuple[str, list[int], list[int]]]:
        """For each type among variables: the type, the value references, and the places in `names`."""
        if names not in self._known_batches:
            batches: dict[str, tuple[str, list[int], list[int]]] = {}
            for place, name in enumerate(names):
                variable = self.description.variable(name)
                _, references, places = batches.setdefault(variable.type, (variable.type, [], []))
                references.append(variable.reference)
                places.append(place)
            self._known_batches[names] = list(batches.values())
        return self._known_batches[names]


_FROM_C: dict[str, Callable[[Any], Value]] = {
    "Real": float,
    "Integer": int,
    "Boolean": bool,
    "String": lambda raw: (raw or b"").decode("utf-8"),
}

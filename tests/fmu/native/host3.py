"""A co-simulation host of FMI 3.0 in miniature: an FMU by the names of its variables, on fmpy's FMU3Slave."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from ctypes import c_bool
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any, NamedTuple, Self

import fmpy
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi3 import FMU3Slave, fmi3Error, fmi3ValueReference
from fmpy.model_description import ModelDescription, ModelVariable

Value = Any
TYPES = ("Float64", "Int32", "Boolean")


class Message(NamedTuple):
    """A line of the FMI log."""

    status: int
    category: str
    text: str


class Step(NamedTuple):
    """What fmi3DoStep says."""

    event: bool
    terminate: bool
    early: bool
    reached: float


class Update(NamedTuple):
    """What an intermediate update says; the callback returns when to return early, or None."""

    time: float
    set_requested: bool
    get_allowed: bool
    finished: bool
    can_return_early: bool


@dataclass(frozen=True)
class Fmu3:
    """An unzipped FMU."""

    folder: str
    description: ModelDescription

    @classmethod
    def unzip(cls, archive: Path, folder: Path) -> Self:
        fmpy.extract(str(archive), str(folder))
        return cls(str(folder), fmpy.read_model_description(str(folder)))

    @property
    def variables(self) -> dict[str, ModelVariable]:
        return {v.name: v for v in self.description.modelVariables}

    def outputs(self) -> list[str]:
        outputs = [v for v in self.description.modelVariables if v.causality == "output" and v.type in TYPES]
        return [v.name for v in outputs if not v.clocks]


class Instance3:
    """An instance of an FMU; leaving its `with` block frees it.

    Every call that does not return fmi3OK or fmi3Warning raises fmpy's FMICallException.

    Attributes:
        log: what the FMU has said.
        time: up to which it has been stepped [s].
    """

    def __init__(
        self,
        fmu: Fmu3,
        event_mode: bool = False,
        early_return: bool = False,
        on_update: Callable[[Update], float | None] | None = None,
        intermediate: Iterable[str] = (),
        token: str | None = None,
        name: str = "one",
        logging: bool = True,
    ) -> None:
        self.fmu = fmu
        self.log: list[Message] = []
        self.time = 0.0
        self.event_mode = event_mode
        self._by_name = fmu.variables
        self.slave = FMU3Slave(
            guid=token or fmu.description.guid,
            unzipDirectory=fmu.folder,
            modelIdentifier=fmu.description.coSimulation.modelIdentifier,
            instanceName=name,
        )

        def update(_environment: object, *told: Any) -> None:
            assert on_update is not None
            *arguments, requested, when = told
            wanted = on_update(Update(*arguments))
            if wanted is not None:
                requested[0], when[0] = True, wanted

        self.slave.instantiate(
            loggingOn=logging,
            eventModeUsed=event_mode,
            earlyReturnAllowed=early_return,
            logMessage=lambda _, *message: self._told(*message),
            intermediateUpdate=on_update and update,
            requiredIntermediateVariables=[self.reference(name) for name in intermediate],
        )

    def __enter__(self) -> Self:
        return self

    def __exit__(self, _kind: type[BaseException] | None, _error: object, _trace: TracebackType | None) -> None:
        self.slave.freeInstance()

    # --- life cycle ---

    def begin(self, start: Mapping[str, Value] | None = None, **experiment: float) -> Self:
        """Set start values, go through initialization mode and, if there is one, the first event mode."""
        self.set(start or {})
        self.time = experiment.get("startTime", 0.0)
        self.slave.enterInitializationMode(**experiment)
        self.slave.exitInitializationMode()
        if self.event_mode:
            self.leave_event_mode()
        return self

    def step(self, size: float) -> Step:
        step = Step(*self.slave.doStep(self.time, size))
        self.time = step.reached
        return step

    def step_to(self, time: float) -> Step:
        return self.step(time - self.time)

    def leave_event_mode(self) -> None:
        assert not any(self.slave.updateDiscreteStates()[:5])
        self.slave.enterStepMode()

    def run(self, stop_time: float, count: int) -> list[Step]:
        """`count` equal steps; events are handled, and early returns end at the point that was meant first."""
        first, steps = self.time, []
        for k in range(1, count + 1):
            point = first + (stop_time - first) * k / count
            while self.time < point:
                steps.append(self.step_to(point))
                if steps[-1].event:
                    self.slave.enterEventMode()
                    self.leave_event_mode()
        return steps

    # --- values ---

    def reference(self, name: str) -> int:
        return int(self._by_name[name].valueReference)

    def set(self, values: Mapping[str, Value]) -> None:
        for name, value in values.items():
            getattr(self.slave, f"set{self._by_name[name].type}")([self.reference(name)], [value])

    def __getitem__(self, name: str) -> Value:
        """The value of a variable; that of an array as a list."""
        variable = self._by_name[name]
        if variable.type == "Clock":
            values = (c_bool * 1)()
            references = (fmi3ValueReference * 1)(self.reference(name))
            self.slave.fmi3GetClock(self.slave.component, references, 1, values)
        else:
            count = variable.shape[0] if variable.dimensions else 1
            values = getattr(self.slave, f"get{variable.type}")([self.reference(name)], nValues=count)
        return values if variable.dimensions else values[0]

    def get(self, names: Iterable[str]) -> dict[str, Value]:
        return {name: self[name] for name in names}

    def outputs(self) -> dict[str, Value]:
        """All outputs but a clock and what it clocks."""
        return self.get(self.fmu.outputs())

    # --- states ---

    def save_bytes(self) -> bytes:
        state = self.slave.getFMUState()
        saved = self.slave.serializeFMUState(state)
        self.slave.freeFMUState(state)
        return bytes(saved)

    def restore_bytes(self, saved: bytes) -> None:
        state = self.slave.deserializeFMUState(saved)
        self.slave.setFMUState(state)
        self.slave.freeFMUState(state)
        self.time = self["time"]

    # --- refusals ---

    def refusal(self, call: Callable[..., object], *arguments: Any) -> str:
        """What the log says to a call that is refused, with an error."""
        before = len(self.log)
        with pytest.raises(FMICallException) as caught:
            call(*arguments)
        (message,) = self.log[before:]
        assert caught.value.status == message.status == fmi3Error
        assert message.category == "logStatusError"
        return message.text

    def _told(self, status: int, category: bytes, text: bytes) -> None:
        self.log.append(Message(status, category.decode(), text.decode()))

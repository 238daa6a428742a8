"""A co-simulation host in miniature: an FMU by the names of its variables, on fmpy's FMU2Slave."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from ctypes import c_void_p
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any, NamedTuple, Self

import fmpy
from fmpy import calloc, free
from fmpy.fmi2 import (
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
)
from fmpy.model_description import ModelDescription, ScalarVariable

from harness.fmu.instances.loading import FMU2SlaveLoaded

Value = float | int | bool


class Message(NamedTuple):
    """A line of the FMI log: fmi2Status, category and text."""

    status: int
    category: str
    text: str


@dataclass(frozen=True)
class Fmu:
    """An unzipped FMU."""

    folder: str
    description: ModelDescription

    @classmethod
    def unzip(cls, archive: Path, folder: Path) -> Self:
        fmpy.extract(str(archive), str(folder))
        return cls.at(str(folder))

    @classmethod
    def at(cls, folder: str) -> Self:
        return cls(folder, fmpy.read_model_description(folder))

    @property
    def variables(self) -> dict[str, ScalarVariable]:
        return {v.name: v for v in self.description.modelVariables}

    def named(self, causality: str) -> list[str]:
        return [v.name for v in self.description.modelVariables if v.causality == causality]

    def start(self, name: str) -> Value:
        variable = self.variables[name]
        text = str(variable.start)
        if variable.type == "Boolean":
            return text == "true"
        return int(text) if variable.type == "Integer" else float(text)


class Instance:
    """An instance of an FMU; leaving its `with` block frees it.

    Every call that does not return fmi2OK or fmi2Warning raises fmpy's FMICallException.

    Attributes:
        log: what the FMU has said.
        time: up to which it has been stepped [s].
    """

    def __init__(self, fmu: Fmu, name: str = "one", logging: bool = True, callbacks: Any = None) -> None:
        self.fmu = fmu
        self.log: list[Message] = []
        self.time = 0.0
        self.slave = FMU2SlaveLoaded(
            guid=fmu.description.guid,
            unzipDirectory=fmu.folder,
            modelIdentifier=fmu.description.coSimulation.modelIdentifier,
            instanceName=name,
        )
        self._by_name = fmu.variables
        self.slave.instantiate(callbacks=callbacks or self._callbacks(), loggingOn=logging)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, _kind: type[BaseException] | None, _error: object, _trace: TracebackType | None) -> None:
        self.slave.freeInstance()

    # --- life cycle ---

    def begin(
        self,
        start: Mapping[str, Value] | None = None,
        start_time: float = 0.0,
        tolerance: float | None = None,
        stop_time: float | None = None,
    ) -> Self:
        """Set up, set start values and go through initialization mode."""
        self.slave.setupExperiment(tolerance=tolerance, startTime=start_time, stopTime=stop_time)
        self.time = start_time
        self.set(start or {})
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()
        return self

    def reset(self) -> Self:
        self.slave.reset()
        self.time = 0.0
        return self

    def step(self, size: float) -> None:
        self.slave.doStep(self.time, size)
        self.time += size

    def run(self, stop_time: float, size: float) -> None:
        """Equal steps, the last one shorter if need be."""
        while self.time < stop_time - 1e-9 * max(1.0, stop_time):
            self.step(min(size, stop_time - self.time))

    # --- values ---

    def set(self, values: Mapping[str, Value]) -> None:
        for kind, names in self._by_type(values).items():
            setter = getattr(self.slave, f"set{kind}")
            setter([self.reference(name) for name in names], [values[name] for name in names])

    def get(self, names: Iterable[str]) -> dict[str, Value]:
        names = list(names)
        found: dict[str, Value] = {}
        for kind, ofkind in self._by_type(names).items():
            values = getattr(self.slave, f"get{kind}")([self.reference(name) for name in ofkind])
            found.update(zip(ofkind, values, strict=True))
        return {name: found[name] for name in names}

    def __getitem__(self, name: str) -> Value:
        return self.get([name])[name]

    def outputs(self) -> dict[str, Value]:
        return self.get(self.fmu.named("output"))

    def reference(self, name: str) -> int:
        return int(self._by_name[name].valueReference)

    @property
    def refusal(self) -> str:
        """Why the last call that was refused was refused."""
        return [message.text for message in self.log if message.category == "logStatusError"][-1]

    # --- states ---

    def save(self) -> c_void_p:
        state: c_void_p = self.slave.getFMUstate()
        return state

    def restore(self, state: c_void_p, time: float) -> None:
        self.slave.setFMUstate(state)
        self.time = time

    def save_bytes(self) -> bytes:
        state = self.save()
        saved = self.slave.serializeFMUstate(state)
        self.slave.freeFMUstate(state)
        return bytes(saved)

    def restore_bytes(self, saved: bytes, time: float) -> None:
        state = self.slave.deSerializeFMUstate(saved)
        self.restore(state, time)
        self.slave.freeFMUstate(state)

    # --- inside ---

    def _by_type(self, names: Iterable[str]) -> dict[str, list[str]]:
        types: dict[str, list[str]] = {}
        for name in names:
            types.setdefault(self._by_name[name].type, []).append(name)
        return types

    def _callbacks(self) -> fmi2CallbackFunctions:
        def logger(_environment: object, _instance: bytes, status: int, category: bytes | None, text: bytes) -> None:
            self.log.append(Message(status, (category or b"").decode(), text.decode()))

        callbacks = fmi2CallbackFunctions()
        callbacks.logger = fmi2CallbackLoggerTYPE(logger)
        callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(calloc)
        callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(free)
        return callbacks

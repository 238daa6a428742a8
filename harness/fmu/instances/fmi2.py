"""Instances of FMUs of FMI 2.0, by way of fmpy."""

from __future__ import annotations

from collections.abc import Sequence
from ctypes import byref, c_double, c_int, c_size_t, c_uint, c_void_p
from functools import partial
from typing import Any

from fmpy.fmi2 import (
    defaultCallbacks,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    fmi2LastSuccessfulTime,
    fmi2Terminated,
)

from ...errors import Status
from ..description import Value
from .common import FmuSlave
from .loading import FMU2SlaveLoaded
from .reals import Batch, RawReals


class Fmi2Slave(FmuSlave):
    """One instance of an FMU of FMI 2.0."""

    _FMI, _STATE = "fmi2", "FMUstate"

    def reals(self, names: Sequence[str]) -> RawReals:
        """Bind Real variables."""
        return self._raw_reals(
            names, ("fmi2GetReal", "fmi2SetReal", "fmi2GetRealOutputDerivatives", "fmi2SetRealInputDerivatives")
        )

    def advance(self, time: float, size: float) -> float:
        """Take a step, as `FmuSlave` does, without detours where nothing special happens."""
        if self._early is not None:
            return super().advance(time, size)
        self._time = time
        said = len(self.messages)
        status = self._step(time, size, self._no_way_back)
        if status > 1:
            return self._returned(time, self._discarded(status, said, time, size), time + size)
        self._time = end = time + size
        return end

    def _load(self, **where: str) -> Any:
        return FMU2SlaveLoaded(**where)

    def _instantiate(self) -> None:
        self._instance.instantiate(visible=False, callbacks=self._callbacks(), loggingOn=True)
        step = self.raw("fmi2DoStep", c_void_p, c_double, c_double, c_int)
        # Without saved states, no step is taken back.
        self._no_way_back = int(not self.description.saves_state)
        self._step = partial(step, c_void_p(self._instance.component))

    def _enter(self, start_time: float, stop_time: float) -> None:
        self._call("fmi2SetupExperiment", self._instance.setupExperiment, None, start_time, stop_time)
        self._call("fmi2EnterInitializationMode", self._instance.enterInitializationMode)

    def _exit(self) -> None:
        self._call("fmi2ExitInitializationMode", self._instance.exitInitializationMode)
        self._initialized = True

    def _do_step(self, begin: float, size: float) -> float | None:
        said = len(self.messages)
        status = self._step(begin, size, self._no_way_back)
        return None if status <= 1 else self._discarded(status, said, begin, size)

    def _discarded(self, status: int, said: int, begin: float, size: float) -> float:
        """The time up to which a step was completed that is not fmi2OK.

        Raises:
            FmuError: nothing of it was, or the FMU wants to end.
        """
        if status == Status.DISCARD and not self._ends():
            reached = c_double(begin)
            ask = self.raw("fmi2GetRealStatus")
            answer = self.quietly(
                partial(ask, c_void_p(self._instance.component), fmi2LastSuccessfulTime, byref(reached))
            )
            if answer <= Status.WARNING and begin < reached.value < begin + size:
                self._count_short(begin + size, _MOST_DISCARDED)
                return reached.value
        raise self.refusal("fmi2DoStep", status, said)

    def _ends(self) -> bool:
        """Whether the FMU wants the simulation to end."""
        ends = c_int(0)
        ask = self.raw("fmi2GetBooleanStatus")
        answer = self.quietly(partial(ask, c_void_p(self._instance.component), fmi2Terminated, byref(ends)))
        return answer <= Status.WARNING and ends.value != 0

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
        self._logged(status, category, text, "%")

    def _get(self, batch: Batch) -> list[Any]:
        name = _NAMES.get(batch.kind, batch.kind)
        if name == "String":
            texts: list[Any] = self._call("fmi2GetString", self._instance.getString, batch.references)
            return texts
        if batch.bound is None:
            count = len(batch.references)
            numbers = ((c_double if name == "Real" else c_int) * count)()
            where = c_void_p(self._instance.component), (c_uint * count)(*batch.references), c_size_t(count), numbers
            batch.bound = partial(self.raw(f"fmi2Get{name}"), *where), numbers
        call, numbers = batch.bound
        said = len(self.messages)
        status = call()
        if status > Status.WARNING:
            raise self.refusal(f"fmi2Get{name}", status, said)
        return list(numbers)

    def _set(self, batch: Batch, numbers: Sequence[Value]) -> None:
        name = _NAMES.get(batch.kind, batch.kind)
        self._call(f"fmi2Set{name}", getattr(self._instance, f"set{name}"), batch.references, numbers)


#: So many steps in a row an FMU may discard before one that it completes: each may take seconds.
_MOST_DISCARDED = 20
#: Types that have no functions of their own.
_NAMES = {"Enumeration": "Integer"}

"""A saved FMU state as bytes: everything that a replay needs, and a check that nothing else is taken for it."""

from __future__ import annotations

import hashlib
import math
import struct
import zlib
from collections.abc import Sequence
from dataclasses import dataclass

from ..admissible import Admissible
from ..model import MechanismError
from ..model.model import check_value
from .protocol import LATEST_START, SAME_TIME, Experiment, Phase
from .variables import Variable

_MAGIC = b"MechFMU1"
_HEAD = struct.Struct("<8s16sIIIQ")  # magic, fingerprint, phase, parameters, inputs, length of the body
_CHECKSUM = struct.Struct("<I")  # of head and body
_EXPERIMENT = struct.Struct("<ddd")


class SavedStateError(ValueError):
    """Bytes that are not a saved state of this model."""


@dataclass(frozen=True)
class SavedState:
    """What a slave saves.

    Attributes:
        phase: of the slave.
        experiment: None before fmi2SetupExperiment.
        parameters, inputs: values in the order of the model.
        words: the engine's state, 8 bytes a word; empty before initialization.
    """

    phase: Phase
    experiment: Experiment | None
    parameters: tuple[float, ...]
    inputs: tuple[float, ...]
    words: bytes


def fingerprint(parts: Sequence[str]) -> bytes:
    """16 bytes that tell models (and engine layouts) apart."""
    return hashlib.sha256("\0".join(parts).encode()).digest()[:16]


def encode(state: SavedState, mark: bytes) -> bytes:
    """A saved state as bytes; `mark` is the model's fingerprint."""
    numbers = struct.pack(f"<{len(state.parameters) + len(state.inputs)}d", *state.parameters, *state.inputs)
    body = _EXPERIMENT.pack(*_numbers(state.experiment)) + numbers + state.words
    head = _HEAD.pack(_MAGIC, mark, state.phase, len(state.parameters), len(state.inputs), len(body))
    return head + body + _CHECKSUM.pack(zlib.crc32(body, zlib.crc32(head)))


def check(data: bytes, mark: bytes) -> None:
    """Check that bytes are an undamaged saved state of the model `mark`.

    Raises:
        SavedStateError: empty, cut off, changed, or of another model.
    """
    if len(data) < _HEAD.size or data[: len(_MAGIC)] != _MAGIC:
        raise SavedStateError(
            f"The {len(data)} bytes given are not a saved state of this kind of FMU; "
            "give what fmi2SerializeFMUstate wrote."
        )
    _, its_mark, _, _, _, length = _HEAD.unpack_from(data)
    complete = _HEAD.size + length + _CHECKSUM.size
    if len(data) != complete:
        raise SavedStateError(
            f"The saved state has {len(data)} bytes instead of {complete}: it was cut off or extended."
        )
    (checksum,) = _CHECKSUM.unpack(data[-_CHECKSUM.size :])
    if zlib.crc32(data[: -_CHECKSUM.size]) != checksum:
        raise SavedStateError("The saved state was changed after it was written: its checksum does not fit.")
    if its_mark != mark:
        raise SavedStateError("The saved state belongs to another model or another version of this one.")


@dataclass(frozen=True)
class Contents:
    """What a model's saved states may hold.

    Attributes:
        mark: the model's fingerprint.
        variables: of the model, in their order.
        state: what the engine's state may hold.
    """

    mark: bytes
    variables: tuple[Variable, ...]
    state: Admissible

    def of(self, causality: str) -> list[Variable]:
        """The variables of a causality."""
        return [variable for variable in self.variables if variable.causality == causality]


def decode(data: bytes, contents: Contents) -> SavedState:
    """The saved state in `data`; whatever it holds has been checked.

    Raises:
        SavedStateError: see `check`; or it holds what the model's states cannot.
    """
    check(data, contents.mark)
    _, _, phase, parameters, inputs, _ = _HEAD.unpack_from(data)
    known = len(contents.of("parameter")), len(contents.of("input"))
    if (parameters, inputs) != known:
        raise _impossible(f"it has {parameters} parameters and {inputs} inputs instead of {known[0]} and {known[1]}")
    if phase not in list(Phase):
        raise _impossible(f"there is no phase {phase}")
    state = _unpacked(data, phase, parameters, inputs)
    _check_head(state, data)
    for variable, value in zip(contents.of("parameter"), state.parameters, strict=True):
        _check_value(variable, value, value)
        if (variable.type == "Integer" and value != int(value)) or (variable.type == "Boolean" and value not in (0, 1)):
            raise _impossible(f"{variable.name} is {value:g}, which is no {variable.type}")
    for variable, value in zip(contents.of("input"), state.inputs, strict=True):
        low = -math.inf if variable.minimum is None else variable.minimum
        high = math.inf if variable.maximum is None else variable.maximum
        rounding = SAME_TIME * max(1.0, abs(value))  # an input with a slope may end beyond its limit by so much
        near = low - rounding <= value <= high + rounding
        _check_value(variable, min(max(value, low), high) if near else value, value)
    if state.words:
        fault = contents.state.fault(state.words)
        if fault is not None:
            raise _impossible(fault)
    return state


def _impossible(fault: str) -> SavedStateError:
    return SavedStateError(f"The saved state is not one that this model can be in: {fault}.")


def _check_value(variable: Variable, value: float, shown: float) -> None:
    try:
        check_value(variable, value)
    except MechanismError as error:
        raise _impossible(f"{variable.name} is {shown:g} ({error})") from error


def _check_head(state: SavedState, data: bytes) -> None:
    if state.phase >= Phase.STEPPING and not state.words:
        raise _impossible(f"it is in phase {state.phase.name.lower()}, but did not begin")
    if state.phase is not Phase.INSTANTIATED and state.experiment is None:
        raise _impossible(f"it is in phase {state.phase.name.lower()}, but was not set up")
    times = state.experiment
    if times is None:
        if not all(math.isnan(number) for number in _EXPERIMENT.unpack_from(data, _HEAD.size)):
            raise _impossible("its experiment has no start time")
    elif not (abs(times.start_time) <= LATEST_START and times.start_time <= times.stop_time and times.tolerance > 0):
        raise _impossible(
            f"its experiment is from {times.start_time:g} s to {times.stop_time:g} s with tolerance {times.tolerance:g}"
        )


def _unpacked(data: bytes, phase: int, parameters: int, inputs: int) -> SavedState:
    start_time, stop_time, tolerance = _EXPERIMENT.unpack_from(data, _HEAD.size)
    experiment = None if math.isnan(start_time) else Experiment(start_time, stop_time, tolerance)
    first = _HEAD.size + _EXPERIMENT.size
    numbers = struct.unpack_from(f"<{parameters + inputs}d", data, first)
    words = data[first + 8 * len(numbers) : -_CHECKSUM.size]
    return SavedState(Phase(phase), experiment, numbers[:parameters], numbers[parameters:], words)


def _numbers(experiment: Experiment | None) -> tuple[float, float, float]:
    """An experiment as three numbers; that there is none, as NaN."""
    if experiment is None:
        return math.nan, math.nan, math.nan
    return experiment.start_time, experiment.stop_time, experiment.tolerance

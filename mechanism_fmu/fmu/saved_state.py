"""A saved FMU state as bytes: everything that a replay needs, and a check that nothing else is taken for it."""

from __future__ import annotations

import hashlib
import math
import struct
import zlib
from collections.abc import Sequence
from dataclasses import dataclass

from .protocol import Experiment, Phase

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


def decode(data: bytes, mark: bytes) -> SavedState:
    """The saved state in `data`; what it holds is checked elsewhere (`saved_contents.check_contents`).

    Raises:
        SavedStateError: see `check`; or its parts do not fit together.
    """
    check(data, mark)
    _, _, phase, parameters, inputs, _ = _HEAD.unpack_from(data)
    first = _HEAD.size + _EXPERIMENT.size
    if first + 8 * (parameters + inputs) + _CHECKSUM.size > len(data):
        raise SavedStateError(f"The saved state is too short for {parameters} parameters and {inputs} inputs.")
    if phase not in list(Phase):
        raise SavedStateError(f"The saved state is in phase {phase}, which there is not.")
    start_time, stop_time, tolerance = _EXPERIMENT.unpack_from(data, _HEAD.size)
    experiment = None if math.isnan(start_time) else Experiment(start_time, stop_time, tolerance)
    numbers = struct.unpack_from(f"<{parameters + inputs}d", data, first)
    words = data[first + 8 * len(numbers) : -_CHECKSUM.size]
    return SavedState(Phase(phase), experiment, numbers[:parameters], numbers[parameters:], words)


def _numbers(experiment: Experiment | None) -> tuple[float, float, float]:
    """An experiment as three numbers; that there is none, as NaN."""
    if experiment is None:
        return math.nan, math.nan, math.nan
    return experiment.start_time, experiment.stop_time, experiment.tolerance

"""A saved FMU state as bytes: everything that a replay needs, and a check that nothing else is taken for it."""

from __future__ import annotations

import hashlib
import math
import struct
import zlib
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ... import codes
from ...engine import status
from ...model import MechanismError
from ...model.model import check_value
from ...tables.declare import Array, Field, Holds
from ...tables.layout import FIELDS, FIELDS_BY_NAME, shape_of
from ..parts.variables import Variable
from .protocol import LATEST_START, SAME_TIME, Experiment, Phase

# Whether words may be the state of a block: asked before a saved state from outside is copied into one.
#
# The C surface asks the same (`saved_check.c`), from the same rules.

#: What the subject of a guard counts.
SUBJECTS = {
    codes.GUARD_GAP: "contacts",
    codes.GUARD_PUSH: "contacts",
    codes.GUARD_NEXT: "patterns",
    codes.GUARD_PREVIOUS: "patterns",
    codes.GUARD_CLICK: "contacts",
    codes.GUARD_FUNCTION: "functions",
    codes.GUARD_STICK: "rubs",
    codes.GUARD_SLIP: "rubs",
    codes.GUARD_SHOCK: "rubs",
    codes.GUARD_SEVERAL: "rubs",
    codes.GUARD_UNDETERMINED: "rubs",
    codes.GUARD_HANDOVER: "contacts",
}


class Rule(NamedTuple):
    """What some words of the state may hold.

    Attributes:
        name: of the field, and of the column where its columns differ.
        first: the first word, counted from the beginning of the state.
        rows, columns, stride: `rows` times `columns` words, `stride` from row to row.
        integer: whether they are int64, not float64.
        holds: what may stand there, with the size already added to `high`.
    """

    name: str
    first: int
    rows: int
    columns: int
    stride: int
    integer: bool
    holds: Holds


def rules(sizes: dict[str, int]) -> tuple[Rule, ...]:
    """The rules of all words of the state, in its order, for a block's sizes (`layout.sizes_of`)."""
    found: list[Rule] = []
    first = 0
    for field in FIELDS:
        if field.section == "state":
            found += _of_field(field, first, sizes)
            first += math.prod(shape_of(field, sizes))
    return tuple(found)


def _of_field(field: Field, first: int, sizes: dict[str, int]) -> list[Rule]:
    if field.holds is None:
        raise TypeError(f"The field {field.name} of the state does not declare what it holds.")
    shape = shape_of(field, sizes)
    names = field.columns or ("",)
    stride = shape[-1] if len(field.holds) > 1 else math.prod(shape)
    rows = math.prod(shape) // stride if stride else 0
    found = []
    for column, (name, holds) in enumerate(zip(names, field.holds, strict=True)):
        last = column == len(names) - 1
        label = f"{field.name}[{name}]" if name else field.name
        high = holds.high + (sizes[holds.of] if holds.of else 0)
        columns = stride - column if last else 1
        found.append(Rule(label, first + column, rows, columns, stride, field.integer, holds._replace(high=high)))
    return found


@dataclass(frozen=True)
class Admissible:
    """The rules of a block's state, word by word.

    Attributes:
        sizes: of the block.
        names: of each word.
        low, high, integer, whole, nan: as of `Rule`, shape (words,) each.
    """

    sizes: dict[str, int]
    names: tuple[str, ...]
    low: Array
    high: Array
    integer: Array
    whole: Array
    nan: Array

    @classmethod
    def of(cls, sizes: dict[str, int]) -> Admissible:
        """The rules for a block's sizes."""
        by_word: dict[int, Rule] = {}
        for rule in rules(sizes):
            for row in range(rule.rows):
                start = rule.first + row * rule.stride
                by_word |= dict.fromkeys(range(start, start + rule.columns), rule)
        words = [by_word[word] for word in range(len(by_word))]
        return cls(
            sizes,
            tuple(rule.name for rule in words),
            np.array([rule.holds.low for rule in words]),
            np.array([rule.holds.high for rule in words]),
            np.array([rule.integer for rule in words], bool),
            np.array([rule.holds.whole for rule in words], bool),
            np.array([rule.holds.nan for rule in words], bool),
        )

    def fault(self, state: bytes) -> str | None:
        """What is wrong with a state, in words, or None."""
        if len(state) != 8 * len(self.names):
            return f"it has {len(state)} bytes of the engine's state instead of {8 * len(self.names)}"
        words = np.frombuffer(state)
        values = np.where(self.integer, words.view(np.int64).astype(float), words)
        fits = (self.low <= values) & (values <= self.high) & (~self.whole | (values == np.floor(values)))
        fits |= self.nan & np.isnan(values)
        if not fits.all():
            at = int(np.argmin(fits))
            kind = "a whole number" if self.whole[at] else "a number"
            return f"{self.names[at]} is {values[at]:g} instead of {kind} from {self.low[at]:g} to {self.high[at]:g}"
        return self._contradiction(state)

    def _contradiction(self, state: bytes) -> str | None:
        """Words that may each stand where they are, but not together."""
        clock, counters = self._field(state, "clock"), self._field(state, "counters")
        guard, subject = (int(counters[k]) for k in (codes.PENDING_GUARD, codes.PENDING_SUBJECT))
        fits = subject in status.EVENT_FAILURES if guard == codes.GUARD_FAILED else self._fits(guard, subject)
        if not fits:
            return f"its pending event {guard} cannot be about {subject}"
        if clock[codes.TIME] < clock[codes.STEP_END] and not clock[codes.STEP_SIZE] > 0:
            return "its time lies in an internal step of no length"
        for record in self._field(state, "impacts")[: counters[codes.COUNT_IN_STEP]]:
            if record[codes.RECORD_CONTACT] < 0:
                return "it counts an impact without a contact"
        for record in self._field(state, "events")[: counters[codes.EVENTS_IN_STEP]]:
            guard, subject = int(record[codes.EVENT_GUARD]), int(record[codes.EVENT_SUBJECT])
            known = guard in SUBJECTS or guard == codes.GUARD_INPUT
            if not known or not self._fits(guard, subject):
                return f"its event {guard} cannot be about {subject}"
        return None

    def _fits(self, guard: int, subject: int) -> bool:
        if guard in SUBJECTS:
            return 0 <= subject < self.sizes[SUBJECTS[guard]]
        return subject == codes.NONE

    def _field(self, state: bytes, name: str) -> Array:
        field = FIELDS_BY_NAME[name]
        first = sum(math.prod(shape_of(f, self.sizes)) for f in FIELDS[: FIELDS.index(field)] if f.section == "state")
        shape = shape_of(field, self.sizes)
        kind = np.int64 if field.integer else np.float64
        return np.frombuffer(state, kind, math.prod(shape), 8 * first).reshape(shape)


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
    """16 bytes that distinguish models (and engine layouts)."""
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
    """The saved state in `data`; what it holds is checked elsewhere (`check_contents`).

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


# Whether a saved state from outside is one that its model can be in: asked before anything of it is used.


class CheckedState(bytes):
    """A saved state that a slave has made itself, or whose contents have been checked."""


@dataclass(frozen=True)
class Contents:
    """What a model's saved states may hold.

    Attributes:
        parameters, inputs: of the model, in their order.
        state: what the engine's state may hold.
    """

    parameters: tuple[Variable, ...]
    inputs: tuple[Variable, ...]
    state: Admissible


def check_contents(state: SavedState, contents: Contents) -> None:
    """Check a decoded state.

    Raises:
        SavedStateError: it cannot have been saved, with what it holds where.
    """
    for variables, values in ((contents.parameters, state.parameters), (contents.inputs, state.inputs)):
        if len(variables) != len(values):
            raise _impossible(f"it has {len(values)} values for {len(variables)} variables")
    _check_head(state)
    for variable, value in zip(contents.parameters, state.parameters, strict=True):
        _check_parameter(variable, value)
    for variable, value in zip(contents.inputs, state.inputs, strict=True):
        _check_input(variable, value)
    fault = contents.state.fault(state.words) if state.words else None
    if fault is not None:
        raise _impossible(fault)


def _impossible(fault: str) -> SavedStateError:
    return SavedStateError(f"The saved state is not one that this model can be in: {fault}.")


def _check_head(state: SavedState) -> None:
    phase, times = state.phase.name.lower(), state.experiment
    if state.phase >= Phase.STEPPING and not state.words:
        raise _impossible(f"it is in phase {phase}, but did not begin")
    if state.phase is not Phase.INSTANTIATED and times is None:
        raise _impossible(f"it is in phase {phase}, but was not set up")
    if times is None:
        return
    if not (abs(times.start_time) <= LATEST_START and times.start_time <= times.stop_time and times.tolerance > 0):
        experiment = f"from {times.start_time:g} s to {times.stop_time:g} s with tolerance {times.tolerance:g}"
        raise _impossible(f"its experiment is {experiment}")


def _check_parameter(variable: Variable, value: float) -> None:
    try:
        check_value(variable, value)
    except MechanismError as error:
        raise _impossible(str(error).removesuffix(".")) from error
    if (variable.type == "Integer" and value != int(value)) or (variable.type == "Boolean" and value not in (0, 1)):
        raise _impossible(f"{variable.name} is {value:g}, which is no {variable.type}")


def _check_input(variable: Variable, value: float) -> None:
    low = -math.inf if variable.minimum is None else variable.minimum
    high = math.inf if variable.maximum is None else variable.maximum
    rounding = SAME_TIME * max(1.0, abs(value))  # an input with a slope may end beyond its limit by so much
    if not (math.isfinite(value) and low - rounding <= value <= high + rounding):
        raise _impossible(f"{variable.name} is {value:g}, which is not within its limits, {low:g} to {high:g}")

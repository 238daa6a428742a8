"""Whether words may be the state of a block: asked before a saved state from outside is copied into one.

The C surface asks the same (`saved_check.c`), from the same rules.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from . import codes
from .engine import status
from .tables.contents import Holds
from .tables.declare import Array, Field
from .tables.layout import FIELDS, FIELDS_BY_NAME, shape_of

#: What the subject of a guard counts.
SUBJECTS = {
    codes.GUARD_GAP: "contacts",
    codes.GUARD_PUSH: "contacts",
    codes.GUARD_NEXT: "patterns",
    codes.GUARD_PREVIOUS: "patterns",
    codes.GUARD_CLICK: "contacts",
    codes.GUARD_FUNCTION: "functions",
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
        if field.room == "state":
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
            told = guard in SUBJECTS or guard == codes.GUARD_INPUT
            if not told or not self._fits(guard, subject):
                return f"its event {guard} cannot be about {subject}"
        return None

    def _fits(self, guard: int, subject: int) -> bool:
        if guard in SUBJECTS:
            return 0 <= subject < self.sizes[SUBJECTS[guard]]
        return subject == codes.NONE

    def _field(self, state: bytes, name: str) -> Array:
        field = FIELDS_BY_NAME[name]
        first = sum(math.prod(shape_of(f, self.sizes)) for f in FIELDS[: FIELDS.index(field)] if f.room == "state")
        shape = shape_of(field, self.sizes)
        kind = np.int64 if field.integer else np.float64
        return np.frombuffer(state, kind, math.prod(shape), 8 * first).reshape(shape)

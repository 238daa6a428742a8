"""Job of a batch: designs, what is asked of each, and arrays for the results, shared by threads."""

from __future__ import annotations

import ctypes
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from .. import codes
from ..tables.layout import scratch_begins
from ..tables.sizes import sizes_of
from .numbers import Array


@dataclass(frozen=True)
class Job:
    """Designs that differ in some words of their blocks, and take the same communication steps.

    Attributes:
        words: length of a block.
        given: what a block holds before its first call: tables and state, shape (words before the scratch,).
        varied_word: the words that differ, shape (varied,).
        varied_value: what stands there, shape (designs, varied).
        times: start, then the end of each communication step [s], shape (points + 1,).
        driven_word: the words of the inputs that signals drive, shape (driven,).
        driven_value: their values, held in each step, shape (points, driven).
        read_output: numbers of the outputs that are read, shape (read,).
        impact_field: columns of an impact record that are kept, shape (fields,).
        until_impact: stop right after the first impact.
        values: of the outputs at the end, shape (designs, read).
        least, greatest: likewise, over the start, the ends of steps and the end; with no rows if not asked for.
        impacts: the first impacts of each design, shape (designs, kept, fields).
        reached: time reached [s], shape (designs,).
        pulled: when each guided contact first pulled [s], shape (designs, contacts); infinite: never.
        impact_count: shape (designs,).
        status: shape (designs,); those that are not `status.OK` are left out.
        next: number of the design that is taken next, shape (1,).
        events: guard and subject of the first events of each design, shape (designs, kept, 2); before them, as events
            `codes.GUARD_BEGIN`, how the motion begins: closed contacts, and behind their numbers what sticks.
        event_count: shape (designs,).
    """

    words: int
    given: Array
    varied_word: Array
    varied_value: Array
    times: Array
    driven_word: Array
    driven_value: Array
    read_output: Array
    impact_field: Array
    until_impact: bool
    values: Array
    least: Array
    greatest: Array
    impacts: Array
    reached: Array
    pulled: Array
    impact_count: Array
    status: Array
    next: Array
    events: Array
    event_count: Array

    @classmethod
    def blank(
        cls,
        given: Array,
        *,
        times: Array,
        drivers: Mapping[int, Array],
        outputs: Sequence[int],
        fields: Sequence[int],
        designs: int,
        kept: int,
        extremes: bool,
        until_impact: bool,
        events: int = 0,
    ) -> Job:
        """A job without answers, whose designs do not differ yet.

        Args:
            given: a block before its first call, shape (words,).
            times: start, and ends of the steps [s].
            until_impact: as of the class.
            events: how many of each design are kept.
            drivers: values of inputs for each communication step, by the input's word.
            outputs: as `read_output`.
            fields: as `impact_field`.
            designs: how many.
            kept: how many impacts of each.
            extremes: whether `least` and `greatest` are asked for.
        """
        looked = designs if extremes else 0
        return cls(
            words=len(given),
            given=given[: scratch_begins(given)].copy(),
            varied_word=np.empty(0, np.int64),
            varied_value=np.empty((designs, 0)),
            times=times,
            driven_word=np.array(list(drivers), np.int64),
            driven_value=np.array([*drivers.values()], float).reshape(len(drivers), len(times) - 1).T.copy(),
            read_output=np.array(outputs, np.int64),
            impact_field=np.array(fields, np.int64),
            until_impact=until_impact,
            values=np.full((designs, len(outputs)), np.nan),
            least=np.full((looked, len(outputs)), np.nan),
            greatest=np.full((looked, len(outputs)), np.nan),
            impacts=np.full((designs, kept, len(fields)), np.nan),
            reached=np.full(designs, np.nan),
            pulled=np.full((designs, sizes_of(given)["contacts"]), np.inf),
            impact_count=np.zeros(designs, np.int64),
            status=np.zeros(designs, np.int64),
            next=np.zeros(1, np.int64),
            events=np.full((designs, events, 2), codes.NONE, np.int64),
            event_count=np.zeros(designs, np.int64),
        )

    def part(self, designs: slice) -> Job:
        """Some of the designs as a job of its own, which writes its answers here."""
        own = {name: getattr(self, name)[designs] for name in _OF_DESIGNS}
        return replace(self, **own, next=np.zeros(1, np.int64))

    def forget_values(self, designs: Sequence[int]) -> None:
        """Outputs of failed designs are no numbers."""
        for values in (self.values, *((self.least, self.greatest) if len(self.least) else ())):
            values[designs] = np.nan


#: What a job finds.
_FOUND = ("values", "least", "greatest", "impacts", "reached", "pulled", "impact_count", "status")

#: Arrays with a row for each design.
_OF_DESIGNS = ("varied_value", *_FOUND, "events", "event_count")


#: The order of the C structure: sizes, then addresses.
_ARRAYS = (
    "given",
    "varied_word",
    "varied_value",
    "times",
    "driven_word",
    "driven_value",
    "read_output",
    "impact_field",
    *_FOUND,
    "next",
    "events",
    "event_count",
)
_SIZES = ("words", "given_words", "designs", "varied", "points", "driven", "read", "fields", "kept", "until_impact")


class CJob(ctypes.Structure):
    """A job as `fmu/native/c/many.c` declares it."""

    _fields_ = (
        *((name, ctypes.c_int64) for name in _SIZES),
        *((name, ctypes.c_void_p) for name in _ARRAYS),
        ("kept_events", ctypes.c_int64),
    )


def as_c(job: Job) -> CJob:
    """A job for C, which holds the addresses of the job's arrays: keep the job as long."""
    sizes = (
        job.words,
        len(job.given),
        len(job.status),
        len(job.varied_word),
        len(job.times) - 1,
        len(job.driven_word),
        len(job.read_output),
        len(job.impact_field),
        job.impacts.shape[1],
        int(job.until_impact),
    )
    for name in _ARRAYS:
        assert getattr(job, name).flags.c_contiguous, name
    arrays = (getattr(job, name).ctypes.data if getattr(job, name).size else None for name in _ARRAYS)
    return CJob(*sizes, *arrays, job.events.shape[1])

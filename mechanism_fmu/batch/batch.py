"""Batch simulation: a model made ready for many designs."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from ctypes import CDLL, c_void_p
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from .. import codes
from ..engine.run import load
from ..fmu.instance.news import pulls
from ..fmu.native.objects import Report, library_here, silently
from ..model import Mechanism, MechanismError, Model
from ..model.event_names import event_name
from ..processors import processors
from .job import Job
from .numbers import Array, BatchResult, Numbers
from .origin import NoBatchError, model_of_fmu
from .prepared import (
    Prepared,
    Refusals,
    columns_of,
    impossible,
    out_of_limits,
    outputs_of,
    points_of,
    prepared,
    said_of,
    signals_of,
)
from .workers import Progress, no_callback, run_job

# The engine's shared library with the call that runs many designs.


def load_many(path: Path | None) -> CDLL | None:
    """The engine's library in a file; None where there is none, or one without this call, or none for this system."""
    library = None if path is None else load(path)
    if library is None or not hasattr(library, "engine_many"):
        return None
    library.engine_many.argtypes, library.engine_many.restype = (c_void_p, c_void_p), None
    return library


#: Designs whose tables are in memory at the same time.
_CHUNK = 4096


@dataclass(frozen=True)
class Batch:
    """A model made ready for many designs. Make one of a model, or `of_fmu`.

    Where the engine's library is not given, it is the one that the installation has compiled, or that the extra `dev`
    compiles once for each state of its sources (one or two minutes) and keeps in the user's cache directory. Without
    either, it is compiled just in time, in every process.

    Attributes:
        model: it.
        library: path of the engine's shared library, or None.
        report: see `mechanism_fmu.fmu.native.objects.compiled_engine`.

    Source: that of `Simulation`, for many designs at once: docs/decisions/018-batch.md.
    """

    model: Model
    library: Path | None = None
    report: Report = silently

    @classmethod
    def of_fmu(cls, path: Path) -> Batch:
        """The model of an FMU by pythonfmu, from the sources that travel in it, and the engine that does.

        Args:
            path: of the FMU's file.

        Raises:
            NoBatchError: not with the numbers of this FMU; the message says why.
        """
        batch = cls(*model_of_fmu(path))
        try:
            batch._prepared  # noqa: B018  (what cannot be traced is better reported now)
        except MechanismError as error:
            raise NoBatchError(f"Only the FMU itself can run its designs: {error}") from error
        return batch

    @property
    def compiled(self) -> str:
        """How the engine is compiled: "ahead of time" or "just in time"."""
        return "just in time" if self._engine is None else "ahead of time"

    def run(
        self,
        designs: Mapping[str, ArrayLike],
        times: Sequence[float],
        outputs: Iterable[str] | None = None,
        *,
        signals: Mapping[str, ArrayLike] | None = None,
        impacts: int = 1,
        extremes: bool = False,
        until_impact: bool = False,
        events: int = 0,
        threads: int | None = None,
        progress: Progress = no_callback,
    ) -> BatchResult:
        """Run designs: the motions that the FMU makes with these start values and communication points.

        A design that fails leaves the others alone, and the result says why it did. Neither the order of the designs
        nor the number of threads changes a bit.

        Args:
            designs: columns of parameters and inputs by name, in SI units, of one length. An input holds its value.
                What is not named has its start value.
            times: the start, then the end of each communication step [s].
            outputs: names of the outputs and calculated parameters that are wanted; None: all.
            signals: values of inputs, held in each communication step, by name; for all designs alike.
            impacts: how many impacts of each design are kept, from the first.
            extremes: whether to keep the least and greatest values that the outputs have at the start, at communication
                points and at the end.
            until_impact: whether to stop each design right after its first impact.
            events: how many events of each design are kept, from the first.
            threads: how many; None: as many as this process may use (`mechanism_fmu.processors`).
            progress: called a few times a second with how many designs are done, and of how many.

        Raises:
            MechanismError: a name, a length or a time that cannot be.
        """
        ready = self._prepared
        columns, points = columns_of(ready, designs), points_of(times)
        count = len(next(iter(columns.values())))
        driven = signals_of(ready, signals or {}, len(points) - 1)
        wanted = outputs_of(ready, outputs)
        job = Job.blank(
            ready.given,
            times=points,
            drivers={ready.inputs[name]: column for name, column in driven.items()},
            outputs=[ready.outputs[name] for name in wanted],
            fields=list(ready.impact_fields.values()),
            designs=count,
            kept=impacts,
            extremes=extremes,
            until_impact=until_impact,
            events=events,
        )
        threads = max(1, min(threads or processors(), count))
        failures: Refusals = {}
        warnings: Refusals = {}
        for first in range(0, count, _CHUNK):
            here = slice(first, min(first + _CHUNK, count))

            def so_far(done: int, _all: int, first: int = first) -> None:
                progress(first + done, count)

            part, refused, warned = self._tables(
                job.part(here), {name: column[here] for name, column in columns.items()}
            )
            refused |= run_job(part, ready.mechanism, self._engine, threads, so_far)
            failures |= {first + design: text for design, text in refused.items()}
            warnings |= {first + design: text for design, text in warned.items() if design not in refused}
        job.forget_values(list(failures))
        contacts = [contact.name for contact in ready.mechanism.contacts]
        names = list(enumerate(wanted))
        return BatchResult(
            designs=columns,
            values={name: job.values[:, k] for k, name in names},
            least={name: job.least[:, k] for k, name in names if extremes},
            greatest={name: job.greatest[:, k] for k, name in names if extremes},
            impact_count=job.impact_count,
            impacts={name: job.impacts[:, :, k] for k, name in enumerate(ready.impact_fields)},
            reached=job.reached,
            events=tuple(_events(ready.mechanism, job, k) for k in range(count)),
            pulled={name: job.pulled[:, c] for c, name in enumerate(contacts)},
            failures=tuple(failures.get(design, "") for design in range(count)),
            warnings=tuple(_warned(warnings.get(k, ""), contacts, job.pulled[k]) for k in range(count)),
            compiled=self.compiled,
            threads=threads,
        )

    @cached_property
    def _prepared(self) -> Prepared:
        return prepared(self.model)

    @cached_property
    def _same(self) -> dict[frozenset[str], dict[int, float]]:
        """What the designs have in common that vary the same parameters (see `Numbers`)."""
        return {}

    @cached_property
    def _engine(self) -> CDLL | None:
        given = load_many(self.library)
        return load_many(library_here(self.report)) if given is None else given

    def _tables(self, job: Job, columns: Mapping[str, Array]) -> tuple[Job, Refusals, Refusals]:
        """The job with the tables of its designs, those of them that are refused, and what the others are warned of."""
        ready, count = self._prepared, len(job.status)
        refused = out_of_limits(self.model, ready.mechanism.inputs, columns)
        values = {p.name: columns.get(p.name, p.start) for p in self.model.parameters}
        numbers = Numbers(ready.traced, values, self._same.setdefault(frozenset(columns), {}))
        refused = impossible(ready.traced, numbers, ready.entries, count) | refused
        words = {ready.inputs[name]: column for name, column in columns.items() if name in ready.inputs}
        words |= dict(zip((e.word for e in ready.entries), numbers.of(e.value for e in ready.entries), strict=True))
        given = job.given.copy()
        varied = {word: column for word, column in words.items() if np.ndim(column)}
        for word, value in words.items():
            if not np.ndim(value):
                given[word] = value
        job.status[list(refused)] = -1
        return (
            replace(
                job,
                given=given,
                varied_word=np.array(list(varied), np.int64),
                varied_value=np.array(list(varied.values())).T.copy() if varied else np.empty((count, 0)),
            ),
            refused,
            said_of(ready.traced.warnings, numbers, count, between="\n"),
        )


def _events(mechanism: Mechanism, job: Job, design: int) -> tuple[str, ...]:
    """Names of the events of a design, behind how its motion begins."""
    count = min(job.event_count.item(design), job.events.shape[1])
    return tuple(_event(mechanism, guard, subject) for guard, subject in job.events[design, :count].tolist())


def _event(mechanism: Mechanism, guard: int, subject: int) -> str:
    if guard == codes.GUARD_NONE:
        return "one of many at one instant"
    if guard != codes.GUARD_BEGIN:
        return event_name(mechanism, guard, subject)
    contacts = len(mechanism.contacts)
    if subject < contacts:
        return f"{mechanism.contacts[subject].name} is closed at the start"
    return f"{mechanism.rubbing[subject - contacts].name} sticks at the start"


def _warned(text: str, contacts: Sequence[str], times: Array) -> str:
    """What is said at the start, and of each contact that has pulled, in the order of time; a line each."""
    pulled = sorted((time, name) for name, time in zip(contacts, times.tolist(), strict=True) if time < math.inf)
    return "\n".join(filter(None, (text, *(pulls(name, time).text for time, name in pulled))))

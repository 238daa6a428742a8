"""Every event of a run, from the FMU's buffer of the events of the last communication step."""

from __future__ import annotations

from collections.abc import Mapping

import pandas as pd

from mechanism_fmu.statechart import Logic, taken

from .buffers import Buffer
from .description import Description, Value
from .logic import LogicFile
from .slave import Observable

_COUNT = "event_count"
_FIELDS = ("time", "guard", "subject", "old_mode", "new_mode", "impulse")

#: Columns of the table of events, with their units.
UNITS = {"time": "s", "guard": "1", "old_mode": "1", "new_mode": "1", "impulse": "N.s"}


class EventCollector:
    """An observer that keeps the events in `events[1].time`, `events[1].guard`, ... after every step.

    Attributes:
        tells: whether the FMU has these variables; one without them has no events to tell.
        lost: events that did not fit into the buffer, when the FMU counts all in `event_count`.
    """

    def __init__(self, description: Description) -> None:
        self._buffer = Buffer(description, "events", _FIELDS)
        self._counts = _COUNT in description.variables
        self._rows: list[list[Value]] = []
        self.tells = bool(self._buffer.fields)
        self.lost = 0

    def started(self, unit: Observable, time: float) -> None:
        """No step, no event."""

    def stepped(self, unit: Observable, time: float) -> None:
        """Keep the events of the step that ends at `time`."""
        new = self._buffer.read(unit)
        self._rows += new
        if new and self._counts:
            self.lost = int(unit.get((_COUNT,))[0]) - len(self._rows)

    def table(self, logic: LogicFile) -> pd.DataFrame:
        """One row for each event, in the order of time, in words: the columns of `UNITS`."""
        rows = [
            (time, logic.event(int(guard), int(subject)), logic.mode(int(old)), logic.mode(int(new)), impulse)
            for time, guard, subject, old, new, impulse in self._rows
        ]
        return pd.DataFrame(rows, columns=list(UNITS))


def counts_of(logic: Logic, events: pd.DataFrame) -> Mapping[int, int]:
    """How often each transition of `logic` happened, by its place."""
    counts = dict.fromkeys(range(len(logic.transitions)), 0)
    for _, guard, old, new, impulse in events.itertuples(index=False):
        for place in taken(logic, str(guard), str(old).split("+"), str(new).split("+"), float(impulse)):
            counts[place] += 1
    return counts

"""Every event of a run, from the FMU's buffer of the events of the last communication step."""

from __future__ import annotations

import re
from collections.abc import Mapping

import pandas as pd

from mechanism_fmu.statechart import Logic, taken

from .description import Description, Value
from .logic import LogicFile
from .slave import Slave

_BUFFERED = re.compile(r"events\[(\d+)\]\.(\w+)")
_IN_STEP = "events_in_step"
_COUNT = "event_count"
_FIELDS = ("time", "guard", "subject", "old_mode", "new_mode", "impulse")

#: Columns of the table of events, with their units.
UNITS = {"time": "s", "guard": "1", "old_mode": "1", "new_mode": "1", "impulse": "N.s"}


class EventCollector:
    """An observer that keeps the events in `events[1].time`, `events[1].guard`, ... after every step.

    The number of them is read from `events_in_step`. An FMU without these variables has no events to tell.

    Attributes:
        lost: events that did not fit into the buffer, when the FMU counts all in `event_count`.
    """

    def __init__(self, description: Description) -> None:
        slots: dict[int, set[str]] = {}
        for name in description.variables:
            match = _BUFFERED.fullmatch(name)
            if match is not None:
                slots.setdefault(int(match[1]), set()).add(match[2])
        whole = sorted(slot for slot, fields in slots.items() if fields >= set(_FIELDS))
        self.tells = bool(whole) and _IN_STEP in description.variables
        self._slots = [[f"events[{slot}].{field}" for field in _FIELDS] for slot in whole]
        self._counts = _COUNT in description.variables
        self._rows: list[list[Value]] = []
        self.lost = 0

    def started(self, slave: Slave, time: float) -> None:
        """No step, no event."""

    def stepped(self, slave: Slave, time: float) -> None:
        """Keep the events of the step that ends at `time`."""
        if not self.tells:
            return
        count = int(slave.get((_IN_STEP,))[0])
        for slot in self._slots[:count]:
            self._rows.append(slave.get(slot))
        if count and self._counts:
            self.lost = int(slave.get((_COUNT,))[0]) - len(self._rows)

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

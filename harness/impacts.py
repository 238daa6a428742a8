"""Every impact of a run, from the FMU's buffer of the impacts of the last communication step."""

from __future__ import annotations

import re

import pandas as pd

from .description import Description, Value, Variable
from .slave import Slave

_BUFFERED = re.compile(r"impacts\[(\d+)\]\.(\w+)")
_IN_STEP = "impacts_in_step"
_LOST = "impacts_lost"


class ImpactCollector:
    """An observer that keeps the impacts in `impacts[1].time`, `impacts[1].velocity`, ... after every step.

    The number of them is read from `impacts_in_step`. An FMU without these variables has no impacts.

    Attributes:
        fields: what is known of an impact, in the FMU's order; the first slot's variables by field name.
        lost: impacts that did not fit into the buffer (`impacts_lost` of the FMU).
    """

    def __init__(self, description: Description) -> None:
        slots: dict[int, dict[str, Variable]] = {}
        for name, variable in description.variables.items():
            match = _BUFFERED.fullmatch(name)
            if match is not None:
                slots.setdefault(int(match[1]), {})[match[2]] = variable
        complete = bool(slots) and _IN_STEP in description.variables
        self.fields: dict[str, Variable] = slots[min(slots)] if complete else {}
        self.lost = 0
        self._slots = [slots[number] for number in sorted(slots)] if complete else []
        self._counts_lost = complete and _LOST in description.variables
        self._rows: list[list[Value]] = []

    def started(self, slave: Slave, time: float) -> None:
        """No step, no impact."""

    def stepped(self, slave: Slave, time: float) -> None:
        """Keep the impacts of the step that ends at `time`."""
        if not self._slots:
            return
        count = int(slave.get((_IN_STEP,))[0])
        for slot in self._slots[:count]:
            self._rows.append(slave.get([slot[field].name for field in self.fields]))
        if count and self._counts_lost:
            self.lost = int(slave.get([_LOST])[0])

    def table(self) -> pd.DataFrame:
        """One row for each impact, in the order of time, with a column for each field."""
        return pd.DataFrame(self._rows, columns=list(self.fields))

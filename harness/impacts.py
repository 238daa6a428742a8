"""Every impact of a run, from the FMU's buffer of the impacts of the last communication step."""

from __future__ import annotations

import pandas as pd

from .buffers import Buffer
from .description import Description, Value
from .slave import Observable

_LOST = "impacts_lost"


class ImpactCollector:
    """An observer that keeps the impacts in `impacts[1].time`, `impacts[1].velocity`, ... after every step.

    An FMU without these variables has no impacts.

    Attributes:
        fields: what is known of an impact, in the FMU's order; the first slot's variables by field name.
        lost: impacts that did not fit into the buffer (`impacts_lost` of the FMU).
    """

    def __init__(self, description: Description) -> None:
        self._buffer = Buffer(description, "impacts")
        self._counts_lost = _LOST in description.variables
        self._rows: list[list[Value]] = []
        self.fields = self._buffer.fields
        self.lost = 0

    def started(self, unit: Observable, time: float) -> None:
        """No step, no impact."""

    def stepped(self, unit: Observable, time: float) -> None:
        """Keep the impacts of the step that ends at `time`."""
        new = self._buffer.read(unit)
        self._rows += new
        if new and self._counts_lost:
            self.lost = int(unit.get((_LOST,))[0])

    def table(self) -> pd.DataFrame:
        """One row for each impact, in the order of time, with a column for each field."""
        return pd.DataFrame(self._rows, columns=list(self.fields))

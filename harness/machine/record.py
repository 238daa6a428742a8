"""Chosen signals of a machine, recorded to a file while it runs, whatever happens to it."""

from __future__ import annotations

import time as clock
from array import array
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ..description import Variable, not_in_step_mode
from ..errors import UsageError
from ..recorder import recorded_variables
from ..slave import Observable
from .growing_table import Column, GrowingTable
from .impacts import Impacts
from .machine import Machine
from .readings import readings

#: So many numbers are kept before they are written: 1 MB.
_CHUNK = 1 << 17
#: What is lost at most when this process is killed [s].
_PATIENCE = 5.0

_NUMBERS = ("Real", "Integer", "Boolean")


class Recorder:
    """An observer that keeps signals in a file, with constant memory.

    The first and the last communication point are always kept, and where there was an impact, both the point there and
    the one before: between them lies the jump.

    Attributes:
        units: of the columns, "1" for numbers without one.
    """

    def __init__(
        self,
        machine: Machine,
        path: Path,
        signals: Sequence[str] | None = None,
        every: int = 1,
        impacts: Impacts | None = None,
    ) -> None:
        """Open the file.

        Args:
            machine: whose signals they are.
            path: `.parquet` or `.csv`.
            signals: names, in the order of the columns; None: all inputs and outputs that are numbers.
            every: so many communication points become one row; 1: the end of each step, also those that an algorithm
                adds between them.
            impacts: another observer, before this one: tells where there were impacts.

        Raises:
            UsageError: a signal that does not exist or is no number, or the disk refuses.
        """
        if every < 1:
            raise UsageError(f"Every {every}-th communication point cannot be recorded; give 1 or more.")
        variables = _variables(machine, signals)
        columns = [Column("time", "Real", "s"), *(Column(v.name, _kept_as(v), v.unit) for v in variables)]
        self.units = {column.name: column.unit or "1" for column in columns}
        self._groups = readings(machine, variables)
        read = ["time", *(name for group in self._groups for name in group.names)]
        self._order = [read.index(column.name) for column in columns]
        self._table = GrowingTable(path, columns)
        self._machine, self._every, self._impacts = machine, every, impacts
        self._row: list[float] = []
        self._row_kept = True
        self._numbers = array("d")
        self._written = clock.monotonic()

    def started(self, unit: Observable, time: float) -> None:
        """Keep the initial values."""
        self._read(time)
        self._keep()

    def stepped(self, unit: Observable, time: float) -> None:
        """Keep the values at the end of a step, or pass them over.

        Raises:
            UsageError: the disk refuses.
        """
        struck = self._impacts is not None and self._impacts.struck
        if struck:
            self._keep()
        self._read(time)
        if struck or self._due():
            self._keep()

    def finish(self) -> Path:
        """Keep the last communication point, and make one file of all; to be called however the run ended.

        Raises:
            UsageError: the disk refuses; the message says where everything is.
        """
        self._keep()
        self._write()
        return self._table.finish()

    def _due(self) -> bool:
        point = self._machine.point
        return self._every == 1 or (point is not None and point % self._every == 0)

    def _read(self, time: float) -> None:
        row = [time]
        for group in self._groups:
            row += group.read()
        self._row, self._row_kept = row, False

    def _keep(self) -> None:
        """Keep the last row, unless it is kept already."""
        if self._row_kept:
            return
        self._numbers.extend(self._row)
        self._row_kept = True
        if len(self._numbers) >= _CHUNK or clock.monotonic() - self._written > _PATIENCE:
            self._write()

    def _write(self) -> None:
        if self._numbers:
            self._table.append(np.array(self._numbers).reshape(-1, len(self._order))[:, self._order])
            self._numbers = array("d")
        self._written = clock.monotonic()


def _kept_as(variable: Variable) -> str:
    """The type of a column; integers of 64 bits are Reals there, as rows are doubles."""
    return "Real" if variable.fmi_type in ("Int64", "UInt64") else variable.type


def _variables(machine: Machine, signals: Sequence[str] | None) -> list[Variable]:
    if signals is None:
        return recorded_variables(machine.description)
    variables = [machine.description.variable(name) for name in dict.fromkeys(signals)]
    for variable in variables:
        if variable.in_event_mode_only:
            raise UsageError(f"{not_in_step_mode(variable)}; leave it out.")
        if variable.type not in _NUMBERS:
            raise UsageError(f"'{variable.name}' is of type {variable.type}; only numbers can be recorded.")
    return variables

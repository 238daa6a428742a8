"""Recorder of a machine's signals: to a file while it runs, whatever happens to it."""

from __future__ import annotations

import re
import time as clock
from array import array
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...errors import UsageError
from ...fmu.description import Description, Variable, not_in_step_mode
from ...fmu.interface import Component, Observable, Reals
from ...run.master import recorded_variables
from ..connection import own_of, part_of
from ..machine import Machine
from .component_impacts import Impacts
from .growing_table import Column, GrowingTable

# Which variables of a machine are recorded.

_NUMBERS = ("Real", "Integer", "Boolean")


def chosen(patterns: Iterable[str], description: Description) -> list[Variable]:
    """The variables that patterns choose, each once, in the machine's order.

    A name chooses its variable, whatever it is, if it is a number; a pattern, in which * stands for any text, chooses
    among inputs and outputs.
    """
    usual = {variable.name for variable in recorded_variables(description)}
    wanted: set[str] = set()
    for pattern in patterns:
        if pattern in description.variables:
            wanted.add(pattern)
            continue
        expression = re.compile(".*".join(re.escape(part) for part in pattern.split("*")))
        wanted |= {name for name in usual if expression.fullmatch(name)}
    known = description.variables.values()
    return [v for v in known if v.name in wanted and v.type in _NUMBERS and not v.in_event_mode_only]


# Reading variables of a machine that are numbers, component by component.


@dataclass(frozen=True)
class Reading:
    """Signals of one component.

    Attributes:
        names: in the machine, in the order of what is read.
    """

    names: tuple[str, ...]
    component: Component
    reals: Reals | None
    others: tuple[str, ...]

    def read(self) -> list[float]:
        """What they are now."""
        values: list[float] = []
        if self.reals is not None:
            self.reals.read()
            values += self.reals.values
        if self.others:
            values += map(float, self.component.get(self.others))
        return values


def readings(machine: Machine, variables: Sequence[Variable]) -> list[Reading]:
    """What to read, and how: a reading for each part that has some of the variables, bound before the run."""
    groups = []
    for part in machine.parts:
        own = [variable for variable in variables if part_of(variable.name) == part]
        reals = [variable.name for variable in own if variable.type == "Real"]
        others = [variable.name for variable in own if variable.type != "Real"]
        if own:
            component = machine.parts[part].component
            bound = component.reals([own_of(name) for name in reals]) if reals else None
            groups.append(Reading((*reals, *others), component, bound, tuple(map(own_of, others))))
    return groups


#: So many numbers are kept before they are written: 1 MB.
_CHUNK = 1 << 17
#: What is lost at most when this process is killed [s].
_PATIENCE = 5.0


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
            impacts: another observer, before this one: knows where there were impacts.

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
        """Keep the initial values.

        Args:
            unit: that is simulated.
            time: of the start [s].
        """
        self._read(time)
        self._keep()

    def stepped(self, unit: Observable, time: float) -> None:
        """Keep the values at the end of a step, or pass them over.

        Args:
            unit: that is simulated.
            time: that is reached [s].

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

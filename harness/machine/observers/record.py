"""Recorder of a machine's signals: to a file while it runs, whatever happens to it."""

from __future__ import annotations

import re
import shutil
import time as clock
from array import array
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pandas as pd

from mechanism_fmu import __version__

from ...errors import UsageError
from ...fmu.description import Description, Variable, not_in_step_mode
from ...fmu.interface import Component, Observable, Reals
from ...run.master import recorded_variables
from ...run.results import prepare_folder, write_binary, write_text
from ..connection import own_of, part_of
from ..machine import Machine
from .component_impacts import Impacts

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


# A table on the disk that grows, such that the process may end at any moment.
#
#     FOLDER/results.parts/000001.parquet, ...    rows as they come
#     FOLDER/results.parquet                      all of them; written last
#
# Every file is written under another name and then renamed, so it is there as a whole or not at all; the parts go only
# when the table is there (docs/decisions/016). With `results.csv`, the parts are CSV files, too.

#: What a suffix stands for.
FORMATS = (".parquet", ".csv")

_DTYPES = {"Real": "float64", "Integer": "int64", "Boolean": "bool"}


@dataclass(frozen=True)
class Column:
    """One column.

    Attributes:
        name: its heading; in CSV files, the unit stands behind it.
        type: "Real", "Integer" or "Boolean".
        unit: "" for none.
    """

    name: str
    type: str
    unit: str


class GrowingTable:
    """A table that is written part by part.

    Attributes:
        path: of the whole table, when it is finished.
        parts: the folder of its parts, until then.
    """

    def __init__(self, path: Path, columns: Sequence[Column]) -> None:
        """Begin with no rows; parts of another run that was killed are removed, a finished table is left until the end.

        Raises:
            UsageError: neither Parquet nor CSV, or the disk refuses.
        """
        if path.suffix not in FORMATS:
            raise UsageError(f"'{path}' is none of the files that can be recorded: {', '.join(FORMATS)}.")
        self.path = path
        self.parts = path.with_suffix(".parts")
        self._columns = tuple(columns)
        if path.suffix == ".parquet":
            self._schema()  # what is missing is said before the run
        shutil.rmtree(self.parts, ignore_errors=True)
        prepare_folder(self.parts)
        self._count = 0

    def append(self, rows: npt.NDArray[np.float64]) -> None:
        """Write rows; when this returns, they can be read by others.

        Args:
            rows: shape (rows, columns).

        Raises:
            UsageError: the disk refuses; nothing is half written, and what was written before is whole.
        """
        part = self.parts / f"{self._count + 1:06d}{self.path.suffix}"
        frame = pd.DataFrame(
            {
                column.name: numbers.astype(_DTYPES[column.type])
                for column, numbers in zip(self._columns, rows.T, strict=True)
            }
        )
        try:
            if self.path.suffix == ".csv":
                headings = [f"{c.name} [{c.unit}]" if c.unit else c.name for c in self._columns]
                write_text(part, lambda file: frame.to_csv(file, index=False, header=headings, lineterminator="\n"))
            else:
                import pyarrow as pa
                import pyarrow.parquet as pq

                table = pa.Table.from_pandas(frame, self._schema(), preserve_index=False)
                write_binary(part, lambda file: pq.write_table(table, file))
        except UsageError as error:
            raise self._kept(error) from error
        self._count += 1

    def finish(self) -> Path:
        """Put all parts into one file, part by part, and return it.

        Raises:
            UsageError: the disk refuses; all parts are still there.
        """
        if not self._count:
            self.append(np.empty((0, len(self._columns))))
        try:
            if self.path.suffix == ".csv":
                write_text(self.path, lambda file: file.writelines(self._lines()))
            else:
                write_binary(self.path, self._join)
        except UsageError as error:
            raise self._kept(error) from error
        shutil.rmtree(self.parts, ignore_errors=True)
        return self.path

    def _written(self) -> list[Path]:
        return [self.parts / f"{number:06d}{self.path.suffix}" for number in range(1, self._count + 1)]

    def _lines(self) -> Iterator[str]:
        for number, part in enumerate(self._written()):
            with part.open(encoding="utf-8", newline="") as file:
                yield from islice(file, 1 if number else 0, None)

    def _join(self, file: object) -> None:
        import pyarrow.parquet as pq

        with pq.ParquetWriter(file, self._schema()) as writer:
            for part in self._written():
                writer.write_table(pq.read_table(part))

    def _schema(self) -> Any:
        import pyarrow as pa

        types = {"Real": pa.float64(), "Integer": pa.int64(), "Boolean": pa.bool_()}
        fields = [pa.field(c.name, types[c.type], metadata={"unit": c.unit or "1"}) for c in self._columns]
        return pa.schema(fields, metadata={"mechanism_fmu": __version__})

    def _kept(self, error: UsageError) -> UsageError:
        if not self._count:
            return error
        return UsageError(f"{error} What was recorded before is whole: {self._count} file(s) in '{self.parts}'.")


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

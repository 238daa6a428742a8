"""Results on the disk, such that a process may end at any moment.

    FOLDER/identity.json         what the results belong to (`identity`); written first
    FOLDER/parts/*.parquet    results as they come: a file for what came together, by its first design's number;
                              many of them are put into one, which takes the place of the first
    FOLDER/results.parquet    all of them, in the order of their numbers; written last

Every file is written under another name and then renamed, so it is there as a whole or not at all. The parts go only
when `results.parquet` is there; whoever finds both reads each design once.
"""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Iterable, Mapping, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pyarrow as pa
import pyarrow.parquet as pq

from mechanism_fmu import __version__

from ..description import Value, Variable
from ..errors import UsageError
from ..results import UNFINISHED, prepare_folder, write_json
from .identity import Identity
from .task import Design, Quantity, Result
from .variation import RESERVED, Axis

_ARROW = {"Real": pa.float64(), "Integer": pa.int64(), "Boolean": pa.bool_(), "String": pa.string()}
_OK, _FAILED = "ok", "failed"

#: So many parts are put into one, since each costs 3 ms when the results are read: of ten thousand, there are three
#: hundred at most.
_MOST_LOOSE = 256


class Store:
    """The results of one folder.

    Attributes:
        folder: of all files.
        table_file: `results.parquet`.
        identity_file: `identity.json`.
    """

    def __init__(self, folder: Path, identity: Identity, axes: Sequence[Axis], quantities: Sequence[Quantity]) -> None:
        """Open a folder, new or with results of the same identity.

        Raises:
            UsageError: it holds results of something else, or the disk refuses.
        """
        self.folder = folder
        self.table_file = folder / "results.parquet"
        self.identity_file = folder / "identity.json"
        self._parts = folder / "parts"
        self._axes, self._quantities = axes, quantities
        self._schema = _schema(identity, axes, quantities)
        self._claim(identity)
        self._loose: dict[Path, pa.Table] = {}

    def results(self) -> pa.Table:
        """All results so far, in the order of the designs' numbers, each design once.

        Raises:
            UsageError: a file cannot be read.
        """
        files = [self.table_file, *sorted(self._parts.glob("*.parquet"))]
        tables = [_read(path, self._schema) for path in files if path.exists()]
        table = pa.concat_tables([self._schema.empty_table(), *tables])
        numbers = table["design"].to_pylist()
        first = {number: row for row, number in reversed(list(enumerate(numbers)))}
        order = pa.array([first[number] for number in sorted(first)], pa.int64())
        return table.take(order).combine_chunks()

    def pairs(self) -> dict[int, tuple[dict[str, Value], Result]]:
        """Values and result of each design, by its number.

        Raises:
            UsageError: a file cannot be read.
        """
        columns = [quantity.column for quantity in self._quantities]
        return {
            row["design"]: (
                {axis.name: row[axis.name] for axis in self._axes},
                Result(
                    row["design"], row["way"], tuple(row[name] for name in columns), row["message"], row["warnings"]
                ),
            )
            for row in self.results().to_pylist()
        }

    def append(self, pairs: Iterable[tuple[Design, Result]]) -> None:
        """Keep results; when this returns, they are on the disk.

        Raises:
            UsageError: the disk refuses.
        """
        rows = [self._row(design, result) for design, result in pairs]
        if not rows:
            return
        path = self._parts / f"{rows[0]['design']:09d}.parquet"
        table = pa.Table.from_pylist(rows, schema=self._schema)
        _write(table, path)
        self._loose[path] = table
        if len(self._loose) == _MOST_LOOSE:
            self._put_together()

    def finish(self) -> pa.Table:
        """Put all results into one file, and return them.

        Raises:
            UsageError: the disk refuses.
        """
        table = self.results()
        if self._parts.exists() or not self.table_file.exists():
            _write(table, self.table_file)
            shutil.rmtree(self._parts, ignore_errors=True)
        return table

    def _put_together(self) -> None:
        """Make one part of those that have come since the last time.

        Who is killed in between leaves some results twice, which `results` reads once.

        Raises:
            UsageError: the disk refuses.
        """
        first, *others = self._loose
        _write(pa.concat_tables(self._loose.values()), first)
        for path in others:
            path.unlink()
        self._loose.clear()

    def _claim(self, identity: Identity) -> None:
        """Mark the folder as belonging to an identity, unless it belongs to another.

        Raises:
            UsageError: it does; or the disk refuses.
        """
        if self.identity_file.exists():
            try:
                found: Mapping[str, Any] = json.loads(self.identity_file.read_text(encoding="utf-8"))["identity"]
            except (OSError, ValueError, KeyError, TypeError) as error:
                raise UsageError(
                    f"'{self.identity_file}' cannot be read ({error}), so nobody can say to what the results in "
                    f"'{self.folder}' belong. Choose another folder with -o."
                ) from error
            changed = identity.changed(found)
            if changed:
                raise UsageError(
                    f"The folder '{self.folder}' holds results of another file, FMU or version: "
                    f"{', '.join(f'[{name}]' for name in changed)} differ from '{self.identity_file}'. "
                    f"Choose another folder with -o, undo the change to go on, or remove '{self.folder}' to begin anew."
                )
        elif self.table_file.exists() or self._parts.exists():
            raise UsageError(f"'{self.folder}' has results, but no {self.identity_file.name}; choose another folder.")
        prepare_folder(self.folder)
        # The identity comes first: whatever lies beside it belongs to it.
        if not self.identity_file.exists():
            write_json(self.identity_file, {"harness_version": __version__, "identity": dict(identity.topics)})
        prepare_folder(self._parts)

    def _row(self, design: Design, result: Result) -> dict[str, Value | None]:
        columns = [quantity.column for quantity in self._quantities]
        return {
            "design": design.number,
            **design.values,
            **dict(zip(columns, result.values, strict=True)),
            "way": result.way,
            "status": _OK if result.failure is None else _FAILED,
            "message": result.failure,
            "warnings": result.warnings,
        }


def failures(table: pa.Table) -> list[tuple[int, str]]:
    """Number and message of each design that failed."""
    rows = zip(table["design"].to_pylist(), table["status"].to_pylist(), table["message"].to_pylist(), strict=True)
    return [(number, message) for number, status, message in rows if status == _FAILED]


def numbers_of(table: pa.Table, column: str) -> npt.NDArray[np.float64]:
    """A column of results as numbers, NaN where there is none, shape (designs,)."""
    return np.array([np.nan if value is None else float(value) for value in table[column].to_pylist()])


def _schema(identity: Identity, axes: Sequence[Axis], quantities: Sequence[Quantity]) -> pa.Schema:
    """The columns, each with its unit in the metadata."""

    def column(name: str, of: Variable | Quantity) -> pa.Field:
        return pa.field(name, _ARROW[of.type], metadata={"unit": of.unit or "1"})

    texts = [pa.field(name, pa.string()) for name in RESERVED[1:]]
    fields = [
        pa.field(RESERVED[0], pa.int64(), nullable=False),
        *(column(axis.name, axis.variable) for axis in axes),
        *(column(quantity.column, quantity) for quantity in quantities),
        *texts,
    ]
    return pa.schema(fields, metadata={"identity": identity.digest, "mechanism_fmu": __version__})


def _read(path: Path, schema: pa.Schema) -> pa.Table:
    import_module("pyarrow.dataset")  # else read_table complains of the schema where there is no memory to load it
    try:
        return pq.read_table(path, schema=schema)
    except (OSError, pa.ArrowException) as error:
        raise UsageError(
            f"'{path}' cannot be read: {error}. Remove this file, and the same command runs its designs again."
        ) from error


def _write(table: pa.Table, path: Path) -> None:
    temporary = path.with_name(f".{path.name}.{os.getpid()}{UNFINISHED}")
    try:
        try:
            pq.write_table(table, temporary)
            os.replace(temporary, path)
        except BaseException:
            temporary.unlink(missing_ok=True)
            raise
    except OSError as error:
        raise UsageError(f"'{path}' cannot be written: {error}.") from error

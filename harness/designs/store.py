"""Store of results on the disk, safe against the end of the process at any moment; and identity of two runs of a file.

    FOLDER/identity.json         what the results belong to (`identity`); written first
    FOLDER/parts/*.parquet    results as they come: a file for what came together, by its first design's number;
                              many of them are put into one, which takes the place of the first
    FOLDER/results.parquet    all of them, in the order of their numbers; written last

Every file is written under another name and then renamed, so it is there as a whole or not at all. The parts go only
when `results.parquet` is there; whoever finds both reads each design once.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import shutil
import zipfile
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pyarrow as pa
import pyarrow.parquet as pq

from mechanism_fmu import __version__, stress as beam_stress

from ..analysis import stress
from ..errors import UsageError
from ..fmu import Fmu
from ..fmu.description import Value, Variable
from ..run.results import UNFINISHED, prepare_folder, write_json
from .task import Design, Quantity, Result, Task, wants_stress
from .variation import RESERVED, Axis

# What makes two runs of a file the same.

_DESIGNS = "designs"
#: Where stress and damage of impacts are calculated.
_STRESS_CODE = (Path(beam_stress.__file__).parent, Path(stress.__file__))
_DESCRIPTION = "modelDescription.xml"
_DATE = re.compile(rb'generationDateAndTime="[^"]*"')


@dataclass(frozen=True)
class Identity:
    """Everything on which results depend, by topic, as JSON.

    Comments, titles and the order of tables in the file are no part of it.

    Attributes:
        topics: names of the file's tables, with what they mean once they are read.
    """

    topics: Mapping[str, Any]

    @property
    def digest(self) -> str:
        """SHA-256 of it all."""
        return _digest(self.topics)

    def changed(self, other: Mapping[str, Any]) -> list[str]:
        """The topics that differ; the designs only where nothing else explains it, as with another scipy."""
        names = dict.fromkeys([*self.topics, *other])
        found = [name for name in names if self.topics.get(name) != other.get(name)]
        return [name for name in found if name != _DESIGNS] or found


def identity(
    fmu: Mapping[str, str],
    task: Task,
    axes: Sequence[Axis],
    how: tuple[str, Mapping[str, Any]],
    designs: Sequence[Design] = (),
) -> Identity:
    """The identity of a list of designs.

    Args:
        fmu: what `contents` says of it.
        task: of every design.
        axes: what is varied.
        how: designs are found: name of the table, and what is in it.
        designs: the list, if it is known from the beginning. It is part of the identity, because another version of
            scipy might make another list of the same file.
    """
    return Identity(
        {
            "fmu": dict(fmu),
            # The stresses are no FMU's: they change with the code.
            "mechanism_fmu": {
                "version": __version__,
                "stress": code_of(_STRESS_CODE) if wants_stress(task) else None,
            },
            "run": {
                "start": task.grid.start,
                "stop": task.grid.stop,
                "step": task.grid.step,
                "material": asdict(task.material.material) | asdict(task.material.strength),
                "input": None if task.inputs is None else _signals(task),
            },
            "set": dict(sorted(task.fixed.items())),
            "vary": {
                axis.name: {
                    "unit": axis.unit,
                    "limits": None if axis.values is not None else [axis.low, axis.high],
                    "values": None if axis.values is None else list(axis.values),
                }
                for axis in axes
            },
            "record": [quantity.column for quantity in task.quantities],
            how[0]: dict(how[1]),
            _DESIGNS: _digest([list(design.values.values()) for design in designs]),
        }
    )


def contents(fmu: Fmu) -> dict[str, str]:
    """What distinguishes FMUs: model, GUID, and SHA-256 of all that is in it but the date of its making.

    Whoever edits an FMU seldom gives it another GUID.
    """
    with zipfile.ZipFile(fmu.path) as archive:
        files = {name: archive.read(name) for name in sorted(archive.namelist())}
    files[_DESCRIPTION] = _DATE.sub(b"", files[_DESCRIPTION])
    return {"model": fmu.description.model, "guid": fmu.description.guid, "sha256": _files_digest(files.items())}


def code_of(places: Iterable[Path]) -> str:
    """SHA-256 of Python files, and of those in folders; where the places lie does not matter."""
    paths = [(place.parent, path) for place in places for path in (sorted(place.rglob("*.py")) or [place])]
    return _files_digest((path.relative_to(root).as_posix(), path.read_bytes()) for root, path in paths)


def _files_digest(files: Iterable[tuple[str, bytes]]) -> str:
    found = hashlib.sha256()
    for name, content in files:
        found.update(name.encode() + hashlib.sha256(content).digest())
    return found.hexdigest()


def _signals(task: Task) -> str:
    assert task.inputs is not None
    names = [variable.name for variable in task.inputs.variables]
    return _digest([names, task.inputs.times.tolist(), task.inputs.values.tolist()])


def _digest(data: Any) -> str:
    return hashlib.sha256(json.dumps(data, sort_keys=True).encode()).hexdigest()


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

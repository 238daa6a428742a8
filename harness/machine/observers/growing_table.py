"""A table on the disk that grows, such that the process may end at any moment.

    FOLDER/results.parts/000001.parquet, ...    rows as they come
    FOLDER/results.parquet                      all of them; written last

Every file is written under another name and then renamed, so it is there as a whole or not at all; the parts go only
when the table is there (docs/decisions/016). With `results.csv`, the parts are CSV files, too.
"""

from __future__ import annotations

import shutil
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pandas as pd

from mechanism_fmu import __version__

from ...errors import UsageError
from ...run.results import prepare_folder, write_binary, write_text

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

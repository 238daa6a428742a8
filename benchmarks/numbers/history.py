"""The file of all numbers that were ever found: docs/project/numbers.csv."""

from __future__ import annotations

import csv
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from ..fmus import ROOT
from .number import Number

HISTORY = ROOT / "docs" / "project" / "numbers.csv"
_COLUMNS = ("date", "commit", "machine", "group", "name", "unit", "value")


@dataclass(frozen=True)
class Entry:
    """A number of one run.

    Attributes:
        date: of the run, ISO.
        commit: of the tree, with "+" where files had changed.
        machine: system, processors and Python.
        number: what was found.
    """

    date: str
    commit: str
    machine: str
    number: Number

    @property
    def run(self) -> str:
        """What tells its run from others."""
        return f"{self.date}, {self.commit}"


def read_history(path: Path) -> list[Entry]:
    """All entries of the file; none where there is no file."""
    if not path.is_file():
        return []
    with path.open(newline="", encoding="utf-8") as file:
        return [
            Entry(
                row["date"],
                row["commit"],
                row["machine"],
                Number(row["group"], row["name"], row["unit"], float(row["value"])),
            )
            for row in csv.DictReader(file)
        ]


def add_to_history(path: Path, entries: Iterable[Entry]) -> None:
    """Write entries behind those that are there; with a head where the file is new."""
    begins = not path.is_file()
    with path.open("a", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        if begins:
            writer.writerow(_COLUMNS)
        for one in entries:
            n = one.number
            writer.writerow((one.date, one.commit, one.machine, n.group, n.name, n.unit, f"{n.value:.6g}"))

"""The commands that faults happen to: small forms of the examples in docs/examples."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import pyarrow.parquet as pq

EXAMPLES = Path(__file__).parents[2] / "docs" / "examples"

#: What is recorded: designs by their numbers, rows by their times, files by their names.
Recorded = dict[object, object]


@dataclass(frozen=True)
class Command:
    """A command and what its folder holds.

    Attributes:
        name: for people.
        arguments: before `-o FOLDER`; a file is named by the place where `write` puts it.
        text: of its file, "" for none.
        recorded: what a folder has that nobody may lose, and that may be read at any moment.
        outcome: names of the files whose bytes are the same each time.
        goes_on: whether the same command goes on with what is recorded; else it begins anew.
    """

    name: str
    arguments: tuple[str, ...]
    text: str
    recorded: Callable[[Path], Recorded]
    outcome: tuple[str, ...]
    goes_on: bool

    def write(self, place: Path) -> list[str]:
        """Write its file into a folder; the arguments that name it."""
        path = place / "asked.toml"
        if not path.exists():  # somebody else may be reading it
            path.write_text(self.text, encoding="utf-8")
        return [str(path) if word == "FILE" else word for word in self.arguments]

    def came_out(self, folder: Path) -> Mapping[str, bytes]:
        """The files that are the same each time but for the folder's name; a missing one is empty."""
        found = {name: (folder / name).read_bytes() if (folder / name).is_file() else b"" for name in self.outcome}
        return {name: data.replace(str(folder).encode(), b"FOLDER") for name, data in found.items()}


def designs(folder: Path) -> Recorded:
    """The designs of a sweep or search that are on the disk, with all their values."""
    files = [folder / "results.parquet", *sorted((folder / "parts").glob("[0-9]*.parquet"))]
    rows = [row for file in files if file.is_file() for row in pq.read_table(file).to_pylist()]
    return {row["design"]: repr(row) for row in rows}


def rows(folder: Path) -> Recorded:
    """The rows of a machine's run that are on the disk: of the run that is at work, else of the last one."""
    parts = sorted((folder / "results.parts").glob("[0-9]*.parquet"))
    files = parts or [file for file in [folder / "results.parquet"] if file.is_file()]
    return {row["time"]: repr(row) for file in files for row in pq.read_table(file).to_pylist()}


def files(folder: Path) -> Recorded:
    """The files of a study that are there, whole or not; a report is another one each time."""
    found = [path for path in sorted(folder.glob("[a-zR]*.*")) if path.suffix != ".html"]
    return {path.name: path.read_bytes().replace(str(folder).encode(), b"FOLDER") for path in found}


def changed(text: str, **values: int | str) -> str:
    """A file with other values, each of a key that is there; the first one of two is meant."""
    for name, value in values.items():
        new, count = re.subn(rf"(?m)^{name} = (\"[^\"]*\"|\S+)", f"{name} = {json.dumps(value)}", text, count=1)
        if not count:
            raise ValueError(f"no {name} in the example")
        text = new
    return text


def commands(size: int) -> list[Command]:
    """All commands, so large that faults meet them at work: `size` designs each, ten times as many with `--fast`."""
    teeth = (EXAMPLES / "teeth.toml").read_text(encoding="utf-8")
    best = (EXAMPLES / "best_tooth.toml").read_text(encoding="utf-8").replace("count = 64", "count = 16")
    cam = (EXAMPLES / "geared_cam.toml").read_text(encoding="utf-8")
    found = designs, ("results.parquet",)
    figures = ("fig08_wheels", "fig09_teeth", "fig10_stress", "fig11_maximum")
    drawn = tuple(f"{name}.{suffix}" for name in figures for suffix in ("svg", "png"))
    return [
        Command("sweep", ("sweep", "FILE", "--workers", "2"), changed(teeth, count=size), *found, True),
        Command("sweep --fast", ("sweep", "FILE", "--fast"), changed(teeth, count=10 * size), *found, True),
        Command(
            "optimise",
            ("optimise", "FILE", "--workers", "2"),
            changed(best, count=size),
            designs,
            ("results.parquet", "optimum.json"),
            True,
        ),
        Command(
            "machine run",
            ("machine", "run", "FILE"),
            changed(cam, stop_time=f"{size} s", every=1),
            rows,
            ("impacts.csv",),  # results.parquet has its rows in groups as they came
            False,
        ),
        Command(
            "study ratchet", ("study", "ratchet"), "", files, ("Ratchet.fmu", "study.csv", "study.json", *drawn), False
        ),
    ]

"""Command: `python -m benchmarks.numbers`: the numbers of this project in one table, and their history in one file.

Sizes, times of builds and starts, speed beside other programs, deviations from known values, tests by kind. Each run
adds its numbers to docs/project/numbers.csv, with the date, the commit and the machine, and makes
docs/project/numbers.md anew: the last run beside the one before on the same machine.
"""

from __future__ import annotations

import csv
import importlib.util
import os
import platform
import re
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from statistics import median
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import Progress
from rich.table import Table

import build_fmu as build_files
import models
from harness.page.page_file import page
from mechanism_fmu.fmu.native.package import build_native_fmu
from mechanism_fmu.fmu.package import build_fmu

from . import base_case, growth, startup
from .world.case import SHOWN
from .world.cases import CASES

ROOT = Path(__file__).resolve().parents[1]
HISTORY = ROOT / "docs" / "project" / "numbers.csv"
PAGE = HISTORY.with_suffix(".md")
_COLUMNS = ("date", "commit", "machine", "group", "name", "unit", "value")
_ROUNDS = 5


@dataclass(frozen=True)
class Number:
    """A number: what it is of, its name there, its unit."""

    group: str
    name: str
    unit: str
    value: float


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


def sizes_and_starts(folder: Path) -> Iterator[Number]:
    """The ratchet's files in every form, times of their builds with a compiled engine, and the start of an FMU."""
    model = models.load("ratchet")
    forms: tuple[tuple[str, Callable[[Path], Path]], ...] = (
        ("native FMU, FMI 2.0, all platforms", lambda place: build_native_fmu(model, place)),
        ("native FMU, FMI 3.0, all platforms", lambda place: build_native_fmu(model, place, fmi=3)),
        ("FMU by pythonfmu", lambda place: build_fmu(model, place)),
    )
    for name, build in forms:
        place = folder / name.replace(" ", "_")
        build(place)
        began = time.perf_counter()
        fmu = build(place)
        yield Number("size", f"ratchet: {name}", "kB", fmu.stat().st_size / 1e3)
        yield Number("time", f"ratchet: build of a {name}", "s", time.perf_counter() - began)
    html = page(build_files.web("ratchet")).encode()
    yield Number("size", "ratchet: page that computes", "kB", len(html) / 1e3)
    for found in startup.compare(fmu, folder / "starts", folder / "cache"):
        yield Number("time", f"start of that FMU, {found.case}", "s", median(found.fast))


def speed() -> Iterator[Number]:
    """Beside a plain program with scipy, and beside MuJoCo where that is installed."""
    yield Number("speed", "base case at equal error, time over solve_ivp's", "1", base_case.measure(_ROUNDS).ratio)
    if importlib.util.find_spec("mujoco"):
        for count in (10, 20, 50, 100):
            ours, theirs = growth.compare(count, _ROUNDS)
            yield Number("speed", f"acceleration of a chain of {count}, time over MuJoCo's", "1", ours / theirs)


def deviations() -> Iterator[Number]:
    """Of the published problems."""
    for case in CASES.values():
        for tolerance in SHOWN:
            name = f"{case.title} at {tolerance:.0e}"
            yield Number("deviation", name, "1", case.deviation(case.run(tolerance)))


def tests() -> Iterator[Number]:
    """How many there are by folder, and how many of them are slow."""
    every = _collected("")
    slow = _collected("slow")
    for kind, count in sorted(every.items()):
        yield Number("tests", kind, "1", count)
    yield Number("tests", "all", "1", sum(every.values()))
    yield Number("tests", "of these, slow", "1", sum(slow.values()))


def _collected(marks: str) -> Counter[str]:
    command = [sys.executable, "-m", "pytest", "--collect-only", "-q", "-p", "no:xdist", "-m", marks, "tests"]
    said = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False).stdout
    files = (line.rpartition(": ") for line in said.splitlines() if re.fullmatch(r"tests/\S+\.py: \d+", line))
    found: Counter[str] = Counter()
    for file, _, count in files:
        found[kind_of(file)] += int(count)
    return found


def kind_of(file: str) -> str:
    """The folder below tests, or two where the first is `unit`, of a file with tests."""
    parts = Path(file).parts[1:-1]
    return "/".join(parts[: 2 if parts[:1] == ("unit",) else 1]) or "house"


# History and page.


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


def page_of(history: Sequence[Entry]) -> str:
    """The page: the last run, and beside it the run before on the same machine, if there was one."""
    last = history[-1]
    runs = list(dict.fromkeys((e.date, e.commit) for e in history if e.machine == last.machine))
    now = {key(e): e.number for e in history if (e.date, e.commit) == runs[-1] and e.machine == last.machine}
    before: dict[tuple[str, str], Number] = {}
    if len(runs) > 1:
        before = {key(e): e.number for e in history if (e.date, e.commit) == runs[-2] and e.machine == last.machine}
    head = f"| | unit | {_run(runs[-1])} |" + (f" {_run(runs[-2])} |" if before else "")
    lines = [
        "# Numbers",
        "",
        f"Made by `python -m benchmarks.numbers`, on {last.machine}. All runs: [numbers.csv](numbers.csv).",
    ]
    for group in dict.fromkeys(n.group for n in now.values()):
        lines += ["", f"## {group.capitalize()}", "", head, f"|{' --- |' * (4 if before else 3)}"]
        for place, number in now.items():
            if number.group == group:
                then = f" {_shown(before[place].value) if place in before else ''} |" if before else ""
                lines.append(f"| {number.name} | {number.unit} | {_shown(number.value)} |{then}")
    return "\n".join(lines) + "\n"


def key(entry: Entry) -> tuple[str, str]:
    """What a number is found again by."""
    return entry.number.group, entry.number.name


def _run(run: tuple[str, str]) -> str:
    return f"{run[0]}, {run[1]}"


def _shown(value: float) -> str:
    return f"{value:.0f}" if value == int(value) and abs(value) < 1e6 else f"{value:.3g}"


def _commit() -> str:
    def git(*arguments: str) -> str:
        return subprocess.run(["git", *arguments], cwd=ROOT, capture_output=True, text=True, check=False).stdout.strip()

    return git("rev-parse", "--short=8", "HEAD") + ("+" if git("status", "--porcelain") else "")


def run(
    pages: Annotated[bool, typer.Option(help="Add to docs/project/numbers.csv and make numbers.md anew.")] = True,
) -> None:
    """Measure sizes, times, speed, deviations and tests, in some three minutes, and keep them."""
    machine = (
        f"{platform.system()} {platform.machine()}, {os.cpu_count()} processors, Python {platform.python_version()}"
    )
    found: list[Number] = []
    with tempfile.TemporaryDirectory() as temporary, Progress(console=Console(stderr=True)) as progress:
        parts = {
            "sizes and starts": lambda: sizes_and_starts(Path(temporary)),
            "speed": speed,
            "published problems": deviations,
            "tests": tests,
        }
        task = progress.add_task("", total=len(parts))
        for name, part in parts.items():
            progress.update(task, description=name)
            found += part()
            progress.advance(task)
    table = Table("", "", "unit", "value", box=None)
    for number in found:
        table.add_row(number.group, number.name, number.unit, _shown(number.value))
    Console().print(table)
    if pages:
        today, commit = datetime.now(UTC).date().isoformat(), _commit()
        add_to_history(HISTORY, (Entry(today, commit, machine, number) for number in found))
        PAGE.write_text(page_of(read_history(HISTORY)), encoding="utf-8")


if __name__ == "__main__":
    typer.run(run)

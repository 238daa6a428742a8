"""What the machine around a command may do to it, tried on sweeps, a search, a machine and a study.

    python -m tests.faults --seed 1

Each fault comes to each command several times, at random moments or with random limits, equally spread: `kill -9`, a
full disk, a folder that cannot be written to, a cache that goes, a clock that is set back, too little memory, the same
command twice at once. Afterwards all that was recorded must be there, and the same command must end with the results of
an undisturbed run, to the byte. See docs/how-to/what-can-go-wrong.md.
"""

from __future__ import annotations

import argparse
import os
import random
import shutil
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from itertools import count
from pathlib import Path

from tests.faults import trials
from tests.faults.commands import Command, commands
from tests.faults.limits import own_mounts
from tests.faults.running import Place
from tests.faults.surroundings import Begin, as_nobody, clock_library, engine_cache, least_memory, with_own_cache
from tests.faults.trials import Trial, Undisturbed

FAULTS = ("kill", "disk", "read-only", "cache", "clock", "memory", "two", "filling")
#: The least disk, and what parts of results may take at most while they come [bytes].
_LEAST_DISK, _PARTS = 8e3, 200e3
#: What an FMU takes, unpacked, and as much for building it [bytes].
_TEMPORARY = 8e6
_HOUR, _BEFORE_ZIP = 3600.0, 50 * 365.25 * 86400.0


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; 1 when a result was lost, or something else is not as promised."""
    parser = argparse.ArgumentParser(
        prog="python -m tests.faults", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--seed", type=int, default=1, help="of the moments and limits")
    parser.add_argument(
        "--count",
        type=int,
        default=5,
        metavar="N",
        help="moments of kill -9 (default 5), and half as many of the others",
    )
    parser.add_argument("--size", type=int, default=200, metavar="N", help="designs, or seconds of a machine")
    parser.add_argument("--faults", nargs="+", choices=FAULTS, default=FAULTS, metavar="FAULT", help=", ".join(FAULTS))
    parser.add_argument("--commands", nargs="+", metavar="NAME", help="beginnings of their names, e.g. sweep machine")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="commands that are tried side by side")
    asked = parser.parse_args(arguments)
    mounts = own_mounts()
    chosen = [one for one in commands(asked.size) if one.name.startswith(tuple(asked.commands or [""]))]
    began = time.monotonic()
    print(f"Seed {asked.seed}.", flush=True)
    with tempfile.TemporaryDirectory(prefix="faults-") as folder, ThreadPoolExecutor(asked.jobs) as pool:
        os.chmod(folder, 0o755)
        tools = Tools(Path(folder), engine_cache(Path(folder, "cache")), mounts, count(1))
        if "clock" in asked.faults:
            clock_library(tools.folder)
        least_memory()
        of_commands = pool.map(lambda command: _tried(command, asked, tools), chosen)
        done = [trial for of_one in of_commands for trial in of_one]
    _show(done)
    print(f"Seed {asked.seed}, {(time.monotonic() - began) / 60:.0f} min.")
    return 1 if any(trial.lost or trial.broken for trial in done) else 0


@dataclass(frozen=True)
class Tools:
    """What all trials use.

    Attributes:
        folder: for theirs, which go.
        cache: with the engine in it.
        mounts: whether disks may be mounted.
        numbers: of their folders.
    """

    folder: Path
    cache: Path
    mounts: bool
    numbers: Iterator[int]

    def place(self) -> Place:
        """A new one."""
        folder = self.folder / str(next(self.numbers))
        folder.mkdir()
        return Place(folder, self.cache)


def _tried(command: Command, asked: argparse.Namespace, tools: Tools) -> list[Trial]:
    """All faults, one after the other, that come to a command."""
    draw = random.Random(f"{asked.seed} {command.name}")
    usual = trials.undisturbed(command, tools.place())
    print(f"{command.name}: {usual.took:.1f} s, {len(usual.recorded)} results without faults", flush=True)
    done = []
    for fault in asked.faults:
        for begin in _trials(fault, usual, draw, asked.count, tools):
            place = tools.place()
            trial = begin(place)
            done.append(trial)
            verdict = "; ".join(trial.broken) or "as promised"
            told = f"{trial.kept} kept, {trial.lost} lost, {verdict}"
            print(f"{command.name}: {trial.fault}, {trial.how}: {told}", flush=True)
            shutil.rmtree(place.folder)
    return done


def _trials(fault: str, usual: Undisturbed, draw: random.Random, many: int, tools: Tools) -> Iterator[Begin]:
    """What is to be tried of a fault."""

    def spread(low: float, high: float, parts: int = many) -> list[float]:
        return [low + (high - low) * (part + draw.random()) / parts for part in range(parts)]

    few = max(1, many // 2)
    if fault == "kill":
        for moment in spread(0.0, usual.took, many - few):
            yield partial(trials.killed, usual, moment=moment)
        for there in spread(1.0, 0.9 * len(usual.recorded), few):
            yield partial(trials.killed, usual, moment=0.0, results=round(there))
    elif fault == "disk":
        for power in spread(0.0, 1.0, few):
            size = round(_LEAST_DISK * (0.98 * sum(usual.sizes.values()) / _LEAST_DISK) ** power)
            yield partial(trials.disk_full if tools.mounts else trials.file_full, usual, size=size)
        if tools.mounts:
            yield partial(trials.temporary_full, usual, size=round(spread(_LEAST_DISK, _TEMPORARY, 1)[0]))
        yield partial(trials.console_full, usual)
    elif fault == "read-only":
        yield partial(as_nobody, partial(trials.read_only, usual, moment=None))
        for moment in spread(0.3 * usual.took, usual.took, max(1, few - 1)):
            yield partial(as_nobody, partial(trials.read_only, usual, moment=moment))
    elif fault == "cache":
        for moment in spread(0.0, usual.took, few):
            yield partial(with_own_cache, partial(trials.cache_deleted, usual, moment=moment))
    elif fault == "clock":
        library = clock_library(tools.folder)
        yield partial(trials.clock_set_back, usual, library=library, after=draw.random() * usual.took, back=_HOUR)
        yield partial(trials.clock_set_back, usual, library=library, after=0.0, back=_BEFORE_ZIP)
    elif fault == "memory":
        for size in spread(1.05 * least_memory(), usual.largest, few):
            yield partial(trials.out_of_memory, usual, size=round(size))
    elif fault == "filling":
        # Most of a folder is an FMU, which comes first, and a report, which comes last; parts have whole pages.
        first = usual.sizes.get(".fmu", 0) + _LEAST_DISK
        others = sum(usual.sizes.values()) - usual.sizes.get(".fmu", 0) - usual.sizes.get(".html", 0)
        for size in spread(first, first + max(others, _PARTS), few):
            yield partial(trials.disk_full if tools.mounts else trials.file_full, usual, size=round(size))
    else:
        yield partial(trials.two_writers, usual, later=0.0)
        for later in spread(0.0, 0.9 * usual.took, max(1, few - 1)):
            yield partial(trials.two_writers, usual, later=later)


def _show(done: Sequence[Trial]) -> None:
    """A table of faults and commands: tried / results kept / lost / otherwise not as promised."""
    print(f"\n{'fault':20} {'command':15} {'tried':>5} {'kept':>8} {'lost':>5} {'not as promised':>16}")
    for fault, command in dict.fromkeys((trial.fault, trial.command) for trial in done):
        of = [trial for trial in done if (trial.fault, trial.command) == (fault, command)]
        kept, lost = sum(trial.kept for trial in of), sum(trial.lost for trial in of)
        broken = sum(bool(trial.broken) for trial in of)
        print(f"{fault:20} {command:15} {len(of):5d} {kept:8d} {lost:5d} {broken:16d}")
    lost, broken = sum(trial.lost for trial in done), sum(bool(trial.broken) for trial in done)
    print(f"{len(done)} trials, {lost} results lost, {broken} otherwise not as promised.")


if __name__ == "__main__":
    sys.exit(main())

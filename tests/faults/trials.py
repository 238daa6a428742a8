"""One fault after the other: what it does to a command, and whether all is as promised afterwards."""

from __future__ import annotations

import re
import shutil
import signal
import time
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from tests.faults.commands import Command, Recorded
from tests.faults.limits import limit_files, limit_memory, mounted, set_writable
from tests.faults.running import Place, Running

_TRACEBACK = "Traceback (most recent call last)"
_REFUSED = 2


@dataclass(frozen=True)
class Undisturbed:
    """A command without faults.

    Attributes:
        command: it.
        took: how long it took [s].
        largest: its address space [bytes].
        recorded: in the end.
        came_out: the files that are the same each time.
        sizes: of all files in its folder [bytes], by their suffixes.
    """

    command: Command
    took: float
    largest: int
    recorded: Recorded
    came_out: Mapping[str, bytes]
    sizes: Mapping[str, int]

    def others(self, folder: Path) -> list[str]:
        """What is not the same in another folder, to the byte or to the bit of every number."""
        came_out = self.command.came_out(folder)
        names = [name for name, data in came_out.items() if data != self.came_out[name]]
        return names + ([] if self.command.recorded(folder) == self.recorded else ["what is recorded"])


@dataclass
class Trial:
    """What came of a fault.

    Attributes:
        fault: kind of it.
        command: that it happened to.
        how: when, or how much.
        kept: results that were there after it.
        lost: results that were recorded, and are no more, or are others.
        broken: what else is not as promised.
    """

    fault: str
    command: str
    how: str
    kept: int = 0
    lost: int = 0
    broken: list[str] = field(default_factory=list)

    def expect(self, holds: bool, else_: str) -> None:
        """Note what does not hold."""
        if not holds:
            self.broken.append(else_)


def undisturbed(command: Command, place: Place) -> Undisturbed:
    """Run a command without faults.

    Raises:
        RuntimeError: it fails.
    """
    with Running(command, place) as running:
        code = running.end()
    if code:
        raise RuntimeError(f"{command.name} fails without any fault, with exit code {code}:\n{running.words()}")
    sizes: Counter[str] = Counter()
    for file in filter(Path.is_file, place.results.rglob("*")):
        sizes[file.suffix] += file.stat().st_size
    recorded, came_out = command.recorded(place.results), command.came_out(place.results)
    return Undisturbed(command, running.took, running.largest, recorded, came_out, sizes)


def killed(usual: Undisturbed, place: Place, moment: float, results: int = 0) -> Trial:
    """`kill -9` after so many seconds and results, of the leading process alone, as a system short of memory does."""
    while True:
        with Running(usual.command, place) as running:
            at_work = running.until(moment, results)
            running.process.send_signal(signal.SIGKILL)
        if at_work:
            break
        moment, results = 0.7 * moment, round(0.7 * results)  # it was faster this time
        shutil.rmtree(place.results)
    trial = Trial("kill -9", usual.command.name, f"after {moment:.1f} s and {results} results")
    keeps(trial, usual, place, running.seen)
    _again(trial, usual, place)
    return trial


def disk_full(usual: Undisturbed, place: Place, size: int) -> Trial:
    """The folder of results is a disk of so many bytes, until the same command comes again."""
    trial = Trial("disk full", usual.command.name, f"{size / 1e3:.0f} kB")
    with mounted(place.results, size) as disk:
        with Running(usual.command, place) as running:
            _ends_in_words(trial, usual, running)
        keeps(trial, usual, place, running.seen)
        disk.enlarge()
        _again(trial, usual, place)
    return trial


def temporary_full(usual: Undisturbed, place: Place, size: int) -> Trial:
    """The folder of temporary files is a disk of so many bytes, until the same command comes again."""
    trial = Trial("temporary disk full", usual.command.name, f"{size / 1e3:.0f} kB")
    with mounted(place.temporary, size) as disk:
        with Running(usual.command, place) as running:
            _ends_in_words(trial, usual, running)
        keeps(trial, usual, place, running.seen)
        disk.enlarge()
        _again(trial, usual, place)
    return trial


def file_full(usual: Undisturbed, place: Place, size: int) -> Trial:
    """No file may be longer than so many bytes."""
    trial = Trial("no room for a file", usual.command.name, f"{size / 1e3:.0f} kB")
    with Running(usual.command, replace(place, before=lambda: limit_files(size))) as running:
        _ends_in_words(trial, usual, running)
    keeps(trial, usual, place, running.seen)
    _again(trial, usual, place)
    return trial


def console_full(usual: Undisturbed, place: Place) -> Trial:
    """What it prints goes to a file on a full disk."""
    trial = Trial("console full", usual.command.name, "/dev/full")
    with Running(usual.command, replace(place, console=Path("/dev/full"))) as running:
        _ends_in_words(trial, usual, running)
    keeps(trial, usual, place, running.seen)
    _again(trial, usual, place)
    return trial


def read_only(usual: Undisturbed, place: Place, moment: float | None) -> Trial:
    """The folder cannot be written to: from the beginning (with earlier results in it), or after so many seconds."""
    trial = Trial("read-only", usual.command.name, "from the beginning" if moment is None else f"after {moment:.1f} s")
    if moment is None:
        with Running(usual.command, place) as running:
            running.end()
        set_writable(place.results, False)
    with Running(usual.command, place) as running:
        if moment is not None:
            running.until(moment)
            while running.at_work and not place.results.exists():
                time.sleep(0.01)
            set_writable(place.results, False)
        code = _ends_in_words(trial, usual, running)
    if moment is None:
        trial.expect(code == _REFUSED, f"exit code {code} instead of {_REFUSED}")
        trial.expect(not usual.others(place.results), "earlier results are not as they were")
    keeps(trial, usual, place, running.seen)
    set_writable(place.results, True)
    _again(trial, usual, place)
    return trial


def cache_deleted(usual: Undisturbed, place: Place, moment: float) -> Trial:
    """Everything in the cache goes after so many seconds."""
    assert place.cache is not None
    trial = Trial("cache deleted", usual.command.name, f"after {moment:.1f} s")
    kept = place.folder / "kept"
    shutil.copytree(place.cache, kept)
    with Running(usual.command, place) as running:
        running.until(moment)
        shutil.rmtree(place.cache, ignore_errors=True)
        _ends_in_words(trial, usual, running)
    keeps(trial, usual, place, running.seen)
    shutil.copytree(kept, place.cache, dirs_exist_ok=True)  # else the next command compiles the engine
    _again(trial, usual, place)
    return trial


def clock_set_back(usual: Undisturbed, place: Place, library: Path, after: float, back: float) -> Trial:
    """The clock on the wall is set back by so many seconds, so many after the start."""
    trial = Trial("clock set back", usual.command.name, f"by {back:.3g} s after {after:.1f} s")
    preload = {"LD_PRELOAD": str(library), "FAULT_CLOCK_AFTER": f"{after:.3f}", "FAULT_CLOCK_BACK": f"{back:.0f}"}
    with Running(usual.command, replace(place, environment={**place.environment, **preload})) as running:
        code = _ends_in_words(trial, usual, running)
    trial.expect(code == 0 or "set the clock" in running.words(), f"exit code {code}")
    keeps(trial, usual, place, running.seen)
    _again(trial, usual, place)
    return trial


def out_of_memory(usual: Undisturbed, place: Place, size: int) -> Trial:
    """No process of the command has more than so many bytes of addresses."""
    trial = Trial("out of memory", usual.command.name, f"{size / 1e6:.0f} MB")
    with Running(usual.command, replace(place, before=lambda: limit_memory(size))) as running:
        _ends_in_words(trial, usual, running, in_library=True)
    keeps(trial, usual, place, running.seen)
    _again(trial, usual, place)
    return trial


def two_writers(usual: Undisturbed, place: Place, later: float) -> Trial:
    """The same command a second time, so many seconds later: it is refused, or waits and finds all done."""
    trial = Trial("two writers", usual.command.name, f"{later:.1f} s later")
    with Running(usual.command, place) as one:
        one.until(later)
        with Running(usual.command, replace(place, name="second_")) as two:
            codes = two.end(), one.end()
    for running, code in zip((two, one), codes, strict=True):
        trial.expect(_TRACEBACK not in running.words(), f"a traceback: {running.words()[-500:]}")
        refused = code == _REFUSED and "Another command is at work" in running.words()
        trial.expect(code == 0 or refused, f"exit code {code}: {running.words()[-500:]}")
    trial.expect(0 in codes, "neither of the two came to its end")
    trial.expect(not usual.others(place.results), "results are not those of one alone")
    keeps(trial, usual, place, one.seen)
    _again(trial, usual, place)
    return trial


def _ends_in_words(trial: Trial, usual: Undisturbed, running: Running, in_library: bool = False) -> int:
    """Wait for its end: with all results, or a failure that is said; its exit code.

    A library that gets no memory may end the process (`in_library`), or, as OpenBLAS, ask for it for ever.
    """
    try:
        code = running.end(*([60.0 + 10.0 * usual.took] if in_library else []))
    except TimeoutError as error:
        trial.expect(in_library, str(error))
        trial.how += ", hung and was killed"
        running.process.kill()
        running.process.wait()
        return -signal.SIGKILL
    said = running.words()
    trial.expect(_TRACEBACK not in said, f"a traceback: ... {said[-700:]}")
    if code == 0:
        others = usual.others(running.place.results)
        trial.expect(not others, f"exit code 0, but not the results of an undisturbed run: {others}")
    else:
        trial.expect(code > 0 or in_library, f"ended by signal {-code}: {said[-500:]}")
        trial.expect(code < 0 or bool(running.errors().strip()), f"exit code {code} without a word: {said[-500:]}")
    return code


def keeps(trial: Trial, usual: Undisturbed, place: Place, seen: Recorded) -> None:
    """Count what was recorded and is not there any more, or another one; what is there is as in an undisturbed run."""
    try:
        there = usual.command.recorded(place.results)
    except Exception as error:
        trial.lost += len(seen)
        trial.expect(False, f"what was recorded cannot be read: {error}")
        return
    trial.kept = len(there)
    trial.lost += sum(there.get(key) != value for key, value in seen.items())
    others = [key for key, value in there.items() if usual.recorded.get(key) != value]
    trial.expect(not others, f"recorded, but not as in an undisturbed run: {others[:5]}")


def _again(trial: Trial, usual: Undisturbed, place: Place) -> None:
    """The same command without a fault comes to the same end, runs nothing twice, and leaves nothing lying about."""
    with Running(usual.command, place) as running:
        code = running.end()
    said = running.words()
    trial.expect(code == 0, f"the same command again ends with {code}: {said[-700:]}")
    if usual.command.goes_on and (found := re.search(r"(\d+) (?:of them )?there before", said)):
        trial.expect(int(found[1]) >= trial.kept, f"{found[1]} there before, but {trial.kept} had been recorded")
    others = usual.others(place.results)
    trial.expect(not others, f"not the results of an undisturbed run: {others}")
    time.sleep(0.2)  # processes of the killed one
    left = [*place.temporary.iterdir(), *place.results.rglob(".*.unfinished"), *place.results.glob("*parts")]
    trial.expect(not left, f"left behind: {[path.name for path in left]}")

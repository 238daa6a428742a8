"""How many times faster several processors are than one: a batch, a sweep of a native FMU, and an optimisation.

    python -m benchmarks.cores [--rounds 5] [--workers 2]         with the extras "native" and "designs"

Each is run by one worker and by several, in turns; both give the same numbers, bit for bit, which is checked. Workers
have started and loaded what they need before the clock runs, as in a sweep that takes longer than a moment. Beside them
stands what the machine itself gives: a loop of the engine that touches nothing but its own block, in as many threads,
because the processors of a virtual machine may be two halves of one.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import AbstractContextManager, ExitStack, contextmanager
from itertools import count
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np

import models
from harness.app.commands.designs_shared import Runners, executor_of, opened
from harness.designs.optimum_file import read_optimum
from harness.designs.search import History, search
from harness.designs.store import Store, contents, identity
from harness.designs.sweep import perform_sweep, read_sweep
from harness.designs.task import Design
from harness.designs.workers import Executor
from harness.run.master import never
from mechanism_fmu.batch import Batch
from mechanism_fmu.processors import processors
from mechanism_fmu.simulation import Simulation

from .fmus import ROOT
from .growth import chain
from .timing import DisagreementError, batch, in_turns

#: Of a batch, of a sweep by FMI calls, and of an optimisation.
_BATCH, _SWEEP, _SEARCH = 512, 384, 384
_FILE = """
[fmu]
file = "{fmu}"
[run]
stop_time = "6 s"
step = "10 ms"
[vary.spring_stiffness]
from = 0.010
to = 0.020
[vary.drive_torque]
from = 0.0008
to = 0.0012
"""
_OF_SWEEP = (
    _FILE
    + f"""
[sweep]
method = "latin_hypercube"
count = {_SWEEP}
[record]
first_impact = ["time", "wheel_speed"]
end = ["wheel_angle"]
"""
)
_OF_SEARCH = (
    _FILE
    + f"""
[optimise]
maximise = "first_impact.wheel_speed"
count = {_SEARCH}
"""
)

#: Runs a case by so many workers, and returns its numbers.
Run = Callable[[int], bytes]


@contextmanager
def of_the_machine(most: int) -> Iterator[Run]:
    """The same motions of a chain, shared out to threads that share nothing.

    Args:
        most: workers.
    """
    motions = [Simulation(chain(20)) for _ in range(4 * most)]

    def move(motion: Simulation) -> bytes:
        motion.begin(0.0)
        motion.advance(0.5)
        return bytes(motion.state.tobytes())

    with ThreadPoolExecutor(1) as one, ThreadPoolExecutor(most) as several:
        yield lambda workers: b"".join((one if workers == 1 else several).map(move, motions))


@contextmanager
def of_batch(_most: int) -> Iterator[Run]:
    """Ratchets over the 6 s of the paper, in one compiled call."""
    many = Batch(models.load("ratchet").MODEL)
    spring = np.linspace(0.010, 0.020, _BATCH)

    def run(workers: int) -> bytes:
        found = many.run({"spring_stiffness": spring}, [0.0, 6.0], ["wheel_angle"], threads=workers)
        return bytes(found.values["wheel_angle"].tobytes() + found.impacts["time"].tobytes())

    yield run


@contextmanager
def of_sweep(most: int, fmu: Path, *, fast: bool) -> Iterator[Run]:
    """A sweep of ratchets, results kept on the disk.

    Args:
        most: workers.
        fmu: of the ratchet.
        fast: in one compiled call, else each design by FMI calls.
    """
    with _ready(most, fmu, _OF_SWEEP, read_sweep, fast) as (asked, stores, executors):

        def run(workers: int) -> bytes:
            return _bytes(perform_sweep(asked, next(stores), executors[workers], lambda _progress: None)[1])

        yield run


@contextmanager
def of_search(most: int, fmu: Path, *, fast: bool) -> Iterator[Run]:
    """The best of such ratchets, by differential evolution; arguments as of `of_sweep`."""
    with _ready(most, fmu, _OF_SEARCH, read_optimum, fast) as (asked, stores, executors):

        def run(workers: int) -> bytes:
            store = next(stores)
            search(asked, History(store, executors[workers], asked.count, never, lambda _history: None))
            return _bytes(store.results())

        yield run


_Asked = tuple[Any, Iterator[Store], dict[int, Executor]]


@contextmanager
def _ready(most: int, fmu: Path, text: str, read: Callable[..., Any], fast: bool) -> Iterator[_Asked]:
    """What a file asks for, a new place for results each time, and executors of one worker and of `most`."""
    with tempfile.TemporaryDirectory() as place, ExitStack() as stack:
        file = Path(place, "asked.toml")
        file.write_text(text.format(fmu=fmu.as_posix()), encoding="utf-8")
        runners = Runners(fast=fast, trust=True)
        asked, used, _, _ = stack.enter_context(opened(file, Path(place, "first"), runners, read))
        known = identity(contents(used), asked.task, asked.axes, asked.how, asked.designs)
        executors = {}
        for workers in (1, most):
            runners = Runners(workers=workers, fast=fast, trust=True)
            executors[workers] = stack.enter_context(executor_of(used, asked.task, runners))
            some = [Design(k + 1, {axis.name: axis.low for axis in asked.axes}) for k in range(2 * workers)]
            list(executors[workers](some, never))  # they start with the first designs
        stores = (Store(Path(place, f"{k}"), known, asked.axes, asked.task.quantities) for k in count())
        yield asked, stores, executors


def _bytes(table: Any) -> bytes:
    """All numbers of a table of results, in the order of the designs."""
    return repr(table.to_pydict()).encode()


def compare(run: Run, most: int, rounds: int) -> tuple[float, float]:
    """Times by one worker and by several [s].

    Args:
        run: of a case.
        most: workers.
        rounds: in which the two take turns.

    Raises:
        DisagreementError: they do not find the same.
    """
    if run(1) != run(most):
        raise DisagreementError(f"{most} workers find other numbers than one.")
    one, several = in_turns(lambda: batch(lambda: run(1), 1), lambda: batch(lambda: run(most), 1), rounds)
    return median(one), median(several)


def measure(most: int, rounds: int) -> Iterator[tuple[str, float, float]]:
    """Of each case: its name, and times by one worker and by several [s]; arguments as of `compare`."""
    with tempfile.TemporaryDirectory() as place:
        native, travels = Path(place, "native"), Path(place, "python")
        build = [sys.executable, "-m", "build_fmu", "ratchet", "-o"]
        subprocess.run([*build, str(native), "--flavour", "native"], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
        subprocess.run([*build, str(travels)], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
        fmu, python = native / "Ratchet.fmu", travels / "Ratchet.fmu"
        cases: dict[str, Callable[[int], AbstractContextManager[Run]]] = {
            "the machine itself": of_the_machine,
            f"batch, {_BATCH} designs": of_batch,
            f"sweep of a native FMU, {_SWEEP} designs": lambda most: of_sweep(most, fmu, fast=False),
            f"optimise with it, {_SEARCH} designs": lambda most: of_search(most, fmu, fast=False),
            f"sweep --fast, {_SWEEP} designs": lambda most: of_sweep(most, python, fast=True),
            f"optimise --fast, {_SEARCH} designs": lambda most: of_search(most, python, fast=True),
        }
        for name, case in cases.items():
            with case(most) as run:
                yield name, *compare(run, most, rounds)


def main() -> None:
    """Measure, and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=5, help="in which one worker and several take turns")
    parser.add_argument("--workers", type=int, default=processors(), help="how many several are")
    asked = parser.parse_args()
    print(f"{'case':40s}  1 worker  {asked.workers} workers  speed-up   [s]")
    for name, one, several in measure(asked.workers, asked.rounds):
        print(f"{name:40s} {one:8.3f} {several:10.3f} {one / several:9.2f}", flush=True)


if __name__ == "__main__":
    main()

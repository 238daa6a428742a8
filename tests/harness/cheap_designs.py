"""Sweeps whose designs take a moment and leave a trace, and a process that runs one until it is killed."""

import gc
import multiprocessing
import os
import socket
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from multiprocessing import forkserver
from pathlib import Path

from fake_slave import fake_description

from harness.designs.store import Store, identity
from harness.designs.sweep import Progress, Sweep, perform_sweep, sampled
from harness.designs.task import Design, Quantity, Result, Task, When
from harness.designs.variation import Axis
from harness.designs.workers import Backend, Work, here
from harness.run.master import TimeGrid

SQUARE = Quantity(When.END, "square", "Real", "m2")
#: Designs with these numbers fail, and crash the process.
FAILING, DEADLY = 7, 11
#: In the place of the result of this one, its process may send something else.
FORGED = 5
#: This one may take two seconds.
LONG = 40


@dataclass(frozen=True)
class Place:
    """All that these ways need of an FMU: a folder that may go, in one that stays."""

    folder: Path


def axis(name: str = "restitution", low: float = 0.0, high: float = 1.0, unit: str = "") -> Axis:
    description = fake_description()
    return Axis(description.variables[name], unit, low, high, None, (), description)


def cheap_sweep(count: int, method: str = "sobol", seed: int = 1) -> Sweep:
    axes = (axis(),)
    task = Task(TimeGrid.of(1.0, 0.1), {}, None, (SQUARE,))
    return Sweep("Cheap", task, axes, method, seed, sampled(axes, method, count, seed))


def store_of(sweep: Sweep, folder: Path) -> Store:
    known = identity({"model": "Cheap"}, sweep.task, sweep.axes, sweep.how, sweep.designs)
    return Store(folder, known, sweep.axes, sweep.task.quantities)


def _square(fmu: Place, task: Task, designs: Sequence[Design]) -> list[Result]:
    results = []
    for design in designs:
        with open(fmu.folder.parent / "trace", "a") as file:
            file.write(f"{design.number}\n")
        time.sleep(1e-3)
        x = float(design.values["restitution"])
        results.append(Result(design.number, "cheap", (x * x,)))
    return results


def _troubled(fmu: Place, task: Task, designs: Sequence[Design]) -> list[Result]:
    for design in designs:
        if design.number == DEADLY:
            os._exit(3)
    return [
        Result.failed(design, "cheap", task, "the pawl has left the wheel.") if design.number == FAILING else result
        for design, result in zip(designs, _square(fmu, task, designs), strict=True)
    ]


def _one_takes_long(fmu: Place, task: Task, designs: Sequence[Design]) -> list[Result]:
    time.sleep(2.0 * sum(design.number == LONG for design in designs))
    return _square(fmu, task, designs)


def _far(fmu: Place, task: Task, designs: Sequence[Design]) -> list[Result]:
    """A valley whose floor is at restitution 0.3, drive_torque -0.2 and 17 teeth; every 40th design fails."""
    results = []
    for design in designs:
        x, y = float(design.values.get("restitution", 0.3)), float(design.values.get("drive_torque", -0.2))
        n = int(design.values.get("tooth_count", 17))
        far = (x - 0.3) ** 2 + 4.0 * (y + 0.2) ** 2 + 0.01 * (n - 17) ** 2
        results.append(
            Result.failed(design, "cheap", task, "the pawl has left the wheel.")
            if design.number % 40 == 0
            else Result(design.number, "cheap", (far, x + y))
        )
    return results


def _forging(forged: bytes, fmu: Place, task: Task, designs: Sequence[Design]) -> list[Result]:
    """Runs designs, but sends bytes of its own instead of one result, and ends as if all were well."""
    if any(design.number == FORGED for design in designs):
        ends = [one for one in gc.get_objects() if isinstance(one, socket.socket) and one.fileno() >= 0]
        ends[0].sendall(forged)
        os._exit(0)
    return _square(fmu, task, designs)


def forging(forged: bytes) -> Backend:
    """The way that forges the result of one design."""
    return Backend("cheap", partial(_forging, forged))  # type: ignore[arg-type]


CHEAP = Backend("cheap", _square)  # type: ignore[arg-type]
TROUBLED = Backend("cheap", _troubled)  # type: ignore[arg-type]
ONE_TAKES_LONG = Backend("cheap", _one_takes_long)  # type: ignore[arg-type]
VALLEY = Backend("cheap", _far)  # type: ignore[arg-type]


def work_of(sweep: Sweep, folder: Path, way: Backend = CHEAP) -> Work:
    place = folder / f"fmu{os.getpid()}"
    place.mkdir(parents=True, exist_ok=True)
    return Work(Place(place), sweep.task, way)  # type: ignore[arg-type]


def run_cheap(count: int, folder: Path, on_progress: Callable[[Progress], None] = lambda progress: None) -> None:
    """Run what is left of a sweep in a folder, in this process."""
    sweep = cheap_sweep(count)
    perform_sweep(sweep, store_of(sweep, folder), partial(here, work_of(sweep, folder)), on_progress)


def begin_processes_with_what_they_need() -> None:
    """From now on all are copies of one that has imported most of it; else each would take seconds for that.

    The one that tests before have left is without it, and cannot be given it any more. It ends here.
    """
    assert not multiprocessing.active_children()  # for whose end that one would wait
    forkserver._forkserver._stop()
    multiprocessing.get_context("forkserver").set_forkserver_preload(["harness.designs.sweep", "harness.designs.store"])
    forkserver.ensure_running()


def run_until_killed(count: int, folder: Path) -> None:
    """Run what is left of a sweep but for the last design; whoever is to kill this process may be late."""
    run_cheap(count, folder, lambda progress: time.sleep(600) if progress.done >= count - 1 else None)

"""Command: `python -m benchmarks.endurance`, from the root of the repository: the native FMU neither grows nor drifts.

100,000 instances, 10,000,000 steps and a million impacts, each in one process; takes some minutes.
"""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable, Iterator
from ctypes import byref
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from time import perf_counter
from types import TracebackType
from typing import Any

import fmpy
import typer
from fmpy.fmi2 import FMU2Slave, defaultCallbacks, fmi2CoSimulation, fmi2Error
from rich.console import Console

import models
from mechanism_fmu.fmu.native.package import build_native_fmu

from . import impacts, rattling

#: So often each is done.
INSTANCES, STEPS, IMPACTS = 100_000, 10_000_000, 1_000_000
_STEP = 1e-3
_PERIOD = 8.0
_HOLD = 20
_MEAN, _AMPLITUDE = math.radians(84.3), math.radians(10.4)

#: The free pawl indexes an unloaded wheel for ever.
_CYCLE = {
    "tooth_slope_angle": math.radians(95),
    "restitution": 0.3,
    "drive_stiffness": 2.0,
    "drive_damping": 0.1,
    "pawl_spring_torque": 5e-3,
    "wheel_damping": 0.1,
    "spring_stiffness": 0.0,
    "spring_preload": 3e-3,
    "drive_torque": 0.0,
}


class BareHost:
    """An unzipped FMU and at most one instance of it, by the library's own functions.

    Attributes:
        time: that the instance has reached [s].
    """

    def __init__(self, folder: str) -> None:
        self._description = fmpy.read_model_description(folder)
        self._references = {variable.name: variable.valueReference for variable in self._description.modelVariables}
        self._resources = (Path(folder) / "resources").as_uri().encode()
        self._slave = FMU2Slave(
            guid=self._description.guid,
            unzipDirectory=folder,
            modelIdentifier=self._description.coSimulation.modelIdentifier,
            instanceName="endures",
        )
        self.time = 0.0

    def __enter__(self) -> BareHost:
        guid = self._description.guid.encode()
        self._slave.component = self._slave.fmi2Instantiate(
            b"endures", fmi2CoSimulation, guid, self._resources, byref(defaultCallbacks), 0, 0
        )
        self.time = 0.0
        return self

    def __exit__(self, _type: type | None, _error: BaseException | None, _trace: TracebackType | None) -> None:
        self._slave.fmi2FreeInstance(self._slave.component)

    def begin(self) -> None:
        """Go through initialization."""
        self._slave.setupExperiment(startTime=0.0)
        self._slave.enterInitializationMode()
        self._slave.exitInitializationMode()

    def step(self, size: float) -> None:
        """Make a communication step."""
        status = self._slave.fmi2DoStep(self._slave.component, self.time, size, 1)
        if status >= fmi2Error:
            raise RuntimeError(f"The step from {self.time} s has failed.")
        self.time += size

    def set(self, values: dict[str, float]) -> None:
        """Set inputs or parameters of type Real."""
        self._slave.setReal([self._references[name] for name in values], list(values.values()))

    def set_whole(self, name: str, value: int) -> None:
        """Set a parameter of type Integer."""
        self._slave.setInteger([self._references[name]], [value])

    def release_pawl(self) -> None:
        """The ratchet's pawl is free, not guided."""
        self._slave.setBoolean([self._references["guided"]], [False])

    def real(self, name: str) -> float:
        """Value of a variable of type Real."""
        return float(self._slave.getReal([self._references[name]])[0])

    def whole(self, name: str) -> int:
        """Value of a variable of type Integer."""
        return int(self._slave.getInteger([self._references[name]])[0])


def memory() -> int:
    """Memory of this process [bytes], as far as the system tells (Linux)."""
    statistics = Path("/proc/self/statm")
    return int(statistics.read_text().split()[1]) * 4096 if statistics.exists() else 0


def live_and_die(host: BareHost, count: int) -> None:
    """Make, initialize, step and free an instance, `count` times."""
    for _ in range(count):
        with host:
            host.begin()
            host.step(_STEP)


def index(host: BareHost, steps: int) -> None:
    """Make `steps` steps of 1 ms with the ratchet indexing one tooth every 8 s; its inputs change every 20 ms."""
    turn = 2 * math.pi / _PERIOD
    with host:
        host.set(_CYCLE)
        host.set_whole("tooth_count", 20)
        host.release_pawl()
        host.begin()
        for first in range(0, steps, _HOLD):
            angle = turn * _STEP * (first + _HOLD / 2)
            host.set(
                {
                    "drive_angle": _MEAN - _AMPLITUDE * math.cos(angle),
                    "drive_speed": _AMPLITUDE * turn * math.sin(angle),
                }
            )
            for _ in range(_HOLD):
                host.step(_STEP)
        teeth, expected = host.whole("clicks"), math.floor(steps * _STEP / _PERIOD)
        if abs(teeth - expected) > 1:
            raise RuntimeError(f"The ratchet has gone {teeth} teeth in {expected} strokes.")


def rattle(host: BareHost, count: int) -> float:
    """Have the pawl make `count` impacts, in steps of about four hops.

    Returns:
        Relative drift of the energy, which nothing dissipates.
    """
    size = 4 * 2 * impacts.SPEED * impacts.ABOUT_HINGE / impacts.TORQUE
    with host:
        host.begin()
        first = _energy(host)
        while host.whole(rattling.COUNTER) < count:
            for _ in range(100):
                host.step(size)
        return _energy(host) / first - 1


def _energy(host: BareHost) -> float:
    return host.real("kinetic_energy") + host.real("spring_energy") - host.real("work_done")


def build(module: Any, folder: Path) -> BareHost:
    """Build the native FMU of a model and unzip it."""
    unzipped = folder / module.MODEL.name
    fmpy.extract(str(build_native_fmu(module, folder)), str(unzipped))
    return BareHost(str(unzipped))


@dataclass(frozen=True)
class Endured:
    """What was done so many times in one process.

    Attributes:
        what: it was.
        each: one of them, in a word.
        count: how many.
        before, after: memory of the process [bytes]; 0 where the system does not tell.
        seconds: all of them took [s].
        drift: of the energy, relative; None where that is not looked at.
    """

    what: str
    each: str
    count: int
    before: int
    after: int
    seconds: float
    drift: float | None


def measure(instances: int = INSTANCES, steps: int = STEPS, impact_count: int = IMPACTS) -> Iterator[Endured]:
    """Do all three, each so many times."""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        ratchet, pawl = build(models.load("ratchet"), Path(folder)), build(rattling, Path(folder))

        def repeat(what: str, each: str, operation: Callable[[int], float | None], count: int) -> Endured:
            operation(1000)  # all that is made once is made here
            before, began = memory(), perf_counter()
            drift = operation(count)
            seconds = perf_counter() - began
            return Endured(what, each, count, before, memory(), seconds, drift)

        yield repeat(
            "instances made, initialized, stepped and freed", "instance", partial(live_and_die, ratchet), instances
        )
        yield repeat("steps of 1 ms of the ratchet that indexes", "step", partial(index, ratchet), steps)
        yield repeat("impacts of the pawl that rattles", "impact", partial(rattle, pawl), impact_count)


def run(instances: int = INSTANCES, steps: int = STEPS, impact_count: int = IMPACTS) -> None:
    """Report memory before and after, and what the runs have ended with; all else is an exception."""
    out = Console(highlight=False)
    for one in measure(instances, steps, impact_count):
        told = "" if one.drift is None else f", drift of energy {one.drift:.2g}"
        out.print(
            f"{one.count:>12,} {one.what}: {one.before / 1e6:.2f} MB before, {one.after / 1e6:.2f} MB after; "
            f"{one.seconds:.1f} s, {one.seconds / one.count * 1e6:.2f} us each{told}",
            soft_wrap=True,
        )


if __name__ == "__main__":
    typer.run(run)

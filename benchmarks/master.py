"""Cost of the master of machines: what it adds to the calls of native FMUs, and a minute of a machine."""

from __future__ import annotations

import runpy
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from ctypes import Array, c_void_p
from functools import partial
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np
import numpy.typing as npt

import models
from harness.fmu import Fmu, open_fmu
from harness.fmu.description import Value
from harness.fmu.instances.fmi2 import Fmi2Slave
from harness.fmu.instances.message_log import discard_message
from harness.fmu.interface import Observable
from harness.machine.connection import Connection
from harness.machine.machine import Machine
from harness.machine.part import Extrapolation
from harness.machine.running import run_machine
from harness.machine.stepping import Jacobi
from harness.run.master import Ending, Observer, TimeGrid
from mechanism_fmu.fmu.native.package import build_native_fmu

from .fmus import ROOT
from .timing import Comparison, DisagreementError, in_turns, require_agreement

#: Where the parts of the machine, their values and connections are.
_EXAMPLE = ROOT / "docs" / "examples" / "indexing_machine.py"
_PARTS = ("gear_train", "cam_drive", "ratchet")
_HOW = {Extrapolation.CONSTANT: "inputs held", Extrapolation.DERIVATIVES: "inputs going on by derivatives"}
_LOOKED_AT = ("gear_train.wheel_angle", "cam_drive.follower_speed", "ratchet.wheel_angle", "ratchet.crank_speed")
_STEP, _MINUTE = 1e-3, 60.0
#: Of a run, and how often it is repeated in a round [s].
_SPAN, _REPEATS = 0.2, 30
_MOST_ADDED, _LONGEST = 5e-6, 10.0

#: Of each step [s].
Times = npt.NDArray[np.float64]
#: A function of an FMU's library as it was called: name of the part, of the function, and all arguments but the first.
_Call = tuple[str, str, tuple[Any, ...], tuple[Any, ...]]


def compare(folder: Path, rounds: int) -> list[Comparison]:
    """Run the machine of `docs/examples/indexing_machine.py` by Jacobi's scheme.

    Raises:
        MechanismError: there is no linker for native FMUs.
    """
    with ExitStack() as stack:
        fmus = {
            name: stack.enter_context(open_fmu(build_native_fmu(models.load(name), folder / "machine")))
            for name in _PARTS
        }
        workshop = _Workshop(fmus)
        with workshop.parts(Fmi2Slave) as parts:
            minute = float(workshop.run(parts, _MINUTE, Extrapolation.CONSTANT).sum())
            compared = [_added(workshop, parts, how, rounds) for how in _HOW]
    run = Comparison("a machine of three native FMUs", "60 s in steps of 1 ms", (_MINUTE,), (minute,), longest=_LONGEST)
    return [*compared, run]


def _added(workshop: _Workshop, parts: Mapping[str, Fmi2Slave], how: Extrapolation, rounds: int) -> Comparison:
    """What the master adds to a step of a component.

    Other programs only ever add to a time, and the difference is small: of each step the shortest of some repetitions
    counts.
    """
    calls = workshop.recorded(_SPAN, how)
    components = sum(name == "fmi2DoStep" for step in calls for _, name, _, _ in step)

    def shortest(steps: Callable[[], Times]) -> float:
        return float(np.min([steps() for _ in range(_REPEATS)], axis=0).sum()) / components

    without, whole = in_turns(
        lambda: shortest(lambda: workshop.replay(parts, calls, how)),
        lambda: shortest(lambda: workshop.run(parts, _SPAN, how)),
        rounds,
    )
    added = tuple(b - a for a, b in zip(without, whole, strict=True))
    subject = "a step of a component (baseline: its FMI calls alone)"
    most = _MOST_ADDED if how is Extrapolation.CONSTANT else None
    return Comparison(subject, f"what the master adds, {_HOW[how]}", without, added, longest=most)


class _Recording(Fmi2Slave):
    """An instance that keeps what its library is asked, in `calls`."""

    calls: list[list[_Call]]

    def raw(self, name: str, *types: Any) -> Callable[..., int]:
        raw = super().raw(name, *types)

        def call(component: Any, *arguments: Any) -> int:
            kept = (type(a).from_buffer_copy(a) if isinstance(a, Array) else a for a in arguments)
            self.calls[-1].append((self.name, name, types, tuple(kept)))
            return raw(component, *arguments)

        return call


class _Stopwatch:
    """An observer that notes when each step ends."""

    def __init__(self) -> None:
        self.times: list[float] = []

    def started(self, unit: Observable, time: float) -> None:
        """The clock starts."""
        self.times.append(perf_counter())

    def stepped(self, unit: Observable, time: float) -> None:
        """A step has ended."""
        self.times.append(perf_counter())


class _Divider:
    """An observer that divides recorded calls by steps, and lets go what was before the first."""

    def __init__(self, calls: list[list[_Call]]) -> None:
        self._calls = calls

    def started(self, unit: Observable, time: float) -> None:
        """The first step begins."""
        self._calls[:] = [[]]

    def stepped(self, unit: Observable, time: float) -> None:
        """The next step begins."""
        self._calls.append([])


class _Workshop:
    """The machine of the example, of native FMUs, to be run again and again.

    Attributes:
        reached: where the last run ended; calls that are made again must end there, too.
    """

    def __init__(self, fmus: Mapping[str, Fmu]) -> None:
        example = runpy.run_path(str(_EXAMPLE))
        self.values: Mapping[str, Value] = {
            f"{part}.{name}": value for part, own in example["VALUES"].items() for name, value in own.items()
        }
        self._connections = [
            Connection(c.source, c.target, c.gain, c.offset, c.rate or "") for c in example["CONNECTIONS"]
        ]
        self._fmus = fmus
        self.reached: list[Value] = []

    def run(self, parts: Mapping[str, Fmi2Slave], stop_time: float, how: Extrapolation, *observers: Observer) -> Times:
        """Run the machine; how long each step took [s]."""
        for part in parts.values():
            part.reset()
        watch = _Stopwatch()
        machine = Machine(parts, self._connections, how)
        grid = TimeGrid.of(stop_time, _STEP)
        outcome = run_machine(machine, Jacobi(), grid, self.values, [watch, *observers])
        if outcome.ending is not Ending.COMPLETED:
            raise DisagreementError(f"The machine of {_EXAMPLE.name} does not run: {outcome.error}")
        self.reached = machine.get(_LOOKED_AT)
        return np.diff(watch.times)

    def recorded(self, stop_time: float, how: Extrapolation) -> list[list[_Call]]:
        """All calls of a run's steps."""
        calls: list[list[_Call]] = [[]]
        with self.parts(_Recording) as parts:
            for part in parts.values():
                part.calls = calls
            self.run(parts, stop_time, how, _Divider(calls))
        return calls

    def replay(self, parts: Mapping[str, Fmi2Slave], calls: Sequence[Sequence[_Call]], how: Extrapolation) -> Times:
        """Make the same calls, and nothing else; how long those of each step took [s]."""
        for part in parts.values():
            part.reset()
        machine = Machine(parts, self._connections, how)
        machine.set(self.values)
        machine.initialize(0.0, _SPAN)
        steps = [
            [
                partial(parts[part].raw(name, *types), c_void_p(parts[part]._instance.component), *arguments)
                for part, name, types, arguments in step
            ]
            for step in calls[:-1]
        ]
        times = [perf_counter()]
        for step in steps:
            for call in step:
                call()
            times.append(perf_counter())
        require_agreement("The machine of FMUs and its calls alone", self.reached, machine.get(_LOOKED_AT), 0.0)
        machine.terminate()
        return np.diff(times)

    @contextmanager
    def parts(self, kind: type[Any]) -> Iterator[dict[str, Any]]:
        """Instances, by part."""
        with ExitStack() as stack:
            parts = {}
            for name, fmu in self._fmus.items():
                parts[name] = kind(fmu.description, fmu.folder, name, discard_message)
                stack.callback(parts[name].free)
            yield parts

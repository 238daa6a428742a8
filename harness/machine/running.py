"""Run of a machine from start to stop: preparation, the loop of steps, warnings of its coupling, results."""

from __future__ import annotations

import math
from array import array
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd

from mechanism_fmu.stress import MaterialCard

from ..errors import FmuError, LogMessage, Status
from ..fmu import Fmu
from ..fmu.description import Description, Value
from ..fmu.interface import Observable
from ..run.drawing import Drawing
from ..run.inputs import InputSignals
from ..run.master import Ending, Observer, Outcome, TimeGrid, never, seconds
from .file.machine_plan import Plan
from .file.notes import notes
from .machine import Machine
from .observers.bonds import BondEnergy
from .observers.component_impacts import ComponentImpacts, Impacts
from .observers.record import readings
from .observers.watched import Watched
from .stepping import LEAST_STEP, Adaptive, Algorithm, EventAware

# A machine whose file is read, and whose FMUs are there.


@dataclass(frozen=True)
class Prepared:
    """A machine whose FMUs are there.

    Attributes:
        plan: it.
        fmus: of its components, by name.
        description: of it, connected.
        inputs: that a table drives.
    """

    plan: Plan
    fmus: Mapping[str, Fmu]
    description: Description
    inputs: InputSignals | None

    @property
    def descriptions(self) -> dict[str, Description]:
        """Of the components' FMUs, by name."""
        return {name: fmu.description for name, fmu in self.fmus.items()}

    @property
    def notes(self) -> list[str]:
        """What is to be said of it that is no mistake."""
        driven = [] if self.inputs is None else [variable.name for variable in self.inputs.variables]
        read = [] if self.inputs is None or not self.inputs.note else [self.inputs.note]
        return read + notes(self.plan, self.descriptions, driven)


# What pictures of a machine need: its signals at few moments, whatever is recorded, with constant memory.

#: Moments that are spread over the run; as many more are kept for impacts.
FRAMES = 400

#: A communication point that is due but for its last bits [part of the time between two frames].
_SLACK = 1e-6


@dataclass(frozen=True)
class Seen:
    """What was seen of a run.

    Attributes:
        table: `time` [s] and the signals by their names in the machine, as float64; a row for each moment.
            What cannot be read is nan.
        constants: parameters and calculated parameters by name, after the initialization; {} if it failed.
    """

    table: pd.DataFrame
    constants: Mapping[str, Value]


class Frames:
    """An observer that keeps signals at evenly spread communication points, and at those of impacts."""

    def __init__(
        self,
        machine: Machine,
        signals: Sequence[str],
        constants: Sequence[str],
        stop_time: float,
        impacts: Impacts | None = None,
    ) -> None:
        """Bind what is to be read, before the run.

        Args:
            machine: whose signals they are.
            signals: names of numbers that move.
            constants: names of those that do not: they are read once.
            stop_time: of the run [s].
            impacts: another observer, before this one: knows where there were impacts.
        """
        self._readings = readings(machine, [machine.description.variable(name) for name in signals])
        self._names = ["time", *(name for reading in self._readings for name in reading.names)]
        self._constant_names = tuple(constants)
        self._constants: dict[str, Value] = {}
        self._numbers = array("d")
        self._span = stop_time / FRAMES
        self._number = 1
        self._struck = 0
        self._impacts = impacts

    def started(self, unit: Observable, time: float) -> None:
        """Keep what is constant, and the first frame."""
        self._constants = dict(zip(self._constant_names, unit.get(self._constant_names), strict=True))
        self._keep(time)

    def stepped(self, unit: Observable, time: float) -> None:
        """Keep a frame when one is due, or an impact has come and there is space for it."""
        if time >= (self._number - _SLACK) * self._span:
            self._number = int(time / self._span + _SLACK) + 1
            self._keep(time)
        elif self._impacts is not None and self._impacts.struck and self._struck < FRAMES:
            self._struck += 1
            self._keep(time)

    def seen(self) -> Seen:
        """What was kept so far."""
        rows = np.array(self._numbers).reshape(-1, len(self._names))
        return Seen(pd.DataFrame(rows, columns=self._names), self._constants)

    def _keep(self, time: float) -> None:
        self._numbers.append(time)
        for reading in self._readings:
            try:
                self._numbers.extend(reading.read())
            except FmuError:  # what is no number is no picture; it need not be the end of the run
                self._numbers.extend([math.nan] * len(reading.names))


# What the user of a machine should know before believing its results.

#: A coupling that makes or loses more than this fraction of what passes is warned of.
_TOLERATED = 0.05


def cautions(algorithm: Algorithm) -> list[LogMessage]:
    """Warnings for `terminal.show_warning` and summary.json.

    Those of parts that cannot be put back are known before the run, those of steps that were too long after it.
    """
    if isinstance(algorithm, EventAware):
        return [
            _warning(
                name,
                "it cannot be put back (canGetAndSetFMUstate), so the others feel its impacts only at the end of the "
                "step; take a shorter step to feel them sooner.",
            )
            for name in algorithm.felt_late
        ]
    if isinstance(algorithm, Adaptive) and algorithm.too_small:
        return [
            _warning(
                "machine",
                f"{algorithm.too_small} steps missed the tolerance {algorithm.tolerance:g} though they were as short "
                f'as they may be, {LEAST_STEP / 1000:g} us; impacts are for algorithm = "event_aware".',
            )
        ]
    return []


def loop_cautions(machine: Machine, time: float) -> list[LogMessage]:
    """A warning of loops without delay that a run until `time` [s] has left unsolved."""
    if not machine.unsettled:
        return []
    inputs = "; ".join(", ".join(loop) for loop in machine.structure.loops)
    return [
        _warning(
            "machine",
            f"{machine.unsettled} exchanges ended while a loop without any delay was still changing its inputs "
            f"({inputs}): they, and all that follows them, depend on how often it was gone round. Let one of its "
            "components return something that does not follow its inputs at once, such as the motion of an inertia.",
            time,
        )
    ]


def bond_cautions(energies: Mapping[str, BondEnergy], time: float) -> list[LogMessage]:
    """Warnings of couplings that have made or lost much energy until `time` [s]: the steps are too long for them."""
    warnings = []
    for name, energy in energies.items():
        if abs(energy.made) > _TOLERATED * energy.most:
            did = "made" if energy.made > 0.0 else "lost"
            warnings.append(
                _warning(
                    "machine",
                    f"over the bond '{name}', the coupling itself has {did} {abs(energy.made):.3g} J, where "
                    f"{energy.most:.3g} J passed at most: the motion is that of another machine, or unstable. Take "
                    'extrapolation = "derivatives" and a step that the lightest body on this shaft allows '
                    '(docs/how-to/machines-running.md), or algorithm = "adaptive".',
                    time,
                )
            )
    return warnings


def _warning(instance: str, text: str, time: float = 0.0) -> LogMessage:
    return LogMessage(instance, time, Status.WARNING, "", text)


def run_machine(
    machine: Machine,
    algorithm: Algorithm,
    grid: TimeGrid,
    start_values: Mapping[str, Value],
    observers: Sequence[Observer] = (),
    inputs: InputSignals | None = None,
    stop_requested: Callable[[], bool] = never,
) -> Outcome:
    """Set start values, initialize, and take a machine through the grid; an algorithm may make more steps of one.

    An error of a component ends the run, and everything observed before it stays with the observers; what was seen in a
    step that not all parts have completed has not happened.

    Args:
        machine: with its parts instantiated.
        algorithm: how it takes a step.
        grid: communication points.
        start_values: by "<part>.<variable>", in its unit.
        observers: who looks on at communication points.
        inputs: signals that open inputs follow, or None.
        stop_requested: asked before each step.
    """
    reached, steps = grid.start, 0
    machine.point = 0
    watched = [part.component for part in machine.parts.values() if isinstance(part.component, Watched)]
    try:
        machine.set(start_values if inputs is None else {**start_values, **inputs.at(seconds(grid.start))})
        if inputs is not None:
            machine.drive(inputs, grid.start)
        machine.initialize(seconds(grid.start), seconds(grid.stop))
        for observer in observers:
            observer.started(machine, seconds(grid.start))
        for number, (_, end) in enumerate(grid, start=1):
            while reached < end and not stop_requested():
                memories = [one.memories() for one in watched]
                try:
                    reached = algorithm.advance(machine, reached, end)
                except FmuError:
                    for one, memory in zip(watched, memories, strict=True):
                        one.recall(memory)
                    raise
                machine.point = number if reached == end else None
                steps += 1
                for observer in observers:
                    observer.stepped(machine, seconds(reached))
            if reached < end:
                break
        machine.terminate()
    except FmuError as error:
        return Outcome(Ending.FAILED, seconds(reached), steps, error)
    finally:
        machine.free_states()
    ending = Ending.COMPLETED if reached == grid.stop else Ending.INTERRUPTED
    return Outcome(ending, seconds(reached), steps)


# What came of a machine's run.


@dataclass(frozen=True)
class MachineRun:
    """What came of a run.

    Attributes:
        machine: that ran.
        outcome: how far it came.
        results: file of the recorded signals; of a run whose disk was full, the folder of what was recorded before.
        units: of results and of impacts, by name ("1": dimensionless).
        impacts: of all components, in the order of time.
        by_component: what struck each component that reports impacts.
        card: material of the beams that impacts strike.
        bonds: energies over power bonds, by name.
        statistics: of each component, ready for JSON.
        rows: of their table, below `machine.statistics.HEADINGS`.
        wall_time: of the simulation [s].
        messages: that need attention, of the components' FMUs; the first ones, if there are very many.
        drawings: of the components' mechanisms, by name.
        seen: what pictures of it need.
        cautions: what the user should know before believing it, beside the machine's notes.
    """

    machine: Prepared
    outcome: Outcome
    results: Path
    units: Mapping[str, Mapping[str, str]]
    impacts: pd.DataFrame
    by_component: Mapping[str, ComponentImpacts]
    card: MaterialCard
    bonds: Mapping[str, BondEnergy]
    statistics: Mapping[str, Mapping[str, float]]
    rows: list[list[str]]
    wall_time: float
    messages: Sequence[LogMessage]
    drawings: Mapping[str, Drawing]
    seen: Seen
    cautions: list[LogMessage]

"""Run of a machine with a progress display: observers, interruption, and the record of the run."""

from __future__ import annotations

import time
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from mechanism_fmu.stress import material_card

from ...errors import LogMessage, UsageError
from ...fmu.description import Description
from ...fmu.interface import Observable
from ...machine.file.machine_plan import Scheme
from ...machine.machine import Machine
from ...machine.observers.bonds import Bond, Bonds
from ...machine.observers.component_impacts import Impacts
from ...machine.observers.growing_table import FORMATS
from ...machine.observers.record import Recorder, chosen
from ...machine.observers.watched import statistics, statistics_rows
from ...machine.running import Frames, MachineRun, Prepared, bond_cautions, cautions, loop_cautions, run_machine
from ...machine.stepping import algorithm_of
from ...report.motion import SUFFIX
from ...report.scene import names_of
from ...run.drawing import Drawing, read_drawing
from ...run.master import Ending, Observer, TimeGrid
from ..execution import interruption
from ..terminal import RunDisplay, console, show_warning
from .machine_ready import instantiated

# Which variables of a machine its pictures need.


def pictured(drawings: Mapping[str, Drawing], descriptions: Mapping[str, Description]) -> tuple[list[str], list[str]]:
    """Those that move, active contacts and strokes among them, and those that do not, by their names in the machine."""
    moving, constant = [], []
    for part, drawing in drawings.items():
        drawn = names_of(drawing.shapes)
        struck = descriptions[part].analysis.struck
        counter = "" if struck is None else struck.strokes
        for name, variable in descriptions[part].variables.items():
            if variable.causality not in ("input", "output"):
                constant += [f"{part}.{name}"] if name in drawn else []
            elif (
                name in drawn
                or _is_contact_state(drawing, name, variable.type)
                or _counts(counter, name, variable.type)
            ):
                moving.append(f"{part}.{name}")
    return moving, constant


def _is_contact_state(drawing: Drawing, name: str, kind: str) -> bool:
    return bool(drawing.shapes) and kind == "Boolean" and name.endswith(SUFFIX)


def _counts(counter: str, name: str, kind: str) -> bool:
    return name == counter and kind in ("Integer", "Real")


#: More messages than this are shown, but not kept.
_MOST_MESSAGES = 1000


class _Beginning:
    """An observer that shows whether there is anything to keep."""

    def __init__(self) -> None:
        self.reached = False

    def started(self, unit: Observable, time: float) -> None:
        self.reached = True

    def stepped(self, unit: Observable, time: float) -> None:
        pass


class _Recording:
    """A recorder whose disk may become full: then the run ends, and what else came of it can still be written.

    Attributes:
        refused: why it could not go on.
    """

    def __init__(self, recorder: Recorder, file: Path) -> None:
        self.refused: UsageError | None = None
        self._recorder = recorder
        self._file = file

    def started(self, unit: Observable, time: float) -> None:
        self._recorder.started(unit, time)

    def stepped(self, unit: Observable, time: float) -> None:
        try:
            self._recorder.stepped(unit, time)
        except UsageError as error:
            self.refused = error

    def finish(self) -> Path:
        """What was recorded: one file, or else the folder of its parts."""
        try:
            path = self._recorder.finish()
        except UsageError as error:
            self.refused = self.refused or error
            return self._file.with_suffix(".parts")
        for suffix in FORMATS:
            if path.suffix != suffix:
                path.with_suffix(suffix).unlink(missing_ok=True)  # of an earlier run
        return path


class _Said:
    """What FMUs say: shown at once, and kept where it needs attention."""

    def __init__(self) -> None:
        self.messages: list[LogMessage] = []

    def __call__(self, message: LogMessage) -> None:
        show_warning(message)
        if message.needs_attention and len(self.messages) < _MOST_MESSAGES:
            self.messages.append(message)


def perform(machine: Prepared, folder: Path) -> MachineRun:
    """Run a machine; the signals are recorded in `folder` as they come.

    Raises:
        FmuError: a component cannot even be instantiated or initialized; nothing is written.
        UsageError: the disk refuses before the run, or a bond is none.
    """
    plan = machine.plan
    grid = TimeGrid.of(plan.policy.stop_time, plan.policy.step)
    card = material_card(plan.material)
    said = _Said()
    with (
        RunDisplay(plan.policy.stop_time, "Loading the components ...") as display,
        interruption(lambda: console.print("Ending at the next step; Ctrl-C again to break off.")) as stop_requested,
        instantiated(machine, said) as parts,
    ):
        unit = Machine(
            parts, plan.connections, plan.policy.extrapolation, plan.title, reads_once=plan.policy.reads_once
        )
        impacts = Impacts(unit)
        bonds = Bonds(unit, {bond.name: Bond(bond.flow, bond.effort, bond.reaction) for bond in plan.bonds})
        signals = [variable.name for variable in chosen(plan.recording.signals, unit.description)]
        file = folder / f"results.{plan.recording.format}"
        recorder = Recorder(unit, file, signals, plan.recording.every, impacts)
        recording = _Recording(recorder, file)
        drawings = {name: read_drawing(fmu.folder, fmu.description) for name, fmu in machine.fmus.items()}
        frames = Frames(unit, *pictured(drawings, machine.descriptions), plan.policy.stop_time, impacts)
        beginning = _Beginning()
        algorithm = algorithm_of(plan.policy, unit)
        observers: list[Observer] = [impacts, bonds, recording, frames, display, beginning]
        began = time.perf_counter()

        def ended() -> bool:
            return stop_requested() or recording.refused is not None

        outcome = run_machine(unit, algorithm, grid, plan.start_values, observers, machine.inputs, ended)
        wall_time = time.perf_counter() - began
    if outcome.error is not None and not beginning.reached:
        with suppress(OSError):
            file.with_suffix(".parts").rmdir()  # of the recorder, empty
        raise outcome.error
    results = recording.finish()
    if outcome.error is None and recording.refused is not None:
        outcome = replace(outcome, ending=Ending.FAILED, error=recording.refused)
    found, energies = impacts.by_component(card), bonds.energies()
    # those of a step to the impact are among the notes
    of_steps = [] if plan.policy.scheme is Scheme.EVENT_AWARE else cautions(algorithm)
    return MachineRun(
        machine=machine,
        outcome=outcome,
        results=results,
        units={"results": recorder.units, "impacts": impacts.units},
        impacts=impacts.table(found),
        by_component=found,
        card=card,
        bonds=energies,
        statistics=statistics(unit),
        rows=statistics_rows(unit, wall_time),
        wall_time=wall_time,
        messages=said.messages,
        drawings=drawings,
        seen=frames.seen(),
        cautions=[*of_steps, *loop_cautions(unit, outcome.final_time), *bond_cautions(energies, outcome.final_time)],
    )

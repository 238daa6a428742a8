"""Machines of FMUs that are there: their files, and how they run without a command."""

from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from functools import partial
from pathlib import Path

import pandas as pd
from typer.testing import CliRunner

from harness.app.cli import main
from harness.fmu import open_fmu
from harness.machine.file.machine_plan import Plan
from harness.machine.file.read_file import components, read_plan
from harness.machine.machine import Machine
from harness.machine.part import Extrapolation
from harness.machine.running import run_machine
from harness.machine.stepping import Jacobi
from harness.run.master import Ending, Recorder, TimeGrid
from harness.toml_file import TomlFile

#: A motor turns gears, and their wheel a cam, by a shaft. Nothing is known of their past: they start at rest, at 0.
GEARED_CAM = """
title = "Geared cam"
[run]
stop_time = "1 s"
step = "5 ms"
algorithm = "jacobi"
extrapolation = "constant"
[component.gears]
file = "{gear_train}"
[component.gears.set]
drive_speed = "-60 rpm"
drive_damping = "0.5 N.m.s/rad"
drive_torque = 0.0
[component.cam]
file = "{cam_drive}"
[component.cam.set]
cam_speed_start = 0.0
unilateral = {unilateral}
drive_stiffness = "5 N.m/rad"
drive_damping = "0.2 N.m.s/rad"
[[connect]]
from = "gears.wheel_angle"
to = "cam.drive_angle"
rate = "gears.wheel_speed"
[[connect]]
from = "gears.wheel_speed"
to = "cam.drive_speed"
{back}
[record]
signals = ["gears.*_angle", "cam.*_angle", "cam.*_speed"]
every = 2
"""

#: What the shaft does to the cam, it does to the wheel the other way round.
BACK = """
[[connect]]
from = "cam.drive_shaft_torque"
to = "gears.load_torque"
gain = -1.0
offset = "1 N.mm"
[[bond]]
name = "shaft"
flow = "cam.drive_speed"
effort = "gears.load_torque"
"""

SIGNALS = ("gears.wheel_angle", "gears.wheel_speed", "cam.cam_angle", "cam.follower_angle")


def geared_cam(folder: Path, gear_train: Path, cam_drive: Path, back: str = BACK, unilateral: str = "true") -> Path:
    """Write the file of the machine."""
    path = folder / "geared_cam.toml"
    path.write_text(
        GEARED_CAM.format(gear_train=gear_train, cam_drive=cam_drive, back=back, unilateral=unilateral),
        encoding="utf-8",
    )
    return path


def plan_of(path: Path) -> Plan:
    """The plan of a file whose components are FMU files."""
    file = TomlFile.read(path)
    parts = components(file, [])
    with ExitStack() as stack:
        fmus = {part.name: stack.enter_context(open_fmu(_file(part.source.path))) for part in parts}
        return read_plan(file, parts, {name: fmu.description for name, fmu in fmus.items()})


#: A machine that reads each output once at a communication point, and only then sets inputs, as other tools do.
ReadOnce = partial(Machine, reads_once=True)


def run(
    plan: Plan, signals: Sequence[str] = SIGNALS, kind: Callable[..., Machine] = Machine, step: float | None = None
) -> pd.DataFrame:
    """Run a plan by Jacobi's scheme with inputs held; the signals at each communication point."""
    with ExitStack() as stack:
        fmus = {part.name: stack.enter_context(open_fmu(_file(part.source.path))) for part in plan.components}
        parts = {name: stack.enter_context(fmu.instantiate(name)) for name, fmu in fmus.items()}
        machine = kind(parts, plan.connections, Extrapolation.CONSTANT)
        recorder = Recorder([machine.description.variables[name] for name in signals])
        grid = TimeGrid.of(plan.policy.stop_time, step or plan.policy.step)
        outcome = run_machine(machine, Jacobi(), grid, plan.start_values, [recorder])
    assert outcome.ending is Ending.COMPLETED, outcome.error
    return recorder.table()


def references(plan: Plan, signals: Sequence[str] = SIGNALS) -> Mapping[str, tuple[str, int]]:
    """For each signal its component and its value reference there."""
    found = {}
    for part in plan.components:
        with open_fmu(_file(part.source.path)) as fmu:
            for signal in signals:
                name, _, own = signal.partition(".")
                if name == part.name:
                    found[signal] = name, fmu.description.variables[own].reference
    return found


def _file(path: Path | None) -> Path:
    assert path is not None
    return path


def invoke(*arguments: str | Path) -> tuple[int, str]:
    """Exit code and text of a command `machine ...`."""
    result = CliRunner().invoke(main, ["machine", *(str(a) for a in arguments)])
    assert result.exception is None or isinstance(result.exception, SystemExit)
    return result.exit_code, " ".join(result.output.split())

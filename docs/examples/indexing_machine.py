"""A machine of three FMUs: a motor turns a gear train, which turns a cam, which swings the crank of a ratchet.

    python docs/examples/indexing_machine.py          writes machine/results.csv

Two turns of the cam index the ratchet's wheel by two teeth. The parts meet only in their inputs and outputs, at
communication points at most `STEP` apart: a step ends where one of them has an impact. In between, inputs go on as the
outputs that they follow did; native FMUs (which need the package ziglang to be built) take such slopes of inputs.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from contextlib import ExitStack
from pathlib import Path

import pandas as pd

from build_fmu import Flavour, build
from harness.fmu import open_fmu
from harness.machine.connection import Connection
from harness.machine.machine import Machine
from harness.machine.observers.bonds import Bond, BondEnergy, Bonds
from harness.machine.observers.record import Recorder
from harness.machine.part import Extrapolation
from harness.machine.running import run_machine
from harness.machine.stepping import EventAware
from harness.run.master import Ending, TimeGrid
from harness.run.results import prepare_folder

STOP_TIME, STEP = 17.0, 2e-3

#: One turn of the cam, and one stroke of the crank, in 8 s.
CAM_SPEED = 2 * math.pi / 8
#: The cam starts on the lower dwell, just before the rise.
CAM_ANGLE = math.radians(160)
RATIO = -0.05 / 0.12
#: From the follower's lowest angle to the crank's, where the ratchet's stroke begins.
CRANK_ANGLE = math.radians(73.9)
FOLLOWER_TO_CRANK = CRANK_ANGLE - 0.5053605102841573

#: The parts' parameters and free inputs, by part, in SI units.
VALUES = {
    "gear_train": {
        "pinion_inertia": 1e-4,
        "wheel_inertia": 2e-3,
        "pinion_angle_start": CAM_ANGLE / RATIO,
        "pinion_speed_start": CAM_SPEED / RATIO,
        # A motor whose torque falls with its speed.
        "drive_speed": CAM_SPEED / RATIO,
        "drive_damping": 0.5,
        "drive_torque": 0.0,
    },
    "cam_drive": {
        "cam_angle_start": CAM_ANGLE,
        "cam_speed_start": CAM_SPEED,
        "unilateral": True,
        "spring_preload": 0.05,
        "drive_stiffness": 5.0,
        "drive_damping": 0.2,
    },
    "ratchet": {
        "guided": False,
        "tooth_count": 20,
        "tooth_slope_angle": math.radians(95),
        "crank_angle_start": CRANK_ANGLE,
        "drive_stiffness": 2.0,
        "drive_damping": 0.1,
        "drive_torque": 0.0,
        "pawl_spring_torque": 5e-3,
        "wheel_damping": 0.1,
        "spring_preload": 3e-3,
    },
}

#: Speeds one way, torques back: what a shaft does to its driven body it does to its driver the other way round.
BONDS = {
    "gears to cam": Bond(
        Connection("gear_train.wheel_speed", "cam_drive.drive_speed"),
        Connection("cam_drive.drive_shaft_torque", "gear_train.load_torque", gain=-1.0),
    ),
    "cam to ratchet": Bond(
        Connection("cam_drive.follower_speed", "ratchet.drive_speed"),
        Connection("ratchet.drive_shaft_torque", "cam_drive.load_torque", gain=-1.0),
    ),
}
CONNECTIONS = (
    Connection("gear_train.wheel_angle", "cam_drive.drive_angle", rate="gear_train.wheel_speed"),
    Connection(
        "cam_drive.follower_angle",
        "ratchet.drive_angle",
        offset=FOLLOWER_TO_CRANK,
        rate="cam_drive.follower_speed",
    ),
    *(connection for bond in BONDS.values() for connection in (bond.flow, bond.effort)),
)


def run(fmus: Mapping[str, Path], step: float, file: Path, stop_time: float = STOP_TIME) -> dict[str, BondEnergy]:
    """Run the machine.

    Args:
        fmus: FMU files by part.
        step: largest communication step [s].
        file: that gets a row for each communication point; `.csv` or `.parquet`.
        stop_time: [s].

    Returns:
        What passed over each bond.
    """
    with ExitStack() as stack:
        parts = {
            name: stack.enter_context(stack.enter_context(open_fmu(path)).instantiate(name))
            for name, path in fmus.items()
        }
        machine = Machine(parts, CONNECTIONS, Extrapolation.DERIVATIVES, "IndexingMachine")
        bonds, recorder = Bonds(machine, BONDS), Recorder(machine, file)
        values = {f"{part}.{name}": value for part, own in VALUES.items() for name, value in own.items()}
        outcome = run_machine(machine, EventAware(machine), TimeGrid.of(stop_time, step), values, [bonds, recorder])
    recorder.finish()
    if outcome.ending is not Ending.COMPLETED:
        raise SystemExit(str(outcome.error))
    return bonds.energies()


def main(folder: Path = Path("machine")) -> None:
    """Build the FMUs, run the machine, write its results, and say what came of it."""
    prepare_folder(folder)
    for model in VALUES:
        build(model, folder, Flavour.NATIVE)
    fmus = dict(zip(VALUES, (folder / f"{name}.fmu" for name in ("GearTrain", "CamDrive", "Ratchet")), strict=True))
    energies = run(fmus, STEP, folder / "results.csv")
    end = pd.read_csv(folder / "results.csv").iloc[-1]
    print(f"clicks: {end['ratchet.clicks']:g}, wheel at {math.degrees(end['ratchet.wheel_angle [rad]']):.4f} deg")
    for name, energy in energies.items():
        print(
            f"{name}: {energy.given:.4g} J given, {energy.taken:.4g} J taken, made by the coupling {energy.made:.2g} J"
        )


if __name__ == "__main__":
    main()

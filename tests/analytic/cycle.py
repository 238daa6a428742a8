"""The free ratchet through whole strokes: numbers of a cycle that a prototype with other methods went through.

The crank follows a compliant shaft whose driven end swings as mean - amplitude cos(2 pi t / 8 s). Angles in degrees.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from mechanism_fmu.model import Mechanism
from mechanism_fmu.simulation import Simulation
from models.ratchet.model import MODEL

PERIOD = 8.0


class Drive(NamedTuple):
    """A wheel, and the swing of the driven end [deg] that indexes it one tooth a stroke."""

    tooth_count: int
    slope_angle: float
    mean: float
    amplitude: float


DRIVES = (Drive(20, 95.0, 84.3, 10.4), Drive(15, 95.0, 80.0, 15.5), Drive(25, 100.0, 85.2, 9.3))


def free_ratchet(drive: Drive = DRIVES[0], **changes: float) -> Mechanism:
    """The ratchet with a free pawl."""
    values = {
        "guided": 0.0,
        "tooth_count": drive.tooth_count,
        "tooth_slope_angle": math.radians(drive.slope_angle),
        "drive_stiffness": 2.0,
        "drive_damping": 0.1,
        "pawl_spring_torque": 5e-3,
        "wheel_damping": 0.1,
    }
    return MODEL.build(MODEL.values(**(values | changes)))


def swing(simulation: Simulation, drive: Drive, time: float) -> None:
    """Set the inputs of the shaft for `time` [s]."""
    turn = 2 * math.pi / PERIOD
    simulation.set_input("drive_angle", math.radians(drive.mean - drive.amplitude * math.cos(turn * time)))
    simulation.set_input("drive_speed", math.radians(drive.amplitude * turn * math.sin(turn * time)))


def strokes(
    drive: Drive = DRIVES[0], until: float = 34.0, hold: float = 0.01, **changes: float
) -> Iterator[Simulation]:
    """Run a free ratchet; the simulation after each stretch of `hold` [s] with constant inputs."""
    simulation = Simulation(free_ratchet(drive, **changes))
    simulation.set_input("drive_torque", 0.0)
    simulation.set_input("spring_preload", 3e-3)
    for k in range(round(until / hold)):
        swing(simulation, drive, (k + 0.5) * hold)
        simulation.advance((k + 1) * hold)
        yield simulation

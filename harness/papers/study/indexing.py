"""A whole indexing cycle of the free ratchet: one tooth a stroke, the wheel held by its holding pawl in between.

The crank follows a compliant shaft whose driven end swings; a spring presses the pawl on the teeth.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas as pd

from ...fmu.description import Value
from ...run.checks import Check, energy_residual
from ...run.results import write_text

STOP_TIME = 34.0
#: The driven end swings as MEAN - AMPLITUDE cos(2 pi t / PERIOD).
PERIOD = 8.0
MEAN = math.radians(84.3)
AMPLITUDE = math.radians(10.4)

#: Parameters and constant inputs of the cycle, in SI units.
VALUES: dict[str, Value] = {
    "guided": False,
    "tooth_count": 20,
    "tooth_slope_angle": math.radians(95),
    "crank_angle_start": MEAN - AMPLITUDE,
    "drive_stiffness": 2.0,
    "drive_damping": 0.1,
    "pawl_spring_torque": 5e-3,
    "wheel_damping": 0.1,
    "spring_preload": 3e-3,
    "drive_torque": 0.0,
}

#: Teeth that the wheel has gone at the end.
CLICKS = 4
_PITCH = math.radians(18)
_START = math.radians(75)
_LEDGER_TOLERANCE = 1e-8
_ROWS_A_SECOND = 50


def write_drive(path: Path) -> Path:
    """Write the motion of the shaft's driven end as a table of inputs.

    Raises:
        UsageError: the disk refuses.
    """
    time = np.linspace(0.0, STOP_TIME, round(STOP_TIME * _ROWS_A_SECOND) + 1)
    turn = 2.0 * math.pi / PERIOD
    table = pd.DataFrame(
        {
            "time [s]": time,
            "drive_angle [rad]": MEAN - AMPLITUDE * np.cos(turn * time),
            "drive_speed [rad/s]": AMPLITUDE * turn * np.sin(turn * time),
        }
    )
    return write_text(path, lambda file: table.to_csv(file, index=False, lineterminator="\n"))


def cycle_checks(results: pd.DataFrame) -> Sequence[Check]:
    """Whether the wheel has gone one tooth a stroke, and the energy ledger closes."""
    if results.empty:
        return [Check("The wheel indexes", False, "nothing was recorded")]
    clicks = results["clicks"].to_numpy()
    times = results["time"].to_numpy()[1:][np.diff(clicks) > 0]
    strokes = [int(count) for count in np.bincount((times // PERIOD).astype(int), minlength=CLICKS)]
    latched = results["latched_angle"].iloc[-1]
    expected = _START + CLICKS * _PITCH
    residual = energy_residual(results)
    worst = math.nan if residual is None else float(residual.abs().max())
    work = float(results["work_done"].abs().max())
    return [
        Check("The holding pawl clicks four times", clicks[-1] == CLICKS, f"{clicks[-1]} clicks"),
        Check("One tooth a stroke", strokes == [1] * CLICKS, f"clicks in each stroke: {strokes}"),
        Check(
            "The wheel is latched at 147 deg",
            abs(latched - expected) < 1e-12,
            f"{math.degrees(latched):.12g} deg",
        ),
        Check(
            "The energy ledger closes to 1e-8 of the work",
            worst <= _LEDGER_TOLERANCE * work,
            f"largest residual {worst:.2e} J of {work:.3g} J",
        ),
    ]

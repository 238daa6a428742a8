"""The paper's parameter study: one FMU, twenty wheels."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path

import pandas as pd

from mechanism_fmu import __version__

from .checks import Check
from .errors import FmuError, UsageError
from .experiment import Experiment, perform
from .fmu import Fmu
from .paper import SLOPE_ANGLES_DEG, TOOTH_COUNTS, study_checks
from .results import write_json, write_text
from .wheels import WHEEL_UNITS, Wheel

#: The first impact comes before 0.96 s in every case.
_STOP_TIME = 1.2
#: Impacts are located inside a step, so the step may be large.
_STEP = 0.01

_NEEDED = ("tooth_count", "tooth_slope_angle", "tooth_length", "tooth_apex_angle", "impacts[1].velocity")


@dataclass(frozen=True)
class Study:
    """What came of the study.

    Attributes:
        fmu: path of the FMU file.
        wheels: each with its first impact.
        warnings: what the FMU said, with the wheels it said it about.
        checks: the paper's claims.
    """

    fmu: Path
    wheels: tuple[Wheel, ...]
    warnings: tuple[str, ...]
    checks: tuple[Check, ...]


def ratchet_study(fmu: Fmu, on_wheel: Callable[[int, int], None]) -> Study:
    """Run all wheels of the paper through one FMU.

    Args:
        fmu: a ratchet.
        on_wheel: called after each wheel with its number and the number of all.

    Raises:
        UsageError: the FMU is no ratchet.
        FmuError: it fails with a wheel, or a wheel has no impact.
    """
    for name in _NEEDED:
        if name not in fmu.description.variables:
            raise UsageError(f"{fmu.description.model} is no ratchet: it has no variable '{name}'.")
    wheels: list[Wheel] = []
    warnings: dict[str, list[str]] = {}
    cases = list(itertools.product(TOOTH_COUNTS, SLOPE_ANGLES_DEG))
    for count, angle in cases:
        wheel, said = _first_impact(fmu, count, math.radians(angle))
        wheels.append(wheel)
        for text in said:
            warnings.setdefault(text, []).append(str(wheel))
        on_wheel(len(wheels), len(cases))
    texts = tuple(f"{text} ({'; '.join(where)})" for text, where in warnings.items())
    return Study(fmu.path, tuple(wheels), texts, study_checks(wheels))


def _first_impact(fmu: Fmu, count: int, angle: float) -> tuple[Wheel, list[str]]:
    """A wheel with its first impact, and what the FMU warned of."""
    run = perform(fmu, Experiment(_STOP_TIME, _STEP, {"tooth_count": count, "tooth_slope_angle": angle}))
    if run.outcome.error is not None:
        raise run.outcome.error
    if run.impacts.empty:
        raise FmuError(
            f"{fmu.description.model} with tooth_count = {count}, tooth_slope_angle = {angle:.6g} rad has no impact "
            f"until {_STOP_TIME:g} s."
        )
    first = run.impacts.iloc[0]
    wheel = Wheel(
        tooth_count=count,
        tooth_slope_angle=angle,
        impact_time=float(first["time"]),
        wheel_speed=float(first["wheel_speed"]),
        impact_velocity=float(first["velocity"]),
        stress_max=float(first["stress_max"]),
        stress_position=float(first["stress_position"]),
        stress_delay=float(first["stress_delay"]),
        tooth_length=float(run.parameters["tooth_length"]),
        tooth_apex_angle=float(run.parameters["tooth_apex_angle"]),
    )
    return wheel, [message.text for message in run.messages if message.needs_attention]


def write_study(study: Study, folder: Path) -> list[Path]:
    """Write study.csv (plain names; SI units) and study.json (units, verdicts, warnings).

    Raises:
        UsageError: the disk refuses.
    """
    rows = [asdict(wheel) for wheel in study.wheels]
    summary = {
        "harness_version": __version__,
        "fmu": str(study.fmu),
        "units": WHEEL_UNITS,
        "wheels": rows,
        "checks": [asdict(check) for check in study.checks],
        "warnings": list(study.warnings),
    }
    table = pd.DataFrame(rows)
    return [
        write_text(folder / "study.csv", lambda file: table.to_csv(file, index=False, lineterminator="\n")),
        write_json(folder / "study.json", summary),
    ]

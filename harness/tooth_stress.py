"""From the impacts of a run to the stress they leave in the tooth."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
import pandas as pd

from mechanism_fmu.stress import (
    STEEL,
    Material,
    MaximumStress,
    WedgeTooth,
    beam_theory_note,
    bending_stress,
    maximum_stress,
    slenderness,
)

from .description import Value
from .errors import FmuError
from .impacts import WHEEL_HELD, wheel_held

#: The calculated parameters by which an FMU describes a tooth.
TOOTH = ("tooth_length", "tooth_apex_angle")

#: The one that says how far beam theory covers it.
SLENDERNESS = "tooth_slenderness"

#: Units of the numbers that `with_stress` adds to the table of impacts.
STRESS_UNITS = {"stress_max": "Pa", "stress_position": "1", "stress_delay": "s"}
#: Those of all columns that it adds; "": a text.
STRESS_COLUMNS = STRESS_UNITS | {"remark": ""}

#: How the stress of one impact is found; that of all of them together has converged modes.
BY_TWO_MODES = "by the paper's two modes; converged modes give a wedge 29 % more (docs/stress.md)."

_TIMES = 600
_PLACES = 101
#: The shown time span reaches this many times the delay of the maximum.
_SPAN = 12.0


def tooth_of(parameters: Mapping[str, Value]) -> WedgeTooth | None:
    """The tooth that the FMU's calculated parameters describe; None when the FMU has no such parameters.

    Its thickness is the default: the stress does not depend on it.

    Raises:
        FmuError: the FMU reports a tooth that cannot be.
    """
    length, apex_angle = (parameters.get(name) for name in TOOTH)
    if length is None or apex_angle is None:
        return None
    try:
        return WedgeTooth(length=float(length), apex_angle=float(apex_angle))
    except ValueError as error:
        raise FmuError(f"The FMU's tooth_length and tooth_apex_angle describe no tooth: {error}") from error


def tooth_summary(tooth: WedgeTooth | None) -> dict[str, Any] | None:
    """The tooth as a beam, and how far beam theory covers it, ready for JSON; None without a tooth."""
    if tooth is None:
        return None
    return {
        "length": tooth.length,
        "apex_angle": tooth.apex_angle,
        "length_over_root_height": slenderness(tooth),
        "beam_theory": beam_theory_note(tooth),
    }


def with_stress(impacts: pd.DataFrame, tooth: WedgeTooth, material: Material = STEEL) -> pd.DataFrame:
    """The table of impacts with the largest bending stress that each leaves, by |v_I| and the paper's two modes.

    Adds `stress_max` [Pa], `stress_position` (x / length, from the root), `stress_delay` [s] after the impact, and
    `remark`. Where the wheel is held, its teeth are not shaken: the remark says so, and there is no stress.

    Raises:
        FmuError: the FMU reports an impact that the stress model does not reach.
    """
    with as_fmu_error():
        found = [maximum_stress(tooth, material, abs(velocity)) for velocity in impacts["velocity"]]
    held = wheel_held(impacts)
    numbers = np.array([(maximum.stress, maximum.position, maximum.time) for maximum in found]).reshape(-1, 3)
    numbers[held] = np.nan
    added = pd.DataFrame(numbers, columns=list(STRESS_UNITS), index=impacts.index)
    return impacts.assign(**added, remark=[WHEEL_HELD if one else "" for one in held])


def worst_impact(impacts: pd.DataFrame) -> int | None:
    """The place of the impact with the largest stress, of equal ones the first; None if none left any.

    Args:
        impacts: as of `with_stress`.
    """
    stress = impacts["stress_max"].to_numpy(dtype=np.float64)
    return None if np.isnan(stress).all() else int(np.nanargmax(stress))


@contextmanager
def as_fmu_error() -> Iterator[None]:
    """What the stress model says of an impact is said of the FMU that reports it."""
    try:
        yield
    except ValueError as error:
        raise FmuError(f"The FMU reports impacts without a stress model: {error}") from error


@dataclass(frozen=True)
class StressField:
    """Bending stress after one impact, signed so that the largest one is positive.

    Attributes:
        position: x / length from the root, shape (places,).
        delay: time since the impact [s], shape (times,).
        stress: [Pa], shape (places, times).
        along: stress along the tooth when it is largest [Pa], shape (places,).
        in_time: stress in time where it is largest [Pa], shape (times,).
        maximum: value, position and delay of the largest.
    """

    position: npt.NDArray[np.float64]
    delay: npt.NDArray[np.float64]
    stress: npt.NDArray[np.float64]
    along: npt.NDArray[np.float64]
    in_time: npt.NDArray[np.float64]
    maximum: MaximumStress


def stress_field(tooth: WedgeTooth, velocity: float, material: Material = STEEL) -> StressField:
    """Bending stress of a tooth along its length and in time, after an impact with `velocity` [m/s]."""
    speed = abs(velocity)
    maximum = maximum_stress(tooth, material, speed)
    position, along = stress_along(tooth, velocity, material)
    delay = np.linspace(0.0, _SPAN * maximum.time, _TIMES)
    place = maximum.position * tooth.length
    sign = float(np.sign(bending_stress(tooth, material, speed, [place], [maximum.time])[0, 0]))
    return StressField(
        position=position,
        delay=delay,
        stress=sign * bending_stress(tooth, material, speed, position * tooth.length, delay),
        along=along,
        in_time=sign * bending_stress(tooth, material, speed, [place], delay)[0],
        maximum=maximum,
    )


def stress_along(
    tooth: WedgeTooth, velocity: float, material: Material = STEEL
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Bending stress of a tooth along its length, at the instant of the largest one after an impact.

    Args:
        tooth: what is struck.
        velocity: of the impact [m/s].
        material: of the tooth.

    Returns:
        x / length from the root, and the stress there [Pa], signed so that the largest one is positive;
        shape (places,) each.
    """
    speed = abs(velocity)
    maximum = maximum_stress(tooth, material, speed)
    position = np.linspace(0.0, 1.0, _PLACES)
    place = maximum.position * tooth.length
    stress = bending_stress(tooth, material, speed, [place, *(position * tooth.length)], [maximum.time])[:, 0]
    return position, np.sign(stress[0]) * stress[1:]

"""The ratchet of the paper: the first impact of a wheel, its base case, its parameter study, and what it claims."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import pandas as pd

from mechanism_fmu.stress import WedgeTooth, slenderness

from ...run.checks import Check

# The first impact of a ratchet wheel: a row of the paper's table.

#: Units of the fields of `Wheel`, and of its slenderness.
WHEEL_UNITS = {
    "tooth_count": "1",
    "tooth_slope_angle": "rad",
    "impact_time": "s",
    "wheel_speed": "rad/s",
    "impact_velocity": "m/s",
    "stress_max": "Pa",
    "stress_position": "1",
    "stress_delay": "s",
    "tooth_length": "m",
    "tooth_apex_angle": "rad",
    "slenderness": "1",
}


@dataclass(frozen=True)
class Wheel:
    """A wheel and its first impact, SI units.

    Attributes:
        tooth_count: nt.
        tooth_slope_angle: beta_0 [rad].
        impact_time: t_I [s].
        wheel_speed: omega(t_I+), of the wheel just after the impact [rad/s].
        impact_velocity: v_I [m/s].
        stress_max: sigma_max, largest bending stress of the tooth [Pa].
        stress_position: where it is, x / length from the root.
        stress_delay: when it is, after the impact [s].
        tooth_length: l [m].
        tooth_apex_angle: alpha [rad].
    """

    tooth_count: int
    tooth_slope_angle: float
    impact_time: float
    wheel_speed: float
    impact_velocity: float
    stress_max: float
    stress_position: float
    stress_delay: float
    tooth_length: float
    tooth_apex_angle: float

    @property
    def slope_angle_deg(self) -> int:
        """beta_0 in whole degrees."""
        return round(math.degrees(self.tooth_slope_angle))

    @property
    def tooth(self) -> WedgeTooth:
        """What the pawl strikes."""
        return WedgeTooth(self.tooth_length, self.tooth_apex_angle)

    @property
    def slenderness(self) -> float:
        """Length of the tooth over the height of its root [-]."""
        return slenderness(self.tooth)

    def cells(self) -> list[str]:
        """A row of the printed table.

        Teeth, beta_0 [deg], t_I [s], omega(t_I+) [rad/s], v_I [m/s], sigma_max [Pa], length over root height [1].
        """
        return [
            str(self.tooth_count),
            str(self.slope_angle_deg),
            f"{self.impact_time:.10f}",
            f"{self.wheel_speed:.10f}",
            f"{self.impact_velocity:.6e}",
            f"{self.stress_max:.1f}",
            f"{self.slenderness:.2f}",
        ]

    def __str__(self) -> str:
        return f"nt = {self.tooth_count}, beta_0 = {self.slope_angle_deg} deg"


# The ratchet of the paper: its base case, its parameter study, and what it claims.
#
# Source: Pennestrì, Valentini, Vita, "Dynamic Analysis of Intermittent-Motion Mechanisms Through the Combined Use of
# Gauss Principle and Logical Functions", section 5.1. Its figures with numbers are lost; the reference numbers are what
# two independent implementations of its text and tables agree on.

TOOTH_COUNTS = (10, 15, 20, 25)
SLOPE_ANGLES_DEG = (85, 90, 95, 100, 105)
#: Number of teeth and slope angle [deg] of the wheel whose mass and inertia are in Table 2.
BASE_CASE = (10, 90)

#: First impact of the base case: quantity, column of the impacts, unit, reference, relative tolerance.
_REFERENCE = (
    ("t_I", "time", "s", 0.9399211769, 1e-7),
    ("omega(t_I+)", "wheel_speed", "rad/s", 0.0227388573, 1e-7),
    ("v_I", "velocity", "m/s", 5.084569462e-4, 1e-7),
    ("sigma_max", "stress_max", "Pa", 16080.32, 1e-6),
)

#: "About 40 % of the length of the tooth from the fixed end."
_PLACE_OF_MAXIMUM = 0.40
_PLACE_TOLERANCE = 0.02


def base_case_checks(impacts: pd.DataFrame) -> tuple[Check, ...]:
    """Whether the first impact of the base case has the reference values."""
    if impacts.empty:
        return (Check("The pawl strikes the tooth face", False, "no impact"),)
    return tuple(
        _agreement(name, unit, float(impacts[column].iloc[0]), reference, tolerance)
        for name, column, unit, reference, tolerance in _REFERENCE
    )


def _agreement(name: str, unit: str, value: float, reference: float, tolerance: float) -> Check:
    deviation = abs(value - reference) / reference
    evidence = f"{value:.10g} {unit}, reference {reference:.10g} {unit}, relative deviation {deviation:.1e}"
    return Check(f"{name} agrees with the reference", deviation <= tolerance, f"{evidence}; limit {tolerance:g}")


def study_checks(wheels: Sequence[Wheel]) -> tuple[Check, ...]:
    """The three claims of the paper about its table."""
    # rounded as shown: wedges of all shapes have their maximum at the same place, and the first shall speak for them
    farthest = max(wheels, key=lambda wheel: round(abs(wheel.stress_position - _PLACE_OF_MAXIMUM), 4))
    falls = _steps(wheels, same=lambda wheel: wheel.slope_angle_deg, along=lambda wheel: wheel.tooth_count)
    rises = _steps(wheels, same=lambda wheel: wheel.tooth_count, along=lambda wheel: wheel.slope_angle_deg)
    least_fall, after_fall = max(falls, key=lambda step: step[0])
    least_rise, after_rise = min(rises, key=lambda step: step[0])
    return (
        Check(
            "The maximum stress lies near 40 % of the length of the tooth",
            abs(farthest.stress_position - _PLACE_OF_MAXIMUM) <= _PLACE_TOLERANCE,
            f"farthest at x/l = {farthest.stress_position:.4f} ({farthest}); "
            f"limit {_PLACE_OF_MAXIMUM:g} ± {_PLACE_TOLERANCE:g}",
        ),
        Check(
            "The maximum stress falls with the number of teeth",
            least_fall < 0.0,
            f"smallest fall from one number to the next {-least_fall:.1%} (to {after_fall})",
        ),
        Check(
            "The maximum stress rises with the slope angle",
            least_rise > 0.0,
            f"smallest rise from one angle to the next {least_rise:.1%} (to {after_rise})",
        ),
    )


def _steps(
    wheels: Sequence[Wheel], same: Callable[[Wheel], int], along: Callable[[Wheel], int]
) -> list[tuple[float, Wheel]]:
    """Relative change of the stress from one wheel to the next, and that next one, for each group of `same`."""
    return [
        (after.stress_max / before.stress_max - 1.0, after)
        for group in sorted({same(wheel) for wheel in wheels})
        for before, after in pairwise(sorted((w for w in wheels if same(w) == group), key=along))
    ]

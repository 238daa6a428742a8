"""The first impact of a ratchet wheel: a row of the paper's table."""

from __future__ import annotations

import math
from dataclasses import dataclass

from mechanism_fmu.stress import WedgeTooth, slenderness

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

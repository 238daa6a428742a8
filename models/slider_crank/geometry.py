"""Where the parts of a slider-crank are and how fast, in closed form from the crank; and its known dead positions.

With the crank r, the rod l, the offset e, the crank's angle theta and the rod's angle phi:

    r cos(theta) + l cos(phi) = x        r sin(theta) + l sin(phi) = e        cos(phi) > 0
"""

from __future__ import annotations

from dataclasses import dataclass
from types import SimpleNamespace

from mechanism_fmu.model.functions import Number, atan2, cos, sin
from mechanism_fmu.model.triangles import root


@dataclass(frozen=True)
class Start:
    """The linkage at the start.

    Attributes:
        rod_angle, rod_speed: phi [rad] and its rate [rad/s].
        slider_position, slider_velocity: x [m] and its rate [m/s].
    """

    rod_angle: Number
    rod_speed: Number
    slider_position: Number
    slider_velocity: Number


def start(values: SimpleNamespace) -> Start:
    """The start from the crank's angle and speed; it needs `rise(values)` between -l and l."""
    r, theta, speed = values.crank_length, values.crank_angle_start, values.crank_speed_start
    up = rise(values)
    along = root(values.rod_length * values.rod_length - up * up)
    rod_speed = -r * cos(theta) * speed / along
    return Start(
        rod_angle=atan2(up, along),
        rod_speed=rod_speed,
        slider_position=r * cos(theta) + along,
        slider_velocity=-r * sin(theta) * speed - up * rod_speed,
    )


def rise(values: SimpleNamespace) -> Number:
    """From the crank pin up to the slider's line at the start: e - r sin(theta) = l sin(phi) [m]."""
    return values.offset - values.crank_length * sin(values.crank_angle_start)


@dataclass(frozen=True)
class DeadPositions:
    """Where the slider turns back: crank and rod in line.

    Attributes:
        outer, inner: x of the slider [m]; 0 where the linkage does not reach that position.
    """

    outer: Number
    inner: Number

    @property
    def stroke(self) -> Number:
        """Distance between the two [m]."""
        return self.outer - self.inner


def dead_positions(values: SimpleNamespace) -> DeadPositions:
    """The slider at sqrt((l + r)^2 - e^2) and sqrt((l - r)^2 - e^2)."""
    far, near = values.rod_length + values.crank_length, values.rod_length - values.crank_length
    square = values.offset * values.offset
    return DeadPositions(root(far * far - square), root(near * near - square))

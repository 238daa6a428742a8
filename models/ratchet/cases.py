"""Cases of the ratchet: guided as in the paper, free, a whole indexing cycle, and that with a jam."""

from __future__ import annotations

import math

from mechanism_fmu.model import Case, SineSignal, TableSignal

#: Of the indexing cycle: the driven end of the shaft swings about this angle, by this angle [rad], in this time [s].
_MEAN, _AMPLITUDE, _PERIOD = math.radians(84.3), math.radians(10.4), 8.0

_INDEXING = {
    "guided": False,
    "tooth_count": 20,
    "tooth_slope_angle": math.radians(95),
    "crank_angle_start": _MEAN - _AMPLITUDE,
    "drive_stiffness": 2.0,
    "drive_damping": 0.1,
    "pawl_spring_torque": 5e-3,
    "wheel_damping": 0.1,
    "spring_preload": 3e-3,
    "drive_torque": 0.0,
}
_DRIVE = {
    "drive_angle": SineSignal(_MEAN, _AMPLITUDE, _PERIOD, -math.pi / 2),
    "drive_speed": SineSignal(0.0, _AMPLITUDE * 2 * math.pi / _PERIOD, _PERIOD),
}
#: A load on the wheel [N.m] over time [s]: in the third stroke it holds the wheel, which stays behind the shaft.
_JAM = TableSignal((0.0, 16.0, 16.5, 23.0, 23.5), (0.0, 0.0, -0.4, -0.4, 0.0))

CASES = (
    Case("guided", "The base case of the paper: the slope of one tooth guides the pawl", {"guided": True}),
    Case("free", "A free pawl on all teeth, and a holding pawl", {"guided": False}),
    Case("indexing", "The crank swings and takes the wheel on by a tooth a stroke", _INDEXING, _DRIVE, 34.0, 0.02),
    Case("jam", "As indexing, with a load in the third stroke", _INDEXING, {**_DRIVE, "load_torque": _JAM}, 34.0, 0.02),
)

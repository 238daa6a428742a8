"""Parameter values of the ratchet, and what is said when they are refused."""

import math

import pytest

from mechanism_fmu.model import MechanismError
from models.ratchet.model import MODEL
from models.ratchet.start import crank_pin, pawl_angle

PAPER = [(teeth, angle) for teeth in (10, 15, 20, 25) for angle in (85, 90, 95, 100, 105)]


def paper_values(teeth, angle):
    return MODEL.values(tooth_count=teeth, tooth_slope_angle=math.radians(angle))


def gap(values, normal):
    """n . (R(-psi) tip - root), from the global position of the pawl's tip at the start [m]."""
    pin, gamma, psi = crank_pin(values), pawl_angle(values), values.wheel_angle_start
    x, y = pin.x + values.pawl_length * math.cos(gamma), pin.y + values.pawl_length * math.sin(gamma)
    seen = (math.cos(psi) * x + math.sin(psi) * y, math.cos(psi) * y - math.sin(psi) * x)
    return normal[0] * (seen[0] - values.wheel_inner_radius) + normal[1] * seen[1]


def refused(**changes):
    values = MODEL.values(**changes)
    with pytest.raises(MechanismError) as refusal:
        MODEL.build(values)
    return values, str(refusal.value)

"""The Geneva drive's parameters-to-tables function: what it refuses, its outline, symbolic numbers."""

import math

import pytest
from derivatives import assert_derivatives_agree

from mechanism_fmu.model import MechanismError
from mechanism_fmu.model.compile import compile_mechanism
from models.geneva.model import MODEL
from models.geneva.ports import SHAPES

PARAMETERS = [p.name for p in MODEL.parameters if p.type != "Boolean"]
POINTS = {
    "pin outside": {"driver_angle_start": 0.3},
    "pin in the slot": {"driver_angle_start": 3.4, "slot_count": 6, "drive_stiffness": 5.0},
}


@pytest.mark.parametrize("point", POINTS)
@pytest.mark.parametrize("name", PARAMETERS)
def test_derivatives_agree_with_differences(name, point):
    assert_derivatives_agree(MODEL, vars(MODEL.values(**POINTS[point])), name)


@pytest.mark.parametrize("slots", range(3, 25))
def test_default_lengths_fit_every_number_of_slots(slots):
    compile_mechanism(MODEL.build(MODEL.values(slot_count=slots)))


@pytest.mark.parametrize(("slots", "diameter"), [(3, 0.024), (4, 0.042), (24, 0.0125)])
def test_a_pin_that_is_too_thick_is_refused_with_the_largest_that_fits(slots, diameter):
    with pytest.raises(MechanismError, match=r"pin_diameter = .* too thick .* Give less than ") as refusal:
        MODEL.build(MODEL.values(slot_count=slots, pin_diameter=diameter))
    allowed = min(float(part.split(" m,")[0]) for part in str(refusal.value).split("Give less than ")[1:])
    MODEL.build(MODEL.values(slot_count=slots, pin_diameter=allowed * (1 - 1e-5)))


@pytest.mark.parametrize("slots", [3, 4, 6, 12, 24])
def test_the_outlines_go_round_once_and_hold_the_slot(slots):
    values = MODEL.values(slot_count=slots)
    known = vars(values) | {c.name: c.value for c in MODEL.mechanism(values).calculated}

    def number(quantity):
        if not isinstance(quantity, str):
            return quantity
        return -known[quantity[1:]] if quantity.startswith("-") else known[quantity]

    wheel, disc = SHAPES[:2]
    angles = [number(angle) for _, angle in wheel.outline]
    assert angles[-1] - angles[0] == pytest.approx(2 * math.pi / slots, rel=1e-14)
    assert max(number(radius) for radius, _ in wheel.outline) == known["slot_mouth_radius"]
    assert angles.index(max(angles)) == len(angles) - 1
    # Where the wheel rests, the middle of its arc touches the locking disc.
    assert number(wheel.outline[0][0]) + number(disc.outline[-1][0]) == pytest.approx(values.centre_distance, rel=1e-14)

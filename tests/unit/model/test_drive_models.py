"""Drives: their parameters-to-tables functions, what is refused, what is warned of."""

import math
import re

import numpy as np
import pytest
from derivatives import assert_derivatives_agree

from mechanism_fmu.model import MechanismError
from mechanism_fmu.simulation import Simulation
from models.cam_drive.model import MODEL as CAM_DRIVE
from models.cam_drive.ports import SHAPES
from models.gear_train.model import MODEL as GEAR_TRAIN
from models.motor.model import MODEL as MOTOR
from models.rotary_table.model import MODEL as ROTARY_TABLE

POINTS = [
    pytest.param(GEAR_TRAIN, {"pinion_angle_start": 2.0, "pinion_speed_start": 3.0}, id="gear train"),
    pytest.param(CAM_DRIVE, {"cam_angle_start": 0.7}, id="cam drive, falling"),
    pytest.param(CAM_DRIVE, {"cam_angle_start": 4.0, "drive_stiffness": 5.0}, id="cam drive, rising"),
    pytest.param(MOTOR, {"rotor_angle_start": 2.0, "rotor_speed_start": 3.0}, id="motor"),
    pytest.param(ROTARY_TABLE, {"table_angle_start": 2.0, "table_damping": 0.1}, id="rotary table"),
]
HOLLOW = {"rise_angle": math.radians(60), "return_angle": math.radians(60), "lift": 0.012, "base_radius": 0.04}


@pytest.mark.parametrize(("model", "point"), POINTS)
def test_derivatives_agree_with_differences(model, point):
    for name in (p.name for p in model.parameters if p.type != "Boolean"):
        assert_derivatives_agree(model, vars(model.values(**point)), name)


@pytest.mark.parametrize("radii", [(900.0, 0.12), (0.05, 50.1), (1e-6, 1e3)])
def test_radii_too_different_to_mesh_are_refused(radii):
    with pytest.raises(MechanismError, match=r"differ by more than a factor of 1000, .* Give radii that are closer"):
        GEAR_TRAIN.build(GEAR_TRAIN.values(pinion_radius=radii[0], wheel_radius=radii[1]))
    Simulation(GEAR_TRAIN.build(GEAR_TRAIN.values(pinion_radius=0.05, wheel_radius=49.9, pinion_angle_start=500.0)))


@pytest.mark.parametrize("degrees", range(-180, 541, 15))
def test_assembly_finds_the_roller_on_the_cam_near_its_guess(degrees):
    mechanism = CAM_DRIVE.build(CAM_DRIVE.values(cam_angle_start=math.radians(degrees)))
    found = Simulation(mechanism).read()
    assert found["cam_angle"] == mechanism.bodies[0].start[2]
    assert found["cam_speed"] == mechanism.bodies[0].start_rate[2]
    assert found["follower_angle"] == pytest.approx(mechanism.bodies[1].start[2], abs=math.radians(2))
    assert found["contact_active"]


@pytest.mark.parametrize(
    ("values", "text"),
    [
        ({"rise_angle": 3.5}, r"rise_angle \+ dwell_angle \+ return_angle = 380.535 deg is more than one turn"),
        ({"hinge_distance": 0.11}, r"differ by 0.05 m, which is too much: .* = 0.04 m from"),
        ({"follower_length": 0.13}, r"differ by 0.05 m, which is too much"),
        ({"hinge_distance": 0.0015}, r"differ by 0.0585 m, which is too much"),
        ({"lift": 0.11}, r"hinge_distance \+ follower_length = 0.14 m is too short: .* = 0.15 m"),
        ({"base_radius": 0.12}, r"= 0.14 m is too short"),
        ({**HOLLOW, "roller_radius": 0.1, "hinge_distance": 0.2, "follower_length": 0.18}, "too large for the hollows"),
        (
            {"hinge_distance": 0.046, "follower_length": 0.085},
            r"The pressure angle reaches .* deg, and the cam would jam",
        ),
    ],
    ids=str,
)
def test_a_cam_that_cannot_turn_its_follower_is_refused(values, text):
    with pytest.raises(MechanismError, match=text) as refusal:
        CAM_DRIVE.build(CAM_DRIVE.values(**values))
    assert re.fullmatch(r"[^.]*(\.\d[^.]*)*\. [^.]*(\.\d[^.]*)*\.", str(refusal.value)), "one objection"


def test_a_whole_turn_of_moves_is_allowed():
    half = CAM_DRIVE.values(rise_angle=math.pi, dwell_angle=0.0, return_angle=math.pi)
    assert CAM_DRIVE.refused(half) == []
    Simulation(CAM_DRIVE.build(half))


@pytest.mark.parametrize("angle", np.linspace(0, 2 * math.pi, 9).tolist())
def test_the_largest_roller_that_is_told_fits_into_the_hollow(angle):
    values = {**HOLLOW, "hinge_distance": 0.2, "follower_length": 0.18}
    (message,) = CAM_DRIVE.refused(CAM_DRIVE.values(**values, roller_radius=0.1))
    limit = float(re.search(r"goes down to (\S+) m", message)[1])
    assert CAM_DRIVE.refused(CAM_DRIVE.values(**values, roller_radius=1.001 * limit))
    fits = CAM_DRIVE.values(**values, roller_radius=0.98 * limit, cam_angle_start=angle)
    assert CAM_DRIVE.refused(fits) == []
    Simulation(CAM_DRIVE.build(fits)).advance(0.2)


@pytest.mark.parametrize(
    ("values", "text"),
    [({}, None), ({"rise_angle": 1.0}, r"pressure angle reaches 4\d\.\d+ deg"), ({"base_radius": 0.02}, None)],
    ids=str,
)
def test_a_steep_cam_is_warned_of(values, text):
    warned = CAM_DRIVE.warned(CAM_DRIVE.values(**values))
    assert CAM_DRIVE.refused(CAM_DRIVE.values(**values)) == []
    if text is None:
        assert warned == []
    else:
        (message,) = warned
        assert re.search(text, message)


def test_the_outline_is_the_cam():
    values = CAM_DRIVE.values()
    known = {c.name: c.value for c in CAM_DRIVE.mechanism(values).calculated}
    (cam,) = (shape for shape in SHAPES if getattr(shape, "name", "") == "cam")
    radii = [known[radius] for radius, _ in cam.outline]
    assert min(radii) == values.base_radius
    assert max(radii) == pytest.approx(values.base_radius + values.lift, rel=1e-14)
    assert known["outline_cam_070"] == pytest.approx(
        values.base_radius + values.lift * (7 / 15 - math.sin(14 * math.pi / 15) / (2 * math.pi)), rel=1e-14
    )

"""Gears, racks and rods whose accelerations or motions are known in closed form (ME451, after Haug)."""

import math
from dataclasses import replace

import numpy as np
import pytest

from mechanism_fmu.model import (
    GROUND,
    Body,
    Distance,
    Force,
    Gears,
    InternalGears,
    Mechanism,
    Output,
    RackAndPinion,
    Revolute,
    Settings,
    Torque,
    Translational,
)
from mechanism_fmu.simulation import Simulation

ORIGIN = (0.0, 0.0)
ALONG_X = (1.0, 0.0)
#: Of the two gears.
INERTIAS = (0.02, 0.11)
RADII = (0.05, 0.12)
TORQUES = (1.5, -0.7)


def accelerations(mechanism):
    """(x, y, phi) of all bodies at the start, shape (3 bodies,)."""
    simulation = Simulation(mechanism)
    n = 3 * len(mechanism.bodies)
    return simulation.field("dy_end")[n : 2 * n].copy()


def gear_pair(joint, distance):
    """Two gears on pins to the ground, `distance` apart."""
    centre = (distance, 0.0)
    return Mechanism(
        bodies=(
            Body("first", 1.0, INERTIAS[0], (*ORIGIN, 0.3)),
            Body("second", 2.0, INERTIAS[1], (*centre, 0.0)),
        ),
        joints=(
            Revolute("pin", "first", ORIGIN, GROUND, ORIGIN),
            Revolute("axle", "second", ORIGIN, GROUND, centre),
            joint,
        ),
        forces=(Torque("drive", "first", torque=TORQUES[0]), Torque("load", "second", torque=TORQUES[1])),
        outputs=(Output("first", "first.angle", "x"), Output("second", "second.angle", "x")),
        held=("first.angle",),
        settings=Settings(relative_tolerance=1e-11),
    )


EXTERNAL = gear_pair(Gears("mesh", "first", RADII[0], 0.0, "second", RADII[1], math.pi), sum(RADII))
#: The ring is body i of the joint, the pinion body j; the line of centres points from the ring's to the pinion's.
INTERNAL = gear_pair(
    InternalGears("mesh", "second", RADII[1], math.pi, "first", RADII[0], math.pi), RADII[1] - RADII[0]
)


@pytest.mark.parametrize(
    ("mechanism", "sign", "expected"),
    [(EXTERNAL, -1, (45.8259325044, -19.0941385435)), (INTERNAL, 1, (30.9058614565, 12.8774422735))],
    ids=["external", "internal"],
)
def test_gears_accelerate_as_their_inertias_and_ratio_ask(mechanism, sign, expected):
    """With phi_2 = ratio phi_1: phi_1'' = (T_1 + ratio T_2) / (J_1 + ratio^2 J_2)."""
    ratio = sign * RADII[0] / RADII[1]
    first = (TORQUES[0] + ratio * TORQUES[1]) / (INERTIAS[0] + ratio**2 * INERTIAS[1])
    np.testing.assert_allclose((first, ratio * first), expected, rtol=1e-11)
    np.testing.assert_allclose(accelerations(mechanism), [0, 0, first, 0, 0, ratio * first], rtol=0, atol=1e-9 * first)


@pytest.mark.parametrize(("mechanism", "sign"), [(EXTERNAL, -1), (INTERNAL, 1)], ids=["external", "internal"])
def test_gears_keep_their_ratio_over_many_turns(mechanism, sign):
    simulation = Simulation(mechanism)
    start = simulation.read()
    for time in (0.5, 1.0, 2.0):
        simulation.advance(time)
        turned = {name: angle - start[name] for name, angle in simulation.read().items()}
        assert turned["second"] == pytest.approx(sign * RADII[0] / RADII[1] * turned["first"], abs=1e-9)
    assert turned["first"] > 4 * math.pi


def test_centres_on_the_other_side_are_accepted_too():
    """The row is d.n: it knows the line of centres, not which way along it, so that the start guess decides."""
    opposite = replace(EXTERNAL.joints[2], angle_j=EXTERNAL.joints[2].angle_j - 17 / 12 * math.pi)
    mechanism = replace(EXTERNAL, joints=(*EXTERNAL.joints[:2], opposite))
    np.testing.assert_allclose(accelerations(mechanism), accelerations(EXTERNAL), rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("direction", [0.0, 0.7, 2.5])
def test_rack_and_pinion_accelerate_as_one(direction):
    """A rack on a slider, a pinion on a pin: x'' = R phi'' and (J + m R^2) phi'' = T + F R."""
    mass, inertia, radius, torque, force = 3.0, 0.05, 0.2, 0.8, -1.1
    u = math.cos(direction), math.sin(direction)
    n = -u[1], u[0]
    centre = (radius * n[0], radius * n[1])
    rack = RackAndPinion("mesh", "rack", ORIGIN, ORIGIN, direction, "pinion", radius)
    mechanism = Mechanism(
        bodies=(
            Body("rack", mass, 1.0),
            Body("pinion", 1.0, inertia, (*centre, direction - math.pi / 2)),
        ),
        joints=(
            Translational("guide", "rack", ORIGIN, u, GROUND, ORIGIN, u),
            Revolute("pin", "pinion", ORIGIN, GROUND, centre),
            rack,
        ),
        forces=(Torque("drive", "pinion", torque=torque), Force("pull", "rack", (force * u[0], force * u[1]))),
    )
    turn = (torque + force * radius) / (inertia + mass * radius**2)
    expected = [radius * turn * u[0], radius * turn * u[1], 0, 0, 0, turn]
    np.testing.assert_allclose(accelerations(mechanism), expected, rtol=0, atol=1e-9)


def rolling(phi_2, carrier, times, weight=0.0):
    """Slide example 3.4.1: gear 2 is carried around gear 1, which stands still; angles of carrier and gear 2."""
    mechanism = Mechanism(
        bodies=(Body("gear", 1.0, 2.0, (3.0 * math.cos(carrier), 3.0 * math.sin(carrier), phi_2)),),
        joints=(
            Distance("carrier", GROUND, ORIGIN, "gear", ORIGIN, 3.0),
            Gears("mesh", GROUND, 1.0, math.pi / 6, "gear", 2.0, 7 * math.pi / 6),
        ),
        forces=(Force("weight", "gear", (0.0, -weight)),),
        outputs=tuple(Output(name, f"gear.{name}", "x") for name in ("x", "y", "angle")),
        settings=Settings(relative_tolerance=1e-11),
        held=("gear.angle",),
    )
    simulation = Simulation(mechanism)
    angles = []
    for time in times:
        simulation.advance(time)
        now = simulation.read()
        angles.append((math.atan2(now["y"], now["x"]), now["angle"]))
    return np.unwrap(np.array(angles), axis=0).T


@pytest.mark.parametrize(("phi_2", "expected"), [(0.0, 30), (-math.pi, -90), (math.pi / 2, 90)])
def test_where_the_carrier_of_the_slides_stands(phi_2, expected):
    """In degrees; the start guess is a little off."""
    (carrier,), _ = rolling(phi_2, math.radians(expected) + 0.2, [0.0])
    assert math.degrees(carrier) == pytest.approx(expected, abs=1e-9)


def test_gear_2_of_the_slides_falls_through_the_bottom():
    """Like a pendulum it comes up to the same height; the carrier is at -90 deg where gear 2 has turned by -pi."""
    carrier, gear = rolling(0.0, math.radians(30), np.linspace(0.0, 4.0, 161).tolist(), weight=9.81)
    np.testing.assert_allclose(gear, 1.5 * (carrier - math.pi / 6), rtol=0, atol=1e-9)
    assert math.degrees(carrier.min()) == pytest.approx(-210, abs=0.5)
    low = carrier.argmin()
    assert np.interp(math.pi / 2, -carrier[:low], gear[:low]) == pytest.approx(-math.pi, abs=1e-6)

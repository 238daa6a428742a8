"""Mechanisms whose motion is known in closed form."""

import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from scipy.special import ellipeinc

from mechanism_fmu.model import (
    GROUND,
    Body,
    Mechanism,
    Output,
    PointLineContact,
    Revolute,
    Settings,
    Torque,
    TorsionSpring,
    Translational,
)
from mechanism_fmu.simulation import Simulation

PRECISE = Settings(relative_tolerance=1e-12)
ORIGIN = (0.0, 0.0)


def angles_at(mechanism, time):
    """Angle and speed of every body at `time`."""
    simulation = Simulation(mechanism)
    simulation.advance(time)
    return np.array([[simulation.read()[f"{b.name}.{q}"] for q in ("angle", "speed")] for b in mechanism.bodies])


def angle_outputs(*bodies):
    return tuple(
        Output(f"{body}.{quantity}", f"{body}.{quantity}", "") for body in bodies for quantity in ("angle", "speed")
    )


@settings(deadline=None, max_examples=20)
@given(st.floats(0.2, 5.0), st.floats(-1.0, 1.0), st.floats(-2.0, 2.0), st.floats(-0.5, 0.5))
def test_a_body_on_a_spring_about_a_pin_swings_harmonically(frequency, angle, speed, preload):
    """The centre of mass is 0.4 m from the pin; the preload only moves the middle of the swing."""
    mass, inertia, radius = 2.0, 0.1, 0.4
    about_pin = inertia + mass * radius**2
    middle = 0.3 - preload / (about_pin * frequency**2)
    x, y = radius * math.cos(angle), radius * math.sin(angle)
    mechanism = Mechanism(
        bodies=(Body("bob", mass, inertia, (x, y, angle), (-y * speed, x * speed, speed)),),
        joints=(Revolute("pin", "bob", (-radius, 0.0), GROUND, ORIGIN),),
        forces=(TorsionSpring("spring", "bob", GROUND, about_pin * frequency**2, 0.3, preload),),
        outputs=angle_outputs("bob"),
        settings=PRECISE,
    )
    time = 7.0
    c, s = math.cos(frequency * time), math.sin(frequency * time)
    expected = [
        middle + (angle - middle) * c + speed / frequency * s,
        -(angle - middle) * frequency * s + speed * c,
    ]
    np.testing.assert_allclose(angles_at(mechanism, time)[0], expected, rtol=0, atol=1e-9)


@settings(deadline=None, max_examples=20)
@given(st.floats(0.05, 5.0), st.floats(0.5, 3.0))
def test_a_free_scotch_yoke_turns_by_an_elliptic_integral(mass_ratio, speed):
    """Energy (J + m a^2 sin^2 phi) phi'^2 / 2 is constant: t is an incomplete elliptic integral of the second kind."""
    inertia, arm = 0.2, 0.5
    mass = mass_ratio * inertia / arm**2
    mechanism = Mechanism(
        bodies=(
            Body("crank", 1.0, inertia, (0.0, 0.0, 0.0), (0.0, 0.0, speed)),
            Body("yoke", mass, 1.0, (arm, 0.0, 0.0)),
        ),
        joints=(
            Revolute("hinge", "crank", ORIGIN, GROUND, ORIGIN),
            Translational("guide", "yoke", ORIGIN, (1.0, 0.0), GROUND, ORIGIN, (1.0, 0.0)),
        ),
        # the crank's pin stays in the yoke's slot, which is the line x = 0 of the yoke
        contacts=(PointLineContact("slot", "crank", (arm, 0.0), "yoke", ORIGIN, (1.0, 0.0), closed=True, guided=True),),
        outputs=(*angle_outputs("crank", "yoke"), Output("x", "yoke.x", "")),
        settings=PRECISE,
    )
    simulation = Simulation(mechanism)
    for time in (0.5, 1.0, 3.0):
        simulation.advance(time)
        found = simulation.read()
        phi = found["crank.angle"]
        assert ellipeinc(phi, -mass_ratio) / speed == pytest.approx(time, abs=1e-9)
        assert found["crank.speed"] == pytest.approx(speed / math.sqrt(1 + mass_ratio * math.sin(phi) ** 2), rel=1e-9)
        assert found["x"] == pytest.approx(arm * math.cos(phi), abs=1e-10)
        assert found["yoke.angle"] == pytest.approx(0.0, abs=1e-11)


@pytest.mark.parametrize("angle", [0.3, 1.0, 2.5])
def test_a_rod_on_two_rails_turns_at_constant_speed(angle):
    """The trammel's centre of mass runs on a circle: its kinetic energy does not depend on the angle."""
    half, speed = 0.6, 1.7
    c, s = math.cos(angle), math.sin(angle)
    mechanism = Mechanism(
        bodies=(Body("rod", 1.5, 0.4, (half * c, half * s, -angle), (-half * s * speed, half * c * speed, -speed)),),
        contacts=(
            PointLineContact("floor", "rod", (half, 0.0), GROUND, ORIGIN, (0.0, 1.0), closed=True, guided=True),
            PointLineContact("wall", "rod", (-half, 0.0), GROUND, ORIGIN, (1.0, 0.0), closed=True, guided=True),
        ),
        outputs=angle_outputs("rod"),
        settings=PRECISE,
    )
    np.testing.assert_allclose(angles_at(mechanism, 5.0)[0], [-angle - 5.0 * speed, -speed], rtol=0, atol=1e-8)


@pytest.mark.parametrize("cranks", [2, 3, 4])
def test_a_coupler_on_equal_cranks_moves_as_if_the_redundant_rows_were_not_there(cranks):
    """Parallel cranks carry the coupler without turning it: J phi'' = T, J = n (i + m a^2 / 4) + M a^2."""
    arm, inertia, mass, coupler_mass, torque = 0.5, 0.02, 0.3, 1.2, 0.4
    start = 0.4
    c, s = math.cos(start), math.sin(start)
    names = [f"crank{k}" for k in range(cranks)]
    joints = []
    for k, name in enumerate(names):
        joints += [
            Revolute(f"{name}_hinge", name, (-arm / 2, 0.0), GROUND, (float(k), 0.0)),
            Revolute(f"{name}_pin", name, (arm / 2, 0.0), "coupler", (float(k), 0.0)),
        ]
    mechanism = Mechanism(
        bodies=(
            *(Body(name, mass, inertia, (k + arm / 2 * c, arm / 2 * s, start)) for k, name in enumerate(names)),
            Body("coupler", coupler_mass, 1.0, (arm * c, arm * s, 0.0)),
        ),
        joints=tuple(joints),
        forces=(Torque("drive", "crank0", torque=torque),),
        outputs=angle_outputs(*names, "coupler"),
        settings=PRECISE,
    )
    effective = cranks * (inertia + mass * arm**2 / 4) + coupler_mass * arm**2
    acceleration = torque / effective
    found = angles_at(mechanism, 1.5)
    expected = [start + acceleration * 1.5**2 / 2, acceleration * 1.5]
    np.testing.assert_allclose(found, [expected] * cranks + [[0.0, 0.0]], rtol=0, atol=1e-9)


def test_force_that_a_guide_carries():
    """A torque on a slider between two contact points is carried as a couple; the slider does not move."""
    mechanism = Mechanism(
        bodies=(Body("plate", 1.0, 1.0),),
        forces=(Torque("twist", "plate", torque=3.0),),
        contacts=(
            PointLineContact("left", "plate", (-0.5, 0.0), GROUND, ORIGIN, (0.0, 1.0), closed=True, guided=True),
            PointLineContact("right", "plate", (0.5, 0.0), GROUND, ORIGIN, (0.0, 1.0), closed=True, guided=True),
        ),
        outputs=(Output("left", "left.force", ""), Output("right", "right.force", "")),
    )
    simulation = Simulation(mechanism)
    simulation.advance(1.0)
    assert simulation.read() == pytest.approx({"left": 3.0, "right": -3.0})
    assert np.abs(simulation.field("y_end")[:6]).max() < 1e-15
    assert np.abs(simulation.field("y_end")[6:]).max() < 3.0 * 1e-15  # work and loss, by a torque of 3 N m


def test_a_free_body_goes_straight_on():
    start, rate = (1.0, 2.0, 3.0), (0.5, -0.25, 2.0)
    simulation = Simulation(Mechanism(bodies=(Body("stone", 1.0, 1.0, start, rate),)))
    simulation.advance(8.0)
    time = simulation.field("clock")[2]
    np.testing.assert_allclose(simulation.field("y_end")[:3], np.add(start, np.multiply(rate, time)), rtol=1e-12)

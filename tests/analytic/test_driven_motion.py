"""Drivers: kinematics of all nine, and the motion, forces and work of driven bodies, in closed form."""

import math

import numpy as np
import pytest

from mechanism_fmu.kinematics import analyse
from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Body,
    DistanceDriver,
    Force,
    Mechanism,
    Output,
    PointLineContact,
    Revolute,
    Settings,
    Torque,
    Translational,
    TranslationalDriver,
    XDriver,
    YDriver,
)
from mechanism_fmu.model.curves.motions import harmonic_motion
from mechanism_fmu.simulation import Simulation

ORIGIN, ALONG_X = (0.0, 0.0), (1.0, 0.0)
TIMES = np.linspace(0.0, 2.0, 9)
POINT = (0.3, -0.2)


def swing(mean, amplitude, frequency, phase):
    """A motion, and (C, C', C'') at TIMES."""
    angle = frequency * TIMES + phase
    values = (
        mean + amplitude * np.sin(angle),
        amplitude * frequency * np.cos(angle),
        -amplitude * frequency**2 * np.sin(angle),
    )
    return harmonic_motion(mean, amplitude, frequency, phase), np.array(values)


X, X_COURSE = swing(0.5, 0.4, 2.0, 0.1)
Y, Y_COURSE = swing(-0.2, 0.3, 1.5, 0.7)
PHI, PHI_COURSE = swing(0.3, 0.8, 1.2, 0.2)
REACH, REACH_COURSE = swing(1.5, 0.3, 1.8, 0.4)


def e(course):
    """e^(i phi) and its two derivatives, from those of phi."""
    phi, rate, bend = course
    now = np.exp(1j * phi)
    return np.array([now, 1j * rate * now, (1j * bend - rate**2) * now])


def times(a, b):
    """The product of two functions with their two derivatives."""
    return np.array([a[0] * b[0], a[1] * b[0] + a[0] * b[1], a[2] * b[0] + 2 * a[1] * b[1] + a[0] * b[2]])


def arm(course):
    return (POINT[0] + 1j * POINT[1]) * e(course)


#: Body "base" is led by three absolute drivers; its point POINT moves as X and Y say, and it turns as PHI says.
BASE = (
    XDriver("base_x", "base", POINT, X),
    YDriver("base_y", "base", POINT, Y),
    AngleDriver("base_angle", "base", PHI),
)
BASE_POINT = X_COURSE + 1j * Y_COURSE
BASE_CENTRE = BASE_POINT - arm(PHI_COURSE)

#: Body "led" against the base: its drivers, where its point POINT is seen from the base's point, and its angle.
SUM = PHI_COURSE + Y_COURSE
LED = {
    "relative x, y, angle": (
        (
            XDriver("x", "led", POINT, Y, "base", POINT),
            YDriver("y", "led", POINT, REACH, "base", POINT),
            AngleDriver("angle", "led", Y, "base"),
        ),
        BASE_POINT + Y_COURSE + 1j * REACH_COURSE,
    ),
    "relative distance": (
        (
            DistanceDriver("distance", "led", POINT, REACH, "base", POINT),
            TranslationalDriver("along", "led", POINT, (0.0, 2.0), harmonic_motion(0.0, 0.0, 1.0), "base", POINT),
            AngleDriver("angle", "led", Y, "base"),
        ),
        BASE_POINT + times(REACH_COURSE, e(PHI_COURSE)),
    ),
    "relative translational": (
        (
            TranslationalDriver("along", "led", POINT, (2.0, 0.0), REACH, "base", POINT),
            TranslationalDriver("across", "led", POINT, (0.0, 0.5), Y, "base", POINT),
            AngleDriver("angle", "led", Y, "base"),
        ),
        BASE_POINT + times(REACH_COURSE + 1j * Y_COURSE, e(PHI_COURSE)),
    ),
    "absolute distance and angle": (
        (
            DistanceDriver("distance", "led", POINT, REACH, GROUND, (0.2, 0.1)),
            YDriver("level", "led", POINT, harmonic_motion(0.1, 0.0, 1.0)),
            AngleDriver("angle", "led", Y, "base"),
        ),
        np.array([0.2 + 0.1j, 0, 0])[:, None] + REACH_COURSE,
    ),
}


@pytest.mark.parametrize("name", LED)
def test_driven_bodies_go_where_their_drivers_say(name):
    drivers, point = LED[name]
    centre = point - arm(SUM)
    guess = (centre[0, 0].real + 0.05, centre[0, 0].imag - 0.05, SUM[0, 0])
    mechanism = Mechanism(
        bodies=(Body("base", 1.0, 1.0, (0.3, 0.0, 0.4)), Body("led", 1.0, 1.0, guess)), joints=(*BASE, *drivers)
    )
    motion = analyse(mechanism, TIMES)
    for body, place, angle in (("base", BASE_CENTRE, PHI_COURSE), ("led", centre, SUM)):
        found = np.array(motion.of(f"{body}.x")) + 1j * np.array(motion.of(f"{body}.y"))
        np.testing.assert_allclose(found, place, rtol=0, atol=1e-10)
        np.testing.assert_allclose(motion.of(f"{body}.angle"), angle, rtol=0, atol=1e-10)


AMPLITUDE, FREQUENCY = 0.5, 3.0
MOTION = harmonic_motion(0.0, AMPLITUDE, FREQUENCY)
ENERGIES = tuple(Output(name, f"energy.{name}", "") for name in ("kinetic", "work", "lost"))
START_SPEED = AMPLITUDE * FREQUENCY


def slider(name, mass, x, speed):
    body = Body(name, mass, 1.0, (x, 0.0, 0.0), (speed, 0.0, 0.0))
    return body, Translational(f"{name}_guide", name, ORIGIN, ALONG_X, GROUND, ORIGIN, ALONG_X)


def test_a_driven_slider_follows_with_the_force_that_this_needs():
    """x = C, and force = m C'' + drag; the driver's work is what the energy has gained and the drag taken."""
    body, guide = slider("ram", 2.0, 0.0, START_SPEED)
    mechanism = Mechanism(
        bodies=(body,),
        joints=(guide, XDriver("drive", "ram", ORIGIN, MOTION)),
        forces=(Force("load", "ram", (-1.5, 0.0)),),
        outputs=(
            Output("x", "ram.x", ""),
            Output("v", "ram.x_rate", ""),
            Output("force", "drive.force", ""),
            *ENERGIES,
        ),
    )
    simulation = Simulation(mechanism)
    for time in np.arange(1, 31) * 0.17:
        simulation.advance(time)
        found = simulation.read()
        angle = FREQUENCY * time
        assert found["x"] == pytest.approx(AMPLITUDE * math.sin(angle), abs=1e-9)
        assert found["v"] == pytest.approx(START_SPEED * math.cos(angle), abs=1e-8)
        acceleration = -START_SPEED * FREQUENCY * math.sin(angle)
        assert found["force"] == pytest.approx(2.0 * acceleration + 1.5, abs=1e-6)
        assert found["kinetic"] == pytest.approx(START_SPEED**2 + found["work"], abs=1e-7)


def test_a_driven_wheel_follows_with_the_torque_that_this_needs():
    inertia, torque = 0.3, 0.4
    mechanism = Mechanism(
        bodies=(Body("wheel", 1.0, inertia, (0.0, 0.0, 0.0), (0.0, 0.0, START_SPEED)),),
        joints=(Revolute("pin", "wheel", ORIGIN, GROUND, ORIGIN), AngleDriver("drive", "wheel", MOTION)),
        forces=(Torque("load", "wheel", torque=torque),),
        outputs=(Output("angle", "wheel.angle", ""), Output("torque", "drive.torque", "")),
    )
    simulation = Simulation(mechanism)
    for time in np.arange(1, 21) * 0.23:
        simulation.advance(time)
        found = simulation.read()
        assert found["angle"] == pytest.approx(AMPLITUDE * math.sin(FREQUENCY * time), abs=1e-9)
        acceleration = -START_SPEED * FREQUENCY * math.sin(FREQUENCY * time)
        assert found["torque"] == pytest.approx(inertia * acceleration - torque, abs=1e-6)


def test_a_driven_ram_hits_a_ball_and_keeps_its_motion():
    """The ball, m, leaves with u+ = C' + e (C' - u-); the driver does the work m (u+ - u-) C' at once."""
    ram, ram_guide = slider("ram", 2.0, 0.0, START_SPEED)
    ball, ball_guide = slider("ball", 1.0, 0.6, -0.5)
    mechanism = Mechanism(
        bodies=(ram, ball),
        joints=(ram_guide, ball_guide, XDriver("drive", "ram", ORIGIN, MOTION)),
        contacts=(PointLineContact("hit", "ball", ORIGIN, "ram", (0.2, 0.0), ALONG_X, restitution=0.5),),
        outputs=(Output("u", "ball.x_rate", ""), Output("x", "ram.x", ""), *ENERGIES),
        settings=Settings(1e-11),
    )
    simulation = Simulation(mechanism)
    simulation.advance(0.6)
    (impact,) = simulation.impacts_in_step()
    angle = FREQUENCY * impact.time
    assert AMPLITUDE * math.sin(angle) + 0.2 == pytest.approx(0.6 - 0.5 * impact.time, abs=1e-9)
    speed = START_SPEED * math.cos(angle)
    after = speed + 0.5 * (speed + 0.5)
    found = simulation.read()
    assert impact.closing_speed == pytest.approx(speed + 0.5, abs=1e-9)
    assert impact.impulse == pytest.approx(after + 0.5, abs=1e-9)
    assert found["u"] == pytest.approx(after, abs=1e-9)
    assert found["x"] == pytest.approx(AMPLITUDE * math.sin(FREQUENCY * 0.6), abs=1e-9)
    # Of the impulse's work, half of 1 - e^2 times the square of the closing speed is lost (the ram is as if endless).
    assert found["lost"] == pytest.approx(0.5 * 0.75 * impact.closing_speed**2, abs=1e-9)
    now = START_SPEED * math.cos(FREQUENCY * 0.6)
    assert found["kinetic"] == pytest.approx(now**2 + after**2 / 2, abs=1e-8)
    assert found["kinetic"] - found["work"] + found["lost"] == pytest.approx(START_SPEED**2 + 0.125, abs=1e-8)


def test_start_rates_give_way_to_drivers_where_coordinates_are_held():
    """The crank is held at its place and rate; what is not held gets the rates that joints and drivers ask for."""
    ram, guide = slider("ram", 2.0, 0.0, 0.0)
    mechanism = Mechanism(
        bodies=(ram, Body("disc", 1.0, 0.2, (1.0, 0.0, 0.4), (0.0, 0.0, 2.0))),
        joints=(
            guide,
            XDriver("drive", "ram", ORIGIN, MOTION),
            Revolute("pin", "disc", (0.1, 0.0), "ram", (1.0, 0.0)),
        ),
        held=("disc.angle",),
        outputs=(
            Output("v", "ram.x_rate", ""),
            Output("turn", "disc.speed", ""),
            Output("u", "disc.x_rate", ""),
            Output("w", "disc.y_rate", ""),
        ),
    )
    found = Simulation(mechanism).read()
    assert found["v"] == pytest.approx(START_SPEED, abs=1e-12)
    assert found["turn"] == 2.0
    assert found["u"] == pytest.approx(START_SPEED + 0.1 * 2.0 * math.sin(0.4), abs=1e-12)
    assert found["w"] == pytest.approx(-0.1 * 2.0 * math.cos(0.4), abs=1e-12)

"""Mechanisms of the gallery whose motion follows from forces: engine, door closer, governor."""

import math

import numpy as np
import pytest
from gallery_examples import run, simulation

# The engine.

CRANK, ROD, CLEARANCE, AREA, ATMOSPHERE, EXPONENT = 0.04, 0.15, 0.01, 5e-3, 1e5, 1.35


def engine_inertia(turned: float) -> float:
    """Twice the kinetic energy over the squared speed of the crank [kg m2]: flywheel, rod, piston."""
    tilt = math.asin(-CRANK * math.sin(turned) / ROD)
    rate = -CRANK * math.cos(turned) / (ROD * math.cos(tilt))  # of the rod's angle
    x = -CRANK * math.sin(turned) - ROD / 2 * math.sin(tilt) * rate
    y = CRANK * math.cos(turned) + ROD / 2 * math.cos(tilt) * rate
    piston = -CRANK * math.sin(turned) - ROD * math.sin(tilt) * rate
    return 0.5 + 0.6 * (x * x + y * y) + 0.6 * ROD**2 / 12 * rate * rate + 0.5 * piston * piston


def gas_work(start: float, end: float, pressure: float) -> float:
    """Work of the gas between two lengths of its column [J]; its pressure in the lower dead centre in atmospheres."""
    longest = 2 * CRANK + CLEARANCE

    def integral(length: float) -> float:
        return longest / (1 - EXPONENT) * (length / longest) ** (1 - EXPONENT)

    return AREA * ATMOSPHERE * (pressure * (integral(end) - integral(start)) - (end - start))


def engine_speed(turned: float, burnt: float, load: float) -> float:
    """Speed of the crank [rad/s] after an angle [rad] from its start in the lower dead centre with 300 rpm."""
    turns, rest = divmod(turned, 2 * math.pi)
    angle = math.pi + rest
    longest, length = 2 * CRANK + CLEARANCE, CRANK + ROD + CLEARANCE
    length -= CRANK * math.cos(angle) + math.sqrt(ROD**2 - (CRANK * math.sin(angle)) ** 2)
    compression = gas_work(longest, CLEARANCE, 1.0)
    work = turns * (compression + gas_work(CLEARANCE, longest, burnt)) - load * turned
    if rest < math.pi:
        work += gas_work(longest, length, 1.0)
    else:
        work += compression + gas_work(CLEARANCE, length, burnt)
    return math.sqrt((engine_inertia(math.pi) * (10 * math.pi) ** 2 + 2 * work) / engine_inertia(angle))


@pytest.mark.parametrize(
    ("burnt", "load", "tolerance", "relative"),
    [(1.0, 0.0, 1e-9, 1e-8), (2.5, 5.0, 1e-9, 2e-7), (2.5, 5.0, 1e-11, 5e-9), (2.5, 20.0, 1e-11, 5e-9)],
)
def test_the_engine_turns_as_fast_as_the_work_of_its_gas(
    burnt: float, load: float, tolerance: float, relative: float
) -> None:
    """Where the gas burns, its force jumps, which the step control alone notices."""
    values = {"burnt": burnt, "load": load, "relative_tolerance": tolerance}
    found = run("engine", np.linspace(0.0, 1.0, 41), **values)
    wanted = [engine_speed(angle - math.pi, burnt, load) for angle in found["angle"]]
    assert found["angle"][-1] > 9 * math.pi
    np.testing.assert_allclose(found["speed"], wanted, rtol=relative, atol=0)


# The door.


def test_the_door_opens_without_damping_and_closes_overdamped() -> None:
    inertia, stiffness, preload, damping, push = 30.0 * 0.9**2 / 3, 12.0, 0.4, 40.0, 2.0
    root = math.sqrt(stiffness / inertia)
    turns_back = math.atan2(push / root, preload) / root
    widest = math.hypot(push / root, preload)  # beyond where the spring is slack
    fast, slow = (-damping - s * math.sqrt(damping**2 - 4 * stiffness * inertia) for s in (1.0, -1.0))
    fast, slow = fast / (2 * inertia), slow / (2 * inertia)

    def door(time: float) -> float:
        if time < turns_back:
            return push / root * math.sin(root * time) + preload * math.cos(root * time) - preload
        after = time - turns_back
        return widest * (fast * math.exp(slow * after) - slow * math.exp(fast * after)) / (fast - slow) - preload

    times = np.linspace(0.0, 5.5, 56)
    found = run("door_closer", times)
    np.testing.assert_allclose(found["angle"], [door(time) for time in times], rtol=0, atol=1e-8)
    running = simulation("door_closer")
    running.advance(8.0)
    (impact,) = running.impacts_in_step()
    assert door(impact.time) == pytest.approx(0.0, abs=1e-8)
    after = impact.time - turns_back
    speed = widest * fast * slow * (math.exp(slow * after) - math.exp(fast * after)) / (fast - slow)
    assert impact.closing_speed == pytest.approx(-speed, rel=1e-8)
    assert running.read()["angle"] == pytest.approx(0.0, abs=1e-14)


# The governor.

LENGTH, GRAVITY = 0.3, 9.81


@pytest.mark.parametrize(("rpm", "ball", "sleeve"), [(150.0, 1.0, 2.0), (120.0, 1.5, 0.5)])
def test_the_governor_settles_at_its_angle(rpm: float, ball: float, sleeve: float) -> None:
    speed = rpm * math.pi / 30
    wanted = math.acos((1 + sleeve / ball) * GRAVITY / (speed**2 * LENGTH))
    found = run("governor", [0.0, 20.0], speed=speed, ball=ball, sleeve=sleeve)
    assert found["angle"][1] + math.pi / 2 == pytest.approx(wanted, abs=1e-9)
    assert found["height"][1] == pytest.approx(-2 * LENGTH * math.cos(wanted), abs=1e-9)
    there = run("governor", [0.0, 1.0], speed=speed, ball=ball, sleeve=sleeve, start=wanted)
    assert np.ptp(there["angle"]) < 1e-9


def test_the_governor_without_damping_swings_between_its_turning_points() -> None:
    """In the turning plane, energy is constant with the potential of the centrifugal force.

    It is quadratic in cos(theta), so that the cosines of both turning points have a sum that is known.
    """
    ball, sleeve, speed, start = 1.0, 2.0, 5 * math.pi, math.pi / 4
    weight, centrifugal = 2 * (ball + sleeve) * GRAVITY * LENGTH, ball * (speed * LENGTH) ** 2
    found = run("governor", np.linspace(0.0, 2.0, 401), damping=0.0, start=start)
    theta = found["angle"] + math.pi / 2
    other = math.acos(weight / centrifugal - math.cos(start))
    assert theta.min() == pytest.approx(start, abs=1e-9)
    assert other - 1e-2 < theta.max() < other + 1e-9
    lost = weight * (math.cos(start) - np.cos(theta)) - centrifugal * (np.sin(theta) ** 2 - math.sin(start) ** 2)
    inertia = 2 * (ball * LENGTH**2 + 1e-9) + sleeve * (2 * LENGTH * np.sin(theta)) ** 2
    np.testing.assert_allclose(found["rate"] ** 2, -2 * lost / inertia, rtol=0, atol=1e-7)

"""Forces that act on a part of the way alone are met, however long the way before them is.

Before such a force nothing limits a step but what a step must not pass over. The answers are closed formulas, sums of
energy, and the motion by scipy's DOP853 from one change of the forces to the next.
"""

import math
import random
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from mechanism_fmu.model import (
    GROUND,
    Input,
    Mechanism,
    NonlinearSpring,
    NonlinearTorsionSpring,
    Output,
    Revolute,
    Settings,
    SpringDamper,
    TorsionSpringDamper,
    characteristic,
    rigid_body,
)
from mechanism_fmu.model.functions import atan2, cos, maximum, minimum, sin, sqrt, where
from mechanism_fmu.simulation import Simulation

#: The engine's default relative tolerance is 1e-9; errors of a bounce add up.
TOLERANCE = 1e-7


def ball(forces, speed, mass=1.0, **more):
    """A ball at the origin that moves along x with some force elements, which take it as their body."""
    body = rigid_body("ball", (0.0, 0.0), mass=mass, inertia=1.0, velocity=(speed, 0.0))
    outputs = (
        Output("x", body.x, "place", "m"),
        Output("kinetic", "energy.kinetic", "energy", "J"),
        Output("events", "event.count", "events", "1", type="Integer"),
    )
    return Simulation(Mechanism((body,), (), tuple(force(body) for force in forces), outputs=outputs, **more))


def shaft(law, speed, inertia=8.5):
    """A shaft on a pin with a torque by a law."""
    body = rigid_body("shaft", (0.0, 0.0), mass=1.0, inertia=inertia, speed=speed)
    outputs = (Output("angle", body.angle, "angle", "rad"), Output("speed", body.speed, "speed", "rad/s"))
    hinge = Revolute("hinge", body.at(0, 0), GROUND.at(0, 0))
    work = NonlinearTorsionSpring("work", body, GROUND, law=law)
    return Simulation(Mechanism((body,), (hinge,), (work,), outputs=outputs))


@pytest.mark.parametrize("stiffness", [1e4, 1e8])
@pytest.mark.parametrize("way", [1.0, 1e5])
@pytest.mark.parametrize("steps", [1, 7])
def test_a_ball_comes_back_from_a_bumper(stiffness, way, steps):
    run = ball([lambda b: bumper(b, way, stiffness=stiffness)], 1.0)
    for k in range(steps):
        run.advance((way + 1.0) * (k + 1) / steps)
    back = 2.0 * (way - 0.05) - (way + 1.0) + math.pi / math.sqrt(stiffness)
    assert run.read()["x"] == pytest.approx(back, abs=TOLERANCE + 1e-9 * way)
    assert run.read()["events"] == 0  # nobody has asked when a spring begins to act


def bumper(body, place, name="bumper", free_length=0.05, **more):
    return SpringDamper(name, body, GROUND.at(place, 0.0), free_length=free_length, one_sided="compressed", **more)


def window(width, torque):
    """A torque over a part of each turn, about 2.3 rad."""

    def law(angle, _):
        distance = atan2(sin(angle - 2.3), cos(angle - 2.3))
        return where(0.5 * width - abs(distance) > 0.0, torque, 0.0)

    return law


@pytest.mark.parametrize("width", [0.6, 1e-3])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_torque_over_a_part_of_each_turn_takes_its_energy(width, sign):
    energy = 240.0
    run = shaft(window(width, energy / width), sign * 15.0)
    run.advance(1.9)
    turned = 1.9 * 15.0 / (2.0 * math.pi)
    assert turned > 3
    speed, angle = run.read()["speed"], run.read()["angle"]
    passed = math.floor((angle - 2.3) / (2.0 * math.pi)) + 1  # net passages of the window
    assert 0.5 * 8.5 * (15.0**2 - speed**2) == pytest.approx(energy * passed, rel=1e-9)
    assert abs(passed) >= 3


def test_a_law_without_value_beyond_its_condition_acts_up_to_there():
    run = ball([lambda b: NonlinearSpring("n", b, GROUND.at(10, 0), law=root)], 1.0)
    run.advance(3.0)
    pull = solve_ivp(
        lambda _, y: [y[1], math.sqrt(max(6.0 - y[0], 0.0))], (0.0, 3.0), [0.0, 1.0], rtol=1e-11, atol=1e-11
    )
    assert 6.0 < pull.y[0, -1] < 14.0
    assert run.read()["x"] == pytest.approx(pull.y[0, -1], abs=TOLERANCE)


def root(length, _):
    return where(length > 4.0, sqrt(length - 4.0), 0.0)


@pytest.mark.parametrize("speed", [1.0, -1.0])
def test_a_hill_of_a_table_far_away_is_climbed(speed):
    """Its work is at most 0.3 J, of which nothing is left behind it; it pulls towards its far end, and so is faster."""
    hill = characteristic([(1.0, 0.0), (2.0, 0.0), (2.01, 30.0), (2.02, 0.0), (3.0, 0.0)])
    run = ball([lambda b: NonlinearSpring("hill", b, GROUND.at(1e3, 0.0), law=hill)], speed, mass=2.0)
    run.advance(998.5)
    end = run.read()
    if speed < 0.0:
        assert end["x"] == pytest.approx(-998.5, abs=1e-9)
        return
    assert end["x"] > 998.5
    # Fritsch and Butland's cubics of a hill with slope 0 at its feet and top: 30 (3 u^2 - 2 u^3) on both sides
    assert end["kinetic"] == pytest.approx(1.0 + 30.0 * 0.01, abs=TOLERANCE)


def test_a_law_that_jumps_back_at_its_own_condition_does_not_stop_the_clock():
    run = ball(
        [lambda b: NonlinearSpring("rub", b, GROUND.at(-1.0, 0.0), law=lambda _, v: where(v > 0, 1.0, 0.5))], 1.0
    )
    run.advance(1.0)
    assert run.read()["x"] == pytest.approx(0.5, abs=TOLERANCE)  # it only slows down here: 1 m/s - 1 m/s2


def test_a_preload_that_an_input_takes_away_ends_the_force():
    spring = lambda b: bumper(b, 0.04, stiffness=100.0)  # noqa: E731
    inputs = (Input("preload", "bumper.preload", 0.0, "preload", "N"),)
    run = ball([spring], 0.0, inputs=inputs)
    run.set_input("preload", 1.5)  # pulls, against the 1 N of the spring
    run.advance(0.1)
    assert run.read()["x"] == 0.0
    run.set_input("preload", 0.0)
    run.advance(0.2)
    assert run.read()["x"] < -1e-3


# Random ones, against another integrator.


def reference(forces, state, end, mass):
    """Place and speed at `end` of one coordinate under forces (value, guards), smooth while guards keep their signs."""
    time = 0.0
    state = np.array(state)
    guards = [guard for _, own in forces for guard in own]
    while time < end:
        ahead = state + 1e-9 * np.array([state[1], 0.0])
        signs = [math.copysign(1.0, guard(*ahead)) for guard in guards]

        def slope(_, y, signs=signs):
            total, first = 0.0, 0
            for value, own in forces:
                total += value(*y, signs[first : first + len(own)])
                first += len(own)
            return [y[1], total / mass]

        events = []
        for guard, sign in zip(guards, signs, strict=True):

            def crosses(_, y, guard=guard, sign=sign):
                return sign * guard(*y)

            crosses.terminal, crosses.direction = True, -1.0
            events.append(crosses)
        found = solve_ivp(
            slope, (time, end), state, method="DOP853", rtol=1e-12, atol=1e-13, events=events, max_step=0.02 * end
        )
        time, state = found.t[-1], found.y[:, -1]
    return state


def drawn_bumper(rng, number):
    side = (-1) ** number
    place = side * rng.choice([0.5, 1.0, 4.0])
    free, stiffness = rng.choice([0.1, 0.25]), rng.choice([2e3, 1e5])
    damping, preload = rng.choice([0.0, 0.0, 3.0]), rng.choice([0.0, 0.0, -20.0])

    def pull(x, v):
        return -(stiffness * (side * (place - x) - free) - damping * side * v + preload)

    guards = (lambda x, v: free - side * (place - x), pull)
    force = lambda x, v, signs: -side * pull(x, v) if min(signs) > 0.0 else 0.0  # noqa: E731
    return (
        force,
        guards,
        lambda b: bumper(b, place, f"bumper_{number}", free, stiffness=stiffness, damping=damping, preload=preload),
    )


def drawn_law(rng, number):
    """A push that depends on place and speed, over a stretch of the way, by one of three ways to write it."""
    first = rng.choice([-0.3, 0.0, 0.2])
    width, size = rng.choice([0.01, 0.125]), rng.choice([-2.0, -0.5, 3.0])
    far = 10.0

    def law(length, rate):
        x = far - length
        inside = minimum(x - first, first + width - x)
        if number % 2 == 0:
            return where(inside > 0.0, size + 0.1 * rate, 0.0)
        return size * maximum(inside, 0.0) / width

    def force(x, v, signs):
        lowest = min(x - first, first + width - x)
        if min(signs[:2]) <= 0.0:
            return 0.0
        return size - 0.1 * v if number % 2 == 0 else size * lowest / width

    guards = (lambda x, v: x - first, lambda x, v: first + width - x, lambda x, v: x - first - 0.5 * width)
    return force, guards, lambda b: NonlinearSpring(f"law_{number}", b, GROUND.at(far, 0.0), law=law)


@pytest.mark.parametrize("seed", range(12))
def test_lines_of_bumpers_and_laws_move_as_by_another_integrator(seed):
    rng = random.Random(seed)
    parts = [drawn_bumper(rng, 0), drawn_bumper(rng, 1)] + [drawn_law(rng, k) for k in range(rng.choice([0, 1, 2]))]
    mass, speed = rng.choice([0.5, 2.0]), rng.choice([-2.0, 0.7, 1.0])
    end = rng.choice([2.0, 5.0])
    run = ball([make for _, _, make in parts], speed, mass)
    run.advance(end)
    place, _ = reference([(force, guards) for force, guards, _ in parts], [0.0, speed], end, mass)
    assert run.read()["x"] == pytest.approx(place, abs=1e-6)


@pytest.mark.parametrize("seed", range(4))
def test_torques_in_turns_and_torsion_springs_keep_the_energy(seed):
    rng = random.Random(seed)
    body = rigid_body("shaft", (0.0, 0.0), mass=1.0, inertia=2.0, speed=rng.choice([3.0, -5.0]))
    hinge = Revolute("hinge", body.at(0, 0), GROUND.at(0, 0))
    stops = [
        TorsionSpringDamper(
            f"stop_{k}", body, GROUND, stiffness=500.0, free_angle=side * rng.choice([1.0, 7.5, 40.0]), one_sided=word
        )
        for k, (side, word) in enumerate([(1.0, "stretched"), (-1.0, "compressed")])
    ]
    width = rng.choice([0.02, 0.4])
    work = NonlinearTorsionSpring("work", body, GROUND, law=window(width, rng.choice([0.5, -0.5])))
    outputs = (Output("e", "energy.kinetic", "kinetic energy", "J"), Output("s", "energy.spring", "in springs", "J"))
    outputs += (Output("w", "energy.work", "work", "J"), Output("angle", body.angle, "angle", "rad"))
    run = Simulation(
        Mechanism((body,), (hinge,), (*stops, work), outputs=outputs, settings=Settings(relative_tolerance=1e-12))
    )
    before = run.read()
    angles = [before["angle"]]
    for k in range(20):
        run.advance(2.0 * (k + 1))
        angles.append(run.read()["angle"])
    now = run.read()
    assert now["e"] + now["s"] - now["w"] == pytest.approx(before["e"], abs=TOLERANCE)
    assert any(before != after for before, after in pairwise(angles))

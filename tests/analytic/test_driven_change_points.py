"""Driven through change points: equal cranks and crossed ones, whose whole motion follows from the driver."""

import math
from dataclasses import replace

import numpy as np
import pytest

from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Curve,
    Mechanism,
    Output,
    Piece,
    Revolute,
    Term,
    bar,
    polynomial_motion,
)
from mechanism_fmu.simulation import Simulation, SimulationError

_DRAWS = 6
_TURNS = 2.2


def crossed(angle, frame):
    """End of the output crank of length 1: the parallelogram's, mirrored about the diagonal from the crank's pin."""
    pin, pivot = np.array([math.cos(angle), math.sin(angle)]), np.array([frame, 0.0])
    along = (pivot - pin) / math.hypot(*(pivot - pin))
    return pin + 2.0 * along * along[0] * frame - [frame, 0.0]


def draw(shape, course, seed):
    """A mechanism, the angle of its output crank as a function of time, and the time of some turns [s]."""
    rng = np.random.default_rng([seed, len(shape), len(course)])
    crank = float(rng.choice([1.0, 0.1, 10 ** rng.uniform(-1.5, 1)]))
    speed = float(rng.choice([-1, 1]) * 10 ** rng.uniform(-1.5, 1.5))
    start = float(rng.choice([0.5, 1.0, math.pi / 2, -math.pi / 4, 2.0, rng.uniform(0.3, 2.8)]))
    tilt = float(rng.choice([0.0, rng.uniform(-3, 3)]))
    corner = rng.choice([0.0, crank]) * rng.uniform(-3, 3, 2)
    masses = 10 ** rng.uniform(-1, 1, 4)
    frame = crank * float(rng.choice([1.5, 2.0, 3.0, rng.uniform(1.3, 4.0)]))
    driver, angle = _course(course, start, tilt, speed, rng)

    def place(x, y):
        c, s = math.cos(tilt), math.sin(tilt)
        return (corner[0] + c * x - s * y, corner[1] + s * x + c * y)

    def tip(turned):
        if shape == "crossed":
            return crank * crossed(turned, frame / crank)
        return crank * np.array([math.cos(turned), math.sin(turned)]) + [frame, 0.0]

    def follows(time):
        x, y = tip(angle(time) - tilt)
        return math.atan2(y, x - frame) + tilt

    pin = (crank * math.cos(start), crank * math.sin(start))
    first = bar("first", place(0, 0), place(*pin), mass=masses[0])
    last = bar("last", place(frame, 0), place(*tip(start)), mass=masses[1])
    rod = bar("rod", place(*pin), place(*tip(start)), mass=masses[2])
    bodies = [first, last, rod]
    joints = [
        Revolute("A", first.a, GROUND.at(*place(0, 0))),
        Revolute("B", first.b, rod.a),
        Revolute("C", last.b, rod.b),
        Revolute("D", last.a, GROUND.at(*place(frame, 0))),
        AngleDriver("drive", first, motion=driver),
    ]
    if shape == "three cranks":
        x, y = frame * rng.uniform(0.1, 0.9), crank * rng.choice([-1, 1]) * rng.uniform(0.3, 1.5)
        third = bar("third", place(x, y), place(x + pin[0], y + pin[1]), mass=masses[3])
        bodies.append(third)
        joints += [Revolute("E", third.a, GROUND.at(*place(x, y))), Revolute("F", third.b, rod.at(x, y))]
    gravity = (0.0, -9.81) if rng.random() < 0.4 else None
    angles = (Output("last", "last.angle", "angle of the output crank", "rad"),)
    mechanism = Mechanism(tuple(bodies), tuple(joints), outputs=angles, gravity=gravity, through_singularities=True)
    return mechanism, follows, _TURNS * 2 * math.pi / abs(speed), rng


def _course(course, start, tilt, speed, rng):
    """Constant speed, constant acceleration, or a speed that varies by half of its mean."""
    begin = start + tilt
    if course == "constant":
        return polynomial_motion(begin, speed), lambda t: begin + speed * t
    if course == "faster":
        square = 0.05 * speed * abs(speed) * rng.uniform(0.2, 2.0)
        return polynomial_motion(begin, speed, square), lambda t: begin + speed * t + square * t * t
    rate = abs(speed) * rng.uniform(0.3, 2.0)
    amplitude, phase = 0.5 * abs(speed) / rate, rng.uniform(0, 6)
    mean = begin - amplitude * math.sin(phase)
    motion = Curve((Piece(0.0, (Term((mean, speed), amplitude, rate, phase),)),))
    return motion, lambda t: mean + speed * t + amplitude * math.sin(rate * t + phase)


@pytest.mark.parametrize(
    ("shape", "course"),
    [
        *((shape, course) for shape in ("two cranks", "three cranks") for course in ("constant", "faster", "varying")),
        ("crossed", "constant"),
        ("crossed", "faster"),
    ],
)
def test_the_output_crank_follows_the_driver_through_change_points(shape, course):
    """Whatever size, speed, start, place, masses and communication step it has."""
    for seed in range(_DRAWS):
        mechanism, follows, until, rng = draw(shape, course, seed)
        simulation = Simulation(mechanism)
        count = int(rng.choice([1, 5, 23, 100]))
        for k in range(1, count + 1):
            simulation.advance(until * k / count)
            angle = simulation.read()["last"]
            assert math.remainder(angle - follows(simulation.time), 2 * math.pi) == pytest.approx(0.0, abs=1e-6), seed


@pytest.mark.parametrize("course", ["constant", "varying"])
def test_without_the_option_it_is_the_singular_configuration_that_is_named(course):
    """And not the driver, which is far from the end of any range."""
    for seed in range(4):
        mechanism, _, until, _ = draw("two cranks", course, seed)
        with pytest.raises(SimulationError, match="A singular configuration lies ahead"):
            Simulation(replace(mechanism, through_singularities=False)).advance(until)

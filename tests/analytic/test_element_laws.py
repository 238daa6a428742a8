"""Laws of force of the user's own, as functions and as tables of points."""

import math

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator
from single_element import EXACT, ORIGIN, on_a_line, read

from mechanism_fmu.model import (
    GROUND,
    Body,
    Mechanism,
    MechanismError,
    NonlinearSpring,
    NonlinearTorsionSpring,
    TorsionSpringDamper,
    characteristic,
)
from mechanism_fmu.model.functions import exp, maximum, smoothstep, tanh, where
from mechanism_fmu.simulation import Simulation


def test_a_table_is_a_monotone_cubic_whose_slope_and_energy_go_with_it():
    points = ((1.5, 0.0), (2.0, 10.0), (2.2, 10.0), (2.6, 40.0), (3.0, 35.0))
    reference = PchipInterpolator(*np.array(points).T)
    spring = NonlinearSpring("spring", "mass", ORIGIN, GROUND, ORIGIN, law=characteristic(points))
    simulation = on_a_line(spring, 2.9, rate=0.3, outputs=read("spring", "length", "force"))
    begin = simulation.read()
    lengths = []
    for time in np.linspace(0.02, 1.0, 50):
        simulation.advance(time)
        found = simulation.read()
        length = found["spring.length"]
        lengths.append(length)
        if 1.5 <= length <= 3.0:
            force, energy = float(reference(length)), float(reference.integrate(1.5, length))
        else:
            end = 1.5 if length < 1.5 else 3.0
            slope, at_end, beyond = float(reference.derivative()(end)), float(reference(end)), length - end
            force = at_end + slope * beyond
            energy = float(reference.integrate(1.5, end)) + at_end * beyond + 0.5 * slope * beyond * beyond
        assert found["spring.force"] == pytest.approx(force, abs=1e-10)
        assert found["spring"] == pytest.approx(energy, abs=1e-10)
        assert found["kinetic"] + found["spring"] == pytest.approx(begin["kinetic"] + begin["spring"], rel=1e-9)
        assert found["work"] == found["lost"] == 0.0
    assert min(lengths) < 1.5, "the straight part before the first point is not reached"


def law(x, v):
    pull = 30.0 * (x - 2.0) + 5.0 * maximum(x - 2.05, 0.0) ** 2 - where(v > 0.1, 1.0, -0.5) * exp(-x)
    return pull + 0.3 * tanh(v / 0.05) + smoothstep(x, 2.0, 2.2) / (1.0 + abs(v))


def test_a_law_of_the_users_own_is_carried_out_as_python_does():
    spring = NonlinearSpring("spring", "mass", ORIGIN, GROUND, ORIGIN, law=law)
    simulation = on_a_line(spring, 2.3, rate=0.3, outputs=read("spring", "length", "speed", "force", "power"))
    begin = simulation.read()
    for time in np.linspace(0.02, 2.0, 40):
        simulation.advance(time)
        found = simulation.read()
        assert found["spring.force"] == law(found["spring.length"], found["spring.speed"])
        assert found["spring.power"] == -found["spring.force"] * found["spring.speed"]
        assert found["kinetic"] == pytest.approx(begin["kinetic"] + found["work"], abs=1e-9)


def test_a_linear_law_is_a_spring():
    linear = NonlinearTorsionSpring("spring", "arm", law=lambda angle, speed: 4.0 * angle + 0.2 * speed)
    damped = TorsionSpringDamper("spring", "arm", stiffness=4.0, damping=0.2)
    found = []
    for element in (linear, damped):
        body = Body("arm", 1.0, 0.3, (0.0, 0.0, 0.5))
        outputs = (*read("arm", "angle"), *read("spring", "torque"))
        simulation = Simulation(Mechanism((body,), forces=(element,), outputs=outputs, settings=EXACT))
        simulation.advance(1.3)
        found.append(list(simulation.read().values()))
    np.testing.assert_allclose(*found, rtol=1e-10)


def branching(x, v):
    if x > 0.0:
        return v
    return 0.0


@pytest.mark.parametrize(
    ("law", "said"),
    [
        (branching, r"line \d+ \(if x > 0\.0:\): A law must not branch on its arguments"),
        (lambda x, v: math.sin(x) + v, "A law must not make plain numbers or text of its arguments"),
        (lambda x, v: max(x, v), "A law must not branch"),
        (lambda x, v: (x > v) * 2.0, "A law must not branch"),
        (lambda x, v: None, "it returns None, but must return a number"),
        (lambda x: x, r"called with two arguments.* write law\(x, v\), not <lambda>\(x\)"),
        (5.0, r"5\.0 is neither a function law\(x, v\) nor a curve"),
        ([(0.0, 1.0), (1.0, 2.0)], "is neither a function"),
        (
            lambda x, v: x * np.array([1.0, 2.0]),
            r"it calculates with array\(\[1\., 2\.\]\), but a law takes real numbers",
        ),
        (lambda x, v: 1j * x, "it calculates with 1j, but a law takes real numbers"),
        (lambda x, v: 1j, "it returns 1j, but must return a number"),
        (lambda x, v: np.ones(2), "must return a number"),
        (lambda x, v: x + None, "it calculates with None"),
        (lambda x, v: sum(x**k for k in range(1, 12) for _ in range(60)) * v, "more than 500 operations"),
    ],
)
def test_a_law_that_cannot_be_recorded_is_refused_with_the_line(law, said):
    with pytest.raises(MechanismError, match=f"(?s)The law of NonlinearSpring 'spring' cannot be used, .*{said}"):
        on_a_line(NonlinearSpring("spring", "mass", ORIGIN, GROUND, ORIGIN, law=law))


def test_a_number_of_another_law_is_refused_wherever_it_comes_back():
    kept = []

    def keeping(x, v):
        kept.append(x * v)
        return x

    on_a_line(NonlinearSpring("spring", "mass", ORIGIN, GROUND, ORIGIN, law=keeping))
    for other in (lambda x, v: kept[0], lambda x, v: kept[0] + x):
        with pytest.raises(MechanismError, match="A number of one law was used in another"):
            on_a_line(NonlinearSpring("spring", "mass", ORIGIN, GROUND, ORIGIN, law=other))


@pytest.mark.parametrize(
    ("exponent", "same"),
    [
        (2.0, lambda x: x * x),
        (np.int64(3), lambda x: x * x * x),
        (np.float64(3.0), lambda x: x * x * x),
        (0, lambda x: 1.0),
        (0.0, lambda x: 1.0),
        (-1, lambda x: 1.0 / x),
        (-3.0, lambda x: 1.0 / (x * x * x)),
        (13, lambda x: (x * x * x * x * x * x) * (x * x * x * x * x * x) * x),
        (50, None),
    ],
)
@pytest.mark.parametrize("angle", [-0.5, 0.7])
def test_whole_powers_are_there_for_negative_numbers_too(exponent, same, angle):
    spring = NonlinearTorsionSpring("spring", "arm", law=lambda x, v: x**exponent)
    arm = Body("arm", 1.0, 0.3, (0.0, 0.0, angle))
    torque = Simulation(Mechanism((arm,), forces=(spring,), outputs=read("spring", "torque"))).read()["spring.torque"]
    assert torque == pytest.approx(-(angle ** float(exponent)), rel=1e-14)
    if same is not None:
        assert torque == -same(angle)


@pytest.mark.parametrize("points", [[(0, 1, 2), (1, 2, 3)], [0.0, 1.0], [(0.0, 1.0), (1.0,)], ["ab", "cd"]])
def test_points_of_a_table_are_pairs(points):
    with pytest.raises(MechanismError, match=r"Point \d of a characteristic is .* must be a pair"):
        characteristic(points)

"""A spring-damper between two points: closed forms, momentum, and a ledger that adds up."""

import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from mechanism_fmu.model import GROUND, Body, Input, Mechanism, MechanismError, Output, Settings, SpringDamper
from mechanism_fmu.simulation import Simulation

EXACT = Settings(relative_tolerance=1e-12)
ENERGIES = tuple(Output(name, f"energy.{name}", "") for name in ("kinetic", "spring", "work", "lost"))
READINGS = tuple(Output(name, f"spring.{name}", "") for name in ("length", "speed", "force"))


def swung(mass, stiffness, damping, preload, start, rate, free_length):
    """A mass on the x axis on a spring-damper from the origin."""
    return Mechanism(
        (Body("mass", mass, 1.0, (start, 0.0, 0.0), (rate, 0.0, 0.0)),),
        forces=(
            SpringDamper(
                "spring", "mass", (0.0, 0.0), GROUND, (0.0, 0.0), stiffness, free_length, damping, preload=preload
            ),
        ),
        inputs=(Input("pull", "spring.preload", preload, ""),),
        outputs=(Output("x", "mass.x", ""), *READINGS, *ENERGIES),
        settings=EXACT,
    )


@settings(deadline=None, max_examples=15)
@given(damping=st.floats(0.0, 3.0), preload=st.floats(-0.5, 0.5), rate=st.floats(-0.5, 0.5))
def test_a_mass_on_a_line_swings_as_the_closed_form_says(damping, preload, rate):
    mass, stiffness, free_length, start = 0.7, 20.0, 2.0, 2.1
    simulation = Simulation(swung(mass, stiffness, damping, preload, start, rate, free_length))
    rest = free_length - preload / stiffness
    decay = damping / (2 * mass)
    root = math.sqrt(stiffness / mass - decay**2)
    a, b = start - rest, (rate + decay * (start - rest)) / root
    for time in (0.05, 0.3, 1.0):
        simulation.advance(time)
        found = simulation.read()
        swing = a * math.cos(root * time) + b * math.sin(root * time)
        turn = root * (b * math.cos(root * time) - a * math.sin(root * time))
        x, speed = rest + math.exp(-decay * time) * swing, math.exp(-decay * time) * (turn - decay * swing)
        assert found["x"] == pytest.approx(x, abs=1e-9)
        assert found["length"] == pytest.approx(x, abs=1e-9)
        assert found["speed"] == pytest.approx(speed, abs=1e-8)
        assert found["force"] == pytest.approx(stiffness * (x - free_length) + damping * speed + preload, abs=1e-7)
        assert found["spring"] == pytest.approx(0.5 * stiffness * (x - free_length) ** 2, abs=1e-8)
        assert found["work"] == pytest.approx(-preload * (x - start), abs=1e-9)


POINT = st.tuples(st.floats(-0.3, 0.3), st.floats(-0.3, 0.3))


@settings(deadline=None, max_examples=15)
@given(
    points=st.tuples(POINT, POINT),
    rates=st.tuples(*[st.floats(-1.0, 1.0)] * 6),
    damping=st.floats(0.0, 2.0),
    preload=st.floats(-1.0, 1.0),
)
def test_two_free_bodies_keep_their_momenta_and_the_ledger_adds_up(points, rates, damping, preload):
    one = Body("one", 1.0, 0.2, (0.0, 0.0, 0.3), rates[:3])
    two = Body("two", 2.0, 0.5, (1.5, 0.4, -1.0), rates[3:])
    spring = SpringDamper("spring", "one", points[0], "two", points[1], 8.0, 1.0, damping, preload=preload)
    places = tuple(
        Output(f"{body}.{what}", f"{body}.{what}", "")
        for body in ("one", "two")
        for what in ("x", "y", "x_rate", "y_rate", "speed")
    )
    simulation = Simulation(Mechanism((one, two), forces=(spring,), outputs=(*places, *ENERGIES), settings=EXACT))

    def kept():
        found = simulation.read()
        total = np.zeros(4)
        for name, mass, inertia in (("one", 1.0, 0.2), ("two", 2.0, 0.5)):
            x, y, u, v, w = (found[f"{name}.{what}"] for what in ("x", "y", "x_rate", "y_rate", "speed"))
            total[:3] += mass * u, mass * v, inertia * w + mass * (x * v - y * u)
        total[3] = found["kinetic"] + found["spring"] + found["lost"] - found["work"]
        return total

    first = kept()
    for time in (0.1, 0.5, 1.0):
        simulation.advance(time)
        np.testing.assert_allclose(kept(), first, atol=1e-9)


def test_energy_is_that_of_the_instant_that_is_read_whatever_was_looked_at_before():
    """Between the engine's own steps, outputs are read at a pose that no step has placed."""
    simulation = Simulation(swung(0.7, 20.0, 0.0, 0.0, 2.5, 0.0, 2.0))
    for time in np.linspace(0.013, 1.3, 37):
        simulation.advance(time)
        found = simulation.read()
        assert found["spring"] == pytest.approx(10.0 * (found["x"] - 2.0) ** 2, rel=1e-12)
        assert found["kinetic"] + found["spring"] == pytest.approx(2.5, rel=1e-9)


def test_where_the_points_rest_in_one_place_there_is_no_force():
    simulation = Simulation(swung(1.0, 10.0, 1.0, 3.0, 0.0, 0.0, 2.0))
    assert simulation.read()["force"] == 0.0
    simulation.advance(0.5)
    found = simulation.read()
    assert found.pop("spring") == 0.5 * 10.0 * 2.0**2  # it is pressed together to nothing
    assert found == dict.fromkeys(found, 0.0)


def test_from_one_place_the_force_acts_along_the_relative_velocity():
    simulation = Simulation(swung(1.0, 0.0, 0.5, 0.0, 0.0, 1.5, 0.0))
    assert simulation.read()["force"] == 0.5 * 1.5
    simulation.advance(1.0)
    found = simulation.read()
    assert found["x"] == pytest.approx(1.5 * (1 - math.exp(-0.5)) / 0.5, abs=1e-9)
    assert found["lost"] == pytest.approx(0.5 * 1.5**2 * (1 - math.exp(-1.0)), abs=1e-9)


def test_derivatives_of_outputs_are_those_of_differences():
    simulation = Simulation(swung(0.7, 20.0, 0.6, 0.5, 2.1, 0.3, 2.0))
    size, values = 1e-4, []
    for time in (0.4 - size, 0.4, 0.4 + size):
        simulation.advance(time)
        values.append(simulation.read())
        if time == 0.4:
            rates = simulation.read_rates()
    for name in ("length", "spring", "x"):
        difference = (values[2][name] - values[0][name]) / (2 * size)
        assert rates[name] == pytest.approx(difference, abs=1e-6)
    assert math.isnan(rates["force"])


@pytest.mark.parametrize("number", ["stiffness", "damping", "free_length"])
def test_numbers_below_zero_are_refused(number):
    spring = SpringDamper("spring", "mass", (0.0, 0.0), GROUND, (0.0, 0.0), **{number: -1.0})
    with pytest.raises(MechanismError, match=rf"SpringDamper 'spring': {number} = -1 .* must not be negative"):
        Simulation(Mechanism((Body("mass", 1.0, 1.0),), forces=(spring,)))

"""Derivatives of outputs: against closed forms, and against differences of the outputs themselves."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings, strategies as st
from rotor import ARM, INERTIA, Stop, rotor

import models
from mechanism_fmu import codes
from mechanism_fmu.model import GROUND, Body, Damper, Mechanism, Output, Revolute
from mechanism_fmu.simulation import Simulation

SOURCES = {
    "angle": "rotor.angle",
    "speed": "rotor.speed",
    "x": "rotor.x",
    "gap": "stop0.gap",
    "kinetic": "energy.kinetic",
    "spring": "energy.spring",
    "work": "energy.work",
    "lost": "energy.lost",
}
JUMPING = {"force": "stop0.force", "count": "impact.count", "when": "impact.time", "closed": "stop0.closed"}


def outputs(sources):
    return tuple(Output(name, source, "") for name, source in sources.items())


@settings(deadline=None, max_examples=20)
@given(st.floats(0.1, 2.0), st.floats(-3.0, 3.0), st.floats(-2.0, 2.0), st.floats(0.5, 3.0))
def test_rates_of_a_rotor_on_a_spring(time, acceleration, speed, frequency):
    simulation = Simulation(
        rotor([Stop(3.0)], speed=speed, acceleration=acceleration, frequency=frequency, outputs=outputs(SOURCES))
    )
    simulation.advance(time)
    values = simulation.read()
    angle, speed = values["angle"], values["speed"]
    assume(simulation.counters[codes.COUNT_IMPACTS] == 0)
    bend = acceleration - frequency**2 * angle
    expected = {"angle": speed, "speed": bend, "x": 0.0, "gap": -ARM * math.cos(3.0 - angle) * speed}
    expected |= {"kinetic": INERTIA * speed * bend, "spring": INERTIA * frequency**2 * angle * speed}
    expected |= {"work": INERTIA * acceleration * speed, "lost": 0.0}
    assert simulation.read_rates() == pytest.approx(expected, rel=1e-9, abs=1e-9)


def test_what_jumps_has_no_rate():
    simulation = Simulation(rotor([Stop(0.5)], acceleration=1.0, outputs=outputs(JUMPING)))
    simulation.advance(0.5)
    assert np.isnan(list(simulation.read_rates().values())).all()


def test_on_a_stop_nothing_moves():
    simulation = Simulation(rotor([Stop(0.0)], acceleration=1.0, outputs=outputs(SOURCES)))
    simulation.advance(0.5)
    assert simulation.read_rates() == pytest.approx(dict.fromkeys(SOURCES, 0.0), abs=1e-12)


def test_power_lost_in_a_damper():
    mechanism = Mechanism(
        bodies=(Body("rotor", 1.0, INERTIA, start_rate=(0.0, 0.0, 2.0)),),
        joints=(Revolute("hinge", "rotor", (0.0, 0.0), GROUND, (0.0, 0.0)),),
        forces=(Damper("damper", "rotor", damping=0.3),),
        outputs=outputs({"lost": "energy.lost"}),
    )
    assert Simulation(mechanism).read_rates() == pytest.approx({"lost": 0.3 * 4.0})


def test_a_rate_follows_an_input_at_once_and_the_state_stays():
    simulation = Simulation(rotor(acceleration=1.0, outputs=outputs({"speed": "rotor.speed", "work": "energy.work"})))
    simulation.advance(0.7)
    simulation.set_input("torque", 3.0 * INERTIA)
    state = simulation.state.copy()
    assert simulation.read_rates() == pytest.approx({"speed": 3.0, "work": 3.0 * INERTIA * 0.7})
    np.testing.assert_array_equal(simulation.state, state)


def test_reading_rates_does_not_disturb_the_motion():
    read, unread = (Simulation(rotor([Stop(0.35)], angle=0.3, frequency=2.0)) for _ in range(2))
    for time in np.linspace(0.1, 3.0, 30):
        read.advance(time)
        read.read_rates()
        unread.advance(time)
    np.testing.assert_array_equal(read.state, unread.state)


def test_rates_of_the_ratchet_are_those_of_its_outputs():
    """Central differences over 2 ms; between the engine's own steps too."""
    model, step = models.load("ratchet").MODEL, 1e-3
    simulation = Simulation(model.mechanism(model.values()))
    simulation.advance(0.3 - step)
    before = simulation.read()
    simulation.advance(0.3)
    rates = simulation.read_rates()
    simulation.advance(0.3 + step)
    after = simulation.read()
    finite = {name: rate for name, rate in rates.items() if not math.isnan(rate)}
    assert len(finite) > 3
    for name, rate in finite.items():
        assert rate == pytest.approx((after[name] - before[name]) / (2 * step), rel=1e-4, abs=1e-7), name

"""A motion that cannot go on says so, keeps the last good instant, and goes on when the cause is gone."""

import math

import numpy as np
import pytest
from rotor import rotor

from mechanism_fmu.model import Output
from mechanism_fmu.simulation import Simulation, SimulationError

OUTPUTS = (Output("angle", "rotor.angle", ""), Output("speed", "rotor.speed", ""))


@pytest.mark.parametrize("torque", [math.nan, math.inf, -math.inf])
def test_an_input_that_is_no_number(torque):
    simulation = Simulation(rotor(acceleration=2.0, outputs=OUTPUTS))
    simulation.advance(0.5)
    good = simulation.read()
    simulation.inputs[0] = torque  # as an FMU writes it: `set_input` refuses it
    with pytest.raises(SimulationError, match=r"t = 0\.5 s: The step size has shrunk to nothing"):
        simulation.advance(1.0)
    assert simulation.time == 0.5
    assert simulation.read() == pytest.approx(good, rel=4e-16)  # by a true step: the dense output rounds otherwise

    simulation.set_input("torque", 0.0)
    simulation.advance(1.5)
    assert simulation.read() == pytest.approx({"angle": 0.25 + 1.0, "speed": 1.0})


def test_a_motion_too_fast_for_the_communication_step():
    simulation = Simulation(rotor(angle=1.0, frequency=1e6, outputs=OUTPUTS, tolerance=1e-3))
    with pytest.raises(SimulationError, match="No progress: a tenth of max_internal_steps"):
        simulation.advance(100.0)
    reached = simulation.time
    assert 0 < reached < 100.0
    assert np.isfinite(simulation.state[: simulation.field("clock").size]).all()
    simulation.advance(reached + 1e-6)
    assert simulation.time == reached + 1e-6

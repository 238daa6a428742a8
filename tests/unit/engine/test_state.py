"""The state is all there is to save: a motion goes on from it bit for bit, whatever else stands in the block."""

import numpy as np
import pytest
from rotor import Stop, rotor

from mechanism_fmu.model import Output
from mechanism_fmu.simulation import Simulation
from mechanism_fmu.tables.layout import FIELDS

OUTPUTS = (Output("angle", "rotor.angle", ""), Output("force", "stop0.force", ""), Output("lost", "energy.lost", ""))


def bouncing():
    stops = [Stop(0.5, restitution=0.9), Stop(-0.4, sign=-1, restitution=0.8)]
    return Simulation(rotor(stops, speed=1.0, acceleration=0.3, frequency=2.0, outputs=OUTPUTS))


def course(simulation, times):
    values = []
    for time in times:
        simulation.advance(time)
        values.append([*simulation.read_array(), *simulation.state])
    return np.array(values)


@pytest.mark.parametrize("saved_at", [0.0, 0.7, 1.9, 2.5])
def test_the_motion_goes_on_from_a_saved_state_in_another_instance(saved_at):
    first, times = bouncing(), np.arange(saved_at, 4.0, 0.0625)
    first.advance(saved_at)
    saved = first.state.copy()
    expected = course(first, times)
    assert first.counters[0] > 2

    second = bouncing()
    second.set_input("torque", 1.0)
    second.advance(3.0)
    for field in FIELDS:
        if field.section == "work":
            second.field(field.name)[...] = -77 if field.integer else np.nan
    second.state[:] = saved
    np.testing.assert_array_equal(course(second, times), expected)

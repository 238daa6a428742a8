"""One change is one event: number and order of events of random mechanisms beside another integrator."""

import pytest
from event_families import FAMILIES, difference

from mechanism_fmu.model import GROUND, Brake, Input, Mechanism, Revolute, rigid_body
from mechanism_fmu.simulation import Simulation

#: Draws that the tests compare; all hundred: python -m tests.analytic.event_families 100.
DRAWS = {"belt": 6, "chain": 3, "brake": 6, "cam": 6}


@pytest.mark.parametrize(("name", "seed"), [(name, seed) for name in FAMILIES for seed in range(DRAWS[name])])
def test_events_are_those_of_another_integrator(name, seed):
    assert difference(name, seed) == ""


def test_a_brake_whose_torque_rises_from_zero_takes_part_from_there_on():
    """A disc at w0 under a torque b t turns by w0 t - b t^3 / (6 J), until it stands after sqrt(2 J w0 / b)."""
    disc = rigid_body("disc", (0, 0), mass=1.0, inertia=0.5, speed=4.0)
    limit = Input("limit", "brake.limit", 0.0, "", "N.m")
    simulation = Simulation(
        Mechanism((disc,), (Revolute("hinge", disc, GROUND),), (Brake("brake", disc, limit=0.0),), inputs=(limit,))
    )
    simulation.set_slope("limit", 1.0)
    simulation.advance(3.0)
    (event,) = simulation.events_in_step()
    assert (event.guard, event.time) == ("brake.sticks", pytest.approx(2.0, abs=1e-9))
    assert simulation.field("y_end")[2] == pytest.approx(4.0 * 2.0 - 8.0 / 3.0, abs=1e-9)

"""Directional derivatives in the engine: where rows depend on an input, the factorisation is not kept."""

import numpy as np
import pytest

from mechanism_fmu.engine.exchange.sensitivities import respond
from mechanism_fmu.model import GROUND, Brake, Input, Mechanism, Output, Revolute, Torque, rigid_body
from mechanism_fmu.simulation import Simulation


@pytest.mark.parametrize(
    ("seed", "friction"), [((1.0, 0.0), 0.0), ((-1.0, 0.0), 0.0), ((0.0, 1.0), -1.0), ((-1.0, 1.0), -1.0)]
)
def test_a_brake_that_holds_has_a_row_whatever_its_limit_is_moved_by(
    seed: tuple[float, float], friction: float
) -> None:
    """On one side of the first step its limit is below 0, where there is nothing to hold with."""
    disc = rigid_body("disc", (0.0, 0.0), mass=1.0, inertia=0.1)
    made = Mechanism(
        (disc,),
        (Revolute("shaft", disc, GROUND),),
        forces=(Brake("brake", disc, limit=0.005), Torque("load", disc, torque=0.001)),
        inputs=(Input("limit", "brake.limit", 0.005, "", "N.m"), Input("load", "load.torque", 0.001, "", "N.m")),
        outputs=(Output("friction", "brake.friction_force", "", "N.m"),),
    )
    simulation = Simulation(made)
    simulation.advance(0.1)
    simulation.field("input_seed")[:] = seed
    simulation.field("state_seed")[:] = 0.0
    simulation.field("asked")[:] = 1
    respond(simulation._block)
    assert simulation.field("response")[0] == pytest.approx(friction, abs=1e-9)
    assert np.isfinite(simulation.field("response")).all()

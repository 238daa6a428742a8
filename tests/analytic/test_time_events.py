"""Time events of Model Exchange: where the next piece of a driver's motion begins, at which accelerations may jump."""

import math

import numpy as np
import pytest

from mechanism_fmu import codes
from mechanism_fmu.engine import status
from mechanism_fmu.model import GROUND, AngleDriver, Body, Mechanism, Revolute
from mechanism_fmu.model.curves.motions import harmonic_motion, table_motion
from mechanism_fmu.simulation import Simulation

POINTS = [(0.0, 0.0), (0.5, 1.0), (1.25, 0.5), (2.0, 2.0)]


def driven(motion):
    return Simulation(
        Mechanism(
            bodies=(Body("rotor", 1.0, 0.02),),
            joints=(
                Revolute("pin", "rotor", (0.0, 0.0), GROUND, (0.0, 0.0)),
                AngleDriver("drive", "rotor", motion=motion),
            ),
        )
    )


def next_piece(simulation, time):
    """How far it is [s], by an event mode in which nothing is due."""
    assert simulation._engine.exchange(codes.EXCHANGE_EVENTS, time) == status.OK
    return simulation.field("exchange_next_piece").item(0)


@pytest.mark.parametrize("time", [0.0, 0.2, 0.5, 0.5 + 1e-9, 1.2499])
def test_the_next_point_of_a_table_is_a_time_event(time):
    later = [at for at, _ in POINTS if at > time + 1e-12]
    assert next_piece(driven(table_motion(POINTS)), time) == pytest.approx(later[0] - time, abs=1e-12)


def test_a_motion_of_one_piece_has_none():
    simulation = driven(harmonic_motion(0.0, 1.0, 3.0))
    assert next_piece(simulation, 0.3) == math.inf
    assert np.isfinite(simulation.field("exchange_seen_y")).all()

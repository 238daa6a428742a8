"""Discs that come off for an instant: hops lower than the noise of gaps, where two circles touch at their seams."""

import pytest

from mechanism_fmu.model import GROUND, Mechanism, Outline, OutlineContact, rigid_body
from mechanism_fmu.simulation import Simulation

RADIUS, ACCELERATION = 0.05, 8.5


@pytest.mark.parametrize("speed", [2e-6, 3.6e-6, 1e-5])
@pytest.mark.parametrize("depth", [0.0, 5e-14])
def test_a_hop_at_the_seams_of_two_circles_ends(speed, depth):
    """It comes back to zero at 2 v/a less what the depth takes, (v + sqrt(v^2 - 2 a d))/a, and rests from then on.

    The top of the first two hops, v^2/(2 a), is below 1e-12 m.
    """
    disc = Outline.circle(RADIUS)
    body = rigid_body("disc", (2 * RADIUS - depth, 0.0), mass=1.0, inertia=1.0, velocity=(speed, 0.0))
    contact = OutlineContact("other", body, GROUND, outline_i=disc, outline_j=disc, points=1)
    simulation = Simulation(Mechanism((body,), contacts=(contact,), gravity=(-ACCELERATION, 0.0)))
    simulation.advance(1e-3)
    assert simulation.mode() == ("other",)
    (event,) = simulation.events_in_step()
    back = (speed + (speed**2 - 2 * ACCELERATION * depth) ** 0.5) / ACCELERATION
    assert event.time == pytest.approx(back, abs=0.1 * back)
    assert simulation.field("y_end")[0] == pytest.approx(2 * RADIUS, abs=1e-12)

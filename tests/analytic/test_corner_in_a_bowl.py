"""A sharp corner in a hollow arc swings as a pendulum does."""

import math

import pytest
from scipy.special import ellipk

from mechanism_fmu.model import GROUND, Body, Mechanism, Outline, OutlineContact, Output, Settings
from mechanism_fmu.simulation import Simulation

G, RADIUS = 9.81, 0.5


@pytest.mark.parametrize("degrees", [10, 40])
def test_a_corner_slides_in_a_bowl_as_a_pendulum_swings(degrees: float) -> None:
    """The corner is the centre of mass, so that nothing turns the body: a quarter of a period, speed, force."""
    swing = math.radians(degrees)
    quarter = math.sqrt(RADIUS / G) * float(ellipk(math.sin(swing / 2) ** 2))
    wedge = Outline.polygon([(0.0, 0.0), (0.02, 0.05), (-0.02, 0.05)])
    at = RADIUS * math.sin(swing), -RADIUS * math.cos(swing)
    body = Body("wedge", 2.0, 0.01, start=(*at, 0.0))
    # half a circle, from the right end to the left one, material below
    bowl = Outline(((RADIUS, 0.0, -1.0), (-RADIUS, 0.0, 0.0)), closed=False)
    contact = OutlineContact("bowl", body, GROUND, outline_i=wedge, outline_j=bowl)
    names = {"x": "m", "x_rate": "m/s", "angle": "rad"}
    outputs = tuple(Output(name, f"wedge.{name}", "", unit) for name, unit in names.items())
    outputs += (Output("force", "bowl.force", "", "N"),)
    settings = Settings(relative_tolerance=1e-12)
    mechanism = Mechanism((body,), contacts=(contact,), outputs=outputs, gravity=(0.0, -G), settings=settings)
    simulation = Simulation(mechanism)
    simulation.advance(quarter)
    found = simulation.read()
    speed = math.sqrt(2 * G * RADIUS * (1 - math.cos(swing)))
    assert found["x"] == pytest.approx(0.0, abs=1e-9)
    assert found["x_rate"] == pytest.approx(-speed, rel=1e-9)
    assert found["force"] == pytest.approx(2.0 * (G + speed**2 / RADIUS), rel=1e-8)
    assert found["angle"] == 0.0
    assert [event.guard for event in simulation.events_in_step()] == []

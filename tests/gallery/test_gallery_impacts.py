"""Mechanisms of the gallery that strike: times and speeds of their impacts against energy between them."""

import math
from collections.abc import Iterator

import numpy as np
import pytest
from gallery_examples import simulation
from scipy.special import ellipeinc

from benchmarks.world.cases.rocking_block import impacts as block_impacts
from mechanism_fmu.simulation import Impact, Simulation


def impacts(running: Simulation, until: float) -> list[Impact]:
    """All impacts up to a time [s]."""
    found = []
    for time in np.linspace(0.0, until, 201)[1:]:
        running.advance(time)
        found += running.impacts_in_step()
    return found


def yoke_impacts(number: int) -> Iterator[tuple[float, float]]:
    """Times [s] and closing speeds [m/s] of the yoke.

    With psi, the crank's angle from the middle of the stroke, the energy is (J + m r^2 cos(psi)^2) psi'^2/2, so that
    the time is the integral of sqrt((J + m r^2) (1 - k sin(psi)^2)) over sqrt(2 E), k = m r^2/(J + m r^2): one of
    elliptic integrals of the second kind. Each stop leaves the part e of the speed, and e^2 of the energy.
    """
    radius, stop, mass, bounce = 0.1, 0.08, 3.0, 0.8
    inertia = 0.02 + 2.0 * 0.05**2  # of the crank about its hinge
    reach = math.asin(stop / radius)
    whole = inertia + mass * radius**2
    energy = 0.5 * whole * (2 * math.pi) ** 2
    time, quarter = 0.0, math.sqrt(whole / 2) * ellipeinc(reach, mass * radius**2 / whole)
    for k in range(number):
        time += (1 if k == 0 else 2) * quarter / math.sqrt(energy)
        rate = math.sqrt(2 * energy / (inertia + mass * radius**2 * math.cos(reach) ** 2))
        yield time, rate * radius * math.cos(reach)
        energy *= bounce**2


def test_the_scotch_yoke_strikes_its_stops_when_an_elliptic_integral_says() -> None:
    found = impacts(simulation("scotch_yoke"), 2.0)
    assert [impact.contact for impact in found] == ["left", "right", "left", "right"]
    wanted = [*yoke_impacts(len(found))]
    np.testing.assert_allclose([(i.time, i.closing_speed) for i in found], wanted, rtol=5e-9, atol=0)


@pytest.mark.parametrize(("width", "height"), [(0.2, 0.8), (0.3, 0.5)])
def test_the_block_rocks_as_housner_found(width: float, height: float) -> None:
    found = impacts(simulation("rocking_block", width=width, height=height), 2.5)
    assert len(found) >= 6
    assert [impact.contact for impact in found[:3]] == ["left", "right", "left"]
    wanted = [*block_impacts(6, width, height)]
    np.testing.assert_allclose([(i.time, i.closing_speed) for i in found[:6]], wanted, rtol=1e-8, atol=0)


def test_the_block_comes_to_rest() -> None:
    running = simulation("rocking_block")
    running.advance(6.0)
    at_rest = running.read()
    assert at_rest["impact_count"] > 50
    assert abs(at_rest["angle"]) < 1e-12
    assert {"left", "right"} <= {*running.mode()}

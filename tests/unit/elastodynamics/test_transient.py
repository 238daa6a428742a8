"""Direct integration, which the benchmark sets beside the periodic motion, is right itself, and ends in it."""

import math

import numpy as np
import pytest

from benchmarks.newmark import transient
from mechanism_fmu.elastodynamics.elastic_cycle import ElasticCycle
from mechanism_fmu.elastodynamics.responses import periodic_response
from tests import bending_four_bar as four_bar


def swinging(ratio=0.05, samples=8):
    """One mass on a constant spring, omega = 10 rad/s, a period of 1 s, no load."""
    return ElasticCycle(1.0, [[2.0]], [[40.0 * ratio]], np.full((samples, 1, 1), 200.0), np.zeros((samples, 1)))


def test_free_swing_is_of_second_order():
    errors, zeta = [], 0.05
    damped = 10 * math.sqrt(1 - zeta**2)
    for steps in (50, 100, 200):
        found = transient(swinging(zeta), steps, 2, displacement=[0.3], velocity=[-1.0])
        t, b = found.time, (-1.0 + 10 * zeta * 0.3) / damped
        exact = np.exp(-10 * zeta * t) * (0.3 * np.cos(damped * t) + b * np.sin(damped * t))
        errors.append(np.abs(found.displacement[:, 0] - exact).max())
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    np.testing.assert_allclose(orders, 2.0, atol=0.05)


def test_without_damping_no_energy_is_lost():
    found = transient(swinging(0.0), 30, 5, displacement=[0.3])
    energy = 100.0 * found.displacement**2 + found.velocity**2
    np.testing.assert_allclose(energy, 9.0, rtol=1e-12)


def test_acceleration_fulfils_the_equations_at_every_step():
    cycle = four_bar.cycle(500, 90)
    found = transient(cycle, 90)
    j = np.arange(91) % 90
    parts = [
        np.einsum("tab,tb->ta", matrix[j], x)
        for matrix, x in (
            (cycle.mass, found.acceleration),
            (cycle.damping, found.velocity),
            (cycle.stiffness, found.displacement),
        )
    ]
    np.testing.assert_allclose(sum(parts), cycle.load[j], atol=1e-9 * np.abs(parts).max())


def test_the_end_of_the_transient_is_the_periodic_motion_to_second_order():
    # With 10 % of damping, four periods forget the start to 1e-9: exp(-0.1 * 490 rad/s * 4 * 0.12 s) = 6e-11.
    cycle = four_bar.cycle(500, 360, ratio=0.1)
    expected = periodic_response(cycle)
    errors = []
    for steps in (500, 1000):
        found = transient(cycle, steps, periods=4).displacement[-steps - 1 : -1]
        errors.append(np.abs(found - expected.samples(steps)).max())
    assert errors[1] < 2e-3 * np.abs(found).max()
    assert math.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.1)


def test_what_cannot_be_integrated_is_refused():
    with pytest.raises(ValueError, match="0 steps of each of 1 periods"):
        transient(swinging(), 0)
    massless = ElasticCycle(1.0, np.diag([1.0, 0.0]), np.eye(2), np.stack([np.eye(2)] * 8), np.zeros((8, 2)))
    with pytest.raises(ValueError, match="has no mass"):
        transient(massless, 10)

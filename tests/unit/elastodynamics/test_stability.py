"""The largest Floquet multiplier against closed forms, and against an integrator of another kind."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from mechanism_fmu.elastodynamics.elastic_cycle import ElasticCycle
from mechanism_fmu.elastodynamics.fourier import coefficients, evaluate
from mechanism_fmu.elastodynamics.responses import growth_per_period
from tests import bending_four_bar as four_bar


def swinging(ratio):
    """One mass on a constant spring, omega = 10 rad/s, a period of 1 s."""
    return ElasticCycle(1.0, [[2.0]], [[40.0 * ratio]], np.full((8, 1, 1), 200.0), np.zeros((8, 1)))


@pytest.mark.parametrize("ratio", [0.0, 0.05, 0.5])
def test_disturbances_of_a_constant_system_die_out_at_its_own_rate_to_fifth_order(ratio):
    errors = [abs(growth_per_period(swinging(ratio), steps) - math.exp(-10 * ratio)) for steps in (20, 40)]
    assert errors[1] < 1e-5
    assert math.log2(errors[0] / errors[1]) == pytest.approx(5.0, abs=0.3)


@pytest.mark.parametrize(("detuning", "grows"), [(0.0, True), (0.3, False)])
def test_stiffness_that_changes_at_twice_the_natural_frequency_makes_it_swing(detuning, grows):
    # Mathieu's first region: omega^2 (1 + e cos 2 omega t) grows by exp(e omega t / 4), if not detuned by e omega / 4.
    omega, e = 10.0, 0.2
    period = math.pi / omega / (1 + detuning)
    stiffness = omega**2 * (1 + e * np.cos(2 * math.pi / 32 * np.arange(32)))
    cycle = ElasticCycle(period, [[1.0]], [[0.0]], stiffness[:, None, None], np.zeros((32, 1)))
    expected = math.exp(e * omega * period / 4) if grows else 1.0
    assert growth_per_period(cycle, 400) == pytest.approx(expected, rel=2e-3)


def test_the_path_generator_is_as_scipys_integrator_has_it():
    cycle = four_bar.cycle(500, 90)
    n = cycle.load.shape[1]
    series = [coefficients(part) for part in (cycle.mass, cycle.damping, cycle.stiffness)]

    def rates(time, state):
        m, c, k = (evaluate(one, np.array([2 * math.pi * time / cycle.period]))[0] for one in series)
        u, v = np.split(state.reshape(2 * n, -1), 2)
        return np.vstack([v, -np.linalg.solve(m, c @ v + k @ u)]).ravel()

    start = np.eye(2 * n).ravel()
    end = solve_ivp(rates, (0.0, cycle.period), start, method="DOP853", rtol=1e-6, atol=1e-8, t_eval=[cycle.period]).y
    expected = np.abs(np.linalg.eigvals(end.reshape(2 * n, 2 * n))).max()
    assert growth_per_period(cycle, 360) == pytest.approx(expected, rel=1e-4)


def test_a_coordinate_without_mass_follows_the_others():
    # two springs in series, a mass at their end and none between them: one spring of half the stiffness
    stiffness = np.broadcast_to(np.array([[400.0, -200.0], [-200.0, 200.0]]), (8, 2, 2))
    damping = np.diag([0.0, 0.3])
    chain = ElasticCycle(1.0, np.diag([0.0, 1.0]), damping, stiffness, np.zeros((8, 2)))
    alone = ElasticCycle(1.0, [[1.0]], [[0.3]], np.full((8, 1, 1), 100.0), np.zeros((8, 1)))
    assert growth_per_period(chain, 50) == pytest.approx(growth_per_period(alone, 50), rel=1e-9)
    assert growth_per_period(alone, 50) == pytest.approx(math.exp(-0.15), rel=1e-6)


def test_modes_too_fast_for_the_steps_do_not_count():
    # a mode of 100 rad/s beside one of 1e5 rad/s, of which each step of the period has 300 swings
    cycle = ElasticCycle(
        1.0, np.eye(2), np.diag([2.0, 20.0]), np.broadcast_to(np.diag([1e4, 1e10]), (8, 2, 2)), np.zeros((8, 2))
    )
    assert growth_per_period(cycle, 360) == pytest.approx(math.exp(-1.0), rel=1e-4)

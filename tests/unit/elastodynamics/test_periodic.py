import math

import numpy as np
import pytest
from hypothesis import given, strategies as st

from mechanism_fmu.elastodynamics.elastic_cycle import ElasticCycle
from mechanism_fmu.elastodynamics.responses import TOLERANCE, periodic_response
from tests import bending_four_bar as four_bar
from tests.elastodynamics_oracle import oracle


@given(st.integers(0, 10**6), st.integers(1, 6))
def test_constant_coefficients_give_the_response_of_each_harmonic(seed, harmonics):
    # (K - (h Omega)^2 M + i h Omega C) U_h = P_h, one harmonic at a time.
    rng = np.random.default_rng(seed)
    n, samples, period = 3, 80, 0.7
    a, b = rng.normal(size=(2, n, n))
    K, M, C = a @ a.T + np.eye(n), 1e-3 * (b @ b.T + np.eye(n)), 0.05 * np.eye(n)
    P = rng.normal(size=(harmonics + 1, n)) + 1j * rng.normal(size=(harmonics + 1, n))
    times = period / samples * np.arange(samples)
    speed = 2 * math.pi / period
    waves = np.exp(1j * speed * np.multiply.outer(times, np.arange(harmonics + 1)))
    found = periodic_response(ElasticCycle(period, M, C, np.broadcast_to(K, (samples, n, n)), (waves @ P).real))
    response = [np.linalg.solve(K - (h * speed) ** 2 * M + 1j * h * speed * C, P[h]) for h in range(harmonics + 1)]
    expected = (waves @ np.array(response)).real
    np.testing.assert_allclose(found.samples(samples), expected, atol=1e-9 * np.abs(expected).max())


def mathieu(samples=160):
    """One coordinate whose stiffness changes by half, with a load that makes u = exp(cos theta) the solution."""
    speed, m, c = 3.0, 2.0, 0.8
    theta = 2 * math.pi / samples * np.arange(samples)
    k = 40.0 * (1 + 0.5 * np.cos(theta))
    u = np.exp(np.cos(theta))
    v = -speed * np.sin(theta) * u
    a = speed**2 * (np.sin(theta) ** 2 - np.cos(theta)) * u
    load = m * a + c * v + k * u
    cycle = ElasticCycle(2 * math.pi / speed, [[m]], [[c]], k[:, None, None], load[:, None])
    return cycle, np.stack([u, v, a])


def test_changing_stiffness_gives_the_solution_that_was_put_in():
    cycle, expected = mathieu()
    found = periodic_response(cycle)
    assert found.residual <= TOLERANCE
    for derivative in range(3):
        np.testing.assert_allclose(found.samples(160, derivative)[:, 0], expected[derivative], atol=1e-10)
    np.testing.assert_allclose(found.at([cycle.period * 0.25, cycle.period * 3.25])[:, 0], expected[0][40], atol=1e-10)


def test_the_mass_may_change_with_the_position():
    theta = 2 * math.pi / 64 * np.arange(64)
    mass = 1.0 + 0.3 * np.sin(theta)
    load = -mass * np.cos(theta) + 9.0 * np.cos(theta)  # of u = cos t, period 2 pi, no damping
    cycle = ElasticCycle(2 * math.pi, mass[:, None, None], [[0.0]], np.full((64, 1, 1), 9.0), load[:, None])
    np.testing.assert_allclose(periodic_response(cycle).samples(64)[:, 0], np.cos(theta), atol=1e-12)


def test_the_path_generator_deviates_as_the_oracle_says():
    response = periodic_response(four_bar.cycle(rpm=500, samples=360))

    def deviation(degrees):
        u = response.at(np.radians(degrees) / (2 * math.pi) * response.period)
        return np.linalg.norm(u[:, :2], axis=1)

    tenths = 0.1 * np.arange(3600)
    samples = deviation(tenths)
    assert tenths[samples.argmax()] == pytest.approx(9.6)
    assert samples.max() == pytest.approx(0.0939424332, abs=1e-10)
    finer = np.linspace(9.5, 9.7, 2001)
    assert deviation(finer).max() == pytest.approx(0.0939424413, abs=1e-10)
    assert finer[deviation(finer).argmax()] == pytest.approx(9.6056, abs=1e-4)


def test_slowly_turned_it_is_the_quasi_static_deviation():
    cycle = four_bar.cycle(rpm=5, samples=180)
    static = cycle.static()
    np.testing.assert_allclose(periodic_response(cycle).samples(180), static, atol=1e-3 * np.abs(static).max())


def test_quasi_static_deviation_is_that_of_the_oracle():
    case = four_bar.cycle(rpm=500, samples=360).static()
    for entry in oracle()["case2"]:
        np.testing.assert_allclose(case[entry["phi_deg"], :3], entry["delta_P"], rtol=1e-9)
    # Its largest value over the cycle is at 13.309 deg, between two tenths of a degree.
    phi, speed = np.radians(np.linspace(13.25, 13.35, 101)), 500 * math.pi / 30
    load = -four_bar.accelerations(phi, speed) @ four_bar.masses()
    u = np.linalg.solve(four_bar.stiffness(phi), load[..., None])[:, :2, 0]
    assert np.linalg.norm(u, axis=1).max() == pytest.approx(0.0744696716, abs=1e-10)
    assert np.linalg.norm(case[:, :2], axis=1).max() < 0.0744696716


def test_too_few_samples_are_warned_of():
    with pytest.warns(UserWarning, match="give more samples"):
        periodic_response(four_bar.cycle(rpm=500, samples=60))


def test_undamped_resonance_has_no_periodic_motion():
    # A stiffness of 4 and a mass of 1 swing twice a period of 2 pi; integers, so that the matrix is singular.
    theta = 2 * math.pi / 64 * np.arange(64)
    cycle = ElasticCycle(2 * math.pi, [[1.0]], [[0.0]], np.full((64, 1, 1), 4.0), np.cos(2 * theta)[:, None])
    with pytest.raises(ValueError, match="Give it damping"):
        periodic_response(cycle)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"load": np.zeros((4, 1))}, r"shape \(4, 1\): give it at 8 or more"),
        ({"load": np.zeros(8)}, r"shape \(8,\)"),
        ({"mass": np.eye(2)}, r"the mass has the shape \(2, 2\)"),
        ({"stiffness": np.ones((7, 1, 1))}, r"the stiffness has the shape \(7, 1, 1\)"),
        ({"damping": [[math.nan]]}, "the damping has values that are not finite"),
        ({"period": 0.0}, "the period is 0 s"),
    ],
)
def test_arrays_that_do_not_fit_are_refused(change, message):
    right = {
        "period": 1.0,
        "mass": np.eye(1),
        "damping": np.eye(1),
        "stiffness": np.ones((8, 1, 1)),
        "load": np.zeros((8, 1)),
    }
    ElasticCycle(**right)
    with pytest.raises(ValueError, match=message):
        ElasticCycle(**right | change)

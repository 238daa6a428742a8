import math

import numpy as np
import pytest
from hypothesis import given, strategies as st

from mechanism_fmu.elastodynamics.elastic_cycle import instantaneous_modes
from tests import bending_four_bar as four_bar
from tests.elastodynamics_oracle import oracle


def random_pair(seed, n=4, positions=3, massless=0):
    rng = np.random.default_rng(seed)
    a = rng.normal(size=(positions, n, n))
    stiffness = a @ a.swapaxes(1, 2) + 0.1 * np.eye(n)
    b = rng.normal(size=(n, n - massless))
    return stiffness, b @ b.T + (0.0 if massless else 0.1) * np.eye(n)


def test_a_chain_of_equal_masses_and_springs_has_its_known_frequencies():
    # n masses m between springs k, walls at both ends: omega_j = 2 sqrt(k/m) sin(j pi / (2 n + 2)).
    n, k, m = 6, 300.0, 0.7
    stiffness = k * (2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1))
    found = instantaneous_modes(stiffness[None], m * np.eye(n))
    expected = 2 * math.sqrt(k / m) * np.sin(np.arange(1, n + 1) * math.pi / (2 * n + 2))
    np.testing.assert_allclose(found.omega[0], expected, rtol=1e-13)
    np.testing.assert_allclose(found.hertz[0], expected / (2 * math.pi), rtol=1e-13)


@given(st.integers(0, 10**6))
def test_shapes_are_modes_and_damping_has_its_ratio_in_each(seed):
    K, M = random_pair(seed)
    modes = instantaneous_modes(K, M)
    z, omega = modes.shapes, modes.omega
    assert np.all(np.diff(omega, axis=1) >= 0)
    np.testing.assert_allclose(K @ z, M @ z * omega[:, None, :] ** 2, atol=1e-9 * np.abs(K @ z).max())
    ratios = np.array([0.01, 0.02, 0.3, 0.0])
    for k, damping in enumerate(modes.damping(ratios)):
        expected = np.diag(2 * ratios / omega[k])
        np.testing.assert_allclose(z[k].T @ damping @ z[k], expected, atol=1e-10 * expected.max())
        np.testing.assert_allclose(damping, damping.T, atol=1e-10 * np.abs(damping).max())


def test_damped_free_vibration_has_the_ratio_that_was_asked():
    # The eigenvalues of the first-order system say so without any mode shape: -zeta omega +- i omega sqrt(1 - zeta^2).
    K, M = random_pair(5, positions=1)
    modes = instantaneous_modes(K, M)
    C, inverse = modes.damping(0.02)[0], np.linalg.inv(M)
    first_order = np.block([[np.zeros((4, 4)), np.eye(4)], [-inverse @ K[0], -inverse @ C]])
    values = np.linalg.eigvals(first_order)
    np.testing.assert_allclose(-values.real / np.abs(values), 0.02, rtol=1e-8)
    np.testing.assert_allclose(np.sort(np.abs(values))[::2], modes.omega[0], rtol=1e-8)


def test_a_coordinate_without_mass_has_a_mode_of_infinite_frequency_and_no_damping():
    K, M = random_pair(1, massless=1)
    modes = instantaneous_modes(K, M)
    assert np.all(np.isinf(modes.omega[:, -1]))
    assert np.all(np.isfinite(modes.omega[:, :-1]))
    assert np.all(np.isfinite(modes.damping(0.02)))


def test_the_path_generator_has_the_frequencies_of_the_oracle():
    for case in oracle()["frequencies_hz"]:
        K = four_bar.stiffness([math.radians(case["phi_deg"])])
        found = instantaneous_modes(K, four_bar.masses()).hertz[0, :3]
        np.testing.assert_allclose(found, case["first_three"], rtol=1e-8)


def test_a_linkage_that_moves_without_bending_is_refused():
    with pytest.raises(ValueError, match="can move without bending"):
        instantaneous_modes(np.diag([1.0, -1.0])[None], np.eye(2))


def test_a_negative_mass_is_refused():
    K = np.stack([np.eye(2)] * 3)
    M = np.stack([np.eye(2), np.diag([1.0, -0.1]), np.eye(2)])
    with pytest.raises(ValueError, match="in position 1"):
        instantaneous_modes(K, M)


@pytest.mark.parametrize("ratio", [-0.01, 1.0, math.nan, [0.02, 2.0]])
def test_a_damping_ratio_that_cannot_be_is_refused(ratio):
    with pytest.raises(ValueError, match="the damping ratio is"):
        instantaneous_modes(np.eye(2)[None], np.eye(2)).damping(ratio)

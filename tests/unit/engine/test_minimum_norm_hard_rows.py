"""Rows that are nearly dependent, or repeated on another scale: where orthogonality is easily lost."""

import numpy as np
import pytest
from exact_pseudoinverse import exact_minimum_norm
from hypothesis import given, settings, strategies as st
from minimum_norm_solver import solve

SEEDS = st.integers(0, 2**32 - 1)


def random_rows(random):
    return random.standard_normal((random.integers(3, 7), random.integers(7, 12)))


def relative(error, *factors):
    return np.abs(error).max() / np.prod([np.abs(factor).max() for factor in factors])


@settings(deadline=None, max_examples=10)
@given(SEEDS)
@pytest.mark.parametrize("distance", 10.0 ** -np.arange(1, 9))
@pytest.mark.parametrize("repeated", [False, True])
def test_nearly_dependent_rows_are_satisfied_to_rounding(repeated, distance, seed):
    """z itself is known only to rounding over `distance`, but D z = b and D^T multiplier = z hold."""
    random = np.random.default_rng(seed)
    D = np.linalg.qr(random.standard_normal((12, 6)))[0].T
    D[1] = D[0] + distance * D[1]
    D[2] = D[0] - distance * D[2]
    rank = len(D)
    if repeated:
        D = np.vstack([D, D[:2], -2 * D[:1]])
    b = D @ random.standard_normal(D.shape[1])
    z, multiplier, found_rank = solve(D, b)
    assert found_rank == rank
    assert relative(D @ z - b, D, z) < 2e-14
    assert relative(D.T @ multiplier - z, D, multiplier) < 2e-14


@settings(deadline=None, max_examples=30)
@given(SEEDS)
def test_repeated_rows_of_other_scales_change_nothing(seed):
    """Scales are powers of two from 1e-3 to 1e3, in any order: what is small may come before what is large."""
    random = np.random.default_rng(seed)
    D = random_rows(random)
    rank = len(D)
    D = np.vstack([D, D[:2], -D[:1]]) * 2.0 ** random.integers(-10, 11, (rank + 3, 1))
    b = D @ random.integers(-8, 9, D.shape[1])
    z, multiplier, found_rank = solve(D, b)
    exact = exact_minimum_norm(D, b)
    assert found_rank == rank == exact.rank
    assert relative(z - exact.z, exact.z) < 1e-12
    assert relative(multiplier - exact.multiplier, exact.multiplier) < 1e-9


@pytest.mark.parametrize("tilt", [0.0, 1e-12, 1e-10, 7e-9, 2e-8])
def test_a_row_of_one_entry_that_is_hardly_turned_is_of_one_no_more(tilt):
    """Its length is the same to the last digit; what is left of it beside the first row is not along one column."""
    D = np.array([[1.0, tilt, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 1.0]])
    b = np.array([1.0, 2.0, 7.0])
    z, multiplier, rank = solve(D, b)
    assert rank == 3
    np.testing.assert_allclose(D @ z, b, rtol=0, atol=1e-14)
    np.testing.assert_allclose(D.T @ multiplier, z, rtol=0, atol=1e-14)

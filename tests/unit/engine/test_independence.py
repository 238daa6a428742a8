"""How far rows are from depending on each other, in closed form, and solutions where scales are large or small."""

import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from minimum_norm_solver import BLOCK, solve

from mechanism_fmu.engine.dynamics.minimum_norm import RANK_TOLERANCE
from mechanism_fmu.tables.layout import field_of


def independence(D):
    solve(D, np.zeros(len(D)))
    return field_of(BLOCK, "independence").item()


def test_no_rows_and_rows_at_right_angles_are_wholly_independent():
    assert independence(np.zeros((0, 5))) == 1.0
    assert independence(np.zeros((2, 5))) == 1.0
    assert independence(np.diag([3.0, 1e-5, 2e4])) == 1.0


@pytest.mark.parametrize("scale", [1e-4, 1.0, 1e4])
@pytest.mark.parametrize("degrees", [90, 60, 10, 0.1, 1e-4])
def test_of_two_rows_it_is_the_squared_sine_of_the_angle_between_them(degrees, scale):
    angle = math.radians(degrees)
    D = np.array([[1.0, 0.0, 0.0], [math.cos(angle), 0.0, math.sin(angle)]])
    assert independence(D * [[1.0], [scale]]) == pytest.approx(math.sin(angle) ** 2, rel=1e-8, abs=1e-24)


@pytest.mark.parametrize("order", [[0, 1, 2], [1, 0, 2], [2, 1, 0], [0, 2, 1], [1, 2, 0], [2, 0, 1]])
def test_the_least_independent_row_counts_wherever_it_stands(order):
    """Of rows 1, 1 + d e_2 and e_3 the last to be taken is one of the first two."""
    d = 1e-3
    D = np.array([[1.0, 0.0, 0.0], [1.0, d, 0.0], [0.0, 0.0, 5.0]])[order]
    assert independence(D) == pytest.approx(d**2 / (1 + d**2), rel=1e-9, abs=0)


def test_a_row_that_repeats_another_does_not_count():
    D = np.array([[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [-2.0, 0.0, 0.0]])
    assert independence(D) == pytest.approx(0.5, rel=1e-12, abs=0)
    assert solve(D, np.zeros(3))[2] == 2


@settings(deadline=None, max_examples=20)
@given(st.integers(0, 2**32 - 1))
@pytest.mark.parametrize("scale", [1e-6, 1e6])
@pytest.mark.parametrize("distance", [1e-3, 1e-6, 1e-8])
def test_nearly_dependent_rows_are_satisfied_whatever_their_scale(distance, scale, seed):
    random = np.random.default_rng(seed)
    D = scale * np.linalg.qr(random.standard_normal((12, 6)))[0].T
    D[1:4] = D[0] + distance * D[1:4]
    b = D @ random.standard_normal(D.shape[1])
    z, multiplier, rank = solve(D, b)
    assert rank == len(D)
    assert np.abs(D @ z - b).max() < 2e-14 * np.abs(D).max() * np.abs(z).max()
    assert np.abs(D.T @ multiplier - z).max() < 2e-14 * np.abs(D).max() * np.abs(multiplier).max()


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_more_rows_than_unknowns_leave_the_rank_of_their_width(scale):
    """What is left of a row is only rounding once the others span everything."""
    random = np.random.default_rng(1)
    D = scale * random.standard_normal((9, 4))
    x = random.standard_normal(4)
    z, _, rank = solve(D, D @ x)
    assert rank == 4
    assert independence(D) > RANK_TOLERANCE
    np.testing.assert_allclose(z, x, rtol=1e-13, atol=1e-13)


def test_what_is_left_of_a_row_after_many_small_losses_is_exact():
    """Each of the other rows takes 99.9 % of what the ones before have left."""
    d = math.sqrt(1e-3)
    row = d ** np.arange(6)
    D = np.vstack([np.eye(5, 6), row])
    assert independence(D) == pytest.approx(d**10 / np.sum(row**2), rel=1e-9, abs=0)


@settings(deadline=None, max_examples=20)
@given(st.integers(0, 2**32 - 1))
@pytest.mark.parametrize("distance", [1e-2, 1e-4, 1e-6, 1e-9, 0.0])
@pytest.mark.parametrize("rows", [3, 6])
def test_what_nearly_depends_is_left_where_a_least_independence_is_asked_for(rows, distance, seed):
    """So that a solution is no larger than a thousand times what it is to bring, each row measured by its length."""
    random = np.random.default_rng(seed)
    D = np.linalg.qr(random.standard_normal((12, rows)))[0].T
    D[-1] = D[0] + distance * D[-1]
    b = 1e-9 * random.standard_normal(rows)
    least = field_of(BLOCK, "least_independence")
    least[0] = 1e-6
    try:
        z, _, rank = solve(D, b)
    finally:
        least[0] = 0.0
    assert rank == (rows if distance > 1e-3 else rows - 1)
    assert np.abs(z).max() < 1e3 * np.abs(b).sum()
    np.testing.assert_allclose(D[1:-1] @ z, b[1:-1], rtol=0, atol=1e-21)

from typing import NamedTuple

import numpy as np
import pytest
from exact_pseudoinverse import exact_minimum_norm
from hypothesis import given, settings, strategies as st
from hypothesis.extra.numpy import arrays
from minimum_norm_solver import solve

from mechanism_fmu.engine.dynamics.minimum_norm import RANK_TOLERANCE

SMALL = st.integers(-4, 4).map(float)


class Problem(NamedTuple):
    D: np.ndarray
    b: np.ndarray
    consistent: bool


@st.composite
def problems(draw, largest_power):
    """Whole-number rows, some of which repeat, combine or miss the others; each times a power of two."""
    width = draw(st.integers(1, 12))
    D = draw(arrays(float, (draw(st.integers(1, 6)), width), elements=SMALL))
    kind = draw(st.sampled_from(["as drawn", "repeated", "combined", "with zeros"]))
    if kind == "repeated":
        D = np.vstack([D, D[draw(st.lists(st.integers(0, len(D) - 1), min_size=1, max_size=3))]])
    elif kind == "combined":
        D = np.vstack([D, draw(arrays(float, (draw(st.integers(1, 3)), len(D)), elements=SMALL)) @ D])
    elif kind == "with zeros":
        D = np.vstack([np.zeros((1, width)), D, np.zeros((1, width))])
    D = D * 2.0 ** draw(arrays(int, (len(D), 1), elements=st.integers(-largest_power, largest_power)))
    consistent = draw(st.booleans())
    b = D @ draw(arrays(float, width, elements=SMALL)) if consistent else draw(arrays(float, len(D), elements=SMALL))
    return Problem(D, b, consistent)


@settings(deadline=None, max_examples=150)
@given(problems(largest_power=0))
def test_agrees_with_numpys_pseudoinverse(problem):
    z, multiplier, rank = solve(problem.D, problem.b)
    inverse = np.linalg.pinv(problem.D)
    size, pull = np.linalg.norm(inverse), np.linalg.norm(problem.b)
    assert rank == np.linalg.matrix_rank(problem.D)
    assert largest(z - inverse @ problem.b) <= 1e-12 * size * pull
    assert largest(multiplier - inverse.T @ z) <= 1e-12 * size**2 * pull


@settings(deadline=None, max_examples=100)
@given(problems(largest_power=10))
def test_agrees_with_exact_arithmetic_for_rows_of_any_scale(problem):
    z, multiplier, rank = solve(problem.D, problem.b)
    exact = exact_minimum_norm(problem.D, problem.b)
    assert rank == exact.rank
    z_within = 1e-12 * largest(exact.z)
    if rank == len(problem.D):  # a row times its multiplier is what it does: to be right beside what the others do
        length = np.linalg.norm(problem.D, axis=1)
        assert largest(z - exact.z) <= z_within
        assert largest(length * (multiplier - exact.multiplier)) <= 1e-12 * largest(length * exact.multiplier)
        return
    condition, inverse = condition_and_inverse(problem.D, rank)
    # a least-squares problem: rounding of the rows moves its answer by so much
    multiplier_within = (1e-11 + np.finfo(float).eps * condition) * largest(exact.multiplier)
    if not problem.consistent:
        # rows that contradict each other make a weighted least-squares problem, as badly conditioned as D
        z_within += 1e-14 * condition * inverse * largest(problem.b)
        multiplier_within += 1e-14 * condition * inverse**2 * largest(problem.b)
    assert largest(z - exact.z) <= z_within
    assert largest(multiplier - exact.multiplier) <= multiplier_within


def largest(values):
    return np.abs(values).max()


def condition_and_inverse(D, rank):
    """Condition number of D and norm of its pseudoinverse."""
    singular = np.linalg.svd(D, compute_uv=False)
    return (singular[0] / singular[rank - 1], 1 / singular[rank - 1]) if rank else (1.0, 1.0)


@pytest.mark.parametrize(("share", "rank"), [(10 * RANK_TOLERANCE, 2), (0.1 * RANK_TOLERANCE, 1)])
@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_a_row_counts_when_enough_of_it_is_its_own(share, rank, scale):
    D = np.array([[1.0, 0.0, 1.0], [1.0, share, 1.0]]) * [[1.0], [scale]]
    assert solve(D, np.zeros(2))[2] == rank


def test_no_rows_and_empty_rows_have_no_solution_but_zero():
    for count in (0, 3):
        z, multiplier, rank = solve(np.zeros((count, 5)), np.ones(count))
        assert rank == 0
        assert not z.any()
        assert not multiplier.any()

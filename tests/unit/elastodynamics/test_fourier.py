import math

import numpy as np
import pytest
from hypothesis import given, strategies as st

from mechanism_fmu.elastodynamics.fourier import coefficients, differentiation, evaluate, even_angles, resampled


def polynomial(seed, harmonics):
    """A trigonometric polynomial of random coefficients, two columns, with its derivatives by hand."""
    rng = np.random.default_rng(seed)
    a, b = rng.normal(size=(2, harmonics + 1, 2))
    h = np.arange(harmonics + 1)[:, None]

    def value(x, derivative=0):
        phase = np.multiply.outer(x, np.arange(harmonics + 1)) + derivative * math.pi / 2
        return np.cos(phase) @ (a * h**derivative) + np.sin(phase) @ (b * h**derivative)

    return value


@given(st.integers(0, 10**6), st.integers(0, 12), st.integers(0, 5), st.sampled_from([0, 1, 2]))
def test_series_through_enough_samples_is_the_polynomial_itself(seed, harmonics, more, derivative):
    f, count = polynomial(seed, harmonics), 2 * harmonics + 1 + more
    x = np.linspace(-3.0, 9.0, 17)
    found = evaluate(coefficients(f(even_angles(count))), x, derivative)
    np.testing.assert_allclose(found, f(x, derivative), atol=1e-10 * (1 + harmonics**derivative))


@given(st.integers(0, 10**6), st.integers(0, 12))
def test_differentiation_is_exact_to_the_last_harmonic(seed, harmonics):
    f, x = polynomial(seed, harmonics), even_angles(2 * harmonics + 1)
    d = differentiation(len(x))
    np.testing.assert_allclose(d @ f(x), f(x, 1), atol=1e-10)
    np.testing.assert_allclose(d @ d @ f(x), f(x, 2), atol=1e-9)


@pytest.mark.parametrize("count", [7, 8, 9, 40])
def test_samples_stay_on_the_series(count):
    samples = np.random.default_rng(count).normal(size=(count, 3, 2))
    back = evaluate(coefficients(samples), even_angles(count))
    np.testing.assert_allclose(back, samples, atol=1e-13)
    np.testing.assert_allclose(resampled(samples, 3 * count)[::3], samples, atol=1e-13)


def test_even_points_have_no_derivative_of_their_highest_harmonic():
    with pytest.raises(ValueError, match="take an odd number"):
        differentiation(8)

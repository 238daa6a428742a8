import numpy as np
import pytest
from numpy.polynomial import legendre, polynomial

from mechanism_fmu.stress.modes import legendre_of_powers, powers_of_legendre

XI = np.linspace(0.0, 1.0, 11)


@pytest.mark.parametrize("degree", [0, 1, 5, 11])
def test_legendre_polynomials_in_powers(degree):
    for n, column in enumerate(powers_of_legendre(degree).T):
        np.testing.assert_allclose(
            polynomial.polyval(XI, column), legendre.legval(2 * XI - 1, np.eye(12)[n]), atol=1e-7
        )


@pytest.mark.parametrize("degree", [0, 1, 5, 11])
def test_powers_in_legendre_polynomials(degree):
    for i, column in enumerate(legendre_of_powers(degree).T):
        np.testing.assert_allclose(legendre.legval(2 * XI - 1, column), XI**i, atol=1e-14)


def test_one_is_the_inverse_of_the_other():
    np.testing.assert_allclose(powers_of_legendre(8) @ legendre_of_powers(8), np.eye(9), atol=1e-9)

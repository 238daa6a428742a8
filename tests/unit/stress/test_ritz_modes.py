import itertools

import numpy as np
import pytest
from scipy.integrate import quad

from mechanism_fmu.stress import STEEL, BeamMode, WedgeTooth, ritz_modes

TOOTH = WedgeTooth(length=0.05, apex_angle=0.5)


def twice_kinetic_energy(rate):
    """Integral of rho A rate(xi)^2 over the length, by a quadrature other than the module's."""

    def integrand(x):
        return STEEL.density * TOOTH.area(x) * rate(x / TOOTH.length) ** 2

    return quad(integrand, 0.0, TOOTH.length, epsabs=0.0, epsrel=1e-12)[0]


def twice_bending_energy(curvature):
    """Integral of E I_n (curvature(xi) / l^2)^2 over the length."""

    def integrand(x):
        return STEEL.youngs_modulus * TOOTH.second_moment(x) * (curvature(x / TOOTH.length) / TOOTH.length**2) ** 2

    return quad(integrand, 0.0, TOOTH.length, epsabs=0.0, epsrel=1e-12)[0]


def test_shape_and_its_derivatives_are_those_of_the_polynomial():
    mode = BeamMode(coefficients=(1.0, -2.0, 0.5), mass=1.0, stiffness=1.0)
    xi = np.linspace(0.0, 1.0, 7)
    np.testing.assert_allclose(mode.shape(xi), xi**2 - 2 * xi**3 + 0.5 * xi**4, atol=1e-15)
    np.testing.assert_allclose(mode.shape(xi, derivative=1), 2 * xi - 6 * xi**2 + 2 * xi**3, atol=1e-15)
    np.testing.assert_allclose(mode.shape(xi, derivative=2), 2 - 12 * xi + 6 * xi**2, atol=1e-15)


def test_every_mode_is_clamped_at_the_root_and_scaled_to_a1_equal_1():
    root = np.array([0.0])
    for mode in ritz_modes(TOOTH, STEEL):
        assert mode.shape(root) == 0.0
        assert mode.shape(root, derivative=1) == 0.0
        assert mode.coefficients[0] == 1.0


def test_modal_mass_and_stiffness_are_the_energies_of_equation_9():
    for mode in ritz_modes(TOOTH, STEEL):
        assert mode.mass == pytest.approx(twice_kinetic_energy(mode.shape), rel=1e-11)
        assert mode.stiffness == pytest.approx(
            twice_bending_energy(lambda xi, u=mode: u.shape(xi, derivative=2)), rel=1e-11
        )


def test_natural_frequency_is_that_of_the_equivalent_mass_and_spring():
    assert BeamMode(coefficients=(1.0,), mass=2.0, stiffness=18.0).natural_frequency == 3.0


@pytest.mark.parametrize("terms", [2, 4])
def test_modes_do_not_exchange_energy(terms):
    modes = ritz_modes(TOOTH, STEEL, terms=terms)
    assert len(modes) == terms
    for one, other in itertools.combinations(modes, 2):
        # Scaled to unit modal mass: two orthogonal modes together have mass 2 and the sum of both stiffnesses.
        a, b = one.mass**-0.5, other.mass**-0.5
        mass = twice_kinetic_energy(lambda xi, u=one, v=other, a=a, b=b: a * u.shape(xi) + b * v.shape(xi))
        stiffness = twice_bending_energy(lambda xi, u=one, v=other, a=a, b=b: a * u.shape(xi, 2) + b * v.shape(xi, 2))
        assert mass == pytest.approx(2.0, rel=1e-9)
        assert stiffness == pytest.approx(one.natural_frequency**2 + other.natural_frequency**2, rel=1e-9)


def test_one_term_is_the_rayleigh_quotient_of_a_parabola():
    # u = xi^2: m = rho b l^2 tan / 30, k = E b tan^3 / 12, so Lambda^2 = 30 / 12 E tan^2 / (rho l^2).
    (mode,) = ritz_modes(TOOTH, STEEL, terms=1)
    unit = (STEEL.youngs_modulus / STEEL.density) ** 0.5 * np.tan(TOOTH.apex_angle) / TOOTH.length
    assert mode.natural_frequency / unit == pytest.approx(2.5**0.5, rel=1e-13)


@pytest.mark.parametrize("terms", [0, -1, 11])
def test_number_of_terms_outside_its_limits_is_refused(terms):
    with pytest.raises(ValueError, match=rf"^number of Ritz terms = {terms}, but .* between 1 and 10: the paper has 2"):
        ritz_modes(TOOTH, STEEL, terms=terms)

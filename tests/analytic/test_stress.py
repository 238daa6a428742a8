"""Known answers of the stress recovery of Pennestrì, Valentini, Vita, section 5."""

import itertools
import math

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import iv, jv

from mechanism_fmu.stress import STEEL, WedgeTooth, maximum_stress, ritz_modes

TOOTH = WedgeTooth(length=0.033, apex_angle=0.61)

# Wheel speed just before and after the impact [rad/s] by slope angle beta_0 [deg]: two independent integrations of the
# paper's mechanism, with 9 redundant and with 3 minimal coordinates, which agree to 1e-14. It does not depend on the
# teeth. Before the impact the spring turns the wheel back a little.
WHEEL_SPEEDS = {
    85: (-0.000681458, 0.0228046146),
    90: (-0.000779456, 0.0227388573),
    95: (-0.000774514, 0.0227178290),
    100: (-0.000672731, 0.0227425265),
    105: (-0.000475511, 0.0228158202),
}
TOOTH_COUNTS = (10, 15, 20, 25)


def frequencies(terms=2):
    """Natural frequencies in units of sqrt(E tan^2 alpha / (rho l^2))."""
    unit = math.sqrt(STEEL.youngs_modulus / STEEL.density) * math.tan(TOOTH.apex_angle) / TOOTH.length
    return np.array([mode.natural_frequency for mode in ritz_modes(TOOTH, STEEL, terms=terms)]) / unit


def exact_frequencies(count):
    """Frequencies of the wedge in the same units.

    (s^3 w'')'' = p^2 s w, s = 1 - xi, p^2 = 12 Lambda^2, is solved by J1(z) / sqrt(s) and I1(z) / sqrt(s) with
    z = 2 sqrt(p s), bounded at the tip; clamping the root s = 1 asks for J1(z) I2(z) + I1(z) J2(z) = 0.
    """

    def clamped(z):
        return (jv(1, z) * iv(2, z) + iv(1, z) * jv(2, z)) / iv(1, z)

    grid = np.linspace(1.0, 20.0, 400)
    signs = np.sign([clamped(z) for z in grid])
    roots = [brentq(clamped, grid[i], grid[i + 1], xtol=1e-14) for i in np.flatnonzero(np.diff(signs))]
    return np.array(roots[:count]) ** 2 / (4 * math.sqrt(12))


def paper_tooth(tooth_count, slope_angle):
    """Beam of the paper's tooth with inner radius 0.1 m and slope 1.115 chords long; `slope_angle` in degrees."""
    pitch = 2 * math.pi / tooth_count
    chord = 2 * 0.1 * math.sin(pitch / 2)
    slope = 1.115 * chord
    between = math.radians(slope_angle) - math.pi / 2 + pitch / 2
    face = math.sqrt(chord**2 + slope**2 - 2 * chord * slope * math.cos(between))
    apex_angle = math.atan2(chord * math.sin(between), slope - chord * math.cos(between))
    length = face if apex_angle + between < math.pi / 2 else slope * math.cos(apex_angle)
    return WedgeTooth(length=length, apex_angle=apex_angle)


def paper_maximum(tooth_count, slope_angle):
    tooth = paper_tooth(tooth_count, slope_angle)
    before, after = WHEEL_SPEEDS[slope_angle]
    return maximum_stress(tooth, STEEL, (after - before) * tooth.length)


def test_two_term_frequencies_are_the_closed_forms():
    expected = np.sqrt((273 + np.array([-7.0, 7.0]) * math.sqrt(1041)) / 20)
    np.testing.assert_allclose(frequencies(), expected, rtol=1e-12)
    np.testing.assert_allclose(frequencies(), [1.5353872, 4.9942553], rtol=0, atol=5e-8)


def test_two_term_frequencies_are_those_printed_in_the_paper():
    np.testing.assert_allclose(frequencies(), [1.535, 4.994], rtol=0, atol=5e-4)


def test_two_term_mode_shapes():
    ratios = [mode.coefficients[1] / mode.coefficients[0] for mode in ritz_modes(TOOTH, STEEL)]
    np.testing.assert_allclose(ratios, [0.7754844, -1.3754844], rtol=0, atol=5e-8)


def test_ritz_frequencies_never_fall_below_the_exact_ones():
    assert exact_frequencies(1)[0] == pytest.approx(1.534337042, abs=5e-10)
    assert np.all(frequencies() > exact_frequencies(2))


def test_ritz_frequencies_fall_to_the_exact_ones_with_every_term():
    firsts = [frequencies(terms)[0] for terms in range(1, 6)]
    assert all(more < fewer for fewer, more in itertools.pairwise(firsts))
    np.testing.assert_allclose(frequencies(10)[:3], exact_frequencies(3), rtol=1e-9)
    np.testing.assert_allclose(exact_frequencies(3), [1.534337042, 4.389931256, 8.665972446], rtol=0, atol=5e-10)


def test_coefficient_of_the_largest_stress_and_its_place():
    found = maximum_stress(TOOTH, STEEL, 1.0)
    assert found.coefficient == pytest.approx(0.786452, abs=1e-6)
    assert found.position == pytest.approx(0.3956, abs=1e-4)


def test_coefficient_of_the_first_mode_alone():
    found = maximum_stress(TOOTH, STEEL, 1.0, modes=ritz_modes(TOOTH, STEEL)[:1])
    assert found.coefficient == pytest.approx(0.739447, abs=1e-6)
    assert found.position == pytest.approx(0.2851, abs=1e-4)


def test_first_mode_alone_in_closed_form():
    # sigma ~ (1 - xi)(1 + 3 a xi) exp(-zeta tau) sin(tau sqrt(1 - zeta^2)): place and time separate.
    zeta, a, frequency = STEEL.damping_ratio, 0.77548439, 1.53538723
    place = (3 * a - 1) / (6 * a)
    phase = math.acos(zeta)
    swing = math.exp(-zeta * phase / math.sqrt(1 - zeta**2))  # sin(phase) cancels sqrt(1 - zeta^2)
    found = maximum_stress(TOOTH, STEEL, 1.0, modes=ritz_modes(TOOTH, STEEL)[:1])
    assert found.position == pytest.approx(place, abs=1e-6)
    assert found.coefficient == pytest.approx((1 - place) * (1 + 3 * a * place) * swing / frequency, rel=1e-7)


@pytest.mark.parametrize(
    ("tooth_count", "slope_angle", "stress"),
    [(10, 90, 16080.32), (20, 95, 6552.67), (25, 85, 2270.30), (10, 105, 22966.82)],
)
def test_largest_stress_of_the_papers_cases(tooth_count, slope_angle, stress):
    # The reference values are cut off after 0.01 Pa, which is 4e-6 of the smallest and 4e-7 of the largest.
    assert 0.0 <= paper_maximum(tooth_count, slope_angle).stress - stress < 0.01


def test_largest_stress_lies_at_about_40_percent_of_the_length():
    for case in itertools.product(TOOTH_COUNTS, WHEEL_SPEEDS):
        assert paper_maximum(*case).position == pytest.approx(0.40, abs=0.01)


def test_largest_stress_falls_with_the_number_of_teeth_and_rises_with_the_slope_angle():
    table = np.array([[paper_maximum(n, beta).stress for beta in WHEEL_SPEEDS] for n in TOOTH_COUNTS])
    assert np.all(np.diff(table, axis=0) < 0)
    assert np.all(np.diff(table, axis=1) > 0)

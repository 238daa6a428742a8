"""Natural frequencies of beams in closed form, and the Rayleigh–Ritz modes against them."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from mechanism_fmu.stress import STEEL, End, RectangularTooth, WedgeTooth, exact_wedge_frequencies, natural_modes

WEDGE, UNIFORM = WedgeTooth(length=0.033, apex_angle=0.61), RectangularTooth(length=0.05, height=0.004)
WEDGE_UNIT = math.sqrt(STEEL.youngs_modulus / STEEL.density) * math.tan(0.61) / 0.033
#: sqrt(E I / (rho A)) / l^2 of the uniform beam: its frequencies are squares of dimensionless roots in this unit.
UNIFORM_UNIT = math.sqrt(STEEL.youngs_modulus / STEEL.density / 12) * 0.004 / 0.05**2

#: Frequency equations of the uniform beam in z = Lambda^(1/2), without what grows; first bracket in units of pi.
EQUATIONS = {
    (End.CLAMPED, End.FREE): (lambda z: math.cos(z) + 1 / math.cosh(z), 0),
    (End.CLAMPED, End.CLAMPED): (lambda z: math.cos(z) - 1 / math.cosh(z), 1),
    (End.FREE, End.FREE): (lambda z: math.cos(z) - 1 / math.cosh(z), 1),
    (End.CLAMPED, End.PINNED): (lambda z: math.tan(z) - math.tanh(z), 0.5),
    (End.PINNED, End.FREE): (lambda z: math.tan(z) - math.tanh(z), 0.5),
    (End.CLAMPED, End.GUIDED): (lambda z: math.tan(z) + math.tanh(z), 0.5),
    (End.GUIDED, End.FREE): (lambda z: math.tan(z) + math.tanh(z), 0.5),
    (End.PINNED, End.PINNED): (math.sin, 0.5),
    (End.GUIDED, End.GUIDED): (math.sin, 0.5),
    (End.PINNED, End.GUIDED): (math.cos, 0),
}


def bending_frequencies(beam, terms, **ends):
    return np.array([mode.natural_frequency for mode in natural_modes(beam, STEEL, terms, **ends)])


def roots(equation, first, count):
    """One root in each interval of length pi; that of a tangent stays clear of its poles."""
    margin = 1e-6
    return np.array(
        [
            brentq(equation, (first + k) * math.pi + margin, (first + k + 1) * math.pi - margin, xtol=1e-15, rtol=1e-15)
            for k in range(count)
        ]
    )


def test_exact_wedge_frequencies_are_the_known_ones():
    found = exact_wedge_frequencies(WEDGE, STEEL, 3) / WEDGE_UNIT
    np.testing.assert_allclose(found, [1.534337042, 4.389931256, 8.665972446], rtol=0, atol=5e-10)


def test_exact_wedge_frequencies_by_shooting():
    # ((1 - x)^3 u'')'' = 12 L^2 (1 - x) u from the tip: power series there, then an integration to the root, where the
    # determinant of deflections and slopes vanishes.
    def determinant(frequency):
        p2 = 12 * frequency**2

        # Solutions bounded at the tip: u = 1 + p2 s^2 / 12 ... and u = s + p2 s^3 / 72 ...; from moment = s^3 u''.
        s = 1e-3
        columns = []
        for a, b in ((1.0, 0.0), (0.0, 1.0)):
            moment = p2 * (a * s**3 / 6 + b * s**4 / 12)
            shear = p2 * (a * s**2 / 2 + b * s**3 / 3)
            u = a * (1 + p2 * s**2 / 12) + b * (s + p2 * s**3 / 72)
            slope = a * p2 * s / 6 + b * (1 + p2 * s**2 / 24)
            columns.append((u, slope, moment, shear))
        solution = [
            solve_ivp(
                lambda s, y: [y[1], y[2] / s**3, y[3], p2 * s * y[0]],
                (s, 1.0),
                column,
                method="DOP853",
                rtol=1e-11,
                atol=1e-14,
            ).y[:, -1]
            for column in columns
        ]
        return solution[0][0] * solution[1][1] - solution[0][1] * solution[1][0]

    for exact in exact_wedge_frequencies(WEDGE, STEEL, 2) / WEDGE_UNIT:
        found = brentq(determinant, 0.99 * exact, 1.01 * exact, xtol=1e-9)
        assert found == pytest.approx(exact, rel=1e-6)


def test_every_root_of_the_wedge_is_found_once():
    found = np.sqrt(exact_wedge_frequencies(WEDGE, STEEL, 1000) / WEDGE_UNIT * 4 * math.sqrt(12))
    # Asymptotically one each pi, at (k + 1/2) pi.
    np.testing.assert_allclose(found / math.pi, np.arange(1, 1001) + 0.5, rtol=0, atol=0.04)
    np.testing.assert_allclose(found[99:] / math.pi, np.arange(100, 1001) + 0.5, rtol=0, atol=1e-3)


@pytest.mark.parametrize("count", [0, 1001])
def test_number_of_wedge_frequencies_outside_its_limits_is_refused(count):
    with pytest.raises(ValueError, match=rf"^number of frequencies = {count:g}, but"):
        exact_wedge_frequencies(WEDGE, STEEL, count)


def test_ten_terms_reach_the_exact_wedge():
    np.testing.assert_allclose(bending_frequencies(WEDGE, 10)[:3], exact_wedge_frequencies(WEDGE, STEEL, 3), rtol=1e-10)


def test_sixty_terms_lose_nothing():
    np.testing.assert_allclose(
        bending_frequencies(WEDGE, 60)[:20], exact_wedge_frequencies(WEDGE, STEEL, 20), rtol=1e-11
    )


def test_first_five_frequencies_of_a_uniform_cantilever():
    exact = roots(*EQUATIONS[End.CLAMPED, End.FREE], 5) ** 2 * UNIFORM_UNIT
    np.testing.assert_allclose(bending_frequencies(UNIFORM, 16)[:5], exact, rtol=1e-9)
    np.testing.assert_allclose(exact[:2] / UNIFORM_UNIT, [3.516015, 22.03449], rtol=1e-6)


@pytest.mark.parametrize("ends", EQUATIONS, ids=lambda ends: f"{ends[0].name}-{ends[1].name}")
def test_uniform_beam_with_all_usual_ends(ends):
    exact = roots(*EQUATIONS[ends], 5) ** 2 * UNIFORM_UNIT
    found = bending_frequencies(UNIFORM, 20, root=ends[0], tip=ends[1])[:5]
    np.testing.assert_allclose(found, exact, rtol=1e-9)


def test_shape_of_a_pinned_beam_is_a_sine():
    xi = np.linspace(0.0, 1.0, 21)
    modes = natural_modes(UNIFORM, STEEL, 20, root=End.PINNED, tip=End.PINNED)
    for number, mode in enumerate(modes[:3], 1):
        np.testing.assert_allclose(mode.shape(xi), np.sin(number * math.pi * xi) / (number * math.pi), atol=1e-9)
        # Half the mass of the beam, for this scale.
        half = STEEL.density * 0.02 * 0.004 * 0.05 / 2
        assert mode.mass == pytest.approx(half / (number * math.pi) ** 2, rel=1e-9)

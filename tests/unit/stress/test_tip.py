import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.integrate import quad

from mechanism_fmu.stress import (
    STEEL,
    RectangularTooth,
    WedgeTooth,
    axial_stress,
    hertz_line_contact,
    peak_force,
    shortest_contact,
)

BRASS = replace(STEEL, youngs_modulus=1.0e11)
WEDGE = WedgeTooth(length=0.05, apex_angle=math.atan(0.4))


def test_wave_runs_there_and_back():
    assert shortest_contact(WEDGE, STEEL) == pytest.approx(0.1 / 5122.7, rel=1e-4)


def test_half_a_sine_has_the_impulse():
    force = peak_force(0.2, 3e-5)
    assert quad(lambda t: force * math.sin(math.pi * t / 3e-5), 0.0, 3e-5)[0] == pytest.approx(0.2)


def test_axial_stress_is_force_over_area():
    np.testing.assert_allclose(axial_stress(RectangularTooth(0.05, 0.01, 0.02), 100.0, [0.0, 0.05]), [5e5, 5e5])
    np.testing.assert_allclose(axial_stress(WEDGE, -100.0, [0.0, 0.025]), [-100 / (0.02 * 0.02), -100 / (0.02 * 0.01)])


def test_sharp_tip_has_no_axial_stress():
    with pytest.raises(ValueError, match=r"no cross section at x = 0\.05 m: ask for a place farther"):
        axial_stress(WEDGE, 1.0, [0.0, 0.05])


def test_line_contact_of_a_cylinder_on_a_plane_as_roark_prints_it():
    # Roark's Formulas for Stress and Strain, cylinder on a plane, equal E, nu = 0.3, diameter D, load p a unit length:
    # largest pressure 0.591 sqrt(p E / D), width 2.15 sqrt(p D / E).
    p, diameter = 2e4, 0.03
    contact = hertz_line_contact(p * 0.01, 0.01, diameter / 2, STEEL)
    assert contact.pressure == pytest.approx(0.591 * math.sqrt(p * STEEL.youngs_modulus / diameter), rel=1e-3)
    assert 2 * contact.half_width == pytest.approx(2.15 * math.sqrt(p * diameter / STEEL.youngs_modulus), rel=2e-3)


@given(force=st.floats(1e-3, 1e6), width=st.floats(1e-4, 1.0), radius=st.floats(1e-5, 10.0), nu=st.floats(0.0, 0.5))
def test_line_contact_carries_the_force_and_fits_the_curvature(force, width, radius, nu):
    contact = hertz_line_contact(force, width, radius, STEEL, BRASS, nu)
    # The pressure is half an ellipse over the width of the strip ...
    assert math.pi / 2 * contact.pressure * contact.half_width * width == pytest.approx(force)
    # ... and flattens the curvature 1 / R: p_0 = E* a / (2 R).
    effective = 1 / ((1 - nu**2) / STEEL.youngs_modulus + (1 - nu**2) / BRASS.youngs_modulus)
    assert contact.pressure == pytest.approx(effective * contact.half_width / (2 * radius))


def test_largest_shear_below_the_surface():
    # On the axis sigma_x = -p_0 ((1 + 2 s^2) / sqrt(1 + s^2) - 2 s) and sigma_z = -p_0 / sqrt(1 + s^2), s = z / a.
    depths = np.linspace(0.0, 3.0, 30001)
    root = np.sqrt(1 + depths**2)
    shear = np.abs((1 + 2 * depths**2) / root - 2 * depths - 1 / root) / 2
    contact = hertz_line_contact(100.0, 0.02, 0.001, STEEL)
    assert contact.shear / contact.pressure == pytest.approx(shear.max(), abs=5e-4)
    assert contact.shear_depth / contact.half_width == pytest.approx(depths[shear.argmax()], abs=5e-4)


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: peak_force(-1.0, 1e-3), r"^impulse = -1 N s.*without sign"),
        (lambda: peak_force(1.0, 0.0), r"^duration of the contact = 0 s.*shortest_contact"),
        (lambda: axial_stress(WEDGE, math.nan, 0.0), r"^force = nan N"),
        (lambda: axial_stress(WEDGE, 1.0, 0.06), r"^place = 0\.06 m"),
        (lambda: hertz_line_contact(0.0, 0.01, 0.01, STEEL), r"^force = 0 N"),
        (lambda: hertz_line_contact(1.0, 10000.0, 0.01, STEEL), r"^width of the contact = 10000 m"),
        (lambda: hertz_line_contact(1.0, 0.01, 0.0, STEEL), r"^radius of the contact = 0 m.*sharp edge"),
        (lambda: hertz_line_contact(1.0, 0.01, 0.01, STEEL, poisson_ratio=0.6), r"^Poisson's ratio = 0\.6, but"),
    ],
)
def test_impossible_blow_is_refused(make, said):
    with pytest.raises(ValueError, match=said):
        make()

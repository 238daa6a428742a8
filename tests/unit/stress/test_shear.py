import math

import numpy as np
import pytest

from mechanism_fmu.stress import (
    STEEL,
    RectangularTooth,
    SectionBeam,
    WedgeTooth,
    bending_moment,
    damped_response,
    natural_modes,
    ritz_modes,
    shear_force,
    shear_stress,
)

WEDGE, UNIFORM = WedgeTooth(length=0.05, apex_angle=0.5), RectangularTooth(length=0.05, height=0.01)
TIMES = np.linspace(0.0, 1e-4, 11)


@pytest.mark.parametrize("tooth", [WEDGE, UNIFORM], ids=["wedge", "rectangle"])
def test_shear_force_is_the_slope_of_the_bending_moment(tooth):
    modes = natural_modes(tooth, STEEL, 24)[:4]
    x, h = np.linspace(0.005, 0.045, 9), 1e-5
    moments = [bending_moment(tooth, STEEL, 2.0, x + k * h, TIMES, modes) for k in (-1, 1)]
    expected = (moments[1] - moments[0]) / (2 * h)
    force = shear_force(tooth, STEEL, 2.0, x, TIMES, modes)
    assert force.shape == (9, 11)
    np.testing.assert_allclose(force, expected, atol=1e-5 * np.abs(expected).max())


def test_force_at_the_root_stops_the_whole_tooth():
    # Of the parabola xi^2 on a uniform beam: rho b h l / 3 times its acceleration.
    (mode,) = ritz_modes(UNIFORM, STEEL, terms=1)
    eta = damped_response(np.array([mode.natural_frequency]), STEEL.damping_ratio, 2.0, TIMES)[0]
    expected = STEEL.density * 0.02 * 0.01 * 0.05 / 3 * mode.natural_frequency**2 * eta
    found = shear_force(UNIFORM, STEEL, 2.0, 0.0, TIMES, (mode,))[0]
    np.testing.assert_allclose(found, expected, rtol=1e-12)


def test_stress_is_half_more_than_the_mean_and_zero_at_the_tip():
    x = np.array([0.0, 0.02, 0.05])
    force, stress = shear_force(UNIFORM, STEEL, 2.0, x, TIMES), shear_stress(UNIFORM, STEEL, 2.0, x, TIMES)
    np.testing.assert_allclose(stress, 1.5 * force / (0.02 * 0.01), rtol=1e-14)
    near_tip = shear_stress(WEDGE, STEEL, 2.0, [0.04, 0.05 - 1e-6, 0.05], TIMES)
    assert np.all(near_tip[2] == 0.0)
    assert np.abs(near_tip[1]).max() < 1e-3 * np.abs(near_tip[0]).max()


def test_two_terms_come_closer_by_inertia_than_by_the_third_derivative():
    x = np.array([0.0])
    exact = shear_force(WEDGE, STEEL, 1.0, x, TIMES, natural_modes(WEDGE, STEEL, 20)[:1])
    mode = ritz_modes(WEDGE, STEEL)[:1]
    h = 1e-7
    moments = bending_moment(WEDGE, STEEL, 1.0, [0.0, h], TIMES, mode)
    derivative = (moments[1] - moments[0]) / h
    inertia = shear_force(WEDGE, STEEL, 1.0, x, TIMES, mode)[0]
    assert np.linalg.norm(inertia - exact) < 0.5 * np.linalg.norm(derivative - exact)


def test_step_in_the_cross_section_is_minded():
    def height(x):
        return np.where(x < 0.02, 0.012, 0.006)

    beam = SectionBeam(
        0.05, lambda x: 0.02 * height(x), lambda x: 0.02 * height(x) ** 3 / 12, lambda x: height(x) / 2, breaks=(0.02,)
    )
    (mode,) = natural_modes(beam, STEEL, 1)
    assert mode.shape(np.array([1.0]))[0] == pytest.approx(1.0)  # xi^2
    force = shear_force(beam, STEEL, 1.0, [0.01, 0.03], TIMES, (mode,))
    eta = damped_response(np.array([mode.natural_frequency]), STEEL.damping_ratio, 1.0, TIMES)[0]
    masses = [
        (0.012 * (0.02**3 - 0.01**3) + 0.006 * (0.05**3 - 0.02**3)) / 3 / 0.05**2,
        0.006 * (0.05**3 - 0.03**3) / 3 / 0.05**2,
    ]
    for row, mass in zip(force, masses, strict=True):
        np.testing.assert_allclose(row, STEEL.density * 0.02 * mass * mode.natural_frequency**2 * eta, rtol=1e-12)


def test_place_off_the_tooth_is_refused():
    with pytest.raises(ValueError, match=r"^place = 0\.06 m"):
        shear_stress(UNIFORM, STEEL, 1.0, 0.06, 0.0)
    with pytest.raises(ValueError, match=r"^impact velocity = nan"):
        shear_force(UNIFORM, STEEL, math.nan, 0.0, 0.0)

import math

import numpy as np
import pytest
from hypothesis import given, strategies as st

from mechanism_fmu.stress import (
    STEEL,
    WedgeTooth,
    bending_moment,
    bending_stress,
    damped_response,
    ritz_modes,
)

TOOTH = WedgeTooth(length=0.05, apex_angle=0.5)
TIMES = np.linspace(0.0, 1e-4, 41)


def deflection(x):
    """Equation (16) for an impact of 2 m/s, of shape (len(x), len(TIMES))."""
    modes = ritz_modes(TOOTH, STEEL)
    frequencies = np.array([mode.natural_frequency for mode in modes])
    shapes = np.stack([mode.shape(x / TOOTH.length) for mode in modes])
    return shapes.T @ damped_response(frequencies, STEEL.damping_ratio, 2.0, TIMES)


def test_moment_is_minus_stiffness_times_curvature_of_the_deflection():
    x, h = np.linspace(0.005, 0.045, 9), 1e-4
    curvature = (deflection(x - h) - 2 * deflection(x) + deflection(x + h)) / h**2  # exact for a cubic
    expected = -STEEL.youngs_modulus * TOOTH.second_moment(x)[:, None] * curvature
    moment = bending_moment(TOOTH, STEEL, 2.0, x, TIMES)
    assert moment.shape == (9, 41)
    np.testing.assert_allclose(moment, expected, atol=1e-8 * np.abs(expected).max())


def test_stress_is_moment_over_section_modulus():
    x = np.linspace(0.0, 0.0499, 9)
    stress = bending_stress(TOOTH, STEEL, 2.0, x, TIMES)
    assert stress.shape == (9, 41)
    np.testing.assert_allclose(
        stress * TOOTH.section_modulus(x)[:, None], bending_moment(TOOTH, STEEL, 2.0, x, TIMES), rtol=1e-11
    )


def test_stress_vanishes_at_the_tip_and_is_continuous_there():
    before_tip = TOOTH.length * (1 - np.array([1e-3, 1e-6, 1e-9, 0.0]))
    stress = np.abs(bending_stress(TOOTH, STEEL, 2.0, before_tip, TIMES)).max(axis=1)
    assert stress[-1] == 0.0
    np.testing.assert_allclose(stress[:-1] / stress[0], [1.0, 1e-3, 1e-6], rtol=1e-2)


def test_chosen_modes_add_up_to_the_whole():
    first, second = ritz_modes(TOOTH, STEEL)
    x = np.linspace(0.0, TOOTH.length, 9)
    parts = [bending_stress(TOOTH, STEEL, 2.0, x, TIMES, modes=(mode,)) for mode in (first, second)]
    whole = bending_stress(TOOTH, STEEL, 2.0, x, TIMES)
    np.testing.assert_allclose(parts[0] + parts[1], whole, atol=1e-12 * np.abs(whole).max())
    assert np.abs(parts[1]).max() > 0.01 * np.abs(whole).max()


def test_modes_of_different_length_can_be_mixed():
    (parabola,), (_, second) = ritz_modes(TOOTH, STEEL, terms=1), ritz_modes(TOOTH, STEEL)
    x = np.linspace(0.0, TOOTH.length, 9)
    parts = [bending_stress(TOOTH, STEEL, 2.0, x, TIMES, modes=(mode,)) for mode in (parabola, second)]
    mixed = bending_stress(TOOTH, STEEL, 2.0, x, TIMES, modes=(parabola, second))
    np.testing.assert_allclose(mixed, parts[0] + parts[1], atol=1e-12 * np.abs(mixed).max())


@given(velocity=st.floats(1e-9, 1e3), factor=st.floats(1e-3, 1e3))
def test_stress_is_proportional_to_the_velocity(velocity, factor):
    one = bending_stress(TOOTH, STEEL, velocity, [0.0, 0.02], TIMES)
    other = bending_stress(TOOTH, STEEL, factor * velocity, [0.0, 0.02], TIMES)
    np.testing.assert_allclose(other, factor * one, rtol=1e-12)


def test_no_velocity_makes_no_stress():
    assert not bending_stress(TOOTH, STEEL, 0.0, [0.0, 0.02], TIMES).any()


def test_single_numbers_count_as_one_place_and_one_time():
    assert bending_stress(TOOTH, STEEL, 1.0, 0.02, 1e-5).shape == (1, 1)


@pytest.mark.parametrize("recover", [bending_moment, bending_stress])
@pytest.mark.parametrize("velocity", [-0.1, math.nan, math.inf, -math.inf])
def test_impossible_velocity_is_refused(recover, velocity):
    with pytest.raises(ValueError, match=rf"^impact velocity = {velocity:g} m/s, but .*jump of the wheel's rate"):
        recover(TOOTH, STEEL, velocity, 0.0, 0.0)


@pytest.mark.parametrize("place", [-1e-3, 0.0501, math.nan])
def test_place_off_the_tooth_is_refused(place):
    with pytest.raises(ValueError, match=rf"^place = {place:g} m, but .* between 0 and 0\.05: x runs from the root"):
        bending_stress(TOOTH, STEEL, 1.0, [0.0, place, 0.02], 0.0)


@pytest.mark.parametrize("time", [-1e-9, math.nan, math.inf])
def test_time_that_is_not_after_the_impact_is_refused(time):
    with pytest.raises(ValueError, match=rf"^time = {time:g} s, but .*counts from the impact"):
        bending_stress(TOOTH, STEEL, 1.0, 0.0, [0.0, time])


def test_empty_choice_of_modes_is_refused():
    with pytest.raises(ValueError, match=r"no mode takes part.*give at least one"):
        bending_stress(TOOTH, STEEL, 1.0, 0.0, 0.0, modes=())

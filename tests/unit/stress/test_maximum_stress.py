import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from mechanism_fmu.stress import STEEL, Material, WedgeTooth, bending_stress, maximum_stress, ritz_modes

TOOTH = WedgeTooth(length=0.05, apex_angle=0.5)


def stress_at(material, x, t):
    return np.abs(bending_stress(TOOTH, material, 1.0, x, t))


def largest_on_a_grid(material, swings, places=401, times_per_swing=400):
    """Largest |sigma_b| over the tooth and `swings` periods of the first mode, by nothing but a fine grid."""
    period = 2 * math.pi / ritz_modes(TOOTH, material)[0].natural_frequency
    x = np.linspace(0.0, TOOTH.length, places)
    return stress_at(material, x, np.linspace(0.0, swings * period, swings * times_per_swing + 1)).max()


@settings(deadline=None)
@given(
    length=st.floats(1e-4, 10.0),
    apex_angle=st.floats(0.01, 1.5),
    thickness=st.floats(1e-4, 10.0),
    youngs_modulus=st.floats(1e6, 1e13),
    density=st.floats(10.0, 3e4),
    velocity=st.floats(1e-9, 1e3),
)
def test_coefficient_and_position_depend_on_neither_size_nor_constants(
    length, apex_angle, thickness, youngs_modulus, density, velocity
):
    tooth = WedgeTooth(length, apex_angle, thickness)
    material = Material(youngs_modulus, density, STEEL.damping_ratio)
    found, reference = maximum_stress(tooth, material, velocity), maximum_stress(TOOTH, STEEL, 1.0)
    assert found.coefficient == pytest.approx(reference.coefficient, rel=1e-10)
    assert found.position == pytest.approx(reference.position, abs=1e-5)
    assert found.stress == pytest.approx(found.coefficient * velocity * math.sqrt(density * youngs_modulus), rel=1e-12)


def test_maximum_is_the_stress_at_its_place_and_time():
    for velocity in (1e-4, 3.0):
        found = maximum_stress(TOOTH, STEEL, velocity)
        stress = bending_stress(TOOTH, STEEL, velocity, found.position * TOOTH.length, found.time)
        assert found.stress == pytest.approx(float(np.abs(stress[0, 0])), rel=1e-12)


def test_stress_is_stationary_at_the_maximum():
    found = maximum_stress(TOOTH, STEEL, 1.0)
    period = 2 * math.pi / ritz_modes(TOOTH, STEEL)[0].natural_frequency
    step = 1e-4
    x = TOOTH.length * (found.position + step * np.array([-1.0, 0.0, 1.0]))
    t = found.time + step * period * np.array([-1.0, 0.0, 1.0])
    around = stress_at(STEEL, x, t) / found.stress
    assert around.max() == around[1, 1]
    for before, at, after in (around[:, 1], around[1, :]):
        slope, curvature = (after - before) / (2 * step), (after - 2 * at + before) / step**2
        assert curvature < -1.0
        assert abs(slope / curvature) < 1e-6  # distance of the exact maximum, in lengths and in periods


@settings(deadline=None, max_examples=25)
@given(damping=st.floats(0.005, 0.9))
def test_nothing_on_a_fine_grid_exceeds_the_maximum(damping):
    material = replace(STEEL, damping_ratio=damping)
    found = maximum_stress(TOOTH, material, 1.0).stress
    grid = largest_on_a_grid(material, swings=3)
    assert grid <= found * (1 + 1e-12)
    assert grid == pytest.approx(found, rel=1e-4)


def test_maximum_agrees_to_1e_6_with_a_very_fine_grid():
    period = 2 * math.pi / ritz_modes(TOOTH, STEEL)[0].natural_frequency
    x = np.linspace(0.38 * TOOTH.length, 0.41 * TOOTH.length, 601)
    t = np.linspace(0.22 * period, 0.25 * period, 601)
    found = maximum_stress(TOOTH, STEEL, 1.0)
    assert largest_on_a_grid(STEEL, swings=20) <= found.stress  # so it lies within the window above
    assert stress_at(STEEL, x, t).max() == pytest.approx(found.stress, rel=1e-7)


@pytest.mark.parametrize("damping", [1e-3, 1e-4])
def test_with_little_damping_a_later_swing_at_the_root_wins(damping):
    material = replace(STEEL, damping_ratio=damping)
    found = maximum_stress(TOOTH, material, 1.0)
    assert found.time > 1.5 * 2 * math.pi / ritz_modes(TOOTH, material)[0].natural_frequency
    assert found.position == 0.0
    grid = largest_on_a_grid(material, swings=100, places=101)
    assert grid <= found.stress
    assert grid == pytest.approx(found.stress, rel=1e-4)


def test_nearly_equal_swings_are_told_apart():
    # Here the first swing, at 40 % of the length, exceeds a later one at the root by 4e-5 only.
    material = replace(STEEL, damping_ratio=0.00149)
    found = maximum_stress(TOOTH, material, 1.0)
    grid = largest_on_a_grid(material, swings=3, times_per_swing=4000)
    assert grid <= found.stress
    assert grid == pytest.approx(found.stress, rel=2e-6)
    assert found.position == pytest.approx(0.402, abs=1e-3)


def test_no_velocity_makes_no_stress_and_keeps_the_place():
    still, moving = maximum_stress(TOOTH, STEEL, 0.0), maximum_stress(TOOTH, STEEL, 1.0)
    assert still.stress == 0.0
    assert (still.position, still.time, still.coefficient) == (moving.position, moving.time, moving.coefficient)


@given(velocity=st.floats(1e-6, 1e3), factor=st.floats(1e-15, 1.0))
def test_stress_goes_to_zero_with_the_velocity(velocity, factor):
    whole, part = maximum_stress(TOOTH, STEEL, velocity), maximum_stress(TOOTH, STEEL, factor * velocity)
    assert part.stress == pytest.approx(factor * whole.stress, rel=1e-14)


def test_scale_of_the_modes_matters():
    # docs/decisions/003-mode-scaling.md: with unit deflection of the tip the largest stress moves to the root.
    modes = tuple(
        replace(mode, coefficients=tuple(a / sum(mode.coefficients) for a in mode.coefficients))
        for mode in ritz_modes(TOOTH, STEEL)
    )
    found = maximum_stress(TOOTH, STEEL, 1.0, modes=modes)
    assert found.position == 0.0
    assert found.coefficient == pytest.approx(0.8119, abs=1e-4)


@pytest.mark.parametrize("velocity", [-1e-3, math.nan, math.inf])
def test_impossible_velocity_is_refused(velocity):
    with pytest.raises(ValueError, match=rf"^impact velocity = {velocity:g} m/s".replace("+", r"\+")):
        maximum_stress(TOOTH, STEEL, velocity)


@pytest.mark.parametrize("damping", [0.0, 9e-5])
def test_too_little_damping_is_refused(damping):
    with pytest.raises(ValueError, match=rf"^damping ratio = {damping:g}, but .*0\.0001.*very many swings"):
        maximum_stress(TOOTH, replace(STEEL, damping_ratio=damping), 1.0)


@pytest.mark.parametrize(("length", "angle"), [(0.02, 0.3), (0.004, 1.2), (3.0, 1e-3)])
def test_one_wedge_tells_of_all(length: float, angle: float) -> None:
    """The search for this very wedge finds what follows by similarity."""
    tooth = WedgeTooth(length, angle)
    found = maximum_stress(tooth, STEEL, 2.0)
    searched = maximum_stress(tooth, STEEL, 2.0, ritz_modes(tooth, STEEL))
    assert found.stress == pytest.approx(searched.stress, rel=1e-9)
    assert found.coefficient == pytest.approx(searched.coefficient, rel=1e-9)
    assert found.position == pytest.approx(searched.position, abs=2e-5)
    assert found.time == pytest.approx(searched.time, rel=2e-5)

import math
import time
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from mechanism_fmu.stress import (
    STEEL,
    Material,
    ModeScaling,
    RectangularTooth,
    TrapezoidTooth,
    WedgeTooth,
    converged_modes,
    exact_wedge_frequencies,
    maximum_stress,
    natural_modes,
)

WEDGE = WedgeTooth(length=0.033, apex_angle=0.61)
TRAPEZOID = TrapezoidTooth(length=0.02, root_height=0.02, tip_height=0.004)
UNIFORM = RectangularTooth(length=0.02, height=0.02)


def modes_of(tooth, count):
    return natural_modes(tooth, STEEL, 2 * count, scaling=ModeScaling.PROJECTION)[:count]


def test_frequencies_of_a_wedge_are_the_exact_ones():
    found = [mode.natural_frequency for mode in converged_modes(WEDGE, STEEL)]
    np.testing.assert_allclose(found, exact_wedge_frequencies(WEDGE, STEEL, 20), rtol=1e-6)


@pytest.mark.parametrize("tooth", [WEDGE, TRAPEZOID, UNIFORM])
def test_they_carry_the_energy_of_the_rigid_rotation(tooth):
    x = np.linspace(0.0, tooth.length, 20001)
    whole = np.trapezoid(STEEL.density * tooth.area(x) * (x / tooth.length) ** 2, x)
    carried = sum(mode.mass for mode in converged_modes(tooth, STEEL))
    assert 0.995 * whole < carried < whole * (1 + 1e-8)


@pytest.mark.parametrize(
    ("tooth", "coefficient", "remainder"),
    [(WEDGE, 1.013135, 2e-5), (TRAPEZOID, 1.023241, 1e-6), (UNIFORM, 2.048747, 1e-6)],
)
def test_more_modes_stress_the_tooth_no_more(tooth, coefficient, remainder):
    found = maximum_stress(tooth, STEEL, 1.0, converged_modes(tooth, STEEL))
    assert found.coefficient == pytest.approx(coefficient, abs=1e-6)
    fewer = maximum_stress(tooth, STEEL, 1.0, modes_of(tooth, 15))
    assert fewer.coefficient == pytest.approx(found.coefficient, rel=remainder)
    more = maximum_stress(tooth, STEEL, 1.0, modes_of(tooth, 28))
    assert more.coefficient == pytest.approx(found.coefficient, rel=1e-6)
    assert more.position == pytest.approx(found.position, abs=1e-4)


def test_less_damping_leaves_more_to_the_fast_modes():
    material = replace(STEEL, damping_ratio=0.01)
    found = maximum_stress(WEDGE, material, 1.0, converged_modes(WEDGE, material))
    more = maximum_stress(WEDGE, material, 1.0, modes_of(WEDGE, 30))
    assert more.coefficient == pytest.approx(found.coefficient, rel=2e-4)


@settings(deadline=None, max_examples=20)
@given(
    length=st.floats(1e-3, 1.0),
    apex_angle=st.floats(0.05, 1.4),
    thickness=st.floats(1e-3, 1.0),
    modulus=st.floats(1e9, 1e12),
    density=st.floats(1e3, 2e4),
)
def test_modes_of_a_wedge_by_similarity_are_those_found_directly(length, apex_angle, thickness, modulus, density):
    tooth, material = WedgeTooth(length, apex_angle, thickness), Material(modulus, density, 0.03)
    found = converged_modes(tooth, material)
    direct = natural_modes(tooth, material, 40, scaling=ModeScaling.PROJECTION)[:20]
    for one, other in zip(found, direct, strict=True):
        assert one.mass == pytest.approx(other.mass, rel=1e-8)
        assert one.natural_frequency == pytest.approx(other.natural_frequency, rel=1e-8)
        np.testing.assert_allclose(one.series, other.series, atol=1e-9)
        assert one.name == other.name


def test_largest_stress_of_a_wedge_by_similarity_is_that_found_directly():
    tooth, material = WedgeTooth(0.004, 1.2, 0.01), Material(7e10, 2700.0, 0.03)
    found = maximum_stress(tooth, material, 2.0, converged_modes(tooth, material))
    direct = natural_modes(tooth, material, 40, scaling=ModeScaling.PROJECTION)[:20]
    searched = maximum_stress(tooth, material, 2.0, direct)
    assert found.stress == pytest.approx(searched.stress, rel=1e-9)
    assert found.coefficient == pytest.approx(searched.coefficient, rel=1e-9)
    assert found.position == pytest.approx(searched.position, abs=2e-5)
    assert found.time == pytest.approx(searched.time, rel=2e-5)


def test_another_wedge_costs_next_to_nothing():
    maximum_stress(WEDGE, STEEL, 1.0, converged_modes(WEDGE, STEEL))
    begin = time.perf_counter()
    for k in range(50):
        tooth = WedgeTooth(0.02 + 1e-5 * k, 0.5)
        maximum_stress(tooth, STEEL, 1.0, converged_modes(tooth, STEEL))
    assert (time.perf_counter() - begin) / 50 < 5e-3  # it takes 0.03 ms, a search 100


def test_a_beam_without_cross_section_is_refused():
    class Nothing(RectangularTooth):
        def area(self, x):
            return 0 * x

    with pytest.raises(ValueError, match=r"^the area of the beam is 0"):
        converged_modes(Nothing(0.02, 0.02), STEEL)


def test_twenty_modes_make_29_percent_more_than_the_paper_s_two():
    paper = maximum_stress(WEDGE, STEEL, 1.0)
    found = maximum_stress(WEDGE, STEEL, 1.0, converged_modes(WEDGE, STEEL))
    assert found.stress / paper.stress == pytest.approx(1.288, abs=1e-3)
    assert found.position == pytest.approx(0.714, abs=1e-3)
    assert math.isclose(paper.position, 0.3956, abs_tol=1e-4)

import math

import numpy as np
import pytest
from hypothesis import given, strategies as st

from mechanism_fmu.elastodynamics.elements import tapered_cantilever
from mechanism_fmu.stress import RectangularTooth, SectionBeam, TableBeam, TrapezoidTooth, WedgeTooth

E = 210e9
LENGTH, THICKNESS = 0.2, 0.02


def linear_taper(ratio, height=0.03):
    """A rectangle `height` high at x = 0, `ratio` times that at the end; formulas below hold for it."""

    def h(x):
        return height * (1 + (ratio - 1) * x / LENGTH)

    return SectionBeam(LENGTH, lambda x: THICKNESS * h(x), lambda x: THICKNESS * h(x) ** 3 / 12, lambda x: h(x) / 2)


@given(st.floats(0.15, 4.0).filter(lambda r: abs(r - 1) > 0.05))
def test_linear_taper_has_its_closed_forms(ratio):
    # With s = 1 + (r - 1) x / l, so dx = l ds / (r - 1) and l - x = l (r - s) / (r - 1); integrated by hand.
    q, area, second = ratio - 1, THICKNESS * 0.03, THICKNESS * 0.03**3 / 12
    f33 = LENGTH / (E * second) * (1 - ratio**-2) / (2 * q)
    f23 = LENGTH**2 / (E * second) / q**2 * (ratio * (1 - ratio**-2) / 2 - (1 - 1 / ratio))
    f22 = (
        LENGTH**3
        / (E * second)
        / q**3
        * (ratio**2 * (1 - ratio**-2) / 2 - 2 * ratio * (1 - 1 / ratio) + math.log(ratio))
    )
    f11 = LENGTH / (E * area) * math.log(ratio) / q
    beam = linear_taper(ratio)
    found = tapered_cantilever(beam, E)
    # The closed forms themselves lose digits by cancellation as the ratio nears 1.
    np.testing.assert_allclose(found, [[f11, 0, 0], [0, f22, f23], [0, f23, f33]], rtol=1e-9)


@given(st.floats(1e-3, 10.0), st.floats(1e-4, 1.0), st.floats(1e9, 1e12))
def test_constant_section_is_the_prismatic_beam(length, height, young):
    beam = RectangularTooth(length, height, THICKNESS)
    area, second = THICKNESS * height, THICKNESS * height**3 / 12
    axial, bend = length / (young * area), length / (young * second)
    expected = [[axial, 0, 0], [0, bend * length**2 / 3, bend * length / 2], [0, bend * length / 2, bend]]
    np.testing.assert_allclose(tapered_cantilever(beam, young), expected, rtol=1e-12)


def test_a_stepped_beam_is_two_prismatic_ones_in_a_row():
    a, b, step = RectangularTooth(0.08, 0.03), RectangularTooth(0.12, 0.01), 0.08

    def height(x):
        return np.where(x < step, 0.03, 0.01)

    beam = SectionBeam(
        0.2, lambda x: 0.02 * height(x), lambda x: 0.02 * height(x) ** 3 / 12, lambda x: height(x) / 2, breaks=(step,)
    )
    # Loads at the end act on the first part with their moment; its end carries the second part along.
    carry = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.12, 1.0]])
    expected = tapered_cantilever(b, E) + carry.T @ tapered_cantilever(a, E) @ carry
    np.testing.assert_allclose(tapered_cantilever(beam, E), expected, rtol=1e-12)


def test_a_beam_from_a_table_will_do():
    x = np.linspace(0.0, LENGTH, 60)
    smooth = TrapezoidTooth(LENGTH, 0.03, 0.015, THICKNESS)
    table = TableBeam(tuple(x), tuple(smooth.area(x)), tuple(smooth.second_moment(x)), tuple(smooth.outer_fibre(x)))
    np.testing.assert_allclose(tapered_cantilever(table, E), tapered_cantilever(smooth, E), rtol=1e-4)


def test_a_sharp_tip_gives_way_without_limit():
    with pytest.raises(ValueError, match="gives way without limit"):
        tapered_cantilever(WedgeTooth(0.05, 0.5), E)


def test_a_section_without_rhyme_or_reason_is_refused():
    beam = SectionBeam(0.2, lambda x: 1e-4 + 0 * x, lambda x: 1e-8 * (2 + np.sin(1e9 * x)), lambda x: 0.01 + 0 * x)
    with pytest.raises(ValueError, match="known to"):
        tapered_cantilever(beam, E)


def test_a_section_that_vanishes_inside_is_refused():
    beam = SectionBeam(0.2, lambda x: 1e-4 + 0 * x, lambda x: 1e-8 * (0.15 - x), lambda x: 0.01 + 0 * x)
    with pytest.raises(ValueError, match=r"I = -\S+ m4 at x = 0\.\d+ m"):
        tapered_cantilever(beam, E)


@pytest.mark.parametrize("young", [0.0, -1.0, math.inf, math.nan])
def test_a_modulus_that_cannot_be_is_refused(young):
    with pytest.raises(ValueError, match="the modulus is"):
        tapered_cantilever(linear_taper(2.0), young)

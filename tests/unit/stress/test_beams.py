"""Beams other than the paper's wedge, which has `test_wedge_tooth.py`."""

import math

import numpy as np
import pytest
from hypothesis import given, strategies as st

from mechanism_fmu.model.sawtooth import sawtooth
from mechanism_fmu.stress import (
    STEEL,
    RectangularTooth,
    SectionBeam,
    TableBeam,
    TrapezoidTooth,
    WedgeTooth,
    maximum_stress,
    natural_modes,
    wedge_of_sawtooth,
)

X = np.linspace(0.0, 0.05, 11)


def frequencies(beam, count=4):
    return [mode.natural_frequency for mode in natural_modes(beam, STEEL, 16)[:count]]


@pytest.mark.parametrize("tooth_count", [10, 15, 20, 25])
@pytest.mark.parametrize("slope_angle", [85, 90, 95, 100, 105])
def test_wedge_of_the_papers_teeth(tooth_count, slope_angle):
    # The model's own geometry, by vectors instead of the rule of Fig. 7.
    tooth = sawtooth(tooth_count, math.radians(slope_angle), 0.1, 1.115)
    wedge = wedge_of_sawtooth(tooth.chord, tooth.slope_length, tooth.chord_angle)
    assert wedge.length == pytest.approx(tooth.beam_length, rel=1e-13)
    assert wedge.apex_angle == pytest.approx(tooth.apex_angle, rel=1e-13)


def test_both_shapes_of_figure_7_by_pythagoras():
    # Sides 3, 4, 5: the right angle between chord and face makes both shapes one.
    both = wedge_of_sawtooth(chord=0.03, slope_length=0.05, chord_angle=math.acos(3 / 5))
    assert both.length == pytest.approx(0.04)
    assert math.tan(both.apex_angle) == pytest.approx(3 / 4)
    # Equilateral: the foot of the perpendicular lies in the middle of the face.
    right = wedge_of_sawtooth(chord=0.03, slope_length=0.03, chord_angle=math.pi / 3)
    assert right.length == pytest.approx(0.015)
    # Right angle at the root of the slope: alpha + alpha_2 > 90 deg.
    assert wedge_of_sawtooth(0.03, 0.04, math.pi / 2).length == pytest.approx(0.04 * 4 / 5)
    # Obtuse between chord and face: the beam ends where the face does.
    left = wedge_of_sawtooth(chord=0.01, slope_length=0.05, chord_angle=math.radians(30))
    assert left.length == pytest.approx(math.sqrt(0.01**2 + 0.05**2 - 2 * 0.01 * 0.05 * math.cos(math.radians(30))))


def test_slope_shorter_than_the_chord_allows_is_refused():
    with pytest.raises(ValueError, match=r"^tooth apex angle = .* below a right angle"):
        wedge_of_sawtooth(chord=0.05, slope_length=0.01, chord_angle=0.3)


def test_trapezoid_sections():
    tooth = TrapezoidTooth(length=0.05, root_height=0.03, tip_height=0.01, thickness=0.02)
    height = np.linspace(0.03, 0.01, 11)
    np.testing.assert_allclose(tooth.area(X), 0.02 * height, rtol=1e-14)
    np.testing.assert_allclose(tooth.second_moment(X), 0.02 * height**3 / 12, rtol=1e-14)
    np.testing.assert_allclose(tooth.section_modulus(X), 0.02 * height**2 / 6, rtol=1e-14)
    np.testing.assert_allclose(tooth.outer_fibre(X), height / 2, rtol=1e-14)


def test_sharp_trapezoid_is_the_wedge():
    wedge = WedgeTooth(0.05, 0.5)
    sharp = TrapezoidTooth(0.05, root_height=0.05 * math.tan(0.5), tip_height=0.0)
    np.testing.assert_allclose(frequencies(sharp), frequencies(wedge), rtol=1e-12)
    assert maximum_stress(sharp, STEEL, 1.0).coefficient == pytest.approx(0.786452, abs=1e-6)


def test_trapezoid_of_one_height_is_the_rectangle():
    rectangle, trapezoid = RectangularTooth(0.05, 0.01), TrapezoidTooth(0.05, 0.01, 0.01)
    np.testing.assert_allclose(rectangle.second_moment(X), trapezoid.second_moment(X), rtol=1e-14)
    np.testing.assert_allclose(frequencies(rectangle), frequencies(trapezoid), rtol=1e-12)


def test_functions_of_a_wedge_make_a_wedge():
    wedge = WedgeTooth(0.05, 0.5)
    same = SectionBeam(0.05, wedge.area, wedge.second_moment, wedge.outer_fibre)
    np.testing.assert_allclose(frequencies(same), frequencies(wedge), rtol=1e-13)
    assert maximum_stress(same, STEEL, 1.0).stress == pytest.approx(maximum_stress(wedge, STEEL, 1.0).stress)


def test_stepped_beam_needs_its_break():
    # Two lengths of different height; the same beam as a fine trapezoid on either side of the step is a table.
    def height(x):
        return np.where(x < 0.02, 0.012, 0.006)

    def beam(breaks):
        return SectionBeam(
            0.05,
            lambda x: 0.02 * height(x),
            lambda x: 0.02 / 12 * height(x) ** 3,
            lambda x: height(x) / 2,
            breaks=breaks,
        )

    # Exact integrals: the first polynomial xi^2 alone, Rayleigh's quotient piece by piece.
    (mode,) = natural_modes(beam((0.02,)), STEEL, 1)
    stiffness = STEEL.youngs_modulus * 0.02 / 12 * 4 / 0.05**4 * (0.012**3 * 0.02 + 0.006**3 * 0.03)
    mass = STEEL.density * 0.02 / 5 / 0.05**4 * (0.012 * 0.02**5 + 0.006 * (0.05**5 - 0.02**5))
    assert mode.natural_frequency == pytest.approx(math.sqrt(stiffness / mass), rel=1e-12)
    (rough,) = natural_modes(beam(()), STEEL, 1)
    assert rough.natural_frequency != pytest.approx(mode.natural_frequency, rel=1e-4)


def test_table_of_a_uniform_beam_is_exact_and_a_fine_table_of_a_wedge_close():
    uniform = TableBeam((0.0, 0.02, 0.05), (2e-4,) * 3, (1.6e-9,) * 3, (0.005,) * 3)
    same = RectangularTooth(0.05, math.sqrt(12 * 1.6e-9 / 2e-4), 0.02)
    ratio = 2e-4 / same.area(X[:1])[0] * same.second_moment(X[:1])[0] / 1.6e-9
    np.testing.assert_allclose(frequencies(uniform), np.array(frequencies(same)) / math.sqrt(ratio), rtol=1e-12)
    wedge = WedgeTooth(0.05, 0.5)
    errors = []
    for points in (11, 21, 41):
        x = np.linspace(0.0, 0.05, points)
        table = TableBeam(x, wedge.area(x), wedge.second_moment(x), wedge.outer_fibre(x))
        errors.append(abs(frequencies(table, 1)[0] / frequencies(wedge, 1)[0] - 1))
    assert errors[2] < errors[1] < errors[0] < 1e-3
    assert math.log2(errors[0] / errors[1]) > 2


@given(x=st.floats(0.0, 0.05))
def test_table_never_overshoots(x):
    table = TableBeam((0.0, 0.02, 0.021, 0.05), (3.0, 3.0, 1.0, 1.0), (3.0, 3.0, 1.0, 1.0), (3.0, 3.0, 1.0, 1.0))
    for of in (table.area, table.second_moment, table.outer_fibre):
        assert 1.0 - 1e-12 <= of(np.array(x)) <= 3.0 + 1e-12


#: Columns of a table with three places.
THREE = ((1.0,) * 3,) * 3


def table_with(column, *values):
    """A table one of whose columns has these values."""
    columns = list(THREE)
    columns[column] = values
    return TableBeam((0.0, 0.02, 0.05), *columns)


@pytest.mark.parametrize("column", range(3))
def test_at_one_end_of_a_table_zero_will_do(column):
    for values in ((0.0, 1.0, 1.0), (1.0, 1.0, 0.0)):
        table = table_with(column, *values)
        ends = [of(np.array([0.0, 0.05])) for of in (table.area, table.second_moment, table.outer_fibre)]
        np.testing.assert_allclose(ends[column], values[::2], atol=1e-15)
        assert table.breaks == (0.02,)


def test_breaks_between_root_and_tip_are_taken():
    beam = SectionBeam(0.05, np.ones_like, np.ones_like, np.ones_like, breaks=[0.02, 0.03])
    assert beam.breaks == (0.02, 0.03)


def test_a_break_may_be_anywhere_between_root_and_tip() -> None:
    for place in (1e-9, 1e-4, 0.05 - 1e-9):
        assert SectionBeam(0.05, np.ones_like, np.ones_like, np.ones_like, breaks=(place,)).breaks == (place,)
    for place in (0.0, -1e-9, 0.05):
        with pytest.raises(ValueError, match="must ascend and lie between root and tip"):
            SectionBeam(0.05, np.ones_like, np.ones_like, np.ones_like, breaks=(place,))


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: TrapezoidTooth(0.0, 0.01, 0.01), r"tooth length = 0 m.*in metres"),
        (lambda: TrapezoidTooth(0.05, -0.01, 0.01), r"tooth root height = -0\.01 m"),
        (lambda: TrapezoidTooth(0.05, 0.01, math.nan), r"tooth tip height = nan m"),
        (lambda: RectangularTooth(0.05, 0.01, math.inf), r"tooth thickness = inf m"),
        (lambda: SectionBeam(0.05, np.cos, np.cos, np.cos, breaks=(0.06,)), r"breaks \(0\.06,\) m must ascend"),
        (lambda: SectionBeam(0.05, np.cos, lambda x: -x, np.cos), r"second_moment of the beam gives .*positive"),
        (lambda: SectionBeam(0.05, lambda x: 1.0, np.cos, np.cos), r"area of the beam gives 1\.0 .*for each"),
        (lambda: SectionBeam(0.05, np.ones_like, np.ones_like, np.ones_like, breaks=(0.03, 0.02)), r"must ascend"),
        (lambda: SectionBeam(0.05, np.ones_like, np.ones_like, np.ones_like, breaks=(0.02, 0.02)), r"must ascend"),
        (lambda: SectionBeam(0.05, np.ones_like, np.ones_like, np.ones_like, breaks=(0.0,)), r"between root and tip"),
        (lambda: SectionBeam(0.05, np.ones_like, np.ones_like, np.ones_like, breaks=(0.05,)), r"between root and tip"),
        (lambda: SectionBeam(0.05, np.ones_like, np.ones_like, np.ones_like, 9e-7), r"tooth thickness = 9e-07 m"),
        (lambda: SectionBeam(0.05, np.ones_like, np.ones_like, np.ones_like, 1001.0), r"tooth thickness = 1001 m"),
        (lambda: SectionBeam(9e-7, np.ones_like, np.ones_like, np.ones_like), r"tooth length = 9e-07 m"),
        (lambda: SectionBeam(0.05, np.ones_like, np.ones_like, np.zeros_like), r"outer_fibre of the beam gives"),
        (
            lambda: SectionBeam(0.05, np.ones_like, np.ones_like, lambda x: np.full_like(x, math.inf)),
            r"outer_fibre of the beam gives .*inf",
        ),
        (lambda: TableBeam((0.0, 0.05, 0.02), *THREE), r"places \(0\.0, 0\.05, 0\.02\) m of the table must ascend"),
        (lambda: TableBeam((0.05, 0.02, 0.0), *THREE), r"must ascend from the root"),
        (lambda: TableBeam((-0.01, 0.02, 0.05), *THREE), r"must ascend from the root, 0"),
        (lambda: TableBeam((0.01, 0.02, 0.05), *THREE), r"must ascend from the root, 0"),
        (lambda: TableBeam((0.0, 5e-7, 9e-7), *THREE), r"tooth length = 9e-07 m"),
        (lambda: TableBeam((0.0, 0.02, 0.05), *THREE, thickness=9e-7), r"tooth thickness = 9e-07 m"),
        *(
            (lambda k=k, bad=bad: table_with(k, *bad), rf"{name} of the table.*positive; at one end zero will do")
            for k, name in enumerate(("areas", "second_moments", "outer_fibres"))
            for bad in ((1.0, 0.0, 1.0), (0.0, 1.0, 0.0), (-1.0, 1.0, 1.0), (1.0, 1.0, math.inf), (math.nan, 1.0, 1.0))
        ),
        (lambda: TableBeam((0.0,), (1.0,), (1.0,), (1.0,)), r"must ascend from the root"),
        (lambda: TableBeam((0.0, 1.0, 1.0), (1.0,) * 3, (1.0,) * 3, (1.0,) * 3), r"must ascend from the root"),
        (lambda: TableBeam((0.0, 1.0), (1.0,) * 2, (1.0,) * 3, (1.0,) * 2), r"2 places, but 3 second_moments"),
        (lambda: TableBeam((0.0, 1.0), (1.0, -1.0), (1.0,) * 2, (1.0,) * 2), r"areas of the table.*positive"),
        (lambda: TableBeam((0.0, 1.0), (1.0, 1.0), (0.0,) * 2, (1.0,) * 2), r"second_moments of the table.*positive"),
    ],
)
def test_impossible_beam_is_refused(make, said):
    with pytest.raises(ValueError, match=said):
        make()


def test_cross_section_that_is_negative_somewhere_is_refused_with_the_place():
    beam = SectionBeam(0.05, np.ones_like, lambda x: np.where(x > 0.04, -1.0, 1.0), np.ones_like)
    with pytest.raises(ValueError, match=r"the second moment of the beam is -1 at x = 0\.04"):
        natural_modes(beam, STEEL)

import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from mechanism_fmu.model.sawtooth import sawtooth, wheel_outline

RADIUS, RATIO = 0.1, 1.115  # Table 1 and c_prop of Pennestrì et al.
PAPER = [(teeth, angle) for teeth in (10, 15, 20, 25) for angle in (85, 90, 95, 100, 105)]


def paper_tooth(teeth, angle):
    return sawtooth(teeth, math.radians(angle), RADIUS, RATIO)


def teeth_of_any_shape():
    return st.tuples(st.integers(3, 200), st.floats(0.01, 1.5), st.floats(1e-3, 10.0), st.floats(1.001, 5.0)).map(
        lambda t: sawtooth(t[0], min(math.pi / 2 - math.pi / t[0] + t[1], 2.6), t[2], t[3])
    )


def polygon_area_and_inertia(points):
    """Area [m2] and polar second moment about the origin [m4] of a counter-clockwise polygon."""
    x, y = np.transpose(points)
    x1, y1 = np.roll(x, -1), np.roll(y, -1)
    cross = x * y1 - x1 * y
    moment = cross * (x * x + x * x1 + x1 * x1 + y * y + y * y1 + y1 * y1)
    return cross.sum() / 2, moment.sum() / 12


def test_steel_wheel_of_the_base_case_has_mass_and_inertia_of_table_2():
    bore, thickness, density = 6.50e-3, 0.02, 7850.0
    area, inertia = polygon_area_and_inertia(wheel_outline(paper_tooth(10, 90), 10, RADIUS)[::-1])
    assert density * thickness * (area - math.pi * bore**2) == pytest.approx(5.6264, abs=5e-5)
    assert density * thickness * (inertia - math.pi * bore**4 / 2) == pytest.approx(32.7948e-3, rel=1.5e-4)


@pytest.mark.parametrize(("teeth", "angle"), [case for case in PAPER if case != (10, 90)])
def test_no_other_case_of_the_paper_has_that_mass(teeth, angle):
    area, _ = polygon_area_and_inertia(wheel_outline(paper_tooth(teeth, angle), teeth, RADIUS)[::-1])
    assert abs(7850 * 0.02 * (area - math.pi * 6.5e-3**2) - 5.6264) > 5e-3


def test_known_numbers_of_the_base_case():
    tooth = paper_tooth(10, 90)
    assert tooth.pitch == pytest.approx(math.radians(36))
    assert tooth.chord == pytest.approx(0.2 * math.sin(math.radians(18)))
    assert tooth.chord_angle == pytest.approx(math.radians(18))
    assert tooth.slope_length == pytest.approx(RATIO * tooth.chord)
    # with beta_0 = 90 deg the slope is a tangent, and the face runs from (r, -L) to the next root
    np.testing.assert_allclose(tooth.apex, (RADIUS, -tooth.slope_length), atol=1e-16)
    next_root = RADIUS * math.cos(tooth.pitch), -RADIUS * math.sin(tooth.pitch)
    assert tooth.face_length == pytest.approx(math.dist(tooth.apex, next_root))
    np.testing.assert_allclose(tooth.slope_normal, (1, 0), atol=1e-15)


@pytest.mark.parametrize(("teeth", "angle"), PAPER)
def test_formulas_of_the_paper(teeth, angle):
    tooth, beta = paper_tooth(teeth, angle), math.radians(angle)
    h, L, a2, F = tooth.chord, tooth.slope_length, tooth.chord_angle, tooth.face_length
    assert pytest.approx(math.sqrt(h * h + L * L - 2 * h * L * math.cos(a2)), rel=1e-13) == F
    assert math.cos(tooth.apex_angle) == pytest.approx((L * L + F * F - h * h) / (2 * L * F), rel=1e-12)
    # the three corners in axes tangential (clockwise) and radial at the root
    assert -tooth.apex[1] == pytest.approx(L * math.sin(beta))
    assert tooth.apex[0] == pytest.approx(RADIUS - L * math.cos(beta))
    lean = math.pi - beta - tooth.apex_angle - tooth.pitch
    np.testing.assert_allclose(tooth.face_direction, (math.cos(lean), -math.sin(lean)), atol=1e-13)
    np.testing.assert_allclose(tooth.face_normal, (-math.sin(lean), -math.cos(lean)), atol=1e-13)


@pytest.mark.parametrize(("teeth", "angle"), PAPER)
def test_beam_is_the_face_unless_alpha_and_alpha_2_exceed_a_right_angle(teeth, angle):
    tooth = paper_tooth(teeth, angle)
    blunt = tooth.apex_angle + tooth.chord_angle >= math.pi / 2
    assert blunt == ((teeth, angle) in {(10, 100), (10, 105), (15, 105)})
    expected = tooth.slope_length * math.cos(tooth.apex_angle) if blunt else tooth.face_length
    assert tooth.beam_length == pytest.approx(expected, rel=1e-13)


@settings(deadline=None)
@given(teeth_of_any_shape())
def test_normals_are_unit_vectors_that_point_into_the_open_notch(tooth):
    for direction, normal in (
        (tooth.slope_direction, tooth.slope_normal),
        (tooth.face_direction, tooth.face_normal),
    ):
        assert math.hypot(*normal) == pytest.approx(1)
        assert np.dot(direction, normal) == pytest.approx(0, abs=1e-12)
    # the notch opens by pitch + apex angle: the slope lies before the face, the face lies before the slope
    opening = math.sin(tooth.pitch + tooth.apex_angle)
    assert np.dot(tooth.slope_direction, tooth.face_normal) == pytest.approx(opening, abs=1e-9)
    assert np.dot(tooth.face_direction, tooth.slope_normal) == pytest.approx(opening, abs=1e-9)


@settings(deadline=None)
@given(teeth_of_any_shape())
def test_beam_is_the_shorter_of_face_and_projected_slope(tooth):
    projected = tooth.slope_length * math.cos(tooth.apex_angle)
    assert tooth.beam_length == pytest.approx(min(tooth.face_length, projected), rel=1e-9)


def test_outline_has_a_root_and_an_apex_for_each_tooth():
    tooth = paper_tooth(15, 95)
    points = wheel_outline(tooth, 15, RADIUS)
    assert len(points) == 30
    np.testing.assert_allclose([math.hypot(*p) for p in points[::2]], RADIUS)
    sides = [math.dist(p, q) for p, q in zip(points, points[1:] + points[:1], strict=True)]
    np.testing.assert_allclose(sides[::2], tooth.slope_length)
    np.testing.assert_allclose(sides[1::2], tooth.face_length)

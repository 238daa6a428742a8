"""The example of the ME451 slides on cams: the tangents g_1 of its cam and g_2 of its roller, by hand and as rows.

With e = (cos a, sin a) a profile has the points rho e and the tangent g = rho' e + rho R e. The slides ask for both:

    rho_1 = 5/4 - 1/4 cos 3a     g_1 = (1/2 sin 4a + 1/4 sin 2a - 5/4 sin a, 5/4 cos a + 1/4 cos 2a - 1/2 cos 4a)
    rho_1 = 1                    g_1 = (-sin a, cos a)              from 2 pi/3 on
    rho_2 = 1/4                  g_2 = (-sin a, cos a)/4

In the rows they are the columns of the contact coordinates: [A_1 g_1, -A_2 g_2] of r_1^C - r_2^C.
"""

import cmath
import math
from functools import cache

import numpy as np
import pytest
from hypothesis import given, strategies as st

from mechanism_fmu.kinematics.equations import Equations
from tests.slide_cam import cam_mechanism

THIRD = 2 * math.pi / 3
W2, W3 = math.sqrt(2), math.sqrt(3)
#: Where these stand among coordinates and rows.
(PHI_1, PHI_2), (ALPHA_1, ALPHA_2) = (2, 5), (6, 7)
POINT, TANGENCY = [-3, -2], -1

#: By hand, at angles on every piece of the cam and at its joins: g_1.
CAM = [
    (0.0, (0.0, 1.0)),
    (math.pi / 6, ((3 * W3 - 5) / 8, (3 + 5 * W3) / 8)),
    (math.pi / 4, ((2 - 5 * W2) / 8, (4 + 5 * W2) / 8)),
    (math.pi / 3, (-3 * W3 / 4, 3 / 4)),
    (math.pi / 2, (-5 / 4, -3 / 4)),
    (THIRD, (-W3 / 2, -1 / 2)),
    (math.pi, (0.0, -1.0)),
    (3 * math.pi / 2, (1.0, 0.0)),
    (2 * math.pi, (0.0, 1.0)),
]
#: The same of the roller: g_2.
ROLLER = [
    (0.0, (0.0, 1 / 4)),
    (math.pi / 3, (-W3 / 8, 1 / 8)),
    (math.pi, (0.0, -1 / 4)),
    (-math.pi / 4, (W2 / 8, W2 / 8)),
]


@cache
def equations():
    """Of cam and roller; the first in a process compiles the engine's rows."""
    return Equations(cam_mechanism("roller"), 0.0)


def test_coordinates_and_rows_stand_where_they_are_looked_for():
    coordinates, rows = equations().coordinates, equations().rows
    assert [coordinates[k] for k in (PHI_1, PHI_2)] == ["cam.angle", "follower.angle"]
    assert [coordinates[k] for k in (ALPHA_1, ALPHA_2)] == ["pair.alpha_i", "pair.alpha_j"]
    assert [rows[k] for k in (*POINT, TANGENCY)] == ["pair[1]", "pair[2]", "pair[3]"]


def rows_at(alpha_1, alpha_2, phi_1=0.0, phi_2=0.0):
    """Rows of the mechanism with the cam and the roller turned anywhere; they need not touch for it."""
    q = equations().start.copy()
    q[[ALPHA_1, ALPHA_2, PHI_1, PHI_2]] = alpha_1, alpha_2, phi_1, phi_2
    return equations().at(q, 0.0)


def tangents(alpha_1, alpha_2, phi_1=0.0, phi_2=0.0):
    """A_1 g_1 and A_2 g_2 as the rows have them."""
    columns = rows_at(alpha_1, alpha_2, phi_1, phi_2).jacobian[POINT]
    return columns[:, ALPHA_1], -columns[:, ALPHA_2]


def g_1(a):
    """The cam's tangent, worked out into single waves."""
    if a % (2 * math.pi) >= THIRD:
        return np.array([-math.sin(a), math.cos(a)])
    x = math.sin(4 * a) / 2 + math.sin(2 * a) / 4 - 5 / 4 * math.sin(a)
    return np.array([x, 5 / 4 * math.cos(a) + math.cos(2 * a) / 4 - math.cos(4 * a) / 2])


def g_2(a):
    return np.array([-math.sin(a), math.cos(a)]) / 4


def turned(vector, angle):
    c, s = math.cos(angle), math.sin(angle)
    return np.array([c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]])


@pytest.mark.parametrize(("alpha", "expected"), CAM)
def test_the_cams_tangent_by_hand(alpha, expected):
    assert tangents(alpha, 0.0)[0] == pytest.approx(expected, abs=1e-15)


@pytest.mark.parametrize(("alpha", "expected"), ROLLER)
def test_the_rollers_tangent_by_hand(alpha, expected):
    assert tangents(0.0, alpha)[1] == pytest.approx(expected, abs=1e-16)


@given(st.floats(-10.0, 10.0), st.floats(-10.0, 10.0), st.floats(-10.0, 10.0), st.floats(-10.0, 10.0))
def test_the_tangents_turn_with_the_bodies(alpha_1, alpha_2, phi_1, phi_2):
    first, second = tangents(alpha_1, alpha_2, phi_1, phi_2)
    np.testing.assert_allclose(first, turned(g_1(alpha_1), phi_1), rtol=0, atol=2e-14)
    np.testing.assert_allclose(second, turned(g_2(alpha_2), phi_2), rtol=0, atol=1e-14)


@pytest.mark.parametrize("alpha", [0.3, 1.0, 1.7, 2.0, 3.0, 5.5])
def test_the_tangents_are_the_derivatives_of_the_points(alpha):
    """By a complex step through the slides' formulas: exact to rounding."""
    a = alpha + 1e-30j
    rho = 5 / 4 - cmath.cos(3 * a) / 4 if alpha < THIRD else 1.0
    for factor, tangent in zip((rho, 0.25), tangents(alpha, alpha), strict=True):
        point = factor * cmath.cos(a), factor * cmath.sin(a)
        np.testing.assert_allclose(tangent, [x.imag / 1e-30 for x in point], rtol=0, atol=4e-15)


@pytest.mark.parametrize("alpha", [0.3, 1.7, 3.0])
def test_the_tangents_are_the_slopes_of_the_rows(alpha):
    """By central differences of the engine's own residual."""
    step = 1e-5
    ahead, behind = (rows_at(alpha + d, alpha, 0.4, 0.7).residual[POINT] for d in (step, -step))
    np.testing.assert_allclose((ahead - behind) / (2 * step), tangents(alpha, alpha, 0.4, 0.7)[0], rtol=0, atol=2e-9)
    ahead, behind = (rows_at(alpha, alpha + d, 0.4, 0.7).residual[POINT] for d in (step, -step))
    np.testing.assert_allclose((ahead - behind) / (2 * step), -tangents(alpha, alpha, 0.4, 0.7)[1], rtol=0, atol=2e-9)


@given(st.floats(-10.0, 10.0), st.floats(-10.0, 10.0), st.floats(-10.0, 10.0), st.floats(-10.0, 10.0))
def test_they_are_parallel_where_the_third_row_says_so(alpha_1, alpha_2, phi_1, phi_2):
    """(R A_1 g_1).A_2 g_2: the cross product of both."""
    first, second = turned(g_1(alpha_1), phi_1), turned(g_2(alpha_2), phi_2)
    expected = first[0] * second[1] - first[1] * second[0]
    assert rows_at(alpha_1, alpha_2, phi_1, phi_2).residual[TANGENCY] == pytest.approx(expected, abs=1e-14)


@pytest.mark.parametrize(("join", "jump"), [(0.0, 9 / 4), (THIRD, -9 / 4), (2 * math.pi, 9 / 4)])
def test_the_cam_is_c1_and_not_c2(join, jump):
    """Its point and its tangent go on over the joins; rho'' jumps between 0 and 9/4.

    So does h = dg/dalpha, by the jump of rho'' times e. In the tangency row the column of alpha_1 is (R h_1).g_2, and
    (R e).g_2 = 1/4 for a roller that is touched at the angle of the join.
    """
    beside = 1e-13
    before, after = (rows_at(join + d, join) for d in (-beside, beside))
    np.testing.assert_allclose(before.residual[POINT], after.residual[POINT], rtol=0, atol=1e-12)
    np.testing.assert_allclose(before.jacobian[POINT, ALPHA_1], after.jacobian[POINT, ALPHA_1], rtol=0, atol=1e-12)
    bend_before, bend_after = (4 * rows.jacobian[TANGENCY, ALPHA_1] for rows in (before, after))
    assert bend_after - bend_before == pytest.approx(jump, abs=1e-11)
    assert (bend_before, bend_after) == pytest.approx((-1.0, 5 / 4) if jump > 0 else (5 / 4, -1.0), abs=1e-11)

import math

import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.spatial.transform import Rotation

from mechanism_fmu.elastodynamics.stretch_rotation import (
    deformed_links,
    planar_deformation,
    planar_operator,
    spatial_deformation,
    spatial_operator,
)
from tests import bending_four_bar as four_bar

SEEDS = st.integers(0, 10**6)


@given(SEEDS, st.floats(-0.5, 0.5), st.floats(0.0, 7.0))
def test_spatial_operator_is_a_rotation_times_a_stretch(seed, stretch, angle):
    axis = np.random.default_rng(seed).normal(size=3)
    vector = angle * axis / np.linalg.norm(axis)
    expected = (1 + stretch) * Rotation.from_rotvec(vector).as_matrix()
    np.testing.assert_allclose(spatial_operator(stretch, vector), expected, atol=1e-14)


@given(st.floats(-0.5, 0.5), st.floats(-7.0, 7.0), st.floats(-0.5, 0.5), st.floats(-7.0, 7.0))
def test_planar_operators_multiply_as_complex_numbers_do(e1, t1, e2, t2):
    z = (1 + e1) * (1 + e2) * np.exp(1j * (t1 + t2))
    found = planar_operator(e1, t1) @ planar_operator(e2, t2)
    np.testing.assert_allclose(found, [[z.real, -z.imag], [z.imag, z.real]], atol=1e-13)


@given(st.floats(-0.5, 0.5), st.floats(-7.0, 7.0))
def test_spatial_operator_about_the_normal_is_the_planar_one(stretch, angle):
    spatial = spatial_operator(stretch, [0.0, 0.0, angle])
    np.testing.assert_allclose(spatial[:2, :2], planar_operator(stretch, angle), atol=1e-14)
    np.testing.assert_allclose(spatial[2], [0.0, 0.0, 1 + stretch], atol=1e-14)


@pytest.mark.parametrize("dimension", [2, 3])
@given(seed=SEEDS)
def test_it_agrees_with_the_linear_theory_to_second_order(dimension, seed):
    rng = np.random.default_rng(seed)
    r, u = rng.normal(size=(2, 5, dimension))
    errors = [np.linalg.norm(deformed_links(r, h * u) - (r + h * u), axis=-1) for h in (1e-3, 5e-4)]
    # A stretch alone is exact; it must not decide what rounding says.
    seen = errors[0] > 1e-9
    np.testing.assert_allclose(np.log2(errors[0] / errors[1])[seen], 2.0, atol=0.1)
    assert np.all(errors[0] <= (1e-3 * np.linalg.norm(u, axis=-1)) ** 2 / np.linalg.norm(r, axis=-1) * 1.1)


def test_a_stretch_along_the_link_is_exact_and_a_turn_keeps_the_length():
    r = np.array([3.0, 4.0])
    np.testing.assert_allclose(deformed_links(r, 0.1 * r), 1.1 * r, rtol=1e-15)
    across = deformed_links(r, [-0.4, 0.3])
    assert np.linalg.norm(across) == pytest.approx(5.0, rel=1e-15)
    assert math.atan2(across[1], across[0]) - math.atan2(4.0, 3.0) == pytest.approx(0.1, rel=1e-13)


@given(SEEDS)
def test_three_dimensions_agree_with_two_in_the_plane(seed):
    r, u = np.random.default_rng(seed).normal(size=(2, 4, 2))
    flat = [np.concatenate([x, np.zeros((4, 1))], axis=1) for x in (r, u)]
    (e2, t2), (e3, t3) = planar_deformation(r, u), spatial_deformation(*flat)
    np.testing.assert_allclose(e3, e2, rtol=1e-12)
    np.testing.assert_allclose(t3, np.stack([0 * t2, 0 * t2, t2], axis=1), rtol=1e-12)
    np.testing.assert_allclose(deformed_links(*flat)[:, :2], deformed_links(r, u), atol=1e-13)


def test_a_chain_of_operators_follows_the_deflection_of_the_path_point_to_second_order():
    phi = math.radians(60)
    px, py, _, ax, ay, _, bx, by = four_bar.points(phi)
    B, load = four_bar.transfer(phi), np.array([10.0, -5.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    delta = B.T @ four_bar.flexibility() @ B @ load
    a, p, b = np.array([ax, ay]), np.array([px, py]), np.array([bx, by])
    ground = np.array([four_bar.GROUND, 0.0])
    path, loop = [], []
    for scale in (1.0, 0.5, 0.25):
        u_p, u_a, u_b = (scale * delta[k : k + 2] for k in (0, 3, 6))
        crank, arm = deformed_links(a, u_a), deformed_links(p - a, u_p - u_a)
        path.append(np.linalg.norm(crank + arm - (p + u_p)))
        coupler, follower = deformed_links(b - a, u_b - u_a), deformed_links(b - ground, u_b)
        loop.append(np.linalg.norm(crank + coupler - follower - ground))
    # delta is 0.027 in: the difference is some of its square by the length of a link.
    assert 1e-6 < path[0] < 3e-4
    for errors in (path, loop):
        np.testing.assert_allclose(np.log2(np.divide(errors[:-1], errors[1:])), 2.0, atol=0.02)


def test_a_link_without_length_is_refused():
    with pytest.raises(ValueError, match="its two ends must differ"):
        planar_deformation([0.0, 0.0], [1.0, 0.0])

"""Which resting contacts push: blocks on supports by statics, random heaps by enumeration of all combinations."""

import itertools

import numpy as np
import pytest
from hypothesis import assume, given, settings, strategies as st
from touching import touching

from mechanism_fmu.engine.contacts.complementarity import MOST_COMBINED
from mechanism_fmu.model import GROUND, Body, Force, Mechanism, Output, PointLineContact
from mechanism_fmu.simulation import Simulation

MASS, INERTIA, GRAVITY = 2.0, 0.3, 9.81
WEIGHT = MASS * GRAVITY


def block_on(supports, push=0.0):
    """A block with feet at these places [m], counted from its centre of mass, at rest on the ground."""
    return Mechanism(
        bodies=(Body("block", MASS, INERTIA, (0.0, 0.5, 0.0)),),
        forces=(Force("weight", "block", (push, -WEIGHT)),),
        contacts=tuple(
            PointLineContact(f"foot{k}", "block", (x, -0.5), GROUND, (0.0, 0.0), (0.0, 1.0))
            for k, x in enumerate(supports)
        ),
        outputs=tuple(Output(f"foot{k}", f"foot{k}.force", "") for k in range(len(supports))),
    )


def forces_and_acceleration(supports):
    simulation = Simulation(block_on(supports))
    return np.array(list(simulation.read().values())), simulation.field("dy_end")[3:6]


@pytest.mark.parametrize(("left", "right"), [(0.4, 0.4), (0.1, 0.7), (0.9, 0.0)])
def test_two_supports_share_the_weight_by_the_lever(left, right):
    forces, acceleration = forces_and_acceleration([-left, right])
    np.testing.assert_allclose(forces, WEIGHT * np.array([right, left]) / (left + right), rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(acceleration, 0.0, atol=1e-12)


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize(("near", "far"), [(0.2, 0.5), (0.01, 0.02), (0.3, 1.3)])
def test_a_weight_outside_the_base_lifts_the_far_support(near, far, side):
    """The block tips about the near foot: f (1 / m + x^2 / J) = g."""
    simulation = Simulation(block_on([side * far, side * near]))
    found = simulation.read()
    force = GRAVITY / (1 / MASS + near**2 / INERTIA)
    assert found == pytest.approx({"foot0": 0.0, "foot1": force}, rel=1e-12)
    assert simulation.mode() == ("foot1",)
    expected = [0.0, force / MASS - GRAVITY, side * near * force / INERTIA]
    np.testing.assert_allclose(simulation.field("dy_end")[3:6], expected, rtol=1e-12, atol=1e-13)
    simulation.advance(0.05)
    assert simulation.mode() == ("foot1",)
    assert simulation.counters[0] == 0  # no impact: it has left, and does not come back


def test_two_supports_that_are_one():
    forces, acceleration = forces_and_acceleration([0.25, 0.25, -0.25])
    np.testing.assert_allclose(forces, [WEIGHT / 4, WEIGHT / 4, WEIGHT / 2], rtol=1e-12)
    np.testing.assert_allclose(acceleration, 0.0, atol=1e-12)


@pytest.mark.parametrize("supports", [[-0.5, 0.0, 0.5], [-0.5, 0.1, 0.7], [-0.4, -0.2, 0.2, 0.5]])
def test_redundant_supports_share_the_weight_with_the_least_sum_of_squares(supports):
    """f_k is linear in the place of the foot: of all forces in balance these have the least norm (Lagrange)."""
    x = np.array(supports)
    forces, acceleration = forces_and_acceleration(supports)
    linear = np.sum(x**2) - np.sum(x) * x
    np.testing.assert_allclose(forces, WEIGHT * linear / (len(x) * np.sum(x**2) - np.sum(x) ** 2), rtol=1e-11)
    np.testing.assert_allclose(acceleration, 0.0, atol=1e-11)


@settings(deadline=None, max_examples=150)
@given(st.lists(st.floats(-1, 1), min_size=3, max_size=MOST_COMBINED + 6))
def test_many_supports_carry_the_weight_and_only_push(places):
    """However the feet share it, also more of them than all combinations can be tried for."""
    assume(min(places) < -1e-3 and max(places) > 1e-3)
    forces, acceleration = forces_and_acceleration(places)
    assert forces.min() >= -1e-9
    assert forces.sum() == pytest.approx(WEIGHT, rel=1e-9)
    assert forces @ places == pytest.approx(0.0, abs=1e-8)
    np.testing.assert_allclose(acceleration, 0.0, atol=1e-7)


@settings(deadline=None, max_examples=100)
@given(st.lists(st.floats(1e-3, 1), min_size=2, max_size=8), st.sampled_from([1, -1]))
def test_a_block_beside_all_its_supports_tips_about_the_nearest(places, side):
    simulation = Simulation(block_on([side * x for x in places]))
    nearest = min(places)
    force = GRAVITY / (1 / MASS + nearest**2 / INERTIA)
    assert sum(simulation.read().values()) == pytest.approx(force, rel=1e-6)
    assert simulation.field("dy_end")[5] == pytest.approx(side * nearest * force / INERTIA, rel=1e-6)


def by_enumeration(heap):
    """Acceleration of a heap at rest: all combinations of closed contacts, the first that breaks no inequality."""
    free = heap.loads / heap.masses
    for count in range(len(heap.rows) + 1):
        for closed in itertools.combinations(range(len(heap.rows)), count):
            rows = heap.rows[list(closed)]
            forces = np.linalg.lstsq(rows / heap.masses @ rows.T, -rows @ free, rcond=1e-10)[0]
            acceleration = free + rows.T @ forces / heap.masses
            kept = np.abs(rows @ acceleration) < 1e-8
            if kept.all() and np.all(forces >= -1e-9) and np.all(heap.rows @ acceleration >= -1e-8):
                return acceleration
    raise AssertionError("no combination")


@settings(deadline=None, max_examples=60)
@given(st.integers(0, 2**32), st.integers(1, 3), st.integers(1, 8))
def test_a_random_heap_agrees_with_the_enumeration_of_all_combinations(seed, bodies, contacts):
    heap = touching(seed, bodies=bodies, contacts=contacts)
    simulation = Simulation(heap.mechanism)
    found = simulation.field("dy_end")[3 * bodies : 6 * bodies]
    expected = by_enumeration(heap)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-6 * np.abs(heap.loads / heap.masses).max())


@settings(deadline=None, max_examples=200)
@given(st.integers(0, 2**32), st.integers(1, 4), st.integers(1, 10))
def test_forces_of_a_random_heap_push_separate_and_complement(seed, bodies, contacts):
    """Newton's law, p >= 0, s'' >= 0 and p s'' = 0: that proves the choice, and the acceleration is unique."""
    heap = touching(seed, bodies=bodies, contacts=contacts)
    simulation = Simulation(heap.mechanism)
    acceleration = simulation.field("dy_end")[3 * bodies : 6 * bodies]
    read = simulation.read()
    forces = np.array([read[f"contact{c}"] for c in range(contacts)])
    size = max(1.0, np.abs(forces).max())
    np.testing.assert_allclose(heap.masses * acceleration, heap.loads + heap.rows.T @ forces, rtol=0, atol=1e-9 * size)
    separation = heap.rows @ acceleration
    assert forces.min() >= -1e-9 * size
    assert separation.min() >= -1e-7
    np.testing.assert_allclose(forces * separation, 0.0, atol=1e-7 * size)

"""The plain reference implementation against the numbers of two earlier, independent ones.

The table and the impulses come from 9 redundant coordinates with eqs (3) and (7) and from 3 minimal
coordinates with Lagrange's equations, which agreed to 1e-14; they stand here with all their printed digits.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from benchmarks.ratchet import Parameters, build
from benchmarks.reference import (
    CRANK_ANGLE,
    FACE,
    PAWL_ANGLE,
    SLOPE,
    WHEEL_ANGLE,
    State,
    Trajectory,
    acceleration,
    advance,
    constraints,
    contact_row,
    impact,
    kinetic_energy,
    simulate,
    spring_energy,
    step,
)

ANGLES = [CRANK_ANGLE, PAWL_ANGLE, WHEEL_ANGLE]

# beta_0 [deg]: t_I [s]; phi', gamma', omega [rad/s] before the impact; the same after it
TABLE = {
    85: (0.9573080523, 0.566692226, -0.270715394, -0.000681458, 0.0192038168, -0.0069272732, 0.0228046146),
    90: (0.9399211769, 0.574072849, -0.207085356, -0.000779456, 0.0191482997, -0.0069073680, 0.0227388573),
    95: (0.9277144372, 0.579788752, -0.146091124, -0.000774514, 0.0191307988, -0.0069008794, 0.0227178290),
    100: (0.9194210908, 0.584076449, -0.087110987, -0.000672731, 0.0191521427, -0.0069081155, 0.0227425265),
    105: (0.9143304857, 0.587100938, -0.029561498, -0.000475511, 0.0192147646, -0.0069299405, 0.0228158202),
}
# half a unit of the last printed digit, and a little
PRINTED = np.array([6e-11, 6e-10, 6e-10, 6e-10, 6e-11, 6e-11, 6e-11])


@cache
def first_impact(slope_angle: int = 90, teeth: int = 10):
    mechanism = build(Parameters(tooth_slope_angle=math.radians(slope_angle), tooth_count=teeth))
    trajectory = simulate(mechanism, 0.96, rtol=1e-12, atol=1e-14)
    return mechanism, trajectory.impacts[0]


@pytest.mark.parametrize("slope_angle", TABLE)
def test_impact_time_and_speeds(slope_angle):
    _, hit = first_impact(slope_angle)
    found = [hit.time, *hit.before[ANGLES], *hit.after[ANGLES]]
    assert np.all(np.abs(np.subtract(found, TABLE[slope_angle])) < PRINTED)


def test_motion_does_not_depend_on_the_number_of_teeth_but_impulses_do():
    _, ten = first_impact()
    _, twenty = first_impact(teeth=20)
    np.testing.assert_allclose(twenty.after, ten.after, rtol=0, atol=1e-12)
    assert twenty.face_impulse > 1.01 * ten.face_impulse


def test_impulses_of_the_base_case():
    _, hit = first_impact()
    assert hit.face_impulse == pytest.approx(7.7895902699e-3, rel=1e-10)
    assert hit.slope_impulse == pytest.approx(1.1321724809e-3, rel=1e-9)


def test_energies_of_the_base_case():
    mechanism, hit = first_impact()
    spring = spring_energy(mechanism, hit.q)
    before, after = (kinetic_energy(mechanism, rates) + spring for rates in (hit.before, hit.after))
    assert before == pytest.approx(2.71981107e-4, rel=2e-9)
    assert after == pytest.approx(8.78293469e-6, rel=1e-9)
    work = mechanism.parameters.drive_torque * (hit.q[CRANK_ANGLE] - mechanism.start[CRANK_ANGLE])
    assert before == pytest.approx(work, abs=1e-16)


def test_constraints_do_not_drift():
    mechanism, hit = first_impact()
    phi, jacobian, _ = constraints(mechanism, hit.q, hit.before, (SLOPE,))
    assert np.abs(phi).max() < 1e-14
    assert np.abs(jacobian @ hit.before).max() < 1e-13


def test_restitution_one_half():
    mechanism, hit = with_restitution(0.5)
    assert hit.after[CRANK_ANGLE] == pytest.approx(-0.258313975, abs=6e-10)
    assert hit.after[WHEEL_ANGLE] == pytest.approx(0.0344980141, abs=6e-11)
    assert hit.face_impulse == pytest.approx(0.0116843854, abs=6e-11)
    _, jacobian, _ = constraints(mechanism, hit.q, hit.after, (FACE,))
    assert jacobian[-1] @ hit.after == pytest.approx(hit.closing_speed / 2, rel=1e-12)


@pytest.mark.parametrize("restitution", [0.0, 0.3, 0.5, 0.8, 1.0])
def test_energy_lost_is_the_impulse_times_the_mean_closing_speed(restitution):
    mechanism, hit = with_restitution(restitution)
    lost = kinetic_energy(mechanism, hit.before) - kinetic_energy(mechanism, hit.after)
    assert lost == pytest.approx(hit.face_impulse * hit.closing_speed * (1 - restitution) / 2, abs=1e-17)


def with_restitution(restitution):
    mechanism, hit = first_impact()
    mechanism = replace(mechanism, parameters=replace(mechanism.parameters, restitution=restitution))
    return mechanism, impact(mechanism, hit.time, hit.q, hit.before)


def test_bounces_end_on_the_face():
    trajectory = simulate(build(Parameters(restitution=0.3)), 2.0)
    speeds = [hit.closing_speed for hit in trajectory.impacts]
    # each bounce returns with about e times the speed: 0.0676 m/s falls below the stick speed at the tenth
    assert len(speeds) == 10
    np.testing.assert_allclose(np.divide(speeds[1:], speeds[:-1]), 0.3, rtol=2e-3)
    assert abs(gap_at(trajectory, 2.0)) < 1e-9


def gap_at(trajectory: Trajectory, time: float) -> float:
    q, qd = trajectory.at(time)
    return contact_row(build(Parameters()), q, qd, FACE)[0]


def test_duplicated_joint_rows_change_nothing():
    mechanism, hit = first_impact()
    doubled = replace(mechanism, pins=mechanism.pins + mechanism.pins[:2])
    np.testing.assert_allclose(
        acceleration(doubled, hit.q, hit.before),
        acceleration(mechanism, hit.q, hit.before),
        rtol=0,
        atol=1e-11,
    )
    twice = impact(doubled, hit.time, hit.q, hit.before)
    np.testing.assert_allclose(twice.after, hit.after, rtol=0, atol=1e-13)
    assert twice.face_impulse == pytest.approx(hit.face_impulse, rel=1e-11)


def test_rows_are_derivatives_of_the_residuals():
    mechanism = build(Parameters(tooth_slope_angle=math.radians(95), tooth_count=15))
    q, qd, size = mechanism.start + 0.01 * np.arange(9), np.linspace(-2, 3, 9), 1e-6
    _, jacobian, gamma = constraints(mechanism, q, qd, (SLOPE, FACE))
    for k in range(9):
        plus, minus = (constraints(mechanism, q + d * np.eye(9)[k], qd, (SLOPE, FACE))[0] for d in (size, -size))
        np.testing.assert_allclose(jacobian[:, k], (plus - minus) / (2 * size), atol=1e-9)
    plus, minus = (constraints(mechanism, q + d * qd, qd, (SLOPE, FACE))[1] @ qd for d in (size, -size))
    np.testing.assert_allclose(gamma, -(plus - minus) / (2 * size), atol=1e-8)


def test_after_the_impact_the_four_bar_swings():
    mechanism, hit = first_impact()
    state, _, none = advance(mechanism, State(hit.time, hit.q, hit.after, on_face=True), 4.9066, 1e-9, 1e-12)
    assert none is None
    assert state.qd[WHEEL_ANGLE] == pytest.approx(0.0, abs=2e-6)
    assert math.degrees(state.q[WHEEL_ANGLE]) == pytest.approx(82.1675, abs=6e-5)


def test_steps_join_to_the_same_motion():
    mechanism, hit = first_impact()
    state, _, _ = advance(mechanism, State(0.0, mechanism.start, np.zeros(9)), 0.938, 1e-9, 1e-12)
    for _ in range(4):
        state = step(mechanism, state)
    assert state.time == pytest.approx(0.942, abs=1e-12)
    assert state.on_face
    whole, _, _ = advance(mechanism, State(hit.time, hit.q, hit.after, on_face=True), 0.942, 1e-9, 1e-12)
    np.testing.assert_allclose(state.qd, whole.qd, rtol=0, atol=1e-9)


def test_reference_curve_is_that_of_the_base_case():
    curve = pd.read_csv(Path(__file__).parents[2] / "models" / "ratchet" / "reference.csv")
    mechanism = build(Parameters())
    trajectory = simulate(mechanism, 6.0)
    np.testing.assert_array_equal(curve["time"], np.arange(601) / 100)
    q, qd = zip(*map(trajectory.at, curve["time"]), strict=True)
    for name, column in (("wheel", WHEEL_ANGLE), ("crank", CRANK_ANGLE), ("pawl", PAWL_ANGLE)):
        np.testing.assert_allclose(curve[f"{name}_angle"], np.transpose(q)[column], rtol=0, atol=1e-8)
        np.testing.assert_allclose(curve[f"{name}_speed"], np.transpose(qd)[column], rtol=0, atol=1e-8)

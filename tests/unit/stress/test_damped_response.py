import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.integrate import solve_ivp

from mechanism_fmu.stress import STEEL, WedgeTooth, damped_response, ritz_modes

TOOTH = WedgeTooth(length=0.05, apex_angle=0.5)


def test_response_solves_equation_10_integrated_numerically():
    zeta, velocity = STEEL.damping_ratio, 1.3
    for mode in ritz_modes(TOOTH, STEEL):
        m, k = mode.mass, mode.stiffness
        c = 2 * zeta * (k * m) ** 0.5
        period = 2 * np.pi * (m / k) ** 0.5
        t = np.linspace(0.0, 5 * period, 101)
        scale = np.array([velocity * period, velocity])  # displacement and velocity of order 1
        integrated = solve_ivp(
            lambda _, y, m=m, k=k, c=c, scale=scale: (
                np.array([y[1] * scale[1], -(c * y[1] * scale[1] + k * y[0] * scale[0]) / m]) / scale
            ),
            (0.0, t[-1]),
            [0.0, 1.0],
            method="DOP853",
            t_eval=t,
            rtol=1e-12,
            atol=1e-13,
        )
        expected = integrated.y[0] * scale[0]
        response = damped_response(np.array([mode.natural_frequency]), zeta, velocity, t)[0]
        np.testing.assert_allclose(response, expected, atol=1e-9 * np.abs(expected).max())


def test_shape_is_modes_by_times():
    assert damped_response(np.array([1.0, 2.0]), 0.03, 1.0, np.zeros(5)).shape == (2, 5)


@given(frequency=st.floats(1.0, 1e6), zeta=st.floats(0.0, 0.99), velocity=st.floats(1e-6, 1e3))
def test_response_starts_at_rest_position_with_the_impact_velocity(frequency, zeta, velocity):
    h = 1e-6 / frequency
    before, at, after = damped_response(np.array([frequency]), zeta, velocity, np.array([-h, 0.0, h]))[0]
    assert at == 0.0
    assert (after - before) / (2 * h) == pytest.approx(velocity, rel=1e-9)


@given(frequency=st.floats(1.0, 1e6), velocity=st.floats(1e-3, 1e3))
def test_undamped_response_keeps_its_amplitude_and_period(frequency, velocity):
    quarter = np.pi / (2 * frequency)
    response = damped_response(np.array([frequency]), 0.0, velocity, quarter * np.array([1.0, 2.0, 3.0, 4.0, 5.0]))[0]
    np.testing.assert_allclose(response / (velocity / frequency), [1, 0, -1, 0, 1], atol=1e-14)


@given(zeta=st.floats(1e-3, 0.5))
def test_successive_peaks_fall_by_the_logarithmic_decrement(zeta):
    period = 2 * np.pi / (1 - zeta**2) ** 0.5
    first, second = damped_response(np.array([1.0]), zeta, 1.0, np.array([1.0, 1.0 + period]))[0]
    assert np.log(first / second) == pytest.approx(2 * np.pi * zeta / (1 - zeta**2) ** 0.5, rel=1e-9)

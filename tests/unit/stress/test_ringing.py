import itertools
import math
import tracemalloc
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from mechanism_fmu.stress import (
    STEEL,
    ModeScaling,
    Ringing,
    WedgeTooth,
    bending_stress,
    maximum_stress,
    natural_modes,
    ritz_modes,
)

TOOTH = WedgeTooth(length=0.033, apex_angle=0.61)
PERIOD = 2 * math.pi / ritz_modes(TOOTH, STEEL)[0].natural_frequency
PLACES = np.linspace(0.0, TOOTH.length, 5)


def direct(times, velocities, x, t, modes=None):
    """Every impact's own stress, added up."""
    whole = np.zeros((len(x), len(t)))
    for time, velocity in zip(times, velocities, strict=True):
        struck = t >= time
        stress = bending_stress(TOOTH, STEEL, abs(velocity), x, t[struck] - time, modes)
        whole[:, struck] += math.copysign(1.0, velocity) * stress
    return whole


def test_one_impact_is_the_paper_s():
    t = np.linspace(0.0, 5 * PERIOD, 201)
    found = Ringing(TOOTH, STEEL, [0.5], [2.0]).stress(PLACES, 0.5 + t)
    expected = bending_stress(TOOTH, STEEL, 2.0, PLACES, 0.5 + t - 0.5)
    np.testing.assert_allclose(found, expected, atol=1e-9 * np.abs(expected).max())


def test_nothing_moves_before_the_first_impact():
    assert not Ringing(TOOTH, STEEL, [0.5, 0.6], [2.0, 1.0]).stress(PLACES, [0.0, 0.499]).any()


@settings(deadline=None, max_examples=30)
@given(
    gaps=st.lists(st.one_of(st.just(0.0), st.floats(0.01, 30.0)), min_size=1, max_size=8),
    velocities=st.lists(st.floats(-2.0, 2.0), min_size=8, max_size=8),
)
def test_sequence_is_the_sum_of_its_impacts(gaps, velocities):
    times = np.cumsum(gaps) * PERIOD
    velocities = velocities[: len(times)]
    t = np.linspace(0.0, times[-1] + 5 * PERIOD, 301)
    expected = direct(times, velocities, PLACES, t)
    found = Ringing(TOOTH, STEEL, times, velocities).stress(PLACES, t)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-2)  # of up to 1e8 Pa


def test_sequence_of_many_modes_scaled_by_projection():
    modes = natural_modes(TOOTH, STEEL, 12, scaling=ModeScaling.PROJECTION)[:6]
    times, velocities = np.array([0.0, 0.7, 0.9]) * PERIOD, [1.0, -0.5, 2.0]
    t = np.linspace(0.0, 4 * PERIOD, 301)
    expected = direct(times, velocities, PLACES, t, modes)
    found = Ringing(TOOTH, STEEL, times, velocities, modes).stress(PLACES, t)
    np.testing.assert_allclose(found, expected, atol=1e-9 * np.abs(expected).max())


def test_sequence_solves_equation_10_with_jumps_integrated_numerically():
    (mode,) = ritz_modes(TOOTH, STEEL)[:1]
    pole, zeta = mode.natural_frequency, STEEL.damping_ratio
    times, velocities = np.array([0.0, 1.3, 1.9]) * PERIOD, [1.0, 0.4, -0.8]
    state, t = np.zeros(2), 3.0 * PERIOD
    for (start, end), jump in zip(itertools.pairwise([*times, t]), velocities, strict=True):
        state[1] += jump / pole  # in units of length times frequency
        state = solve_ivp(
            lambda _, y: pole * np.array([y[1], -y[0] - 2 * zeta * y[1]]), (start, end), state, rtol=1e-11, atol=1e-18
        ).y[:, -1]
    expected = state[0] * bending_stress(TOOTH, STEEL, 1.0, [0.01], [0.3 * PERIOD], (mode,))[0, 0]
    expected /= math.exp(-zeta * pole * 0.3 * PERIOD) / pole
    expected /= math.sin(pole * math.sqrt(1 - zeta**2) * 0.3 * PERIOD) / math.sqrt(1 - zeta**2)
    assert Ringing(TOOTH, STEEL, times, velocities, (mode,)).stress(0.01, t)[0, 0] == pytest.approx(expected, rel=1e-7)


def test_impact_in_step_doubles_the_swing_and_one_against_it_stops_it():
    (mode,) = ritz_modes(TOOTH, STEEL)[:1]
    barely = replace(STEEL, damping_ratio=1e-4)
    t = np.linspace(1.0, 2.0, 101) * PERIOD
    single = np.abs(Ringing(TOOTH, barely, [0.0], [1.0], (mode,)).stress(0.0, t)).max()
    doubled = np.abs(Ringing(TOOTH, barely, [0.0, PERIOD], [1.0, 1.0], (mode,)).stress(0.0, t)).max()
    stopped = np.abs(Ringing(TOOTH, barely, [0.0, PERIOD], [1.0, -1.0], (mode,)).stress(0.0, t)).max()
    assert doubled == pytest.approx(2 * single, rel=2e-3)
    assert stopped < 2e-3 * single


def test_largest_swing_of_one_impact_is_the_maximum_stress():
    found = maximum_stress(TOOTH, STEEL, 2.0)
    swings = list(Ringing(TOOTH, STEEL, [0.25], [-2.0]).swings(found.position * TOOTH.length))
    largest = max(swings, key=lambda swing: abs(swing.stress))
    assert abs(largest.stress) == pytest.approx(found.stress, rel=1e-10)
    assert largest.time - 0.25 == pytest.approx(found.time, rel=1e-5)


def test_nothing_of_the_history_lies_beyond_its_swings():
    times, velocities = np.array([0.0, 0.31, 0.35, 2.6, 40.0]) * PERIOD, [1.0, -0.3, 0.8, 0.5, -1.0]
    ringing = Ringing(TOOTH, STEEL, times, velocities)
    swings = list(ringing.swings(0.013))
    assert [s.time for s in swings] == sorted(s.time for s in swings)
    fine = np.linspace(0.0, 60 * PERIOD, 60001)
    history = ringing.stress(0.013, fine)[0]
    largest = np.abs(history).max()
    for before, after in itertools.pairwise(swings):
        inside = history[(fine > before.time) & (fine < after.time)]
        low, high = sorted((before.stress, after.stress))
        if len(inside) and after.time < 20 * PERIOD:
            assert low - 1e-9 * largest <= inside.min()
            assert inside.max() <= high + 1e-9 * largest


def test_ringing_is_followed_until_it_is_over():
    ringing = Ringing(TOOTH, STEEL, [0.0], [1.0])
    end = list(ringing.swings(0.013))[-1]
    largest = maximum_stress(TOOTH, STEEL, 1.0).stress
    after = np.abs(ringing.stress(0.013, end.time + np.linspace(0.0, 3.0, 301) * PERIOD)).max()
    assert end.stress == 0.0
    assert after < 1.5e-2 * largest
    assert after > 1e-4 * largest


def test_impacts_at_one_time_add_up():
    one = list(Ringing(TOOTH, STEEL, [0.0], [1.5]).swings(0.01))
    split = list(Ringing(TOOTH, STEEL, [0.0, 0.0], [1.0, 0.5]).swings(0.01))
    assert max(s.stress for s in split) == pytest.approx(max(s.stress for s in one), rel=1e-12)


def test_no_velocity_makes_no_swing():
    assert all(swing.stress == 0.0 for swing in Ringing(TOOTH, STEEL, [0.0, 1.0], [0.0, 0.0]).swings(0.01))


def test_memory_does_not_grow_with_the_number_of_impacts():
    def peak(count):
        ringing = Ringing(TOOTH, STEEL, np.arange(count) * PERIOD, np.ones(count))
        tracemalloc.start()
        for _ in ringing.swings(0.01):
            pass
        size = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        return size

    peak(2)
    assert peak(200) < 2 * peak(20)


@pytest.mark.parametrize(
    ("times", "velocities", "said"),
    [
        ([], [], r"0 times and 0 velocities.*at least one"),
        ([0.0, 1.0], [1.0], r"2 times and 1 velocities"),
        ([0.0, 2.0, 1.0], [1.0] * 3, r"impact 3 at 1 s comes before impact 2 at 2 s: sort them"),
        ([math.nan], [1.0], r"^time of an impact = nan s"),
        ([0.0], [math.inf], r"^impact velocity = inf m/s.*with sign"),
    ],
)
def test_impossible_sequence_is_refused(times, velocities, said):
    with pytest.raises(ValueError, match=said):
        Ringing(TOOTH, STEEL, times, velocities)


def test_too_little_damping_and_places_off_the_tooth_are_refused():
    with pytest.raises(ValueError, match=r"^damping ratio = 0, but .*thousands of swings"):
        Ringing(TOOTH, replace(STEEL, damping_ratio=0.0), [0.0], [1.0])
    ringing = Ringing(TOOTH, STEEL, [0.0], [1.0])
    with pytest.raises(ValueError, match=r"^place = 0\.034 m"):
        ringing.stress(0.034, 0.0)
    with pytest.raises(ValueError, match=r"^place = -1 m"):
        next(ringing.swings(-1.0))
    with pytest.raises(ValueError, match=r"^time = nan s"):
        ringing.stress(0.01, math.nan)

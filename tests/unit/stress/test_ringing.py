import itertools
import math
import tracemalloc
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from scipy.integrate import solve_ivp

from mechanism_fmu.stress import (
    STEEL,
    ModeScaling,
    Ringing,
    WedgeTooth,
    bending_stress,
    converged_modes,
    maximum_stress,
    natural_modes,
    rainflow_cycles,
    ritz_modes,
)

TOOTH = WedgeTooth(length=0.033, apex_angle=0.61)
PERIOD = 2 * math.pi / ritz_modes(TOOTH, STEEL)[0].natural_frequency
PAPER, CONVERGED = ritz_modes(TOOTH, STEEL), converged_modes(TOOTH, STEEL)
PLACES = np.linspace(0.0, TOOTH.length, 5)


def direct(times, velocities, x, t, modes):
    """Every impact's own stress, added up."""
    whole = np.zeros((len(x), len(t)))
    for time, velocity in zip(times, velocities, strict=True):
        struck = t >= time
        stress = bending_stress(TOOTH, STEEL, abs(velocity), x, t[struck] - time, modes)
        whole[:, struck] += math.copysign(1.0, velocity) * stress
    return whole


def test_modes_are_the_converged_ones_unless_given():
    t = np.linspace(0.0, 5 * PERIOD, 201)
    given = Ringing(TOOTH, STEEL, [0.0], [2.0], CONVERGED).stress(PLACES, t)
    np.testing.assert_array_equal(Ringing(TOOTH, STEEL, [0.0], [2.0]).stress(PLACES, t), given)
    assert np.abs(given).max() > 1.1 * np.abs(Ringing(TOOTH, STEEL, [0.0], [2.0], PAPER).stress(PLACES, t)).max()


def test_one_impact_is_the_paper_s():
    t = np.linspace(0.0, 5 * PERIOD, 201)
    found = Ringing(TOOTH, STEEL, [0.5], [2.0], PAPER).stress(PLACES, 0.5 + t)
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
    for modes in (PAPER, CONVERGED):
        expected = direct(times, velocities, PLACES, t, modes)
        found = Ringing(TOOTH, STEEL, times, velocities, modes).stress(PLACES, t)
        # Of up to 1e8 Pa; fast modes feel the rounding of the times more.
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-2 * modes[-1].natural_frequency * PERIOD / 20)


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


@pytest.mark.parametrize("modes", [PAPER, CONVERGED])
def test_largest_swing_of_one_impact_is_the_maximum_stress(modes):
    found = maximum_stress(TOOTH, STEEL, 2.0, modes)
    swings = list(Ringing(TOOTH, STEEL, [0.25], [-2.0], modes).swings(found.position * TOOTH.length))
    largest = max(swings, key=lambda swing: abs(swing.stress))
    assert abs(largest.stress) == pytest.approx(found.stress, rel=1e-10)
    assert largest.time - 0.25 == pytest.approx(found.time, rel=1e-5)


@pytest.mark.parametrize(("modes", "share"), [(PAPER, 1e-9), (CONVERGED, 1e-4)])
def test_nothing_of_the_history_lies_beyond_its_swings(modes, share):
    times, velocities = np.array([0.0, 0.31, 0.35, 2.6, 40.0]) * PERIOD, [1.0, -0.3, 0.8, 0.5, -1.0]
    ringing = Ringing(TOOTH, STEEL, times, velocities, modes)
    swings = list(ringing.swings(0.013))
    assert [s.time for s in swings] == sorted(s.time for s in swings)
    fine = np.linspace(0.0, 60 * PERIOD, 60001)
    history = ringing.stress(0.013, fine)[0]
    largest = np.abs(history).max()
    for before, after in itertools.pairwise(swings):
        inside = history[(fine > before.time) & (fine < after.time)]
        low, high = sorted((before.stress, after.stress))
        if len(inside) and after.time < 20 * PERIOD:
            assert low - share * largest <= inside.min()
            assert inside.max() <= high + share * largest


@settings(deadline=None, max_examples=15)
@given(
    gaps=st.lists(st.floats(0.01, 5.0), min_size=1, max_size=5),
    velocities=st.lists(st.floats(0.2, 2.0), min_size=5, max_size=5),
    damping=st.floats(0.005, 0.3),
    xi=st.floats(0.0, 0.95),
)
def test_pace_of_the_modes_still_heard_misses_nothing(gaps, velocities, damping, xi):
    """The pace of the fastest mode from the first impact to the last swing finds the same."""
    times = np.cumsum(gaps) * PERIOD
    material = replace(STEEL, damping_ratio=damping)
    ringing = Ringing(TOOTH, material, times, velocities[: len(times)])
    adaptive = list(ringing.swings(xi * TOOTH.length))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("mechanism_fmu.stress.ringing._HEARD", 1e-300)
        whole = list(ringing.swings(xi * TOOTH.length))
    largest = max(abs(swing.stress) for swing in whole)
    assert max(abs(swing.stress) for swing in adaptive) == pytest.approx(largest, rel=1e-10)
    cycles, expected = (
        sorted(c.amplitude for c in rainflow_cycles(s.stress for s in swings) if c.amplitude > 1e-3 * largest)
        for swings in (adaptive, whole)
    )
    np.testing.assert_allclose(cycles, expected, atol=1e-5 * largest)


def test_ringing_is_followed_until_it_is_over():
    ringing = Ringing(TOOTH, STEEL, [0.0], [1.0])
    end = list(ringing.swings(0.013))[-1]
    largest = maximum_stress(TOOTH, STEEL, 1.0, CONVERGED).stress
    after = np.abs(ringing.stress(0.013, end.time + np.linspace(0.0, 3.0, 301) * PERIOD)).max()
    assert end.stress == 0.0
    assert after < 1.5e-2 * largest
    assert after > 1e-4 * largest


JUMPS = st.lists(st.floats(-2.0, 2.0), min_size=1, max_size=5)


@settings(deadline=None, max_examples=25)
@given(parts=JUMPS, before=st.floats(-2.0, 2.0), gap=st.floats(0.01, 5.0))
def test_splitting_a_jump_into_parts_at_one_instant_changes_nothing(parts, before, gap):
    time = gap * PERIOD
    t = np.linspace(0.0, time + 3 * PERIOD, 101)
    one = Ringing(TOOTH, STEEL, [0.0, time], [before, sum(parts)]).stress(PLACES, t)
    split = Ringing(TOOTH, STEEL, [0.0, *[time] * len(parts)], [before, *parts]).stress(PLACES, t)
    np.testing.assert_allclose(split, one, rtol=0, atol=1e-6)  # of up to 1e8 Pa


def test_swings_of_a_split_jump_are_those_of_the_whole():
    one = list(Ringing(TOOTH, STEEL, [0.0], [1.5]).swings(0.01))
    split = list(Ringing(TOOTH, STEEL, [0.0, 0.0], [1.0, 0.5]).swings(0.01))
    assert max(s.stress for s in split) == pytest.approx(max(s.stress for s in one), rel=1e-12)


@settings(deadline=None, max_examples=25)
@given(jump=st.floats(-2.0, 2.0), before=st.floats(-2.0, 2.0), gap=st.floats(0.01, 5.0))
def test_two_equal_and_opposite_jumps_at_one_instant_cancel(jump, before, gap):
    t = np.linspace(0.0, (gap + 3) * PERIOD, 101)
    alone = Ringing(TOOTH, STEEL, [0.0], [before]).stress(PLACES, t)
    both = Ringing(TOOTH, STEEL, [0.0, gap * PERIOD, gap * PERIOD], [before, jump, -jump]).stress(PLACES, t)
    np.testing.assert_allclose(both, alone, rtol=0, atol=10.0)  # of up to 1e8 Pa, with the rounding of fast phases


@settings(deadline=None, max_examples=25)
@given(jumps=JUMPS, gap=st.floats(0.01, 5.0))
def test_other_signs_of_all_jumps_flip_the_history(jumps, gap):
    times = np.arange(len(jumps)) * gap * PERIOD
    t = np.linspace(0.0, times[-1] + 3 * PERIOD, 101)
    one = Ringing(TOOTH, STEEL, times, jumps).stress(PLACES, t)
    other = Ringing(TOOTH, STEEL, times, np.negative(jumps)).stress(PLACES, t)
    np.testing.assert_array_equal(other, -one)


@settings(deadline=None, max_examples=25)
@given(jumps=JUMPS, factor=st.floats(1e-12, 1.0))
def test_stress_goes_to_zero_with_the_jumps(jumps, factor):
    times = np.arange(len(jumps)) * 0.7 * PERIOD
    t = np.linspace(0.0, times[-1] + 3 * PERIOD, 101)
    one = Ringing(TOOTH, STEEL, times, jumps).stress(PLACES, t)
    less = Ringing(TOOTH, STEEL, times, factor * np.array(jumps)).stress(PLACES, t)
    np.testing.assert_allclose(less, factor * one, rtol=0, atol=1e-12 * factor * np.abs(one).max() + 1e-250)


@settings(deadline=None, max_examples=25)
@given(rate=st.floats(0.01, 10.0))
def test_a_wheel_stopped_dead_gives_the_stress_of_its_whole_speed(rate):
    """Law of the jump: l (0 - omega) is as large as l (omega - 0), the start of a wheel from rest, and opposite."""
    started, stopped = TOOTH.length * (rate - 0.0), TOOTH.length * (0.0 - rate)
    swings = [list(Ringing(TOOTH, STEEL, [0.0], [jump]).swings(0.7 * TOOTH.length)) for jump in (started, stopped)]
    for one, other in zip(*swings, strict=True):
        assert other.stress == -one.stress
    whole = maximum_stress(TOOTH, STEEL, TOOTH.length * rate, CONVERGED)
    at_its_place = Ringing(TOOTH, STEEL, [0.0], [stopped]).swings(whole.position * TOOTH.length)
    assert max(abs(s.stress) for s in at_its_place) == pytest.approx(whole.stress, rel=1e-9)


def test_no_velocity_makes_no_swing():
    swings = list(Ringing(TOOTH, STEEL, [0.0, 1.0], [0.0, 0.0]).swings(0.01))
    assert swings
    assert all(swing.stress == 0.0 for swing in swings)


def peak_memory(count, damping):
    """Bytes that the swings of a sequence take at most."""
    material = replace(STEEL, damping_ratio=damping)
    ringing = Ringing(TOOTH, material, np.arange(count) * PERIOD, np.ones(count))
    tracemalloc.start()
    for _ in ringing.swings(0.01):
        pass
    size = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return size


def test_memory_does_not_grow_with_the_number_of_impacts():
    peak_memory(2, 0.03)
    assert peak_memory(200, 0.03) < 2 * peak_memory(20, 0.03)


def test_memory_does_not_grow_with_the_length_of_the_ringing():
    peak_memory(1, 0.003)
    assert peak_memory(1, 0.0002) < 2 * peak_memory(1, 0.002)


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

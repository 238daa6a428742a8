import itertools
import math
import re

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from mechanism_fmu.stress import (
    CARDS,
    STEEL,
    STEEL_CARD,
    Cycle,
    MeanStress,
    Ringing,
    Strength,
    WedgeTooth,
    converged_modes,
    material_card,
    maximum_stress,
    miner_damage,
    rainflow_cycles,
    ritz_modes,
    sequence_damage,
)
from mechanism_fmu.stress.fatigue import effective_amplitude

TOOTH = WedgeTooth(length=0.033, apex_angle=0.61)
PERIOD = 2 * math.pi / ritz_modes(TOOTH, STEEL)[0].natural_frequency
STRENGTH = Strength(3e8, 5e8, 8e8, -0.1)


def counts(history):
    """Cycles by range, as the standard prints them."""
    found: dict[float, float] = {}
    for cycle in rainflow_cycles(history):
        found[2 * cycle.amplitude] = found.get(2 * cycle.amplitude, 0.0) + cycle.count
    return found


def test_rainflow_counts_the_example_of_the_standard():
    # ASTM E1049-85, Fig. 6: one cycle of range 4 and halves of 3, 4, 6, 8, 8, 9.
    assert counts([-2, 1, -3, 5, -1, 3, -4, 4, -2]) == {3: 0.5, 4: 1.5, 6: 0.5, 8: 1.0, 9: 0.5}


def test_rainflow_takes_the_history_piece_by_piece():
    taken = []

    def history():
        for k in range(10):
            taken.append(k)
            yield (-1.0) ** k * k

    next(rainflow_cycles(history()))
    assert len(taken) == 4


def test_points_between_two_extremes_do_not_count():
    assert counts([0, 1, 2, 3, 1, -2, 0, 2]) == counts([0, 3, -2, 2])


def test_basquin_line_and_its_inverse():
    assert STRENGTH.amplitude_at(0.5) == pytest.approx(8e8)
    assert STRENGTH.damage_of(8e8) == pytest.approx(2.0)  # half a cycle
    # A tenth of the stress lives 10^10 times as long with b = -0.1.
    assert STRENGTH.damage_of(8e7) == pytest.approx(2e-10)
    assert STRENGTH.damage_of(0.0) == 0.0


@given(cycles=st.floats(0.5, 1e15))
def test_as_many_cycles_as_the_line_says_are_the_end(cycles):
    amplitude = STRENGTH.amplitude_at(cycles)
    assert miner_damage([Cycle(amplitude, 0.0, cycles)], STRENGTH) == pytest.approx(1.0, rel=1e-9)


def test_goodman():
    assert effective_amplitude(1e8, 2.5e8, 5e8) == pytest.approx(2e8)
    assert effective_amplitude(1e8, -2.5e8, 5e8) == 1e8
    assert effective_amplitude(1e8, 2.5e8, 5e8, MeanStress.NONE) == 1e8
    assert effective_amplitude(1e8, 5e8, 5e8) == math.inf
    assert miner_damage([Cycle(1e8, 6e8, 1.0)], STRENGTH) == math.inf


def test_every_card_is_whole_and_tells_its_sources():
    assert STEEL_CARD.material == STEEL
    assert CARDS[STEEL_CARD.name] == STEEL_CARD
    for name, card in CARDS.items():
        assert name == card.name
        told = " ".join(re.findall(r"(?:^|; )([\w', ]+):", "; ".join(card.sources)))
        for symbol in ("E", "rho", "zeta", "R_e", "R_m", "sigma_f'", "b"):
            assert symbol in re.findall(r"[\w']+", told), (name, symbol)
        # S-N lines of steels: between a third and a half of R_m is borne a million times.
        assert 0.2 < card.strength.amplitude_at(1e6) / card.strength.tensile_strength < 0.6


def test_numbers_of_cards_as_printed():
    dowling = material_card("SAE4142").strength
    # Table 9.1 prints A = 1837 MPa of sigma_a = A N^b, too.
    assert dowling.amplitude_at(1.0) == pytest.approx(1837e6, rel=1e-3)
    assert material_card("AISI4340").strength.amplitude_at(1.0) == pytest.approx(1643e6, rel=1e-3)
    assert material_card("SAE1015").strength.amplitude_at(1.0) == pytest.approx(927e6, rel=1e-3)
    # The uniform material law has its knee of 0.45 R_m at 5e5 cycles.
    for name in ("steel", "S355", "C45E", "42CrMo4"):
        strength = material_card(name).strength
        assert strength.amplitude_at(5e5) == pytest.approx(0.45 * strength.tensile_strength, rel=5e-3)


def test_card_is_found_whatever_its_capitals_and_unknown_ones_are_answered_with_the_list():
    assert material_card("s355") is CARDS["S355"]
    with pytest.raises(ValueError, match=r"no material 'wood'; there are steel, S355, .*AISI4340"):
        material_card("wood")


def test_one_impact_by_hand():
    # A damped wave through zero: peaks of falling size, so that rainflow closes nothing but halves.
    (mode,) = ritz_modes(TOOTH, STEEL)[:1]
    found = sequence_damage(TOOTH, STEEL, STRENGTH, [0.0], [100.0], modes=(mode,))
    maximum = maximum_stress(TOOTH, STEEL, 100.0, (mode,))
    ratio = math.exp(-math.pi * STEEL.damping_ratio / math.sqrt(1 - STEEL.damping_ratio**2))
    peaks = maximum.stress * ratio ** np.arange(100)
    halves = [Cycle(peaks[0] / 2, peaks[0] / 2, 0.5)]
    halves += [Cycle((a + b) / 2, (a - b) / 2, 0.5) for a, b in itertools.pairwise(peaks)]
    # Each half cycle begins at a larger peak: of alternating sign. The first fibre has tension first.
    signs = [1.0, *(-1.0) ** np.arange(99)]
    by_fibre = [
        miner_damage(
            (Cycle(c.amplitude, side * s * c.mean, c.count) for c, s in zip(halves, signs, strict=True)), STRENGTH
        )
        for side in (1.0, -1.0)
    ]
    assert found.damage == pytest.approx(max(by_fibre), rel=1e-6)
    assert found.repeats_to_failure == pytest.approx(1 / found.damage)
    assert found.stress == pytest.approx(maximum.stress, rel=1e-10)
    assert found.time == pytest.approx(maximum.time, rel=1e-5)
    assert found.yield_safety == pytest.approx(3e8 / maximum.stress)
    assert found.impacts == 1
    worst = (peaks[0] + peaks[1]) / 2 / STRENGTH.amplitude_at(1e7) + (peaks[0] - peaks[1]) / 2 / 5e8
    assert found.fatigue_safety == pytest.approx(1 / worst, rel=1e-9)


def test_impacts_far_apart_do_each_their_own_damage():
    # Nothing rings any more when the next one comes: but for the halves at the ends, one after the other.
    one = sequence_damage(TOOTH, STEEL, STRENGTH, [0.0], [5.0])
    ten = sequence_damage(TOOTH, STEEL, STRENGTH, np.arange(10) * 1000 * PERIOD, [5.0] * 10)
    assert ten.stress == pytest.approx(one.stress, rel=1e-9)
    assert 9 * one.damage < ten.damage < 22 * one.damage


def test_impacts_in_step_do_more_than_the_same_far_apart():
    apart = sequence_damage(TOOTH, STEEL, STRENGTH, np.arange(5) * 1000 * PERIOD, [5.0] * 5)
    together = sequence_damage(TOOTH, STEEL, STRENGTH, np.arange(5) * PERIOD, [5.0] * 5)
    assert together.stress > 2 * apart.stress
    assert together.damage > 100 * apart.damage
    assert together.repeats_to_failure < 0.01 * apart.repeats_to_failure


@settings(deadline=None, max_examples=20)
@given(factor=st.floats(0.1, 3.0))
def test_damage_without_mean_stress_is_a_power_of_the_velocity(factor):
    times, velocities = np.array([0.0, 0.4, 3.0]) * PERIOD, np.array([20.0, -10.0, 30.0])
    none = MeanStress.NONE
    one = sequence_damage(TOOTH, STEEL, STRENGTH, times, velocities, mean_stress=none)
    other = sequence_damage(TOOTH, STEEL, STRENGTH, times, factor * velocities, mean_stress=none)
    assert other.damage == pytest.approx(one.damage * factor**10, rel=1e-6)
    assert other.cycles == one.cycles
    assert other.yield_safety == pytest.approx(one.yield_safety / factor)


def test_sign_of_all_impacts_does_not_matter():
    times, velocities = np.array([0.0, 0.4, 3.0]) * PERIOD, np.array([20.0, -10.0, 30.0])
    one = sequence_damage(TOOTH, STEEL, STRENGTH, times, velocities)
    other = sequence_damage(TOOTH, STEEL, STRENGTH, times, -velocities)
    assert other.damage == pytest.approx(one.damage, rel=1e-12)


@pytest.mark.parametrize("modes", [ritz_modes(TOOTH, STEEL), None])
def test_damage_by_a_history_sampled_finely(modes):
    times, velocities = np.array([0.0, 0.4, 3.0, 3.1]) * PERIOD, [20.0, -10.0, 30.0, 15.0]
    none = MeanStress.NONE
    found = sequence_damage(TOOTH, STEEL, STRENGTH, times, velocities, position=0.3, modes=modes, mean_stress=none)
    t = np.linspace(0.0, 45 * PERIOD, 45 * 2000)
    history = Ringing(TOOTH, STEEL, times, velocities, modes).stress(0.3 * TOOTH.length, t)[0]
    assert found.damage == pytest.approx(miner_damage(rainflow_cycles(history), STRENGTH, none), rel=1e-4)
    assert found.stress == pytest.approx(np.abs(history).max(), rel=1e-5)


def test_converged_modes_and_their_critical_section_are_the_default():
    modes = converged_modes(TOOTH, STEEL)
    found = sequence_damage(TOOTH, STEEL, STRENGTH, [0.0], [20.0])
    maximum = maximum_stress(TOOTH, STEEL, 20.0, modes)
    assert found == sequence_damage(TOOTH, STEEL, STRENGTH, [0.0], [20.0], modes=modes, position=maximum.position)
    assert found.stress == pytest.approx(maximum.stress, rel=1e-10)
    assert found.position == pytest.approx(0.714, abs=1e-3)
    paper = sequence_damage(TOOTH, STEEL, STRENGTH, [0.0], [20.0], modes=ritz_modes(TOOTH, STEEL))
    assert paper.position == pytest.approx(0.3956, abs=1e-4)
    assert found.stress > 1.28 * paper.stress
    assert found.fatigue_safety < paper.fatigue_safety


def test_no_velocity_does_no_damage():
    found = sequence_damage(TOOTH, STEEL, STRENGTH, [0.0], [0.0])
    assert (found.stress, found.damage, found.cycles) == (0.0, 0.0, 0.0)
    assert found.repeats_to_failure == found.yield_safety == found.fatigue_safety == math.inf


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ((0.0, 5e8, 8e8, -0.1), r"^yield strength = 0 Pa"),
        ((6e8, 5e8, 8e8, -0.1), r"^tensile strength = 5e\+08 Pa.*no less than the yield strength"),
        ((3e8, 5e8, math.nan, -0.1), r"^fatigue strength coefficient = nan Pa"),
        ((3e8, 5e8, 8e8, 0.1), r"^fatigue strength exponent = 0\.1, but"),
    ],
)
def test_impossible_strength_is_refused(values, said):
    with pytest.raises(ValueError, match=said):
        Strength(*values)

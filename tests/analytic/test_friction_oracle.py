"""Friction against the numbers of an oracle, computed in two ways each: stick and slip, pins, impacts, jamming.

One test a kind of case, which takes all numbers from the file. The environment variable FRICTION_ORACLE names another
file with other numbers; kinds that it lacks, and kinds without a test here, are skipped by name.
"""

from __future__ import annotations

import friction_blocks as blocks
import friction_rods as rods
import friction_rotors as rotors
import pytest
from friction_cases import AT_AN_INSTANT, OTHER_FILE, SHARES, Comparison, all_cases, kind_of

from tests.exchanged_oracle import kinds_with_tests, of_kind as skipped_without

#: Kinds with a test below.
KINDS = tuple(map(str, range(1, 9)))
LAWS = ("newton", "poisson", "stronge")


def of_kind(number, *parts, **optional):
    """All cases of a kind, each in its parts; `optional` are those it may be without, by a result that they have."""
    cases = [case for case in all_cases() if kind_of(case) == str(number)]
    pairs = [(case, part) for case in cases for part in parts]
    pairs += [(case, part) for case in cases for result, part in optional.items() if result in case["results"]]
    named = [pytest.param(case, part, id=f"{case['id']}-{part.__name__}") for case, part in pairs]
    return pytest.mark.parametrize(("case", "part"), skipped_without(OTHER_FILE, number, named, arguments=2))


tolerances = pytest.mark.parametrize("tolerance", SHARES)


def compare(case, part, how, share):
    seen = Comparison(share)
    part(case, how, seen)
    seen.check()


@pytest.mark.parametrize("kind", kinds_with_tests(OTHER_FILE, map(kind_of, all_cases()), KINDS))
def test_kind_is_known(kind):
    assert kind in KINDS


@of_kind(1, blocks.thrown, b_t=blocks.pushed, c_t_stop_1=blocks.shaken)
@tolerances
def test_block_on_a_plane(case, part, tolerance):
    compare(case, part, tolerance, SHARES[tolerance])


@of_kind(2, a_t_leaves_belt=blocks.belt, b_period=blocks.den_hartog)
@tolerances
def test_mass_on_a_spring(case, part, tolerance):
    compare(case, part, tolerance, SHARES[tolerance])


@of_kind(3, rotors.rolls, rotors.released)
@tolerances
def test_round_body(case, part, tolerance):
    compare(case, part, tolerance, SHARES[tolerance])


@of_kind(4, rods.slides)
@tolerances
def test_rod_that_slides(case, part, tolerance):
    compare(case, part, tolerance, SHARES[tolerance])


@of_kind(4, rods.jams)
@tolerances
def test_rod_that_jams(case, part, tolerance):
    compare(case, part, tolerance, case["tolerance"]["jam"])


@of_kind(4, rods.table)
def test_rod_at_an_instant(case, part):
    compare(case, part, None, AT_AN_INSTANT)


@of_kind(4, rods.shocks)
def test_rod_that_jumps(case, part):
    compare(case, part, None, AT_AN_INSTANT)


@of_kind(5, rods.strikes)
@pytest.mark.parametrize("law", LAWS)
def test_rod_that_strikes(case, part, law):
    compare(case, part, law, AT_AN_INSTANT)


@of_kind(5, rods.strikes_guarded)
@pytest.mark.parametrize("law", LAWS)
def test_guard_of_the_energy(case, part, law):
    compare(case, part, law, AT_AN_INSTANT)


@of_kind(6, rods.rocks)
@tolerances
def test_block_that_rocks(case, part, tolerance):
    compare(case, part, tolerance, SHARES[tolerance])


@of_kind(6, rods.strikes_flat)
@pytest.mark.parametrize("law", LAWS[:2])
def test_block_that_strikes(case, part, law):
    compare(case, part, law, AT_AN_INSTANT)


@of_kind(7, blocks.stacked)
@tolerances
def test_stacked_blocks(case, part, tolerance):
    compare(case, part, tolerance, SHARES[tolerance])


@of_kind(8, a_rests_at=rotors.braked, b_rests_at=rotors.pinned, c_turns=rotors.on_torsion_spring)
@tolerances
def test_pendulum(case, part, tolerance):
    compare(case, part, tolerance, SHARES[tolerance])

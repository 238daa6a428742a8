"""Lattice worlds: whatever becomes of them, nothing overlaps without a word, and no energy is gained.

How many run to their end is a number of the command (`tests.analytic.run_lattice_worlds`), with its date in
docs/decisions/074-overlap-watch.md: it is not yet what it is to be.
"""

import pytest

from tests.analytic.lattice_worlds import lattice_world
from tests.analytic.run_lattice_worlds import run

#: Worlds whose bodies went into each other without a word before the watch.
WENT_THROUGH = (24, 90, 93, 158, 179, 258, 263, 292)


def check(seed: int) -> None:
    world = lattice_world(seed)
    result = run(world)
    said = f"seed {seed} at {result.time} s: {world.description}: {result.detail}"
    assert not result.fault or result.fault.startswith("refused"), said
    assert "although" not in result.fault, said  # refused as without an answer, and yet there is one


@pytest.mark.parametrize("first", range(0, 100, 20))
def test_nothing_overlaps_in_silence(first: int) -> None:
    for seed in range(first, first + 20):
        check(seed)


@pytest.mark.parametrize("seed", WENT_THROUGH)
def test_worlds_that_went_through(seed: int) -> None:
    check(seed)


@pytest.mark.slow
@pytest.mark.parametrize("first", range(100, 300, 20))
def test_nothing_overlaps_in_silence_in_three_hundred_worlds(first: int) -> None:
    for seed in range(first, first + 20):
        check(seed)


@pytest.mark.parametrize("seed", [26, 47])
def test_a_refusal_is_proved_by_all_modes(seed: int) -> None:
    """Painlevé's paradox of several blocks: all contacts slip, and no modes of theirs have finite forces."""
    result = run(lattice_world(seed))
    if "No set of pushing" in result.detail:
        assert "(proved)" in result.fault

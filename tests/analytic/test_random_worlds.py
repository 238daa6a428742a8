"""Random worlds run to their end: nothing goes into anything, energy never grows, and with e = 1 none is lost."""

import pytest

from tests.analytic.random_worlds import world
from tests.analytic.run_worlds import run

#: Blocks that lie on each other at more places than a mechanism of so many bodies has contacts for: refused by name.
MANY_TOUCH = (80, 121)


def check(seed: int) -> None:
    outcome = run(world(seed))
    assert outcome.fault == "", f"seed {seed} at {outcome.time:.6g} s: {outcome.detail}"


@pytest.mark.parametrize("seed", range(24))
def test_random_worlds(seed: int) -> None:
    check(seed)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [seed for seed in range(24, 128) if seed not in MANY_TOUCH])
def test_a_hundred_random_worlds(seed: int) -> None:
    check(seed)

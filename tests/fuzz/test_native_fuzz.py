"""The short form of `python -m tests.fuzz.native`, and the kept forged states, each of which must be refused."""

from functools import cache

import pytest

import models
from tests.fuzz.forged import HEAD, forged_heads, forged_words
from tests.fuzz.native import VERSIONS, can_run, driver, has_clock, run

pytestmark = pytest.mark.skipif(not can_run(), reason="needs Linux and gcc with its sanitizers")


@pytest.fixture(scope="module")
def driver_of(tmp_path_factory):
    folder = tmp_path_factory.mktemp("fuzz")
    return cache(lambda name, clocks=False: driver(name, folder, clocks))


@pytest.mark.parametrize("fmi", VERSIONS)
@pytest.mark.parametrize("name", models.available())
def test_random_calls_and_forged_states_do_no_harm(driver_of, name, fmi):
    counted = run(driver_of(name), fmi, 20261122, 3000, 300)

    assert counted["calls"] >= 3000
    assert counted["forged"] >= 300
    assert 0 < counted["accepted"] < counted["forged"]
    assert counted["ok"] > counted["refused"] > 0


@pytest.mark.parametrize("name", list(filter(has_clock, models.available())))
def test_nor_do_they_with_a_clock(driver_of, name):
    counted = run(driver_of(name, clocks=True), 3, 20261122, 3000, 300)

    assert counted["ok"] > counted["refused"] > 0
    assert 0 < counted["accepted"] < counted["forged"]


@pytest.mark.parametrize("fmi", VERSIONS)
@pytest.mark.parametrize("name", models.available())
def test_kept_forged_states_are_refused(driver_of, name, fmi):
    before = len(HEAD) + len(models.load(name).MODEL.parameters)
    words = [(place, bits) for _, place, bits in forged_heads()]
    words += [(before + place, bits) for _, place, bits in forged_words(models.load(name).MODEL)]
    assert len(words) > 60

    counted = run(driver_of(name), fmi, 1, 0, 0, *(str(x) for place, bits in words for x in (place, f"{bits:x}")))

    assert counted["forged"] == len(words)
    assert counted["accepted"] == 0

"""Units of a page are chosen by size."""

import math

import pytest
from hypothesis import given, strategies as st

from harness.fmu.units import Units
from harness.page.shown_units import LADDERS, shown_unit


@pytest.mark.parametrize(
    ("unit", "magnitude", "shown"),
    [
        ("m", 0.13, "mm"),
        ("m", 1.5, "m"),
        ("kg", 5.6264, "kg"),
        ("kg", 0.0976, "g"),
        ("kg.m2", 9e-5, "kg.mm2"),
        ("N.m", 0.001, "N.mm"),
        ("N.m", -20.0, "N.m"),
        ("Pa", 2e8, "MPa"),
        ("J", 3e-4, "uJ"),
        ("m", 0.0, "m"),
        ("m", math.inf, "m"),
        ("V", 1e-6, "V"),
    ],
)
def test_the_unit_in_which_a_number_is_nearest_to_ten(unit: str, magnitude: float, shown: str) -> None:
    assert shown_unit(unit, magnitude)[0] == shown


@given(st.sampled_from(sorted(LADDERS)), st.floats(1e-12, 1e12))
def test_the_factor_is_that_of_the_units(unit: str, magnitude: float) -> None:
    shown, factor = shown_unit(unit, magnitude)
    assert Units().convert(1.0, unit, shown) == pytest.approx(factor, rel=1e-12)

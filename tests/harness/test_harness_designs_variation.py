"""Where the values of something that is varied lie between its limits."""

import math
from dataclasses import replace

import pytest
from cheap_designs import axis

ANGLE = axis("tooth_slope_angle", 90.0, 180.0, unit="deg")
COUNT = axis("tooth_count", 10, 19)
LISTED = replace(axis("restitution"), values=(0.1, 0.5, 0.7, 0.9))


@pytest.mark.parametrize(("part", "degrees"), [(0.0, 90.0), (0.25, 112.5), (1.0, 180.0)])
def test_a_number_lies_at_its_part_of_the_way_and_back(part: float, degrees: float) -> None:
    value = ANGLE.at(part)
    assert value == pytest.approx(math.radians(degrees), rel=1e-15)
    assert ANGLE.fraction(float(value)) == pytest.approx(part, abs=1e-15)


def test_both_limits_are_reached_exactly_and_nothing_beyond() -> None:
    assert (ANGLE.fraction(ANGLE.real(90.0)), ANGLE.fraction(ANGLE.real(180.0))) == (0.0, 1.0)
    assert (ANGLE.fraction(0.0), ANGLE.fraction(10.0)) == (0.0, 1.0)
    assert ANGLE.real(80.0) == ANGLE.real(90.0)
    assert ANGLE.real(190.0) == ANGLE.real(180.0)


@pytest.mark.parametrize(("part", "count"), [(0.0, 10), (0.0999, 10), (0.1001, 11), (0.9, 19), (0.9999, 19), (1.0, 19)])
def test_whole_numbers_are_equally_wide(part: float, count: int) -> None:
    assert COUNT.at(part) == count


@pytest.mark.parametrize(("part", "value"), [(0.0, 0.1), (0.2499, 0.1), (0.25, 0.5), (0.75, 0.9), (1.0, 0.9)])
def test_values_of_a_list_are_equally_wide(part: float, value: float) -> None:
    assert LISTED.at(part) == value


def test_how_many_values_there_are() -> None:
    assert (ANGLE.count, COUNT.count, LISTED.count) == (math.inf, 10, 4)

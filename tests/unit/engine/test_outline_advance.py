"""The bound of speed with which two outlines are looked at holds for every step that the dense output can describe."""

import numpy as np
import pytest

from mechanism_fmu.engine.outlines.advance import _SLOPE
from mechanism_fmu.tables.method import METHOD


def multiplied(row: int, t: np.ndarray) -> np.ndarray:
    """What a row of the dense output is multiplied by at parts of the step (`engine.interpolation`)."""
    powers = row - 1
    return t * t ** (powers // 2) * (1.0 - t) ** ((powers + 1) // 2)


@pytest.mark.parametrize("row", range(1, METHOD.dense_rows))
def test_no_row_changes_faster_than_the_bound_says(row: int) -> None:
    t = np.linspace(0.0, 1.0, 20_001)
    slopes = np.abs(np.diff(multiplied(row, t)) / np.diff(t))
    assert slopes.max() <= (1.0 + 1e-9 if row <= 3 else _SLOPE)
    assert slopes.max() > 0.02  # it is a bound of something


def test_the_rows_are_those_of_the_interpolation() -> None:
    """The nested form, written out."""
    chance = np.random.default_rng(1)
    dense = chance.standard_normal(METHOD.dense_rows)
    t = 0.37
    value = dense[-1]
    for row in range(METHOD.dense_rows - 2, -1, -1):
        value = dense[row] + (t if row % 2 == 0 else 1.0 - t) * value
    written = dense[0] + sum(dense[row] * multiplied(row, np.array(t)) for row in range(1, METHOD.dense_rows))
    assert written == pytest.approx(value, rel=1e-13)

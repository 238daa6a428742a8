"""The curve through points is that of scipy, and monotone where they are."""

import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.interpolate import PchipInterpolator

from mechanism_fmu.stress.interpolation import monotone_cubic

POINTS = st.lists(st.tuples(st.floats(0.1, 2.0), st.sampled_from((0.0, 1.0, -1.0, 2.5, 0.3))), min_size=2, max_size=8)


@given(POINTS)
def test_it_is_that_of_scipy(points: list[tuple[float, float]]) -> None:
    places = np.cumsum([step for step, _ in points])
    values = [value for _, value in points]
    at = np.linspace(places[0] - 0.05, places[-1] + 0.05, 97)
    found, expected = monotone_cubic(places.tolist(), values)(at), PchipInterpolator(places, values)(at)
    assert found == pytest.approx(expected, rel=1e-12, abs=1e-12)


@given(POINTS)
def test_it_overshoots_nowhere(points: list[tuple[float, float]]) -> None:
    places = np.cumsum([step for step, _ in points])
    values = np.array([value for _, value in points])
    curve = monotone_cubic(places.tolist(), values.tolist())
    assert curve(places) == pytest.approx(values, abs=1e-12)
    for k in range(len(places) - 1):
        between = curve(np.linspace(places[k], places[k + 1], 50))
        low, high = sorted(values[k : k + 2])
        assert between.min() >= low - 1e-12
        assert between.max() <= high + 1e-12

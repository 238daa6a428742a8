"""Andrews' squeezing mechanism against the values that were published."""

import numpy as np
import pytest
from gallery_examples import run

from benchmarks.world.cases.andrews import AT_START, COMPUTED, PRINTED, gaps, second_formulation, source_angles

PUBLISHED = np.array([float(digits) for digits in PRINTED])


def angles(**values: float) -> np.ndarray:
    """The seven angles of the sources at the start and at t = 0.03 s, shape (2, 7) [rad]."""
    found = run("andrews", (0.0, 0.03), **values)
    return np.array(source_angles(*(found[f"K{k}"] for k in range(1, 8)))).T


def test_its_start_follows_from_lengths() -> None:
    np.testing.assert_allclose(angles()[0], AT_START, rtol=0, atol=2e-15)


@pytest.mark.parametrize(("tolerance", "relative"), [(1e-9, 1e-9), (1e-12, 5e-10)])
def test_the_published_values(tolerance: float, relative: float) -> None:
    """At both tolerances gamma is off by 2.8e-10 of itself: so much are the printed digits off."""
    np.testing.assert_allclose(angles(relative_tolerance=tolerance)[1], PUBLISHED, rtol=relative, atol=0)


def test_a_tighter_tolerance_changes_less_than_the_printed_digits_are_off() -> None:
    tight, tighter = (angles(relative_tolerance=tolerance)[1] for tolerance in (1e-12, 1e-13))
    np.testing.assert_allclose(tight, tighter, rtol=1e-11, atol=0)
    assert abs(tighter[2] / PUBLISHED[2] - 1) == pytest.approx(2.7e-10, rel=0.05)
    np.testing.assert_allclose(tighter, COMPUTED, rtol=1e-12, atol=0)


def test_seven_angles_of_the_source_give_the_computed_values() -> None:
    """What they are off the closures at the end is what the integration has let go."""
    assert np.abs(gaps(AT_START)).max() < 1e-16
    found = second_formulation()
    assert np.abs(gaps(found)).max() < 1e-14
    np.testing.assert_allclose(found, COMPUTED, rtol=2e-12, atol=0)

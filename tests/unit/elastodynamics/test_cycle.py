"""A whole cycle of Case 2."""

import numpy as np
import pytest

from benchmarks.path_generator import INCH, PathGenerator
from mechanism_fmu.elastodynamics import configurations, linkage, quasi_static
from mechanism_fmu.kinematics import analyse

GENERATOR = PathGenerator()
MECHANISM = GENERATOR.mechanism()


def cycle(degrees):
    motion = analyse(MECHANISM, np.radians(degrees) / GENERATOR.speed)
    return quasi_static(configurations(linkage(MECHANISM), motion))


def test_the_largest_deviation_is_the_known_one():
    around, near = cycle(np.arange(0.0, 360.0, 6.0)), cycle(np.arange(13.25, 13.36, 0.001))
    largest = near.deviation("arm.end").max()
    assert largest / INCH == pytest.approx(0.0744696716, abs=6e-11)  # known to ten digits
    assert around.deviation("arm.end").max() < largest


def test_deflections_grow_with_the_square_of_the_speed():
    slow = PathGenerator(speed=GENERATOR.speed / 3)
    mechanism = slow.mechanism()
    degrees = np.arange(0.0, 120.0, 15.0)
    other = quasi_static(configurations(linkage(mechanism), analyse(mechanism, np.radians(degrees) / slow.speed)))
    for found, wanted in zip(
        (other.displacement, other.stress), (cycle(degrees).displacement, cycle(degrees).stress), strict=True
    ):
        np.testing.assert_allclose(9 * found, wanted, rtol=1e-9, atol=1e-9 * np.abs(wanted).max())

import math

import numpy as np
import pytest

from mechanism_fmu.elastodynamics.elastic_cycle import ElasticCycle, instantaneous_modes
from mechanism_fmu.elastodynamics.responses import critical_speeds, speed_sweep
from tests import bending_four_bar as four_bar


def test_critical_speeds_are_mean_frequencies_over_harmonics():
    stiffness = np.array([np.diag([4.0, 100.0]), np.diag([16.0, 144.0])])
    found = critical_speeds(instantaneous_modes(stiffness, np.eye(2)), 3)
    np.testing.assert_allclose(found, [[3.0, 1.5, 1.0], [11.0, 5.5, 11 / 3]], rtol=1e-14)


def test_sweep_of_one_mass_is_its_magnification_and_peaks_where_it_must():
    theta = 2 * math.pi / 66 * np.arange(66)

    # Natural frequency 10 rad/s, 5 % of damping, a load of twice the crank's frequency, which grows with its square.
    stiffness, load = np.full((66, 1, 1), 100.0), 100.0 * np.cos(2 * theta)[:, None]
    at_5 = ElasticCycle(2 * math.pi / 5.0, [[1.0]], [[1.0]], stiffness, load)
    speeds = np.linspace(2.0, 8.0, 25)
    done = []
    found = speed_sweep(at_5, 5.0, speeds / 5.0, lambda u: np.abs(u[:, 0]), on_speed=done.append)
    assert done == list(range(25))
    r = 2 * speeds / 10
    exact = 1 / np.hypot(1 - r**2, 2 * 0.05 * r)
    # The largest of 66 samples misses the peak by less than 1 - cos(2 * 2 pi / 132).
    quasi_static = (speeds / 5.0) ** 2
    np.testing.assert_allclose(found.dynamic, quasi_static * exact, rtol=1 - math.cos(4 * math.pi / 132) + 1e-9)
    np.testing.assert_allclose(found.static, quasi_static, rtol=1e-12)
    critical = critical_speeds(instantaneous_modes(np.array([[[100.0]]]), np.eye(1)), 2)[0, 1]
    assert speeds[(found.dynamic / found.static).argmax()] == critical == 5.0


def test_the_path_generator_peaks_within_a_few_percent_of_a_critical_speed():
    cycle = four_bar.cycle(500, 180)
    mean = critical_speeds(instantaneous_modes(cycle.stiffness, cycle.mass), 10)[0] * 30 / math.pi
    near = mean[7]  # harmonic 8 of the crank meets the first frequency
    factors = near / 500 * np.array([0.94, 1.0, 1.06])
    found = speed_sweep(four_bar.cycle(500, 300), 500 * math.pi / 30, factors, lambda u: np.hypot(u[:, 0], u[:, 1]))
    np.testing.assert_allclose(found.speed, near * math.pi / 30 * np.array([0.94, 1.0, 1.06]))
    magnification = found.dynamic / found.static
    assert magnification.argmax() == 1


def test_a_faster_cycle_is_that_of_the_faster_linkage():
    found, expected = four_bar.cycle(500, 24).faster(1.7), four_bar.cycle(850, 24)
    assert found.period == pytest.approx(expected.period, rel=1e-14)
    for name in ("mass", "damping", "stiffness", "load"):
        part = getattr(expected, name)
        np.testing.assert_allclose(getattr(found, name), part, atol=1e-12 * np.abs(part).max())
    with pytest.raises(ValueError, match="the speed is 0 times"):
        expected.faster(0.0)


def test_no_harmonics_are_refused():
    with pytest.raises(ValueError, match="ask for one or more"):
        critical_speeds(instantaneous_modes(np.eye(2)[None], np.eye(2)), 0)

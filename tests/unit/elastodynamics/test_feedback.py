import warnings

import numpy as np
import pytest

from mechanism_fmu.elastodynamics.elastic_cycle import ElasticCycle
from mechanism_fmu.elastodynamics.responses import fed_back, periodic_response
from tests import bending_four_bar as four_bar


def one_mass(ratio, samples=33):
    """One harmonic load on a constant spring, turned at `ratio` of the natural frequency."""
    theta = 2 * np.pi / samples * np.arange(samples)
    return ElasticCycle(2 * np.pi, [[ratio**2]], [[0.0]], np.ones((samples, 1, 1)), np.cos(theta)[:, None])


def test_below_resonance_the_geometric_series_is_summed():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = fed_back(one_mass(0.5))
    assert found.converged
    np.testing.assert_allclose(found.displacement[0], 1 / (1 - 0.25), rtol=1e-8)
    # Each round adds (Omega / omega)^2 of the one before.
    np.testing.assert_allclose(found.changes[1:] / found.changes[:-1], 0.25, rtol=1e-5)


def test_above_resonance_it_stops_at_once_and_says_so():
    with pytest.warns(UserWarning, match="settles to 4 of the quasi-static deviation after 2 rounds"):
        found = fed_back(one_mass(2.0))
    assert not found.converged


def test_the_path_generator_at_low_speed_comes_to_the_periodic_motion():
    cycle = four_bar.cycle(rpm=100, samples=240)
    found, static = fed_back(cycle), cycle.static()
    expected = periodic_response(cycle).samples(240)
    assert found.converged
    np.testing.assert_allclose(found.displacement, expected, atol=1e-8 * np.abs(expected).max())
    assert np.abs(static - expected).max() > 1e-3 * np.abs(expected).max()


def test_at_500_rpm_it_stalls():
    with pytest.warns(UserWarning, match="Take periodic_response"):
        found = fed_back(four_bar.cycle(rpm=500, samples=180))
    assert not found.converged
    assert len(found.changes) < 10
    assert found.changes.min() > 1e-3


def test_without_load_nothing_happens():
    unloaded = ElasticCycle(1.0, [[1.0]], [[0.0]], np.ones((8, 1, 1)), np.zeros((8, 1)))
    found = fed_back(unloaded)
    assert found.converged
    assert not found.displacement.any()

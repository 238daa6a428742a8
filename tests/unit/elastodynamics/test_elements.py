"""Flexibility matrices against beam theory: the work of unit forces, integrated over the beam."""

import numpy as np
import pytest
from hypothesis import given, strategies as st
from numpy.polynomial.legendre import leggauss

from mechanism_fmu.elastodynamics import (
    bent_coupler,
    cantilever,
    spatial_link,
    supported_beam,
    torsion_shaft,
    two_force_member,
)
from mechanism_fmu.model import Section

beams = st.tuples(
    st.floats(0.01, 10.0),
    st.builds(Section.rectangle, st.floats(1e-3, 0.1), st.floats(1e-3, 0.1)),
    st.floats(1e9, 4e11),
)


def by_unit_forces(length, section, young, internal):
    """F_jk = integral of N_j N_k/EA + M_j M_k/EI, for (N, M) at distances x from the left end, by unit forces."""
    places, weights = leggauss(4)
    x = 0.5 * length * (places + 1)
    normal, moment = (np.array([np.broadcast_to(part(x), x.shape) for part in parts]) for parts in internal)
    area, bending = young * section.area, young * section.second_moment
    return 0.5 * length * ((normal * weights) @ normal.T / area + (moment * weights) @ moment.T / bending)


def none(x):
    return 0.0


def one(x):
    return 1.0


@given(beams)
def test_a_cantilever(beam):
    length = beam[0]
    internal = (one, none, none), (none, lambda x: length - x, one)
    np.testing.assert_allclose(cantilever(*beam), by_unit_forces(*beam, internal), rtol=1e-12)


@given(beams)
def test_a_beam_on_two_supports_with_an_end_moment(beam):
    length = beam[0]
    internal = (one, none), (none, lambda x: 1 - x / length)
    np.testing.assert_allclose(supported_beam(*beam), by_unit_forces(*beam, internal), rtol=1e-12)


@given(beams)
def test_links_with_fewer_ways_to_be_loaded_are_parts_of_these(beam):
    np.testing.assert_array_equal(two_force_member(*beam), cantilever(*beam)[:1, :1])
    np.testing.assert_array_equal(spatial_link(*beam), np.diag(np.diag(cantilever(*beam))[:2]))


@given(beams, st.floats(0.1, 3.0))
def test_a_bent_coupler_is_a_cantilever_and_a_supported_beam(beam, ratio):
    found = bent_coupler(ratio * beam[0], *beam)
    np.testing.assert_array_equal(found[:3, :3], cantilever(ratio * beam[0], *beam[1:]))
    np.testing.assert_array_equal(found[3:, 3:], supported_beam(*beam))
    assert not found[:3, 3:].any()
    assert not found[3:, :3].any()


def test_a_shaft_twists_as_tables_say():
    radius, length, shear_modulus = 0.01, 0.5, 80e9
    angle = 30.0 * torsion_shaft(length, np.pi * radius**4 / 2, shear_modulus)[0, 0]
    assert angle == pytest.approx(2 * 30.0 * length / (np.pi * radius**4 * shear_modulus), rel=1e-14)

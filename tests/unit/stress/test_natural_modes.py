import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from mechanism_fmu.stress import (
    STEEL,
    End,
    ModeScaling,
    RectangularTooth,
    TrapezoidTooth,
    WedgeTooth,
    bending_stress,
    damped_response,
    maximum_stress,
    natural_modes,
    ritz_modes,
)
from mechanism_fmu.stress.ritz import admissible

TOOTH = WedgeTooth(length=0.05, apex_angle=0.5)
ALL_ENDS = list(itertools.product(End, End))
ENDS = np.array([0.0, 1.0])
XI, WEIGHTS = ((values + shift) / 2 for values, shift in zip(np.polynomial.legendre.leggauss(100), (1, 0), strict=True))


def names(ends):
    return "-".join(end.name for end in ends)


def participation(beam, mode, field):
    """Integral of rho A u field over the length, by a rule of its own."""
    mass = STEEL.density * beam.length * WEIGHTS * beam.area(XI * beam.length)
    return float(mass @ (mode.shape(XI) * field(XI)))


@pytest.mark.parametrize("ends", ALL_ENDS, ids=names)
@pytest.mark.parametrize("terms", [1, 2, 5, 30])
def test_basis_is_orthonormal_and_held_at_its_ends(ends, terms):
    basis = admissible(terms, *ends)
    np.testing.assert_allclose(basis.T @ basis, np.eye(terms), atol=1e-14)
    degrees = [int(np.flatnonzero(np.abs(column) > 1e-9).max()) for column in basis.T]
    assert degrees == sorted(degrees)


@pytest.mark.parametrize("ends", ALL_ENDS, ids=names)
def test_modes_are_held_at_their_ends_and_free_elsewhere(ends):
    root, tip = ends
    beam = TrapezoidTooth(0.05, 0.01, 0.005)
    mode = natural_modes(beam, STEEL, 20, root=root, tip=tip)[0]
    for place, end in enumerate(ends):
        for order in (0, 1):
            value = mode.shape(ENDS, derivative=order)[place]
            assert (abs(value) < 1e-10) == (order in end.vanishing)
        # What is not held follows by itself: no moment where it may turn, no shear force where it may move.
        moment = mode.shape(ENDS, derivative=2)[place] / np.abs(mode.shape(np.linspace(0, 1, 99), derivative=2)).max()
        assert (abs(moment) < 1e-4) == (1 not in end.vanishing)


@pytest.mark.parametrize("ends", ALL_ENDS, ids=names)
def test_beam_turned_round_has_the_same_frequencies(ends):
    root, tip = ends
    one = natural_modes(TrapezoidTooth(0.05, 0.01, 0.005), STEEL, 16, root=root, tip=tip)
    other = natural_modes(TrapezoidTooth(0.05, 0.005, 0.01), STEEL, 16, root=tip, tip=root)
    for a, b in zip(one[:4], other[:4], strict=True):
        assert a.natural_frequency == pytest.approx(b.natural_frequency, rel=1e-10)


def test_two_terms_on_the_wedge_are_the_papers_modes():
    xi = np.linspace(0.0, 1.0, 21)
    for natural, paper in zip(natural_modes(TOOTH, STEEL, 2), ritz_modes(TOOTH, STEEL), strict=True):
        assert natural.natural_frequency == paper.natural_frequency
        assert (natural.mass, natural.stiffness) == (paper.mass, paper.stiffness)
        np.testing.assert_allclose(natural.shape(xi), paper.shape(xi), atol=1e-14)
    assert maximum_stress(TOOTH, STEEL, 1.0, natural_modes(TOOTH, STEEL, 2)).coefficient == pytest.approx(
        maximum_stress(TOOTH, STEEL, 1.0).coefficient, rel=1e-12
    )


@pytest.mark.parametrize("ends", ALL_ENDS, ids=names)
def test_modes_do_not_exchange_energy(ends):
    beam = TrapezoidTooth(0.05, 0.01, 0.004)
    modes = natural_modes(beam, STEEL, 14, root=ends[0], tip=ends[1], rigid=True)
    assert len(modes) == 14
    for one, other in itertools.combinations(modes[:6], 2):
        scale = math.sqrt(one.mass * other.mass)
        assert abs(participation(beam, one, other.shape)) < 1e-10 * scale


def test_modal_mass_is_the_integral_of_equation_9():
    for mode in natural_modes(TOOTH, STEEL, 8)[:4]:
        assert mode.mass == pytest.approx(participation(TOOTH, mode, mode.shape), rel=1e-10)


@pytest.mark.parametrize(
    ("ends", "named"),
    [
        ((End.FREE, End.FREE), ["rigid translation", "rigid rotation"]),
        ((End.PINNED, End.FREE), ["rigid rotation"]),
        ((End.FREE, End.PINNED), ["rigid rotation"]),
        ((End.GUIDED, End.FREE), ["rigid translation"]),
        ((End.GUIDED, End.GUIDED), ["rigid translation"]),
        ((End.PINNED, End.GUIDED), []),
        ((End.PINNED, End.PINNED), []),
        ((End.CLAMPED, End.FREE), []),
    ],
)
def test_rigid_modes_are_named_or_left_out(ends, named):
    beam = TrapezoidTooth(0.05, 0.02, 0.01)
    bending = natural_modes(beam, STEEL, 12, root=ends[0], tip=ends[1])
    every = natural_modes(beam, STEEL, 12, root=ends[0], tip=ends[1], rigid=True)
    assert [mode.name for mode in every if not mode.name.startswith("bending")] == named
    assert every[len(named) :] == bending
    assert [mode.name for mode in bending[:2]] == ["bending 1", "bending 2"]
    assert all(mode.natural_frequency == 0.0 for mode in every[: len(named)])
    assert all(mode.natural_frequency > 1e3 for mode in bending)


def test_free_beam_turns_about_its_centre_of_mass():
    beam = TrapezoidTooth(0.05, 0.02, 0.01, 0.02)
    translation, rotation = natural_modes(beam, STEEL, 4, root=End.FREE, tip=End.FREE, rigid=True)[:2]
    assert translation.mass == pytest.approx(STEEL.density * 0.02 * 0.015 * 0.05)
    centre = (0.02 + 2 * 0.01) / (3 * (0.02 + 0.01))  # of a trapezoid, from the larger side
    assert rotation.shape(np.array([centre]))[0] == pytest.approx(0.0, abs=1e-14)
    assert rotation.shape(ENDS, derivative=1) == pytest.approx([1.0, 1.0])


def test_rigid_mode_has_no_stress():
    modes = natural_modes(TOOTH, STEEL, 4, root=End.PINNED, rigid=True)
    with pytest.raises(ValueError, match=r"a rigid mode bends nothing.*leave it out"):
        bending_stress(TOOTH, STEEL, 1.0, 0.0, 0.0, modes=modes)


def test_first_coefficient_of_every_kind_of_root_is_1():
    for root, power in ((End.CLAMPED, 2), (End.PINNED, 1), (End.GUIDED, 0), (End.FREE, 0)):
        for mode in natural_modes(TrapezoidTooth(0.05, 0.02, 0.01), STEEL, 10, root=root, tip=End.PINNED)[:3]:
            value = mode.shape(ENDS, derivative=power)[0] / math.factorial(power)
            assert value == pytest.approx(1.0, rel=1e-9)


@pytest.mark.parametrize("beam", [TOOTH, RectangularTooth(0.05, 0.01)], ids=["wedge", "rectangle"])
def test_projected_modes_add_up_to_the_rigid_rotation(beam):
    xi = np.linspace(0.0, 1.0, 21)
    weight = np.sqrt(beam.area(xi * beam.length))
    errors = []
    for terms in (4, 8, 16, 32):
        whole = sum(mode.shape(xi) for mode in natural_modes(beam, STEEL, terms, scaling=ModeScaling.PROJECTION))
        errors.append(np.linalg.norm(weight * (whole - xi)) / np.linalg.norm(weight * xi))
    assert errors == sorted(errors, reverse=True)
    assert errors[-1] < 2e-3


def test_projection_is_the_least_squares_fit_in_kinetic_energy():
    modes = natural_modes(TOOTH, STEEL, 6, scaling=ModeScaling.PROJECTION)
    for mode in modes:
        assert participation(TOOTH, mode, lambda xi: xi) == pytest.approx(mode.mass, rel=1e-9)
    # Parseval: the energies of the modes add up to no more than that of the rotation.
    rotation = STEEL.density * 0.02 * math.tan(0.5) * 0.05**2 / 12
    assert 0.99 * rotation < sum(mode.mass for mode in modes) <= rotation


def test_projection_starts_the_whole_tooth_at_the_velocity_of_a_rigid_rotation():
    modes = natural_modes(TOOTH, STEEL, 30, scaling=ModeScaling.PROJECTION)
    frequencies = np.array([mode.natural_frequency for mode in modes])
    step = 1e-4 / frequencies.max()
    velocity = damped_response(frequencies, STEEL.damping_ratio, 2.0, np.array([step]))[:, 0] / step
    xi = np.linspace(0.2, 0.95, 6)
    np.testing.assert_allclose(velocity @ np.array([mode.shape(xi) for mode in modes]), 2.0 * xi, rtol=5e-3)


def test_numbers_of_the_decision_on_scaling():
    # docs/decisions/003-mode-scaling.md
    projected = maximum_stress(TOOTH, STEEL, 1.0, ritz_modes(TOOTH, STEEL, scaling=ModeScaling.PROJECTION))
    assert projected.coefficient == pytest.approx(0.865809, abs=1e-6)
    assert projected.position == pytest.approx(0.479, abs=5e-4)
    for count, coefficient, place in ((2, 0.889374, 0.6758), (6, 1.004120, 0.7119), (12, 1.013084, 0.7138)):
        modes = natural_modes(TOOTH, STEEL, 20, scaling=ModeScaling.PROJECTION)[:count]
        found = maximum_stress(TOOTH, STEEL, 1.0, modes)
        assert found.coefficient == pytest.approx(coefficient, abs=1e-6)
        assert found.position == pytest.approx(place, abs=1e-4)


def test_exact_modes_of_a_wedge_with_a1_equal_1_are_projected_already():
    # docs/decisions/003-mode-scaling.md; the uniform beam has twice the coefficient.
    for beam, factor in ((TOOTH, 1.0), (RectangularTooth(0.05, 0.01), 2.0)):
        first = natural_modes(beam, STEEL, 24)[:6]
        projected = natural_modes(beam, STEEL, 24, scaling=ModeScaling.PROJECTION)[:6]
        for one, other in zip(first, projected, strict=True):
            assert math.sqrt(other.mass / one.mass) == pytest.approx(factor, rel=1e-7)


@pytest.mark.parametrize("beam", [TOOTH, TrapezoidTooth(0.05, 0.02, 0.002)], ids=["wedge", "trapezoid"])
def test_largest_stress_of_many_modes_is_that_of_a_fine_grid(beam):
    modes = natural_modes(beam, STEEL, 24, scaling=ModeScaling.PROJECTION)[:10]
    found = maximum_stress(beam, STEEL, 1.0, modes)
    t = np.arange(0.0, 1.0, 2e-3) * 2 * math.pi / modes[0].natural_frequency
    around = found.time + np.linspace(-0.05, 0.05, 101) * 2 * math.pi / modes[-1].natural_frequency
    x = np.linspace(0.0, beam.length, 301)
    coarse, fine = (np.abs(bending_stress(beam, STEEL, 1.0, x, times, modes)).max() for times in (t, around))
    assert coarse <= found.stress * (1 + 1e-12)
    assert fine == pytest.approx(found.stress, rel=1e-4)


def test_mode_without_part_in_the_rotation_has_no_projection():
    beam = RectangularTooth(0.05, 0.01)
    with pytest.raises(ValueError, match=r"bending 1 takes no part in a rotation about the root.*FIRST_COEFFICIENT"):
        natural_modes(beam, STEEL, 8, root=End.PINNED, scaling=ModeScaling.PROJECTION)


@settings(deadline=None, max_examples=20)
@given(length=st.floats(1e-3, 10.0), slenderness=st.floats(1.0, 100.0), taper=st.floats(0.05, 1.0))
def test_frequencies_scale_with_height_over_length_squared(length, slenderness, taper):
    height = length / slenderness
    one = natural_modes(TrapezoidTooth(1.0, 0.1, 0.1 * taper), STEEL, 10)
    other = natural_modes(TrapezoidTooth(length, height, height * taper), STEEL, 10)
    for a, b in zip(one[:3], other[:3], strict=True):
        assert b.natural_frequency == pytest.approx(a.natural_frequency * height / 0.1 / length**2, rel=1e-10)


def test_more_terms_never_raise_a_frequency():
    for ends in ALL_ENDS:
        found = [
            [mode.natural_frequency for mode in natural_modes(TOOTH, STEEL, n, root=ends[0], tip=ends[1])]
            for n in range(4, 11)
        ]
        for fewer, more in itertools.pairwise(found):
            assert all(b <= a * (1 + 1e-10) for a, b in zip(fewer, more[:-1], strict=True))


@pytest.mark.parametrize(
    ("ends", "least"), [((End.CLAMPED, End.FREE), 1), ((End.FREE, End.FREE), 3)], ids=["one", "two"]
)
@pytest.mark.parametrize("terms", [0, 61])
def test_number_of_terms_outside_its_limits_is_refused(ends, least, terms):
    with pytest.raises(ValueError, match=rf"^number of Ritz terms = {terms}, but .* between {least} and 60"):
        natural_modes(TOOTH, STEEL, terms, root=ends[0], tip=ends[1])

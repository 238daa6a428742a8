import math

import numpy as np
import pytest
from hypothesis import given, strategies as st

from benchmarks.path_generator import PathGenerator
from mechanism_fmu.elastodynamics import configurations, inertia_forces, linkage, mass_matrix, system_forces
from mechanism_fmu.elastodynamics.elastic_cycle import instantaneous_modes
from mechanism_fmu.elastodynamics.structure.masses import beam_mass, consistent_load, consistent_mass
from mechanism_fmu.kinematics import analyse
from mechanism_fmu.model import GROUND, AngleDriver, Body, Mechanism, Member, Revolute, Section
from mechanism_fmu.model.curves.motions import polynomial_motion

SECTION, YOUNG, DENSITY, LENGTH = Section.rectangle(0.02, 0.01), 210e9, 7850.0, 0.5


def rod(pieces, speed=0.0, speeding=0.0):
    """A clamped rod in `pieces`, which a driver holds or turns."""
    x = np.linspace(0.0, LENGTH, pieces + 1)
    members = tuple(
        Member(f"bar{k}", "rod", (x[k], 0.0), (x[k + 1], 0.0), SECTION, YOUNG, DENSITY) for k in range(pieces)
    )
    mechanism = Mechanism(
        bodies=(Body("rod", 1.0, 1.0, (0.0, 0.0, 0.3)),),
        joints=(
            Revolute("hinge", "rod", (0.0, 0.0), GROUND, (0.0, 0.0)),
            AngleDriver("drive", "rod", polynomial_motion(0.3, speed, speeding / 2)),
        ),
        members=members,
    )
    return configurations(linkage(mechanism), analyse(mechanism, [0.0]))


@given(st.floats(0.01, 10.0), st.floats(0.01, 10.0), st.tuples(*[st.floats(-3.0, 3.0)] * 3))
def test_a_beam_that_moves_as_a_whole_has_the_energy_of_a_rigid_bar(mass, length, speeds):
    along, across, turn = speeds
    ends = np.array([along, across, turn, along, across + turn * length, turn])
    middle = across + turn * length / 2
    energy = mass / 2 * (along**2 + middle**2) + mass * length**2 / 12 * turn**2 / 2
    assert ends @ beam_mass(mass, length) @ ends / 2 == pytest.approx(energy, rel=1e-10, abs=1e-12)


def test_frequencies_of_a_cantilever_converge_to_the_exact_ones_as_the_fourth_power():
    # (beta l)^2 sqrt(EI / m l^4) with cosh x cos x = -1.
    per_length = DENSITY * SECTION.area
    exact = np.array([1.8751040687119611, 4.694091132974174]) ** 2 * math.sqrt(
        YOUNG * SECTION.second_moment / per_length / LENGTH**4
    )
    errors = []
    for pieces in (4, 8, 16):
        c = rod(pieces)
        omega = instantaneous_modes(c.stiffness, consistent_mass(c)).omega[0]
        errors.append(omega[:2] / exact - 1)
    assert np.all(np.array(errors) > 0)  # Rayleigh: never below
    np.testing.assert_allclose(np.log2(np.divide(errors[:-1], errors[1:])), 4.0, atol=0.15)
    # Lumped, they come from below, as the square.
    lumped = [instantaneous_modes(c.stiffness, mass_matrix(c)).omega[0, 0] / exact[0] - 1 for c in map(rod, (4, 8))]
    assert lumped[0] < lumped[1] < 0
    assert math.log2(lumped[0] / lumped[1]) == pytest.approx(2.0, abs=0.2)


def test_a_spinning_rod_is_stretched_and_a_speeding_one_bent_as_by_hand():
    speed, speeding = 30.0, 200.0
    c = rod(4, speed, speeding)
    load = system_forces(c, inertia_forces(c))[0] + consistent_load(c)[0]
    u = np.linalg.solve(c.stiffness[0], load)
    tip = c.displacement("bar3.end")[0] @ u
    along = tip[:2] @ [math.cos(0.3), math.sin(0.3)]
    across = tip[:2] @ [-math.sin(0.3), math.cos(0.3)]
    m, ei, ea = DENSITY * SECTION.area, YOUNG * SECTION.second_moment, YOUNG * SECTION.area
    # Nodes of consistent elements are exact for polynomial loads of the beam.
    assert along == pytest.approx(m * speed**2 * LENGTH**3 / (3 * ea), rel=1e-9)
    assert across == pytest.approx(-11 * m * speeding * LENGTH**5 / (120 * ei), rel=1e-9)
    assert tip[2] == pytest.approx(-m * speeding * LENGTH**4 / (8 * ei), rel=1e-9)


def test_the_path_generator_has_the_same_mass_either_way():
    mechanism = PathGenerator().mechanism()
    c = configurations(linkage(mechanism), analyse(mechanism, [0.0, 0.01]))
    consistent, lumped = consistent_mass(c), mass_matrix(c)
    eigenvalues = np.linalg.eigvalsh(consistent)
    assert np.all(eigenvalues > 0)
    # Less mass moves in the lowest mode when it is spread: half of a link's is not all at its end.
    first = [instantaneous_modes(c.stiffness, m).omega[:, 0] for m in (consistent, lumped)]
    assert np.all(first[0] > first[1])
    np.testing.assert_allclose(first[0], first[1], rtol=0.1)

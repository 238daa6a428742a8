"""The bending four-bar path generator in motion: the engine against Case 2 and the flexibility approach."""

import math

import numpy as np
import pytest

from mechanism_fmu.simulation import Simulation
from tests.path_generator import DEFLECTIONS, IMPERIAL, MEMBERS, built, cycle


@pytest.mark.parametrize(
    ("angle", "expected"),
    [
        (30, (0.0577198319228, -0.0239236983318, -0.0127808257008)),
        (60, (0.0197192762558, -0.0126183323705, -0.00389195051505)),
    ],
)
def test_case_2_of_the_oracle(angle, expected):
    """Half of each link's mass at each end, and disks, at 500 rpm."""
    simulation = Simulation(built(IMPERIAL))
    simulation.advance(math.radians(angle - 30) / IMPERIAL["speed"])
    found = simulation.read()
    assert [found[f"arm_end_{q}"] for q in DEFLECTIONS] == pytest.approx(expected, rel=1e-8)
    assert found["arm_end_deviation"] == pytest.approx(math.hypot(*expected[:2]), rel=1e-8)
    for k, axis in enumerate("xy"):
        assert found[f"arm_end_{axis}_bent"] == pytest.approx(found[f"arm_end_{axis}"] + expected[k], rel=1e-9)


@pytest.fixture(scope="module")
def compared():
    """Outputs every 10 deg of a cycle, and the same by the flexibility approach.

    Two ways to it: three displacements of every node here, released rotations and joints eliminated there.
    """
    return cycle(IMPERIAL, 36)


@pytest.mark.parametrize("place", [f"{member}.{end}" for member in MEMBERS for end in ("start", "end")])
def test_every_end_gives_way_as_by_the_flexibility_approach(compared, place):
    table, expected = compared
    found = np.stack([table[f"{place.replace('.', '_')}_{q}"] for q in DEFLECTIONS], axis=1)
    np.testing.assert_allclose(found, expected.deflection(place), rtol=1e-10, atol=1e-13)


@pytest.mark.parametrize("member", MEMBERS)
def test_forces_and_stresses_are_those_of_the_flexibility_approach(compared, member):
    table, expected = compared
    number = [e.member.name for e in expected.configurations.linkage.elements].index(member)
    for k, effort in enumerate(("axial_force", "start_moment", "end_moment")):
        scale = np.abs(expected.section_forces[:, :, k]).max()
        np.testing.assert_allclose(
            table[f"{member}_{effort}"], expected.section_forces[:, number, k], rtol=1e-10, atol=1e-12 * scale
        )
    np.testing.assert_allclose(table[f"{member}_stress"], expected.stress[:, number], rtol=1e-10)

"""Deflections and forces of random linkages against a plane frame by direct stiffness."""

import numpy as np
import pytest
from frames import random_assembly, random_sections
from hypothesis import given, settings
from hypothesis import strategies as st

from mechanism_fmu.elastodynamics import configurations, linkage, quasi_static, section_forces

KINDS = {
    "four-bar": ["dyad"],
    "slider-crank": ["block"],
    "crank with a pin in a guide": ["pin"],
    "six-bar": ["dyad", "dyad"],
    "six-bar with a slider": ["dyad", "block"],
    "eight-bar": ["dyad", "pin", "dyad"],
}


def displaced(given_linkage, cycle, mechanism):
    """(u_x, u_y, theta) of both ends of every member, shape (members, 2, 3)."""
    return np.array([[cycle.deflection(f"{m.name}.{end}")[0] for end in ("start", "end")] for m in mechanism.members])


@pytest.mark.parametrize("kinds", KINDS.values(), ids=KINDS)
@settings(deadline=None, max_examples=25)
@given(st.integers(0, 2**32 - 1))
def test_deflections_and_forces_are_those_of_a_frame(kinds, seed):
    numbers = np.random.default_rng(seed)
    assembly = random_assembly(numbers, kinds)
    sections = random_sections(numbers, sum(map(len, assembly.bars.values())))
    mechanism = assembly.mechanism(sections)
    structure = linkage(mechanism)
    forces = np.zeros((len(mechanism.members), 2, 3))
    loads = {}
    for k, member in enumerate(mechanism.members):
        for e, end in enumerate(("start", "end")):
            load = numbers.normal(size=3)
            place = next(n for n, p in enumerate(structure.freedoms.places) if f"{member.name}.{end}" in p.names)
            load[2] *= structure.freedoms.columns[place, 2] >= 0  # no moment on a mere pin
            forces[k, e] = loads[f"{member.name}.{end}"] = load

    cycle = quasi_static(configurations(structure, assembly.motion(mechanism)), loads)

    moved, inner = assembly.frame(sections)(forces)
    found = displaced(structure, cycle, mechanism)
    assert np.abs(found - moved).max() <= 1e-10 * np.abs(moved).max()
    assert np.abs(cycle.section_forces[0] - inner).max() <= 1e-10 * np.abs(inner).max()

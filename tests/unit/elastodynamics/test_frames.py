"""Deflections and forces of random linkages against a plane frame by direct stiffness."""

import numpy as np
import pytest
from frames import random_assembly, random_sections
from hypothesis import given, settings, strategies as st

from mechanism_fmu.elastodynamics import configurations, linkage, quasi_static
from mechanism_fmu.elastodynamics.structure.places import RELEASED

KINDS = {
    "four-bar": ["dyad"],
    "slider-crank": ["block"],
    "crank with a pin in a guide": ["pin"],
    "six-bar": ["dyad", "dyad"],
    "six-bar with a slider": ["dyad", "block"],
    "eight-bar": ["dyad", "pin", "dyad"],
    "rigid rocker": ["rigid", "dyad"],
    "quick return": ["arm", "dyad", "block"],
    "one link too many": ["dyad", "brace"],
    "two links too many": ["dyad", "brace", "dyad", "brace"],
}


@pytest.mark.parametrize("kinds", KINDS.values(), ids=KINDS)
@settings(deadline=None, max_examples=12)
@given(st.integers(0, 2**32 - 1))
def test_deflections_and_forces_are_those_of_a_frame(kinds, seed):
    numbers = np.random.default_rng(seed)
    assembly = random_assembly(numbers, kinds)
    sections = random_sections(numbers, sum(map(len, assembly.bars.values())))
    mechanism = assembly.mechanism(sections)
    structure = linkage(mechanism)
    ends = [f"{member.name}.{end}" for member in mechanism.members for end in ("start", "end")]
    loads = dict(zip(ends, numbers.normal(size=(len(ends), 3)), strict=True))
    for name, columns in zip(structure.freedoms.places, structure.freedoms.columns, strict=True):
        for end in {*name.names} & {*ends}:
            loads[end][2] *= columns[2] != RELEASED  # no moment on a mere pin

    cycle = quasi_static(configurations(structure, assembly.motion(mechanism)), loads)

    moved, inner = assembly.frame(sections)(np.reshape([*loads.values()], (-1, 2, 3)))
    found = np.reshape([cycle.deflection(end)[0] for end in ends], moved.shape)
    assert np.abs(found - moved).max() <= 1e-10 * np.abs(moved).max()
    assert np.abs(cycle.section_forces[0] - inner).max() <= 1e-10 * np.abs(inner).max()

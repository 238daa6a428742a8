"""From element forces to the stress in the outer fibres."""

from __future__ import annotations

import numpy as np

from .elements import FloatArray, block_diagonal
from .linkage import Linkage


def section_forces(linkage: Linkage, element_forces: FloatArray) -> FloatArray:
    """(N, M_start, M_end) of each element, shape (times, elements, 3), from f, shape (times, n) [N, N m].

    Tension N is positive, and so are moments that bend the element to its left, seen from its start; between the ends
    they change in proportion to the way.
    """
    matrix = block_diagonal(element.section_forces for element in linkage.elements)
    return (element_forces @ matrix.T).reshape(len(element_forces), -1, 3)


def largest_stress(linkage: Linkage, forces: FloatArray) -> FloatArray:
    """|N|/A + |M| (h/2)/I where the moment is largest, at an end: shape (times, elements) [Pa].

    `forces` are those of `section_forces`.
    """
    sections = [element.member.section for element in linkage.elements]
    areas = np.array([section.area for section in sections])
    moduli = np.array([2 * section.second_moment / section.depth for section in sections])
    stress: FloatArray = np.abs(forces[:, :, 0]) / areas + np.abs(forces[:, :, 1:]).max(axis=2) / moduli
    return stress

"""Consistent masses: the distributed mass of the members swings with the shapes in which they bend."""

from __future__ import annotations

import numpy as np

from .configuration import Configurations
from .elements import FloatArray
from .linkage import Element
from .masses import mass_matrix
from .pose import dot, left


def beam_mass(mass: float, length: float) -> FloatArray:
    """Mass matrix of a uniform beam for (u, v, theta) of its two ends, shape (6, 6).

    Displacements along it are linear between the ends, those across it Hermite's cubics.

    Source: J. S. Archer, Consistent mass matrix for distributed mass systems, J. Struct. Div. ASCE 89 (1963).
    """
    turns = np.array([1.0, length, 1.0, length])
    numbers = np.array(
        [[156.0, 22.0, 54.0, -13.0], [22.0, 4.0, 13.0, -3.0], [54.0, 13.0, 156.0, -22.0], [-13.0, -3.0, -22.0, 4.0]]
    )
    whole = np.zeros((6, 6))
    whole[np.ix_([0, 3], [0, 3])] = mass / 6.0 * np.array([[2.0, 1.0], [1.0, 2.0]])
    whole[np.ix_([1, 2, 4, 5], [1, 2, 4, 5])] = mass / 420.0 * np.outer(turns, turns) * numbers
    return whole


def consistent_mass(configurations: Configurations) -> FloatArray:
    """M, shape (times, m, m): sum of E^T m_e E of the members, and the lumps of disks and rigid bodies.

    A released rotation follows from the other displacements of its member, as it does in E. The shapes turn with the
    links; what their turning adds to the acceleration, 2 Omega u' and Omega^2 u, is left out, and so is the stiffening
    by axial forces, of the same order: (Omega / omega)^2 of what remains.
    """
    ends, more = configurations.ends, _more_than_lumped(configurations)
    members: FloatArray = np.einsum("teim,eij,tejn->tmn", ends, more, ends, optimize=True)
    return mass_matrix(configurations) + members


def consistent_load(configurations: Configurations) -> FloatArray:
    """What consistent masses add to the inertia load of the lumps, shape (times, m): the sum of -E^T (m_e - lumps) a_e.

    A rigid member's acceleration a_e is linear along it, so that m_e gives its inertia forces exactly.
    """
    ends, more = configurations.ends, _more_than_lumped(configurations)
    rigid = np.stack([_rigid(configurations, element) for element in configurations.linkage.elements], axis=1)
    load: FloatArray = -np.einsum("teim,eij,tej->tm", ends, more, rigid, optimize=True)
    return load


def _more_than_lumped(configurations: Configurations) -> FloatArray:
    """m_e less half of the mass at either end, shape (elements, 6, 6)."""
    found = []
    for element in configurations.linkage.elements:
        mass = element.member.density * element.member.section.area * element.length
        found.append(beam_mass(mass, element.length) - np.diag(mass / 2 * np.array([1.0, 1.0, 0.0, 1.0, 1.0, 0.0])))
    return np.array(found)


def _rigid(configurations: Configurations, element: Element) -> FloatArray:
    """Accelerations of the two ends along the element, to its left, and of its angle, shape (times, 6)."""
    pose, member = configurations.pose, element.member
    vector = (member.end[0] - member.start[0], member.end[1] - member.start[1])
    along = pose.turned(member.body, vector) / element.length
    columns = []
    for point in (member.start, member.end):
        a = pose.acceleration_of(member.body, point)
        columns += [dot(a[:, :2], along), dot(a[:, :2], left(along)), a[:, 2]]
    return np.stack(columns, axis=1)

"""Masses of the structure, lumped and consistent, and what their accelerations do."""

from __future__ import annotations

import numpy as np

from ..elements import FloatArray
from .configuration import Configurations
from .linkage import Element, Linkage
from .places import RELEASED, place_of
from .pose import dot, left

# Lumped masses: half of each member at each of its ends, and its own; and what their accelerations do.


def lumps(linkage: Linkage) -> FloatArray:
    """Mass and inertia at every place, shape (places, 2) [kg, kg m2].

    A rigid body has its own mass and inertia at its centre of mass; lumped masses on it are a part of them.

    Args:
        linkage: the structure.

    Source: Case 2 of Erdman, Sandor, Oakberg (1972), masses at the joints; half of each link at either end is this
        project's: docs/explanation/elastodynamics-dynamics.md, Case 3.
    """
    mechanism, places = linkage.mechanism, linkage.freedoms.places
    found = np.zeros((len(places), 2))
    for element in linkage.elements:
        mass = element.member.density * element.member.section.area * element.length
        found[[element.start, element.end], 0] += mass / 2
    flexible = {member.body for member in mechanism.members}
    for lump in mechanism.lumped_masses:
        if lump.body in flexible:
            place = place_of(places, mechanism, f"LumpedMass {lump.name!r}", lump.body, lump.point)
            found[place] += lump.mass, lump.inertia
    for body in mechanism.bodies:
        if body.name not in flexible:
            place = place_of(places, mechanism, f"Body {body.name!r}", body.name, (0.0, 0.0))
            found[place] += body.mass, body.inertia
    return found


def mass_matrix(configurations: Configurations) -> FloatArray:
    """M of the lumps in the free displacements, shape (times or 1, m, m); without lumps at some, it is singular.

    Args:
        configurations: the linkage along the motion.

    Source: textbook: kinetic energy of the lumps, M = Z^T diag(m, J) Z; docs/explanation/elastodynamics-dynamics.md,
        Case 3.
    """
    freedoms = configurations.linkage.freedoms
    diagonal = np.zeros(freedoms.ground + 1)
    masses = lumps(configurations.linkage)
    for columns, (mass, inertia) in zip(freedoms.columns, masses, strict=True):
        np.add.at(diagonal, columns[:2], mass)
        if columns[2] != RELEASED:
            diagonal[columns[2]] += inertia
    basis = configurations.basis
    matrix: FloatArray = np.swapaxes(basis, 1, 2) @ (diagonal[:-1, None] * basis)
    return matrix


def inertia_forces(configurations: Configurations) -> FloatArray:
    """(-m a_x, -m a_y, -J phi'') at every place in the rigid motion, shape (times, places, 3) [N, N m].

    Args:
        configurations: the linkage along the motion.

    Source: d'Alembert's principle, as in Case 2 of Erdman, Sandor, Oakberg (1972).
    """
    pose, places = configurations.pose, configurations.linkage.freedoms.places
    masses = lumps(configurations.linkage)
    forces = np.zeros((len(pose.time), len(places), 3))
    for number, (place, (mass, inertia)) in enumerate(zip(places, masses, strict=True)):
        if mass or inertia:
            forces[:, number] = -np.array([mass, mass, inertia]) * pose.acceleration_of(place.body, place.point)
    return forces


def system_forces(configurations: Configurations, forces: FloatArray) -> FloatArray:
    """P along the free displacements, shape (times, m), of forces at the places.

    Args:
        configurations: the linkage along the motion.
        forces: (f_x, f_y, moment) on each place, shape (times, places, 3) [N, N m]; a moment on a rotation that is no
            unknown must be zero.

    Source: virtual work with w = Z u: docs/decisions/022-elastodynamics.md.
    """
    freedoms = configurations.linkage.freedoms
    wide = np.zeros((len(forces), freedoms.ground + 1))
    for number, columns in enumerate(freedoms.columns):
        for k, column in enumerate(columns):
            if column != RELEASED:
                wide[:, column] += forces[:, number, k]
    basis = configurations.basis
    if basis.shape[1] == basis.shape[2]:
        return wide[:, :-1]
    projected: FloatArray = (wide[:, None, :-1] @ basis)[:, 0]
    return projected


# Consistent masses: the distributed mass of the members swings with the shapes in which they bend.


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
    """M, shape (times, m, m): sum of E^T m_e E of the members, and the lumps of bodies, rigid or not.

    A released rotation follows from the other displacements of its member, as it does in E. The shapes turn with the
    links; what their turning adds to the acceleration, 2 Omega u' and Omega^2 u, is left out, and so is the stiffening
    by axial forces, of the same order: (Omega / omega)^2 of what remains.

    Args:
        configurations: the linkage along the motion.

    Source: J. S. Archer, Consistent mass matrix for distributed mass systems, J. Struct. Div. ASCE 89 (1963);
        docs/explanation/elastodynamics-dynamics.md, eq (K2).
    """
    ends, more = configurations.ends, _more_than_lumped(configurations)
    members: FloatArray = np.einsum("teim,eij,tejn->tmn", ends, more, ends, optimize=True)
    return mass_matrix(configurations) + members


def consistent_load(configurations: Configurations) -> FloatArray:
    """What consistent masses add to the inertia load of the lumps, shape (times, m): the sum of -E^T (m_e - lumps) a_e.

    A rigid member's acceleration a_e is linear along it, so that m_e gives its inertia forces exactly.

    Args:
        configurations: the linkage along the motion.

    Source: J. S. Archer, Consistent mass matrix for distributed mass systems, J. Struct. Div. ASCE 89 (1963);
        docs/explanation/elastodynamics-dynamics.md, eq (K2).
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

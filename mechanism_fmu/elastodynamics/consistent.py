"""Consistent masses: the distributed mass of the members swings with the shapes in which they bend."""

from __future__ import annotations

import numpy as np

from .configuration import Configurations
from .elements import FloatArray
from .masses import inertia_forces, lumps, mass_matrix, system_forces


def beam_mass(mass: float, length: float) -> FloatArray:
    """Mass matrix of a uniform beam for (u, v, theta) of its two ends, shape (6, 6).

    Displacements along it are linear between the ends, those across it Hermite's cubics.

    Source: J. S. Archer, Consistent mass matrix for distributed mass systems, J. Struct. Div. ASCE 89 (1963).
    """
    axial = mass / 6.0 * np.array([[2.0, 1.0], [1.0, 2.0]])
    l = length  # noqa: E741
    across = (
        mass
        / 420.0
        * np.array(
            [
                [156.0, 22.0 * l, 54.0, -13.0 * l],
                [22.0 * l, 4.0 * l * l, 13.0 * l, -3.0 * l * l],
                [54.0, 13.0 * l, 156.0, -22.0 * l],
                [-13.0 * l, -3.0 * l * l, -22.0 * l, 4.0 * l * l],
            ]
        )
    )
    whole = np.zeros((6, 6))
    whole[np.ix_([0, 3], [0, 3])] = axial
    whole[np.ix_([1, 2, 4, 5], [1, 2, 4, 5])] = across
    return whole


def consistent_mass(configurations: Configurations) -> FloatArray:
    """M, shape (times, m, m): E^T m_e E of every member, and the lumps of disks and rigid bodies.

    A released rotation follows from the other displacements of its member, as it does in E. The shapes turn with the
    links; that part of the acceleration which comes from their turning, 2 Omega u' and Omega^2 u, is left out, as is the
    stiffening by axial forces, of the same order: (Omega / omega)^2 of what remains.
    """
    ends, masses = configurations.ends, _element_masses(configurations)
    members: FloatArray = np.einsum("teim,eij,tejn->tmn", ends, masses, ends, optimize=True)
    return members + mass_matrix(configurations, members=False)


def consistent_load(configurations: Configurations) -> FloatArray:
    """P = -sum of E^T m_e a_e, and the lumps' -m a, shape (times, m), of the mechanism that moves as a rigid one.

    A rigid member's acceleration is linear along it, so that the matrices m_e give its inertia forces exactly.
    """
    pose, linkage = configurations.pose, configurations.linkage
    places = linkage.freedoms.places
    loads = system_forces(configurations, inertia_forces(configurations, members=False))
    for number, (element, mass) in enumerate(zip(linkage.elements, _element_masses(configurations), strict=True)):
        along = pose.turned(element.member.body, element.along)
        across = np.stack([-along[:, 1], along[:, 0]], axis=1)
        rigid = []
        for place in (places[element.start], places[element.end]):
            ax, ay, turn = pose.acceleration_of(place.body, place.point)
            a = np.stack([ax, ay], axis=1)
            rigid += [np.sum(along * a, axis=1), np.sum(across * a, axis=1), turn]
        loads = loads - np.einsum("tim,ij,jt->tm", configurations.ends[:, number], mass, np.array(rigid), optimize=True)
    return loads

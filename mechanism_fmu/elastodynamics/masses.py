"""Lumped masses: half of each member at each of its ends, and the disks; and what their accelerations do."""

from __future__ import annotations

import numpy as np

from .configuration import Configurations
from .elements import FloatArray
from .freedoms import RELEASED
from .linkage import Linkage
from .places import place_of


def lumps(linkage: Linkage) -> FloatArray:
    """Mass and inertia at every place, shape (places, 2) [kg, kg m2].

    A rigid body has its own mass and inertia at its centre of mass; disks are a part of them.
    """
    mechanism, places = linkage.mechanism, linkage.freedoms.places
    found = np.zeros((len(places), 2))
    for element in linkage.elements:
        mass = element.member.density * element.member.section.area * element.length
        found[[element.start, element.end], 0] += mass / 2
    flexible = {member.body for member in mechanism.members}
    for disk in mechanism.disks:
        if disk.body in flexible:
            place = place_of(places, mechanism, f"Disk {disk.name!r}", disk.body, disk.point)
            found[place] += disk.mass, disk.inertia
    for body in mechanism.bodies:
        if body.name not in flexible:
            place = place_of(places, mechanism, f"Body {body.name!r}", body.name, (0.0, 0.0))
            found[place] += body.mass, body.inertia
    return found


def mass_matrix(configurations: Configurations) -> FloatArray:
    """M of the lumps in the free displacements, shape (times or 1, m, m); without lumps at some, it is singular."""
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
    """(-m a_x, -m a_y, -J phi'') at every place in the rigid motion, shape (times, places, 3) [N, N m]."""
    pose, places = configurations.pose, configurations.linkage.freedoms.places
    masses = lumps(configurations.linkage)
    forces = np.zeros((len(pose.time), len(places), 3))
    for number, (place, (mass, inertia)) in enumerate(zip(places, masses, strict=True)):
        if mass or inertia:
            forces[:, number] = -np.array([mass, mass, inertia]) * pose.acceleration_of(place.body, place.point)
    return forces


def system_forces(configurations: Configurations, forces: FloatArray) -> FloatArray:
    """P along the free displacements of (f_x, f_y, moment) at every place, shape (times, places, 3) to (times, m).

    A moment on a rotation that is no unknown must be zero.
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

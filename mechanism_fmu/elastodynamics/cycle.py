"""Elastodynamic analysis by the paper's definition: deflections under the inertia forces of the rigid mechanism."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from .configuration import Configurations
from .elements import FloatArray
from .errors import LinkageError
from .freedoms import RELEASED
from .masses import inertia_forces, system_forces
from .places import named_place
from .reactions import Reactions, power_of, reactions
from .stresses import largest_stress, section_forces


@dataclass(frozen=True)
class Power:
    """Where the power of a motion comes from and goes to, each of shape (times,) [W].

    Attributes:
        drives: of drivers, or of what holds the mechanism.
        loads: of the loads.
        kinetic: by which the kinetic energy of the lumps grows.
        lost: to friction.
    """

    drives: FloatArray
    loads: FloatArray
    kinetic: FloatArray
    lost: FloatArray

    @property
    def balance(self) -> FloatArray:
        """Drives + loads - kinetic - lost, shape (times,) [W]: zero but for rounding."""
        return self.drives + self.loads - self.kinetic - self.lost


@dataclass(frozen=True)
class Cycle:
    """A linkage along a motion, bent by its loads and by the inertia of the rigid motion.

    Attributes:
        configurations: the linkage along the motion.
        forces: all forces and moments at the places, shape (times, places, 3) [N, N m]: inertia, loads and friction.
        displacement: u, shape (times, m) [m, rad].
        element_forces: f, shape (times, n) [N, N m].
        section_forces: (N, M_start, M_end) of each element, shape (times, elements, 3) [N, N m].
        stress: the largest in each element, |N|/A + |M| (h/2)/I, shape (times, elements) [Pa].
        reactions: of joints and drivers.
        power: its balance.
    """

    configurations: Configurations
    forces: FloatArray
    displacement: FloatArray
    element_forces: FloatArray
    section_forces: FloatArray
    stress: FloatArray
    reactions: Reactions
    power: Power

    def deflection(self, place: str) -> FloatArray:
        """(delta_x, delta_y, rotation) of a place, e.g. "arm.end", shape (times, 3) [m, m, rad].

        Raises:
            LinkageError: there is no such place.
        """
        rows = self.configurations.displacement(place)
        deflection: FloatArray = (rows @ self.displacement[:, :, None])[:, :, 0]
        return deflection

    def deviation(self, place: str) -> FloatArray:
        """How far a place is off its rigid path, shape (times,) [m]."""
        deflection = self.deflection(place)
        deviation: FloatArray = np.hypot(deflection[:, 0], deflection[:, 1])
        return deviation


def quasi_static(configurations: Configurations, loads: Mapping[str, ArrayLike] | None = None) -> Cycle:
    """Deflections, forces, stresses, reactions and power along a motion: u = B^T F B P, eqs (10) to (12).

    Args:
        configurations: the linkage along the motion.
        loads: by names of places, force and moment (f_x, f_y, moment) on each, shape (3,) or (times, 3) [N, N m].

    Raises:
        LinkageError: the linkage can move although it should stand still, there is no such place, a moment acts where a
            pin takes none, or friction does not settle.
    """
    applied = _applied(configurations, loads or {})
    inertia = inertia_forces(configurations)
    found = reactions(configurations, inertia + applied)
    forces = inertia + applied + found.friction
    transfer, flexibility = configurations.transfer, configurations.linkage.flexibility
    element_forces: FloatArray = (transfer @ system_forces(configurations, forces)[:, :, None])[:, :, 0]
    displacement: FloatArray = (np.swapaxes(transfer, 1, 2) @ (element_forces @ flexibility)[:, :, None])[:, :, 0]
    sections = section_forces(configurations.linkage, element_forces)
    power = Power(
        drives=found.drive_power,
        loads=power_of(configurations, applied),
        kinetic=-power_of(configurations, inertia),
        lost=found.lost_power,
    )
    stress = largest_stress(configurations.linkage, sections)
    return Cycle(configurations, forces, displacement, element_forces, sections, stress, found, power)


def _applied(configurations: Configurations, loads: Mapping[str, ArrayLike]) -> FloatArray:
    freedoms = configurations.linkage.freedoms
    forces = np.zeros((len(configurations.pose.time), len(freedoms.places), 3))
    for name, load in loads.items():
        place = named_place(freedoms.places, name)
        forces[:, place] += np.asarray(load, dtype=float)
        if freedoms.columns[place, 2] == RELEASED and np.any(forces[:, place, 2]):
            raise LinkageError(
                f"A moment acts at {name!r}, where there is only a pin; name the place in `linkage(..., loaded=...)`."
            )
    return forces

"""Elastodynamic analysis by the paper's definition: deflections under the inertia forces of the rigid mechanism.

Beside them, how unevenly the drive works, and what the linkage does to its frame.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import cumulative_trapezoid

from ..model import GROUND, Mechanism, Revolute
from ..model.body import Point
from .elements import FloatArray, LinkageError
from .reaction_forces import Reactions, friction_of, power_of, reactions
from .structure.configuration import Configurations
from .structure.linkage import largest_stress, section_forces
from .structure.masses import inertia_forces, system_forces
from .structure.places import RELEASED, held_coordinates, named_place
from .structure.pose import left
from .turn import crank_of, rigid_rows


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

    Source: `quasi_static`; a deflection as of `deflection_of`.
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

        Args:
            place: its name, e.g. "arm.end".

        Raises:
            LinkageError: there is no such place.
        """
        return np.asarray((self.configurations.displacement(place) @ self.displacement[:, :, None])[:, :, 0])

    def deviation(self, place: str) -> FloatArray:
        """How far a place is off its rigid path, shape (times,) [m].

        Args:
            place: its name, e.g. "arm.end".

        Raises:
            LinkageError: there is no such place.
        """
        deflection = self.deflection(place)
        return np.asarray(np.hypot(deflection[:, 0], deflection[:, 1]))


def quasi_static(configurations: Configurations, loads: Mapping[str, ArrayLike] | None = None) -> Cycle:
    """Deflections, forces, stresses, reactions and power along a motion: u = B^T F B P, eqs (10) to (12).

    Args:
        configurations: the linkage along the motion.
        loads: by names of places, force and moment (f_x, f_y, moment) on each, shape (3,) or (times, 3) [N, N m].

    Raises:
        LinkageError: the linkage can move although it should stand still, there is no such place, a moment acts where a
            pin takes none, or friction does not settle.

    Source: Erdman, Sandor, Oakberg (1972), eqs (10) to (12) and (14); friction, stress and power:
        docs/explanation/elastodynamics.md, section Inertia, torque and power.
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


# How unevenly a drive works over a cycle, and the flywheel that evens it out.


@dataclass(frozen=True)
class Fluctuation:
    """A torque over a range of angles.

    Attributes:
        mean: over the angle [N m].
        least, largest: [N m].
        energy: by which the work of the torque runs ahead of that of its mean, from least to most [J]: a flywheel J at
            the mean speed w keeps the speed within +- energy/(2 J w^2) of it.
    """

    mean: float
    least: float
    largest: float
    energy: float


@dataclass(frozen=True)
class Flywheel:
    """What evens a speed out.

    Attributes:
        coefficient: of fluctuation, (largest - least speed) / mean speed [-].
        inertia: J of the flywheel on the crank [kg m2].
        speed: of the crank with it, under a drive of constant torque, shape (times,) [rad/s].
    """

    coefficient: float
    inertia: float
    speed: FloatArray


def flywheel(angle: FloatArray, torque: FloatArray, speed: float, coefficient: float) -> Flywheel:
    """The flywheel that keeps to a coefficient of fluctuation: J = E / (coefficient speed^2).

    The drive gives the mean torque, the flywheel the rest: J w^2/2 falls by what the torque has worked beyond its mean.
    E is `Fluctuation.energy`. The torque is that at constant speed: what the linkage's own inertia evens out besides is
    left to it, so that the real fluctuation is somewhat smaller.

    Args:
        angle: increasing, over a whole cycle, shape (times,) [rad].
        torque: that the crank needs at constant speed, shape (times,) [N m].
        speed: mean of the least and the largest one [rad/s].
        coefficient: of fluctuation [-], above 0 and below 2.

    Raises:
        LinkageError: the coefficient or the speed cannot be, or the angles are as `torque_fluctuation` refuses them.

    Source: textbook: R. L. Norton, Design of Machinery, chapter on dynamic force analysis;
        docs/explanation/elastodynamics.md, section Inertia, torque and power.
    """
    if not 0.0 < coefficient < 2.0:
        raise LinkageError(
            f"The coefficient of fluctuation is {coefficient:g}; give one above 0 and below 2, e.g. 0.02 for 2 %."
        )
    if not 0.0 < speed < np.inf:
        raise LinkageError(f"The speed is {speed:g} rad/s; a flywheel evens out a positive one.")
    found = torque_fluctuation(angle, torque)
    ahead = cumulative_trapezoid(torque - found.mean, angle, initial=0.0)
    inertia = found.energy / (coefficient * speed**2)
    if inertia == 0.0:
        return Flywheel(coefficient, 0.0, np.full_like(torque, speed))
    largest = speed * (1.0 + coefficient / 2)
    return Flywheel(coefficient, inertia, np.sqrt(largest**2 - 2.0 * (ahead - ahead.min()) / inertia))


def torque_fluctuation(angle: FloatArray, torque: FloatArray) -> Fluctuation:
    """Mean over the angle, extremes and energy of a torque, by the trapezoidal rule.

    Args:
        angle: increasing, over a whole cycle, shape (times,) [rad].
        torque: at these angles, shape (times,) [N m].

    Raises:
        LinkageError: there are fewer than two angles, or they do not increase.

    Source: textbook: work of a torque beyond its mean; R. L. Norton, Design of Machinery, chapter on dynamic force
        analysis.
    """
    if len(angle) < 2 or np.any(np.diff(angle) <= 0.0):
        raise LinkageError("The angles must increase; give at least two, over a whole cycle.")
    mean = float(np.trapezoid(torque, angle) / (angle[-1] - angle[0]))
    ahead = cumulative_trapezoid(torque - mean, angle, initial=0.0)
    return Fluctuation(mean, float(torque.min()), float(torque.max()), float(np.ptp(ahead)))


# What a linkage does to its frame: shaking force and shaking moment, by two ways.
#
# By the joints: the sum of what those that stand on the ground, and the drive, exert on it. By Newton's laws: minus the
# rate of momentum, -sum m a and -sum (r x m a + J phi''), with the loads; friction within the linkage has no say in it.
# The paper names both, "shaking force and shaking moment", and does not write them down; the method is textbook (e.g.
# R. L. Norton, *Design of Machinery*, chapter on dynamic force analysis).


@dataclass(frozen=True)
class Shaking:
    """Forces on the frame.

    Attributes:
        about: the point of the ground to which the moment belongs [m].
        force: (F_x, F_y) on the frame, shape (times, 2) [N].
        moment: on the frame, the drive's reaction torque included, shape (times,) [N m].

    Source: `shaking`.
    """

    about: Point
    force: FloatArray
    moment: FloatArray

    def gap(self, other: Shaking) -> float:
        """The largest difference to another one, in parts of the largest force and moment; 0 where nothing shakes.

        Args:
            other: about the same point, at the same times.
        """
        pairs = ((self.force, other.force), (self.moment, other.moment))
        most = [max(float(np.abs(one).max()), float(np.abs(two).max())) for one, two in pairs]
        parts = [float(np.abs(a - b).max()) / m for (a, b), m in zip(pairs, most, strict=True) if m > 0.0]
        return max(parts, default=0.0)


def crank_hinge(mechanism: Mechanism) -> Point:
    """Where the crank is hinged to the ground [m]; the origin if no one pin does that.

    Args:
        mechanism: with a crank of `crank_of`.

    Raises:
        LinkageError: as of `crank_of`.

    Source: definition: the pin between crank and ground.
    """
    pair = {crank_of(mechanism), GROUND}
    pins = [j for j in mechanism.joints if isinstance(j, Revolute) and {j.body_i, j.body_j} == pair]
    if len(pins) != 1:
        return (0.0, 0.0)
    x, y = pins[0].point_i if pins[0].body_i == GROUND else pins[0].point_j
    return float(x), float(y)


def shaking(cycle: Cycle, about: Point = (0.0, 0.0)) -> Shaking:
    """Shaking force and moment by the joints on the ground, the drive among them.

    Args:
        cycle: of the linkage.
        about: point of the ground to which the moment belongs [m].

    Raises:
        ValueError: that point is not finite.

    Source: textbook: R. L. Norton, Design of Machinery, chapter on dynamic force analysis; Erdman, Sandor, Oakberg
        (1972) name both and write neither down.
    """
    configurations, found = cycle.configurations, cycle.reactions
    mechanism, pose = configurations.linkage.mechanism, configurations.pose
    grounded = {joint.name for joint in mechanism.joints if GROUND in (joint.body_i, joint.body_j)}
    grounded |= {f"{body}.{what}" for body, what in held_coordinates(mechanism)}
    rows, owners = rigid_rows(mechanism, pose)
    mine = [k for k, owner in enumerate(owners) if owner in grounded]
    on_bodies = np.einsum("tk,tkc->tc", found.multipliers[:, mine], rows[:, mine]).reshape(len(rows), -1, 3)
    centres = pose.position[:, :-1, :2]
    force, moment = _summed(about, centres, -on_bodies)
    exerted = friction_of(configurations, found)
    for joint in mechanism.joints:
        if joint.name in exerted and joint.name in grounded:
            # friction acts where the moving body is touched
            moving, on_body = ("j", exerted[joint.name][1]) if joint.body_i == GROUND else ("i", exerted[joint.name][0])
            body, point = getattr(joint, f"body_{moving}"), getattr(joint, f"point_{moving}")
            more, turning = _summed(about, pose.place(body, point)[:, None], -on_body[:, None])
            force, moment = force + more, moment + turning
    return Shaking(about, force, moment)


def momentum_shaking(cycle: Cycle, about: Point = (0.0, 0.0)) -> Shaking:
    """Shaking force and moment by Newton's laws: all inertia forces and loads, without any reaction.

    Args:
        cycle: of the linkage.
        about: point of the ground to which the moment belongs [m].

    Raises:
        ValueError: that point is not finite.

    Source: textbook: R. L. Norton, Design of Machinery, chapter on dynamic force analysis; Erdman, Sandor, Oakberg
        (1972) name both and write neither down.
    """
    configurations = cycle.configurations
    return Shaking(about, *_summed(about, _places(configurations), cycle.forces - cycle.reactions.friction))


def _places(configurations: Configurations) -> FloatArray:
    """Where all places are, shape (times, places, 2) [m]."""
    places = configurations.linkage.freedoms.places
    return np.stack([configurations.pose.place(place.body, place.point) for place in places], axis=1)


def _summed(about: Point, points: FloatArray, loads: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Sum of (f_x, f_y, moment) at points, shape (times, n, 3) and (times, n, 2): force, and moment about a point."""
    if not np.isfinite(about).all():
        raise ValueError(f"the point of the moment, about = {about}, is not finite; give a point of the ground [m].")
    arms = left(points - np.asarray(about))
    return loads[..., :2].sum(axis=1), (loads[..., 2] + np.einsum("tnk,tnk->tn", arms, loads[..., :2])).sum(axis=1)

"""Forces in the joints of the rigid mechanism and of its drivers: statics with inertia and friction forces."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..model import Mechanism, Revolute, Translational
from .elements import FloatArray, LinkageError
from .structure.configuration import Configurations
from .structure.places import attachments, held_coordinates, is_driver, rubbing_pins
from .structure.pose import dot, guide_axis, left
from .turn import rigid_rows

# Friction in pins and guides, from the forces that they carry and how fast they slide.


@dataclass(frozen=True)
class Rubbing:
    """A joint with friction, along a motion.

    Attributes:
        joint: its name.
        places: numbers of its two places, i and j.
        slip: of i against j: angular [rad/s] in a pin, along the guide [m/s] in a slider, shape (times,).
        direction: what one unit of friction is on place i, shape (times, 3): a torque, or a force along the guide.
        coulomb: coefficient times radius [m] of a pin, coefficient of a slider.
        viscous: damping of a pin [N m s/rad]; 0 of a slider.
        rows: how many of the joint's multipliers make up the force that it carries.
    """

    joint: str
    places: tuple[int, int]
    slip: FloatArray
    direction: FloatArray
    coulomb: float
    viscous: float
    rows: int

    def effort(self, carried: FloatArray) -> FloatArray:
        """What opposes the slip, for the force that the joint carries, shape (times,) [N] to (times,) [N m, or N].

        Coulomb: coefficient (times radius) times force, none at rest; viscous: damping times slip.
        """
        return -self.coulomb * carried * np.sign(self.slip) - self.viscous * self.slip


def with_friction(mechanism: Mechanism, coefficient: float, pin_radius: float | None = None) -> Mechanism:
    """The mechanism with the same Coulomb friction in all its pins and sliders; dampers stay as they are.

    Args:
        mechanism: whose own friction gives way.
        coefficient: of friction [-].
        pin_radius: of all pins [m]; a mechanism without pins needs none.

    Raises:
        LinkageError: coefficient or radius cannot be, or it has pins and no radius is given.

    Source: Coulomb's law; docs/explanation/elastodynamics.md, section Inertia, torque and power.
    """
    if not 0.0 <= coefficient < np.inf:
        raise LinkageError(f"The coefficient of friction is {coefficient:g}; give one from 0 on, e.g. 0.1.")
    pins = [joint.name for joint in mechanism.joints if isinstance(joint, Revolute)]
    if pins and pin_radius is None:
        raise LinkageError(
            f"In a pin, friction acts at its radius: give the radius of the pins ({', '.join(pins)}), e.g. 5 mm."
        )
    radius = 0.0 if pin_radius is None else pin_radius
    if not 0.0 <= radius < np.inf:
        raise LinkageError(f"The radius of the pins is {radius:g} m; give one from 0 on, e.g. 0.005.")
    joints = tuple(
        replace(joint, friction_radius=coefficient * radius)
        if isinstance(joint, Revolute)
        else replace(joint, friction=coefficient)
        if isinstance(joint, Translational)
        else joint
        for joint in mechanism.joints
    )
    return replace(mechanism, joints=joints)


def rubbing_joints(configurations: Configurations) -> tuple[Rubbing, ...]:
    """Pins with a friction radius or with a `Damper` between their bodies, and sliders with a coefficient of friction.

    Raises:
        LinkageError: the bodies of a damper have no pin in common, or several.
    """
    mechanism, pose = configurations.linkage.mechanism, configurations.pose
    places, times = configurations.linkage.freedoms.places, len(configurations.pose.time)
    found = []
    for joint, coulomb, viscous in rubbing_pins(mechanism):
        i, j = (pose.bodies.index(body) for body in (joint.body_i, joint.body_j))
        slip = pose.velocity[:, i, 2] - pose.velocity[:, j, 2]
        direction = np.broadcast_to([0.0, 0.0, 1.0], (times, 3))
        found.append(Rubbing(joint.name, attachments(mechanism, places, joint), slip, direction, coulomb, viscous, 2))
    for slider in mechanism.joints:
        if isinstance(slider, Translational) and slider.friction > 0.0:
            along = guide_axis(slider, pose)
            speed_i = pose.velocity_of(slider.body_i, slider.point_i)
            speed_j = pose.velocity_of(slider.body_j, slider.point_j)
            between = pose.place(slider.body_j, slider.point_j) - pose.place(slider.body_i, slider.point_i)
            slip = dot(along, speed_i[:, :2] + speed_i[:, 2:] * left(between) - speed_j[:, :2])
            direction = np.column_stack([along, np.zeros(times)])
            at = attachments(mechanism, places, slider)
            found.append(Rubbing(slider.name, at, slip, direction, float(slider.friction), 0.0, 1))
    return tuple(found)


#: Friction is found when no force changes any more by this part of the largest; this often it is tried.
_SETTLED, _ROUNDS = 1e-13, 200


@dataclass(frozen=True)
class Reactions:
    """What joints and drivers exert on the rigid mechanism.

    Attributes:
        owners: the joint, or the held coordinate, of each row.
        multipliers: lambda of M q'' = F + Phi_q^T lambda with rows of unit length, shape (times, rows) [N, N m]: of a
            pin the force on body i, of a slider the force on body j to the left of its axis and then the torque, of a
            driver or a held coordinate the force or torque on body j.
        friction: forces and moments by friction at the places, shape (times, places, 3) [N, N m].
        drive_power: of drivers and held coordinates, shape (times,) [W].
        lost_power: what friction takes, shape (times,) [W].

    Source: `reactions`.
    """

    owners: tuple[str, ...]
    multipliers: FloatArray
    friction: FloatArray
    drive_power: FloatArray
    lost_power: FloatArray

    def of(self, joint: str) -> FloatArray:
        """The multipliers of one joint, driver or held coordinate ("crank.angle"), shape (times, rows of it).

        Args:
            joint: name of a joint or driver, or "<body>.<coordinate>" of what is held.

        Raises:
            LinkageError: there is none of this name.
        """
        if joint not in self.owners:
            raise LinkageError(f"There is no reaction {joint!r}; there are: {', '.join(dict.fromkeys(self.owners))}.")
        return self.multipliers[:, [k for k, owner in enumerate(self.owners) if owner == joint]]


def reactions(configurations: Configurations, forces: FloatArray) -> Reactions:
    """Reactions of the rigid mechanism to forces at the places.

    Phi_q^T lambda + F + F_friction(lambda) = 0 is solved by iteration, because Coulomb friction depends on lambda:
    friction of the reactions of the last round, until they settle.

    Args:
        configurations: the linkage along the motion.
        forces: (f_x, f_y, moment) on each place, inertia forces among them, shape (times, places, 3) [N, N m].

    Raises:
        LinkageError: the rigid mechanism can move although its drivers stand still, always or in one configuration, or
            friction does not settle: a joint is about to lock itself.

    Source: multipliers as in Pennestrì, Valentini, Vita, eq (1), with the sign of docs/explanation/theory.md; friction
        and its iteration: docs/explanation/elastodynamics.md, section Inertia, torque and power.
    """
    rows, owners = rigid_rows(configurations.linkage.mechanism, configurations.pose)
    joints = rubbing_joints(configurations)
    friction = np.zeros_like(forces)
    multipliers = _solved(rows, _on_bodies(configurations, forces), configurations.pose.time)
    for _ in range(_ROUNDS if joints else 0):
        friction = _friction(joints, owners, multipliers, forces.shape)
        last = multipliers
        multipliers = _solved(rows, _on_bodies(configurations, forces + friction), configurations.pose.time)
        settled = np.abs(multipliers - last).max(axis=1) <= _SETTLED * np.abs(multipliers).max()
        if np.all(settled):
            break
    if joints and not np.all(settled):
        raise LinkageError(
            f"At t = {configurations.pose.time[np.argmin(settled)]:.9g} s friction does not settle in {_ROUNDS} "
            f"rounds: a joint ({', '.join(one.joint for one in joints)}) is about to lock itself. Make friction "
            "smaller, or leave this position out."
        )
    rates = configurations.pose.velocity[:, :-1].reshape(len(rows), -1)
    drives = {joint.name for joint in configurations.linkage.mechanism.joints if is_driver(joint)}
    drives |= {f"{body}.{what}" for body, what in held_coordinates(configurations.linkage.mechanism)}
    driving = [owner in drives for owner in owners]
    power = np.sum(multipliers[:, driving] * (rows @ rates[:, :, None])[:, driving, 0], axis=1)
    return Reactions(owners, multipliers, friction, power, -power_of(configurations, friction))


@dataclass(frozen=True)
class JointForce:
    """What a joint carries and, where it has friction, what that does.

    Attributes:
        joint: its name.
        force: that it carries: of a pin the whole, of a slider the part across its axis, shape (times,) [N].
        friction: on body i: torque of a pin [N m], force of a slider along its axis [N], shape (times,); zero without.
        turning: whether friction is a torque.
        lost_power: by friction, shape (times,) [W].
    """

    joint: str
    force: FloatArray
    friction: FloatArray
    turning: bool
    lost_power: FloatArray


def joint_forces(configurations: Configurations, found: Reactions) -> tuple[JointForce, ...]:
    """The forces in all joints but drivers, in their order, with what friction does there.

    Args:
        configurations: the linkage along the motion.
        found: its reactions.

    Raises:
        LinkageError: the reactions are another linkage's.

    Source: Coulomb's law and viscous friction of what each joint carries; docs/explanation/elastodynamics.md, section
        Inertia, torque and power.
    """
    rubbing = {joint.joint: joint for joint in rubbing_joints(configurations)}
    none = np.zeros(len(configurations.pose.time))
    forces = []
    for joint in configurations.linkage.mechanism.joints:
        if is_driver(joint):
            continue
        rows = 2 if isinstance(joint, Revolute) else 1
        force = np.linalg.norm(found.of(joint.name)[:, :rows], axis=1)
        rubs = rubbing.get(joint.name)
        friction = none if rubs is None else rubs.effort(_carried(rubs, found.owners, found.multipliers))
        lost = none if rubs is None else -friction * rubs.slip
        forces.append(JointForce(joint.name, force, friction, isinstance(joint, Revolute), lost))
    return tuple(forces)


def friction_of(configurations: Configurations, found: Reactions) -> dict[str, tuple[FloatArray, FloatArray]]:
    """Of each joint with friction, by its name: (f_x, f_y, moment) on body i and on body j, shape (times, 3) each."""
    exerted = {}
    for joint in rubbing_joints(configurations):
        on_i = joint.direction * joint.effort(_carried(joint, found.owners, found.multipliers))[:, None]
        exerted[joint.joint] = on_i, -on_i
    return exerted


def power_of(configurations: Configurations, forces: FloatArray) -> FloatArray:
    """Power of forces at the places, which move as the rigid mechanism does, shape (times,) [W].

    Args:
        configurations: the linkage along the motion.
        forces: (f_x, f_y, moment) on each place, shape (times, places, 3) [N, N m].

    Source: textbook law: the sum of f . v + M phi'.
    """
    pose = configurations.pose
    loads = _on_bodies(configurations, forces)
    power: FloatArray = np.einsum("tk,tk->t", loads, pose.velocity[:, :-1].reshape(loads.shape))
    return power


def _solved(rows: FloatArray, loads: FloatArray, time: FloatArray) -> FloatArray:
    """Lambda of Phi_q^T lambda + loads = 0, shape (times, rows); of least norm where rows say the same."""
    count, coordinates = rows.shape[1:]
    transposed = np.swapaxes(rows, 1, 2)
    if count < coordinates:
        raise LinkageError(
            f"{coordinates - count} degree(s) of freedom of the rigid mechanism are neither driven nor held; add a "
            "driver, or name a coordinate in `Mechanism.held`."
        )
    if count > coordinates:
        return -(np.linalg.pinv(transposed) @ loads[:, :, None])[:, :, 0]
    try:
        return -np.asarray(np.linalg.solve(transposed, loads[:, :, None]), dtype=np.float64)[:, :, 0]
    except np.linalg.LinAlgError:
        worst = float(time[np.argmin(np.linalg.svd(rows, compute_uv=False)[:, -1])])
        raise LinkageError(
            f"At t = {worst:.9g} s the rigid mechanism can move although its drivers stand still; leave this position "
            "out, or drive another body."
        ) from None


def _on_bodies(configurations: Configurations, forces: FloatArray) -> FloatArray:
    """Forces at the places as forces and moments at the centres of mass of the bodies, shape (times, 3 bodies)."""
    pose = configurations.pose
    loads = np.zeros((len(pose.time), len(pose.bodies), 3))
    for number, place in enumerate(configurations.linkage.freedoms.places):
        if not forces[:, number].any():
            continue
        k = pose.bodies.index(place.body)
        arm = left(pose.turned(place.body, place.point))
        loads[:, k] += forces[:, number]
        loads[:, k, 2] += np.einsum("tk,tk->t", arm, forces[:, number, :2])
    return loads[:, :-1].reshape(len(loads), -1)


def _friction(
    joints: tuple[Rubbing, ...], owners: tuple[str, ...], multipliers: FloatArray, shape: tuple[int, ...]
) -> FloatArray:
    """Forces and moments by friction at the places for the reactions `multipliers`."""
    forces = np.zeros(shape)
    for joint in joints:
        on_i = joint.direction * joint.effort(_carried(joint, owners, multipliers))[:, None]
        forces[:, joint.places[0]] += on_i
        forces[:, joint.places[1]] -= on_i
    return forces


def _carried(joint: Rubbing, owners: tuple[str, ...], multipliers: FloatArray) -> FloatArray:
    """The force that a joint with friction carries, shape (times,) [N]."""
    first = owners.index(joint.joint)
    return np.asarray(np.linalg.norm(multipliers[:, first : first + joint.rows], axis=1))

"""Friction in pins and guides, from the forces that they carry and how fast they slide."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..model import Mechanism, Revolute, Translational
from .configuration import Configurations
from .elements import FloatArray
from .errors import LinkageError
from .locks import attachments, rubbing_pins
from .pose import dot, left
from .rows import guide_axis


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

"""What a linkage does to its frame: shaking force and shaking moment, by two ways.

By the joints: the sum of what those that stand on the ground, and the drive, exert on it. By Newton's laws: minus the
rate of momentum, -sum m a and -sum (r x m a + J phi''), with the loads; friction within the linkage has no say in it.
The paper names both, "shaking force and shaking moment", and does not write them down; the method is textbook (e.g.
R. L. Norton, *Design of Machinery*, chapter on dynamic force analysis).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..model import GROUND, Mechanism, Revolute
from ..model.body import Point
from .configuration import Configurations
from .cycle import Cycle
from .elements import FloatArray
from .locks import held_coordinates
from .pose import left
from .reactions import friction_of
from .rigid_rows import rigid_rows
from .turn import crank_of


@dataclass(frozen=True)
class Shaking:
    """Forces on the frame.

    Attributes:
        about: the point of the ground to which the moment belongs [m].
        force: (F_x, F_y) on the frame, shape (times, 2) [N].
        moment: on the frame, the drive's reaction torque included, shape (times,) [N m].
    """

    about: Point
    force: FloatArray
    moment: FloatArray

    def gap(self, other: Shaking) -> float:
        """The largest difference to another one, in parts of the largest force and moment; 0 where nothing shakes."""
        pairs = ((self.force, other.force), (self.moment, other.moment))
        most = [max(float(np.abs(one).max()), float(np.abs(two).max())) for one, two in pairs]
        parts = [float(np.abs(a - b).max()) / m for (a, b), m in zip(pairs, most, strict=True) if m > 0.0]
        return max(parts, default=0.0)


def crank_hinge(mechanism: Mechanism) -> Point:
    """Where the crank is hinged to the ground [m]; the origin if no one pin does that.

    Raises:
        LinkageError: as of `crank_of`.
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
    """Shaking force and moment by Newton's laws: all inertia forces and loads, without any reaction; as `shaking`."""
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

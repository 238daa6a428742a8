"""Where the rigid bodies are in all configurations, how fast they go, and how their points are accelerated."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..kinematics import KinematicMotion
from ..model import GROUND, Mechanism
from ..model.body import Point
from .elements import FloatArray
from .errors import LinkageError


@dataclass(frozen=True)
class Pose:
    """Coordinates q, rates and accelerations of the bodies of a mechanism; the ground comes last, and rests.

    Attributes:
        bodies: names of the bodies, and `GROUND`.
        time: shape (times,) [s].
        position, velocity, acceleration: (x, y, phi) of each body, shape (times, bodies + 1, 3) [m, rad and by s, s2].
        cosine, sine: of phi, shape (times, bodies + 1).
    """

    bodies: tuple[str, ...]
    time: FloatArray
    position: FloatArray
    velocity: FloatArray
    acceleration: FloatArray
    cosine: FloatArray
    sine: FloatArray

    def turned(self, body: str, vector: Point) -> FloatArray:
        """A vector of a body's frame in the global one, A s, shape (times, 2)."""
        k = self.bodies.index(body)
        x, y = vector
        turned = np.empty((len(self.time), 2))
        turned[:, 0] = self.cosine[:, k] * x - self.sine[:, k] * y
        turned[:, 1] = self.sine[:, k] * x + self.cosine[:, k] * y
        return turned

    def place(self, body: str, point: Point) -> FloatArray:
        """Where a point of a body of a body is, r + A s, shape (times, 2) [m]."""
        return self.position[:, self.bodies.index(body), :2] + self.turned(body, point)

    def velocity_of(self, body: str, point: Point) -> FloatArray:
        """(v_x, v_y, phi') of a point of a body, shape (times, 3) [m/s, rad/s]."""
        rate = self.velocity[:, self.bodies.index(body)]
        return np.column_stack([rate[:, :2] + rate[:, 2:] * left(self.turned(body, point)), rate[:, 2]])

    def acceleration_of(self, body: str, point: Point) -> FloatArray:
        """(a_x, a_y, phi'') of a point of a body, shape (times, 3) [m/s2, rad/s2]: r'' + phi'' R A s - phi'^2 A s."""
        k = self.bodies.index(body)
        arm, given, rate = self.turned(body, point), self.acceleration[:, k], self.velocity[:, k, 2:]
        return np.column_stack([given[:, :2] + given[:, 2:] * left(arm) - rate**2 * arm, given[:, 2]])


def left(vectors: FloatArray) -> FloatArray:
    """R v: vectors, shape (..., 2), turned by +90 deg."""
    turned = np.empty_like(vectors)
    turned[..., 0], turned[..., 1] = -vectors[..., 1], vectors[..., 0]
    return turned


def dot(first: FloatArray, second: FloatArray) -> FloatArray:
    """Products of vectors of shape (times, 2), shape (times,)."""
    return first[:, 0] * second[:, 0] + first[:, 1] * second[:, 1]


def pose_of(mechanism: Mechanism, motion: KinematicMotion) -> Pose:
    """The bodies of a mechanism in a motion of it.

    Raises:
        LinkageError: the motion is another mechanism's, or not finite.
    """
    names = tuple(f"{body.name}.{c}" for body in mechanism.bodies for c in ("x", "y", "angle"))
    if motion.coordinates[: len(names)] != names:
        raise LinkageError(
            f"The motion has the coordinates {', '.join(motion.coordinates)}, but the mechanism has "
            f"{', '.join(names)}; analyse the same mechanism."
        )
    tables = []
    for table in (motion.position, motion.velocity, motion.acceleration):
        if not np.all(np.isfinite(table)):
            raise LinkageError("The motion holds numbers that are not finite; give a motion that can be.")
        rest = np.zeros((len(table), 3))
        tables.append(np.hstack([table[:, : len(names)], rest]).reshape(len(table), -1, 3))
    angle = tables[0][:, :, 2]
    bodies = (*(body.name for body in mechanism.bodies), GROUND)
    position, velocity, acceleration = tables
    return Pose(bodies, motion.time, position, velocity, acceleration, np.cos(angle), np.sin(angle))

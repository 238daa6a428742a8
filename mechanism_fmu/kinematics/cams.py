"""A cam and its follower over one turn of the cam: contact point, curvature, pressure angle."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from ..model import AngleDriver, CamFlatFollower, CamFollower, Mechanism, PointFollower
from ..model.motions import polynomial_motion
from .equations import Equations, FloatArray
from .errors import KinematicsError
from .motion import KinematicMotion, analyse
from .profile_values import curvature, curve_values
from .profiles import ProfileReport, profile_report

_DRIVER = "turn of the cam"
#: A pressure angle beyond this is usually avoided [rad]: 30 deg for a sliding, 45 deg for an oscillating follower.
USUAL_LIMIT = math.radians(30)

Pair = CamFollower | CamFlatFollower | PointFollower


@dataclass(frozen=True)
class CamReport:
    """A cam pair over one turn of its cam.

    Attributes:
        motion: of all bodies, with the cam turning at 1 rad/s: velocities are derivatives by the cam's angle.
        cam_angle: shape (angles,) [rad].
        pressure_angle: between the contact normal and the way that the follower's point can go [rad], 0..pi/2.
        relative_curvature: sum of both curvatures at the contact [1/m]; positive: the pair fits.
        profile: of the cam.
    """

    motion: KinematicMotion
    cam_angle: FloatArray
    pressure_angle: FloatArray
    relative_curvature: FloatArray
    profile: ProfileReport

    def problems(self, limit: float = USUAL_LIMIT) -> tuple[str, ...]:
        """What an engineer should know of the pair, one sentence each; `limit` of the pressure angle [rad]."""
        return tuple(self._problems(limit))

    def _problems(self, limit: float) -> Iterator[str]:
        worst = int(np.argmax(self.pressure_angle))
        if self.pressure_angle[worst] > limit:
            yield (
                f"The pressure angle reaches {math.degrees(self.pressure_angle[worst]):.2f} deg at cam angle "
                f"{math.degrees(self.cam_angle[worst]):.1f} deg; usual is at most {math.degrees(limit):g} deg. Give a "
                "larger base circle, or a longer rise."
            )
        least = int(np.argmin(self.relative_curvature))
        if self.relative_curvature[least] <= 0.0:
            yield (
                f"At cam angle {math.degrees(self.cam_angle[least]):.1f} deg the follower does not fit into the cam's "
                "hollow. Give a smaller roller, or a smoother profile."
            )


def cam_report(mechanism: Mechanism, contact: str, cam: str, angles: int = 360) -> CamReport:
    """Turn the body `cam` once, whatever drove it before, and look at one of its pairs.

    Args:
        mechanism: with one degree of freedom when its drivers are taken away.
        contact: name of the pair of profiles.
        cam: name of its body that is the cam; the other one is the follower.
        angles: how many steps the turn has.

    Raises:
        KinematicsError: there is no such pair, or it does not run through a whole turn.
    """
    pair = _pair(mechanism, contact, cam)
    start = next(float(body.start[2]) for body in mechanism.bodies if body.name == cam)
    joints = tuple(joint for joint in mechanism.joints if joint.motion is None)
    drive = AngleDriver(_DRIVER, cam, polynomial_motion(start, 1.0))
    driven = replace(mechanism, joints=(*joints, drive), inputs=(), outputs=(), calculated=())
    times = np.linspace(0.0, 2 * math.pi, angles + 1)
    motion = analyse(driven, times)
    normal, bend = _contact(motion, pair)
    ways = _ways(Equations(driven), motion, pair, cam)
    cosine = np.abs(np.sum(normal * ways, axis=1))
    profile = next(p for p in (pair.profiles if pair.body_i == cam else pair.profiles[::-1]) if p is not None)
    return CamReport(
        motion=motion,
        cam_angle=motion.of(f"{cam}.angle")[0],
        pressure_angle=np.arccos(np.minimum(cosine, 1.0)),
        relative_curvature=bend,
        profile=profile_report(profile),
    )


def _pair(mechanism: Mechanism, contact: str, cam: str) -> Pair:
    pairs = {c.name: c for c in mechanism.contacts if isinstance(c, (CamFollower, CamFlatFollower, PointFollower))}
    if contact not in pairs:
        raise KinematicsError(f"There is no pair of profiles {contact!r}; there are: {', '.join(pairs) or 'none'}.")
    if cam not in (pairs[contact].body_i, pairs[contact].body_j):
        raise KinematicsError(
            f"{cam!r} is none of the bodies of {contact!r}, {pairs[contact].body_i!r} and {pairs[contact].body_j!r}."
        )
    return pairs[contact]


def _contact(motion: KinematicMotion, pair: Pair) -> tuple[FloatArray, FloatArray]:
    """The unit normals, shape (times, 2), and the sums of the curvatures, shape (times,)."""
    total = np.zeros(len(motion.time))
    normal = np.zeros((len(motion.time), 2))
    bodies = (pair.body_i, pair.body_j)
    for body, profile, which in zip(bodies, pair.profiles, ("i", "j"), strict=True):
        if profile is None:
            continue
        alpha, phi = motion.of(f"{pair.name}.alpha_{which}")[0], _angle(motion, body)
        values = curve_values(profile, alpha)
        total += curvature(values)
        rho, rate, _ = values
        along = np.arctan2(rho, rate) + alpha + phi  # direction of rho' e + rho R e
        normal = np.column_stack([np.sin(along), -np.cos(along)])
    return normal, total


def _angle(motion: KinematicMotion, body: str) -> FloatArray:
    name = f"{body}.angle"
    return motion.of(name)[0] if name in motion.coordinates else np.zeros(len(motion.time))


def _ways(equations: Equations, motion: KinematicMotion, pair: Pair, cam: str) -> FloatArray:
    """Unit vectors along which the follower's contact point can go while the cam stands still, shape (times, 2).

    Raises:
        KinematicsError: without the pair, the follower can move in more than one way, or in none.
    """
    follower = pair.body_j if pair.body_i == cam else pair.body_i
    kept = [k for k, name in enumerate(equations.rows) if name.partition("[")[0] != pair.name]
    bodies = [k for k, name in enumerate(equations.coordinates) if name.endswith((".x", ".y", ".angle"))]
    first = motion.coordinates.index(f"{follower}.x")
    ways = np.empty((len(motion.time), 2))
    for k, (time, q) in enumerate(zip(motion.time, motion.position, strict=True)):
        jacobian = equations.at(q, time).jacobian[np.ix_(kept, bodies)]
        _, values, directions = np.linalg.svd(jacobian)
        free = directions[int(np.sum(values > 1e-9 * values[0])) :]
        if len(free) != 1:
            raise KinematicsError(
                f"Without {pair.name!r} and with the cam at rest the mechanism has {len(free)} degrees of freedom, but "
                "a pressure angle has sense with 1 only."
            )
        x, y, turn = free[0][first : first + 3]
        px, py = _contact_point(motion, pair, k) - q[first : first + 2]
        way = np.array([x - py * turn, y + px * turn])
        ways[k] = way / np.linalg.norm(way)
    return ways


def _contact_point(motion: KinematicMotion, pair: Pair, k: int) -> FloatArray:
    """The contact point at the k-th time, shape (2,) [m]."""
    if isinstance(pair, PointFollower):
        body, profile, centre, which = pair.body_j, pair.profile_j, pair.centre_j, "j"
    else:
        body, profile, centre, which = pair.body_i, pair.profile_i, pair.centre_i, "i"
    alpha, phi = motion.of(f"{pair.name}.alpha_{which}")[0][k], _angle(motion, body)[k]
    rho = float(curve_values(profile, np.array([alpha]))[0, 0])
    local = np.array([float(c) for c in centre]) + rho * np.array([math.cos(alpha), math.sin(alpha)])
    c, s = math.cos(phi), math.sin(phi)
    origin = np.zeros(2)
    if f"{body}.x" in motion.coordinates:
        first = motion.coordinates.index(f"{body}.x")
        origin = motion.position[k, first : first + 2]
    point: FloatArray = origin + np.array([c * local[0] - s * local[1], s * local[0] + c * local[1]])
    return point

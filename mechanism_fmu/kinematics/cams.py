"""A cam and its follower over one turn of the cam: contact point, curvature, pressure angle."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from ..model import AngleDriver, CamFlatFollower, Curve, Mechanism, PointFollower
from ..model.curves.motions import polynomial_motion
from ..model.joints import HigherPair
from .equations import Equations, FloatArray, KinematicsError
from .mobility import free_directions
from .motion import KinematicMotion, analyse
from .profiles import ProfileReport, curvature, curve_values, profile_report, radius_of

# Where a cam and its follower touch: normal, curvatures, and the way that the follower can go there.


def contact_geometry(motion: KinematicMotion, pair: HigherPair) -> tuple[FloatArray, FloatArray]:
    """The unit normals, shape (times, 2), and the sums of the curvatures, shape (times,) [1/m]."""
    total = np.full(len(motion.time), np.inf if isinstance(pair, PointFollower) else 0.0)
    normal = np.empty((len(motion.time), 2))
    for body, profile, which in zip((pair.body_i, pair.body_j), pair.profiles, ("i", "j"), strict=True):
        if profile is None:
            continue
        alpha = motion.of(f"{pair.name}.alpha_{which}")[0]
        rho, rate, bend = curve_values(profile, alpha)
        total += curvature(np.array([rho, rate, bend]))
        along = np.arctan2(rho, rate) + alpha + motion.of(f"{body}.angle")[0]  # direction of rho' e + rho R e
        normal = np.column_stack([np.sin(along), -np.cos(along)])
    return normal, total


def follower_ways(equations: Equations, motion: KinematicMotion, pair: HigherPair, cam: str) -> FloatArray:
    """Unit vectors along which the follower can go at the contact while the cam stands still, shape (times, 2).

    Zero where that point of the follower cannot move at all.

    Raises:
        KinematicsError: without the pair, the follower can move in more than one way, or in none.
    """
    follower = pair.body_j if pair.body_i == cam else pair.body_i
    kept = [k for k, owner in enumerate(equations.owners) if owner != pair.name]
    others = [k for k, name in enumerate(equations.coordinates) if not name.startswith(f"{pair.name}.alpha_")]
    first = others.index(equations.coordinates.index(f"{follower}.x"))
    arms = _points(motion, pair, follower) - np.column_stack([motion.of(f"{follower}.{c}")[0] for c in ("x", "y")])
    ways = np.empty((len(motion.time), 2))
    for k, (time, q) in enumerate(zip(motion.time, motion.position, strict=True)):
        rows = equations.balanced(equations.at(q, time).jacobian)[np.ix_(kept, others)]
        free = free_directions(rows)
        if free.shape[1] != 1:
            raise KinematicsError(
                f"Without {pair.name!r} and with the cam at rest the mechanism has {free.shape[1]} degrees of freedom, "
                "but a pressure angle has sense with 1 only. Guide the follower, or take other contacts away."
            )
        x, y, turn = free[first : first + 3, 0] * (1.0, 1.0, 1.0 / equations.size)
        way = np.array([x - arms[k, 1] * turn, y + arms[k, 0] * turn])
        ways[k] = way / (np.linalg.norm(way) or 1.0)
    return ways


def _points(motion: KinematicMotion, pair: HigherPair, follower: str) -> FloatArray:
    """The contact points, or the centres of the follower's round roller, shape (times, 2) [m]."""
    if isinstance(pair, PointFollower):
        return _profile_points(motion, pair, "j")
    if isinstance(pair, CamFlatFollower):
        return _profile_points(motion, pair, "i")
    which = "i" if follower == pair.body_i else "j"
    profile = pair.profile_i if which == "i" else pair.profile_j
    return _profile_points(motion, pair, which, 0.0 if radius_of(profile) is not None else 1.0)


def _profile_points(motion: KinematicMotion, pair: HigherPair, which: str, part: float = 1.0) -> FloatArray:
    """Points of profile "i" or "j" at its contact coordinate, that part of the radius away from its centre."""
    body, profile, centre = (getattr(pair, f"{name}_{which}") for name in ("body", "profile", "centre"))
    alpha = motion.of(f"{pair.name}.alpha_{which}")[0]
    x, y, phi = (motion.of(f"{body}.{c}")[0] for c in ("x", "y", "angle"))
    rho = part * curve_values(profile, alpha)[0]
    a, b = float(centre[0]) + rho * np.cos(alpha), float(centre[1]) + rho * np.sin(alpha)
    return np.column_stack([x + np.cos(phi) * a - np.sin(phi) * b, y + np.sin(phi) * a + np.cos(phi) * b])


_DRIVER = "turn of the cam"
#: A pressure angle beyond this is usually avoided [rad]: 30 deg for a sliding, 45 deg for an oscillating follower.
USUAL_LIMIT = math.radians(30)


@dataclass(frozen=True)
class CamReport:
    """A cam pair over one turn of its cam.

    Attributes:
        motion: of all bodies, with the cam turning at 1 rad/s: velocities are derivatives by the cam's angle.
        cam_angle: shape (angles + 1,) [rad].
        pressure_angle: between the contact normal and the way that the follower can go at the contact [rad], 0..pi/2;
            of a round roller, at its centre.
        relative_curvature: sum of both curvatures at the contact [1/m]; positive: the pair fits. A point fits always:
            infinite.
        profile: of the cam.
        roller_radius: of the follower's roller [m]: 0 of a point, None of a flat face or any other profile.
        flat: whether the follower has a flat face.
    """

    motion: KinematicMotion
    cam_angle: FloatArray
    pressure_angle: FloatArray
    relative_curvature: FloatArray
    profile: ProfileReport
    roller_radius: float | None
    flat: bool

    def problems(self, limit: float = USUAL_LIMIT) -> tuple[str, ...]:
        """What an engineer should know of pair and profile, one sentence each; `limit` of the pressure angle [rad].

        Args:
            limit: of the pressure angle [rad].
        """
        return (*self._problems(limit), *self.profile.problems(self.roller_radius, flat=self.flat))

    def _problems(self, limit: float) -> Iterator[str]:
        worst = int(np.argmax(self.pressure_angle))
        if self.pressure_angle[worst] > limit:
            yield (
                f"The pressure angle reaches {math.degrees(self.pressure_angle[worst]):.2f} deg at cam angle "
                f"{math.degrees(self.cam_angle[worst]):.1f} deg; usual is at most {math.degrees(limit):g} deg. Give a "
                "larger base circle, or spread the rise over a larger angle."
            )
        least = int(np.argmin(self.relative_curvature))
        if self.relative_curvature[least] <= 0.0:
            yield (
                f"At cam angle {math.degrees(self.cam_angle[least]):.1f} deg the follower is on the wrong side of the "
                "cam, or does not fit into its hollow. Check the start guess, or give a profile without that hollow."
            )


def cam_report(mechanism: Mechanism, contact: str, cam: str, angles: int = 360) -> CamReport:
    """Turn the body `cam` once, whatever drove it before, and look at one of its pairs.

    Args:
        mechanism: with one degree of freedom when its drivers are taken away.
        contact: name of the pair of profiles; it must be closed.
        cam: name of its body that is the cam; the other one is the follower.
        angles: how many steps the turn has, 1 or more.

    Raises:
        KinematicsError: angles cannot be, there is no such pair, or it does not run through a whole turn.

    Source: textbook: R. L. Norton, Design of Machinery, chapter on cam design; the contact itself: ME451 slides,
        cam-follower.
    """
    if not 1 <= angles < math.inf:
        raise KinematicsError(f"angles = {angles} steps of a turn; give 1 or more, e.g. 360.")
    pair = _pair(mechanism, contact, cam)
    start = next(float(body.start[2]) for body in mechanism.bodies if body.name == cam)
    joints = tuple(joint for joint in mechanism.joints if joint.motion is None)
    drive = AngleDriver(_DRIVER, cam, polynomial_motion(start, 1.0))
    driven = replace(mechanism, joints=(*joints, drive), inputs=(), outputs=(), calculated=(), held=())
    on_cam, on_follower = pair.profiles if pair.body_i == cam else pair.profiles[::-1]
    if on_cam is None:
        raise KinematicsError(f"{cam!r} has no profile in {contact!r}: the cam is the other body.")
    flat, roller_radius = isinstance(pair, CamFlatFollower), _roller_radius(pair, on_follower)
    profile = profile_report(on_cam)
    try:
        motion = analyse(driven, np.linspace(0.0, 2 * math.pi, angles + 1))
    except KinematicsError as error:
        known = " ".join(profile.problems(roller_radius, flat=flat))
        raise type(error)(f"{contact!r} does not run through a whole turn of {cam!r}. {known} {error}") from error
    normal, bend = contact_geometry(motion, pair)
    cosine = np.abs(np.sum(normal * follower_ways(Equations(driven, 0.0), motion, pair, cam), axis=1))
    return CamReport(
        motion=motion,
        cam_angle=motion.of(f"{cam}.angle")[0],
        pressure_angle=np.arccos(np.minimum(cosine, 1.0)),
        relative_curvature=bend,
        profile=profile,
        roller_radius=roller_radius,
        flat=flat,
    )


def _roller_radius(pair: HigherPair, profile: Curve | None) -> float | None:
    if isinstance(pair, PointFollower):
        return 0.0
    return None if profile is None else radius_of(profile)


def _pair(mechanism: Mechanism, contact: str, cam: str) -> HigherPair:
    pairs = {c.name: c for c in mechanism.contacts if isinstance(c, HigherPair)}
    if contact not in pairs:
        raise KinematicsError(f"There is no pair of profiles {contact!r}; there are: {', '.join(pairs) or 'none'}.")
    pair = pairs[contact]
    names = [body.name for body in mechanism.bodies]
    if cam not in (pair.body_i, pair.body_j) or not {pair.body_i, pair.body_j} <= set(names):
        raise KinematicsError(
            f"A report on {contact!r} needs one of its bodies, {pair.body_i!r} and {pair.body_j!r}, as the cam and the "
            f"other one as a follower that can move; the cam given is {cam!r}."
        )
    if pair.enabled < 0.5 or pair.closed < 0.5:
        raise KinematicsError(f"{contact!r} is open; give it closed=True and enabled=True.")
    return pair

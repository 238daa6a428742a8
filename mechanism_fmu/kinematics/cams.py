"""A cam and its follower over one turn of the cam: contact point, curvature, pressure angle."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from ..model import AngleDriver, CamFlatFollower, Curve, Mechanism, PointFollower
from ..model.joints import HigherPair
from ..model.motions import polynomial_motion
from .contact_geometry import contact_geometry, follower_ways
from .equations import Equations, FloatArray
from .errors import KinematicsError
from .motion import KinematicMotion, analyse
from .profile_values import radius_of
from .profiles import ProfileReport, profile_report

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
        """What an engineer should know of pair and profile, one sentence each; `limit` of the pressure angle [rad]."""
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

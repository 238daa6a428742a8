"""Where a cam and its follower touch: normal, curvatures, and the way that the follower can go there."""

from __future__ import annotations

import numpy as np

from ..model import CamFlatFollower, PointFollower
from ..model.joints import HigherPair
from .equations import Equations, FloatArray
from .errors import KinematicsError
from .motion import KinematicMotion
from .profile_values import curvature, curve_values, radius_of
from .rank import free_directions


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

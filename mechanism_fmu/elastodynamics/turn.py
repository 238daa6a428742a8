"""One turn of a mechanism at constant speed, whatever drives it in a simulation."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from ..kinematics import KinematicMotion
from ..model import GROUND, AngleDriver, Mechanism, polynomial_motion
from .closure import closed_at
from .configuration import Configurations, configurations
from .errors import LinkageError
from .fourier import FloatArray, coefficients, evaluate, even_angles
from .linkage import linkage

#: What a turn may end beside its beginning [m, rad], for a mechanism of the size 1 m.
_REPEATS = 1e-9

#: Name of the driver that turns the crank; its reaction is the input torque.
DRIVE = "constant_speed"


def crank_of(mechanism: Mechanism) -> str:
    """The body that turns a mechanism: that of its driver of an angle against the ground, or whose angle is held.

    Raises:
        LinkageError: there is none, or another one besides.
    """
    driven = [j.body_j for j in mechanism.joints if isinstance(j, AngleDriver) and j.body_i == GROUND]
    others = [j.name for j in mechanism.joints if j.motion is not None and j.name not in _angle_drivers(mechanism)]
    held = [] if driven or others else [name.rpartition(".") for name in mechanism.held]
    found = [*driven, *(body for body, _, what in held if what == "angle")]
    if len(found) == 1 and not others and all(what == "angle" for _, _, what in held):
        return found[0]
    what = ", ".join([*found, *others, *(".".join((b, w)) for b, _, w in held if w != "angle")]) or "nothing"
    raise LinkageError(
        f"One body must turn the mechanism, but what its drivers and held coordinates move is: {what}. Drive one angle "
        'against the ground with an AngleDriver, or hold one: Mechanism(..., held=("crank.angle",)).'
    )


def turn(mechanism: Mechanism, speed: float, samples: int) -> Configurations:
    """A whole turn of the crank, counter-clockwise, its end included, at even times.

    Positions are exact to rounding; accelerations are derivatives of the series through the velocities, which 360
    samples of a linkage that stays away from dead centres determine to rounding, too.

    Args:
        mechanism: with members, and a crank of `crank_of`; drivers and held coordinates give way to a constant speed.
        speed: of the crank [rad/s], > 0.
        samples: steps of the turn, 8 or more; its angles are multiples of 2 pi / samples, from the first one at or
            behind the angle at the start on.

    Raises:
        LinkageError: speed or samples cannot be, the crank cannot turn fully, or the mechanism is no structure of
            members.
    """
    if not 0.0 < speed < math.inf:
        raise LinkageError(f"The speed of the crank is {speed:g} rad/s, but must be positive and finite.")
    if not 8 <= samples < math.inf:
        raise LinkageError(f"{samples} samples of a turn are too few; give 8 or more, e.g. 360.")
    crank = crank_of(mechanism)
    start = next(float(body.start[2]) for body in mechanism.bodies if body.name == crank)
    step = 2 * math.pi / samples
    # a start within rounding of a multiple is one
    first = math.ceil(start / step - 1e-9)
    angles = step * np.arange(first, first + samples + 1)
    driver = AngleDriver(DRIVE, crank, polynomial_motion(start, speed))
    joints = tuple(joint for joint in mechanism.joints if joint.name not in _angle_drivers(mechanism))
    driven = replace(mechanism, joints=(*joints, driver), held=())
    before = [start] if start < angles[0] else []
    position, rate = (part[len(before) :] for part in closed_at(driven, np.array([*before, *angles])))
    gap = np.abs(position[-1] - position[0] - 2 * math.pi * np.round(rate.mean(axis=0)) * _angular(driven)).max()
    if gap > _REPEATS * max(1.0, np.abs(position).max()):
        raise LinkageError(
            f"After one turn of {crank!r} the mechanism is not where it was, by {gap:.3g} m or rad. Choose a "
            "crank of whose every turn the motion repeats."
        )
    # q'' by the trigonometric series of q', which repeats
    second = evaluate(coefficients(rate[:-1]), even_angles(samples), 1)
    names = tuple(f"{body.name}.{c}" for body in mechanism.bodies for c in ("x", "y", "angle"))
    motion = KinematicMotion(
        names, (angles - angles[0]) / speed, position, speed * rate, speed**2 * np.vstack([second, second[:1]])
    )
    return configurations(linkage(driven), motion)


def _angular(mechanism: Mechanism) -> FloatArray:
    """1 for each coordinate that is an angle, else 0."""
    return np.tile([0.0, 0.0, 1.0], len(mechanism.bodies))


def _angle_drivers(mechanism: Mechanism) -> set[str]:
    return {j.name for j in mechanism.joints if isinstance(j, AngleDriver) and j.body_i == GROUND}

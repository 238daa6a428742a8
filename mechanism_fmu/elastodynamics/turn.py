"""One turn of a mechanism at constant speed, whatever drives it in a simulation."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ..kinematics import KinematicMotion
from ..model import (
    GROUND,
    AngleDriver,
    CompliantShaft,
    Distance,
    Mechanism,
    RevoluteTranslational,
    Torque,
    Translational,
    polynomial_motion,
)
from .elements import FloatArray, LinkageError
from .fourier import coefficients, evaluate, even_angles
from .structure.configuration import Configurations, configurations
from .structure.linkage import linkage
from .structure.places import held_coordinates
from .structure.pose import Pose, dot, left, pose_of, rotation_rows, translation_rows

# Phi_q of the rigid mechanism, in all configurations at once.


def rigid_rows(mechanism: Mechanism, pose: Pose) -> tuple[FloatArray, tuple[str, ...]]:
    """Phi_q of joints, drivers and held coordinates, shape (times, rows, 3 bodies), and whose each row is.

    Raises:
        LinkageError: as of `translation_rows`.
    """
    found: list[FloatArray] = []
    owners: list[str] = []
    for joint in mechanism.joints:
        ends = [
            (pose.bodies.index(body), left(pose.turned(body, point)), columns)
            for body, point, columns in (
                (joint.body_i, getattr(joint, "point_i", (0.0, 0.0)), slice(0, 3)),
                (joint.body_j, getattr(joint, "point_j", (0.0, 0.0)), slice(3, 6)),
            )
        ]
        for row in (*translation_rows(joint, pose), *rotation_rows(joint, pose)):
            wide = np.zeros((len(pose.time), len(pose.bodies), 3))
            for k, arm, columns in ends:
                part = row[:, columns]
                wide[:, k, :2] += part[:, :2]
                wide[:, k, 2] += part[:, 2] + dot(part, arm)
            found.append(wide)
            owners.append(joint.name)
    for body, what in held_coordinates(mechanism):
        wide = np.zeros((len(pose.time), len(pose.bodies), 3))
        wide[:, pose.bodies.index(body), ("x", "y", "angle").index(what)] = 1.0
        found.append(wide)
        owners.append(f"{body}.{what}")
    rows = np.stack(found, axis=1)[:, :, :-1]  # the ground does not move
    return rows.reshape(*rows.shape[:2], -1), tuple(owners)


# A mechanism at given angles of its crank: Phi(q) = 0 by Newton's method, without the compiled engine.

#: Rows are closed to this [m, rad], of a mechanism of the size 1 m; more rounds than these are not going to help.
_CLOSED, _ROUNDS = 1e-13, 12
#: From one of these to the next [rad] the motion is followed one by one; all others are found from them at once.
_STRIDE = math.radians(5)


def closed_at(mechanism: Mechanism, angles: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Coordinates q and their derivatives q' by the crank's angle, both of shape (angles, 3 bodies).

    Args:
        mechanism: its last joint is the driver of the crank's angle; its start guess closes at the first angle.
        angles: of the crank [rad], increasing.

    Raises:
        LinkageError: there is a position that the mechanism does not reach, or where it could go on in several ways.
    """
    count = max(2, math.ceil((angles[-1] - angles[0]) / _STRIDE) + 1)
    stations = np.linspace(angles[0], angles[-1], count)
    q = np.array([[x for body in mechanism.bodies for x in body.start]], dtype=float)
    found, rate = [], np.zeros_like(q)
    for angle, before in zip(stations, [stations[0], *stations[:-1]], strict=True):
        q, rate = _closed(mechanism, q + (angle - before) * rate, np.array([angle]))
        found.append(q[0])
    guess = np.array([np.interp(angles, stations, column) for column in np.transpose(found)]).T
    return _closed(mechanism, guess, angles)


def _closed(mechanism: Mechanism, q: FloatArray, angles: FloatArray) -> tuple[FloatArray, FloatArray]:
    size = max(1.0, float(np.abs(q[:, [k for k in range(q.shape[1]) if k % 3 != 2]]).max()))
    for _ in range(_ROUNDS):
        pose = _pose(mechanism, q)
        rows, _owners = rigid_rows(mechanism, pose)
        if rows.shape[1] != rows.shape[2]:
            raise LinkageError(
                f"{len(mechanism.joints)} joints, the crank's driver among them, give {rows.shape[1]} rows, but "
                f"{len(mechanism.bodies)} bodies have {rows.shape[2]} coordinates; leave out joints that repeat each "
                "other, or add those that are missing."
            )
        left_open = _residual(mechanism, pose, angles)
        worst = int(np.argmax(np.abs(left_open).max(axis=1)))
        try:
            change = np.linalg.solve(rows, -left_open[:, :, None])[:, :, 0]
            unit = np.zeros((rows.shape[1], 1))
            unit[-1] = 1.0
            rate = np.linalg.solve(rows, np.broadcast_to(unit, (len(q), *unit.shape)))[:, :, 0]
        except np.linalg.LinAlgError:
            break
        if np.abs(left_open).max() <= _CLOSED * size:
            return q, rate
        q = q + change
    raise LinkageError(
        f"The crank cannot turn fully: near {math.degrees(angles[worst]):.6g} deg the joints cannot be "
        "closed, or do not say how the mechanism goes on. Choose lengths with which it turns, or another crank."
    )


def _pose(mechanism: Mechanism, q: FloatArray) -> Pose:
    names = tuple(f"{body.name}.{c}" for body in mechanism.bodies for c in ("x", "y", "angle"))
    rest = np.zeros_like(q)
    return pose_of(mechanism, KinematicMotion(names, np.zeros(len(q)), q, rest, rest))


def _residual(mechanism: Mechanism, pose: Pose, angles: FloatArray) -> FloatArray:
    """Phi in the order and with the scale of `rigid_rows`, shape (angles, rows)."""
    found = []
    for joint in mechanism.joints[:-1]:
        between = pose.place(joint.body_j, getattr(joint, "point_j", (0.0, 0.0))) - pose.place(
            joint.body_i, getattr(joint, "point_i", (0.0, 0.0))
        )
        for row in translation_rows(joint, pose):
            found.append(dot(row[:, 3:5], between))
        if isinstance(joint, (Distance, RevoluteTranslational)):
            found[-1] = found[-1] - joint.distance
        if isinstance(joint, Translational):
            along_i, along_j = pose.turned(joint.body_i, joint.axis_i), pose.turned(joint.body_j, joint.axis_j)
            found.append(np.arctan(dot(left(along_i), along_j) / dot(along_i, along_j)))
    crank = pose.bodies.index(mechanism.joints[-1].body_j)
    return np.column_stack([*found, pose.position[:, crank, 2] - angles])


#: What a turn may end beside its beginning [m, rad], for a mechanism of the size 1 m.
_REPEATS = 1e-9

#: Name of the driver that turns the crank; its reaction is the input torque.
DRIVE = "constant_speed"


def crank_of(mechanism: Mechanism) -> str:
    """The body that turns a mechanism: that of its driver of an angle against the ground, or whose angle is held.

    Args:
        mechanism: with one driven or held angle against the ground.

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

    Source: Newton's method on Phi(q, t) = 0 and Phi_q qd = nu (ME451); docs/decisions/023-ked.md, Constant speed.
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


# What of a mechanism's inputs and outputs turns its crank, and reports how its members bend.


@dataclass(frozen=True)
class ElasticPorts:
    """Names of inputs and outputs; "" where there is none.

    Attributes:
        crank: the body that turns the mechanism.
        torque: input of the torque on it.
        shaft_speed, shaft_angle: inputs of the shaft that turns it, [rad/s] and [rad].
        outputs: names of outputs that read members, by their sources, e.g. "arm.end.x_bent" or "arm.stress".
    """

    crank: str
    torque: str
    shaft_speed: str
    shaft_angle: str
    outputs: dict[str, str]

    @property
    def places(self) -> tuple[str, ...]:
        """Ends of members, e.g. "arm.end", whose deviation is an output."""
        return tuple(s.removesuffix(".deviation") for s in self.outputs if s.endswith(".deviation"))


def elastic_ports(mechanism: Mechanism) -> ElasticPorts:
    """The ports of a mechanism with members.

    Args:
        mechanism: with members and a crank of `crank_of`.

    Raises:
        LinkageError: as of `crank_of`.
    """
    crank = crank_of(mechanism)
    turning = {f.name: f for f in mechanism.forces if getattr(f, "body", "") == crank and f.reaction == GROUND}
    targets = {port.target: port.name for port in mechanism.inputs}

    def of(kind: type, column: str) -> str:
        found = (targets.get(f"{name}.{column}", "") for name, force in turning.items() if isinstance(force, kind))
        return next(filter(None, found), "")

    members = {member.name for member in mechanism.members}
    outputs = {port.source: port.name for port in mechanism.outputs if port.source.partition(".")[0] in members}
    return ElasticPorts(crank, of(Torque, "torque"), of(CompliantShaft, "speed"), of(CompliantShaft, "angle"), outputs)

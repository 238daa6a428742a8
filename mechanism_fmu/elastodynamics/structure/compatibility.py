"""Compatibility: constraints of joints and rigid bodies on the displacements, G w = 0, and free ones: w = Z u."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from scipy.linalg import qr

from ...model import Mechanism, Revolute, RevoluteTranslational, Translational
from ..elements import FloatArray, LinkageError
from .places import Freedoms, attachments, fixed_points
from .pose import Pose, guide_axis, left, translation_rows

# What guides, rods, drivers and rigid bodies ask of the displacements w of the places: G w = 0.


def constraint_rows(mechanism: Mechanism, freedoms: Freedoms, pose: Pose) -> tuple[FloatArray, tuple[str, ...]]:
    """G, shape (times, rows, unknowns), and the part that each row is of.

    Pins and equal rotations are no rows: they have one unknown in common already.

    Raises:
        LinkageError: of a joint that the flexibility approach does not know.
    """
    wide: list[FloatArray] = []
    owners: list[str] = []
    for joint in mechanism.joints:
        rows = [] if isinstance(joint, Revolute) else translation_rows(joint, pose)
        for row in rows:
            i, j = attachments(mechanism, freedoms.places, joint)
            wide.append(_spread(freedoms, row, i, j))
            owners.append(joint.name)
    for body, axis in fixed_points(mechanism):
        row = np.zeros((len(pose.time), 6))
        row[:, 3 + ("x", "y").index(axis)] = 1.0
        place = next(n for n, p in enumerate(freedoms.places) if body in p.names)
        wide.append(_spread(freedoms, row, 0, place))
        owners.append(f"{body}.{axis}")
    for row, body, i, j in _rigid_rows(mechanism, freedoms, pose):
        wide.append(_spread(freedoms, row, i, j))
        owners.append(body)
    asking = [k for k, row in enumerate(wide) if row.any()]
    stacked = np.stack([wide[k] for k in asking], axis=1) if asking else np.zeros((1, 0, freedoms.ground))
    return stacked, tuple(owners[k] for k in asking)


def guided(mechanism: Mechanism, freedoms: Freedoms, pose: Pose) -> dict[tuple[int, int], FloatArray]:
    """Of displacements (u_x, u_y) that a guide keeps in line, by their numbers: its direction, shape (times, 2)."""
    found: dict[tuple[int, int], FloatArray] = {}
    for joint in mechanism.joints:
        if isinstance(joint, (Translational, RevoluteTranslational)):
            for place in reversed(attachments(mechanism, freedoms.places, joint)):
                x, y = (int(column) for column in freedoms.columns[place, :2])
                if freedoms.ground not in (x, y) and (x, y) not in found:
                    found[x, y] = guide_axis(joint, pose)
                    break
    return found


def _rigid_rows(mechanism: Mechanism, freedoms: Freedoms, pose: Pose) -> list[tuple[FloatArray, str, int, int]]:
    """The rows u_k - u_0 - theta R A s_k = 0 of the places k of a rigid body: rows, body, and places 0 and k."""
    found = []
    flexible = {member.body for member in mechanism.members}
    for body in mechanism.bodies:
        if body.name in flexible:
            continue
        first, *others = (n for n, place in enumerate(freedoms.places) if place.body == body.name)
        for other in others:
            arm = left(pose.turned(body.name, freedoms.places[other].point))
            for k in range(2):
                row = np.zeros((len(pose.time), 6))
                row[:, k], row[:, 2], row[:, 3 + k] = -1.0, -arm[:, k], 1.0
                found.append((row, body.name, first, other))
    return found


def _spread(freedoms: Freedoms, row: FloatArray, i: int, j: int) -> FloatArray:
    """A row for (u_i, theta_i, u_j, theta_j) of two places as one for w, shape (times, unknowns)."""
    wide = np.zeros((len(row), freedoms.ground + 1))
    for place, first in ((i, 0), (j, 3)):
        for k, column in enumerate(freedoms.columns[place]):
            if column >= 0:  # a released rotation is asked for by no row
                wide[:, column] += row[:, first + k]
    return wide[:, :-1]


# Which displacements are free: w = Z u for all w with G w = 0.

#: Rows say the same when the least pivot is below this part of the largest.
_DEPENDENT = 1e-9
#: Coordinates chosen in the first configuration serve in another one while what multiplies them stays below this.
_LARGEST = 1e4
#: Displacements are preferred to rotations as those that follow from others: angles count as so many longest arms.
_ARMS = 10.0

_Guided = Mapping[tuple[int, int], FloatArray]


def independent_basis(
    rows: FloatArray, owners: tuple[str, ...], names: tuple[str, ...], guides: _Guided
) -> tuple[FloatArray, tuple[str, ...]]:
    """Z, shape (times, unknowns, m), or (1, unknowns, m) where it is always the same, and the names of the m free u.

    Args:
        rows: G, shape (times, rows, unknowns).
        owners: the part that each row is of.
        names: of the unknowns.
        guides: by the numbers of u_x and u_y, the direction of a guide, shape (times, 2): the first of the two counts
            along it then, and is named so.

    Raises:
        LinkageError: rows say the same, or the motion goes so far that no choice of free displacements serves it all.
    """
    if not rows.shape[1]:
        return np.eye(len(names))[None], names
    turned, labels = np.broadcast_to(np.eye(len(names)), (len(rows), len(names), len(names))).copy(), list(names)
    for (x, y), along in guides.items():
        turned[:, x, x], turned[:, y, x] = along.T
        turned[:, x, y], turned[:, y, y] = -along[:, 1], along[:, 0]
        labels[x], labels[y] = names[x].removesuffix(".x") + ".along", names[y].removesuffix(".y") + ".across"
    if not np.ptp(rows, axis=0).any() and not np.ptp(turned, axis=0).any():
        rows, turned = rows[:1], turned[:1]
    local = rows @ turned
    following, free = _choice(local[0], owners, np.array([name.endswith(".angle") for name in names]))
    basis = np.zeros((len(local), len(names), len(free)))
    basis[:, free, range(len(free))] = 1.0
    basis[:, following] = -_solved(local[:, :, following], local[:, :, free], owners)
    return turned @ basis, tuple(labels[k] for k in free)


def _choice(
    rows: FloatArray, owners: tuple[str, ...], angular: np.ndarray[Any, np.dtype[np.bool_]]
) -> tuple[list[int], list[int]]:
    """Numbers of the unknowns that follow from the others, and of these, by the pivots of the rows."""
    arm = np.abs(rows[:, angular]).max(initial=0.0) or 1.0
    scaled = rows / np.where(angular, _ARMS * arm, 1.0)
    triangle, order = qr(scaled, mode="r", pivoting=True)
    pivots = np.abs(np.diag(triangle))
    if rows.shape[0] > rows.shape[1] or pivots[-1] <= _DEPENDENT * pivots[0]:
        raise LinkageError(
            f"The rows of {', '.join(dict.fromkeys(owners))} say the same of rigid parts: their forces cannot be "
            "distinguished. Take one of them out, or give members to the bodies between them; `mobility` names such "
            "rows."
        )
    following = sorted(order[: len(rows)].tolist())
    return following, [k for k in range(rows.shape[1]) if k not in following]


def _solved(matrices: FloatArray, right: FloatArray, owners: tuple[str, ...]) -> FloatArray:
    try:
        solution = np.asarray(np.linalg.solve(matrices, right), dtype=np.float64)
    except np.linalg.LinAlgError:
        solution = np.full_like(right, np.inf)
    if not np.abs(solution).max(initial=0.0) < _LARGEST:
        raise LinkageError(
            f"{', '.join(dict.fromkeys(owners))}: the motion comes to where the displacements that were free at its "
            "start no longer are; analyse it in pieces, each from a configuration of its own on."
        )
    return solution

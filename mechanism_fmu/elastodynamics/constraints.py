"""What guides, rods, drivers and rigid bodies ask of the displacements w of the places: G w = 0."""

from __future__ import annotations

import numpy as np

from ..model import Mechanism, Revolute, RevoluteTranslational, Translational
from .elements import FloatArray
from .freedoms import Freedoms
from .locks import attachments, fixed_points
from .pose import Pose, left
from .rows import guide_axis, translation_rows


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

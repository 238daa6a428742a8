"""Phi_q of the rigid mechanism, in all configurations at once."""

from __future__ import annotations

import numpy as np

from ..model import Mechanism
from .elements import FloatArray
from .locks import held_coordinates
from .pose import Pose, left
from .rows import rotation_rows, translation_rows


def rigid_rows(mechanism: Mechanism, pose: Pose) -> tuple[FloatArray, tuple[str, ...]]:
    """Phi_q of joints, drivers and held coordinates, shape (times, rows, 3 bodies), and whose each row is.

    Raises:
        LinkageError: as of `translation_rows`.
    """
    found: list[FloatArray] = []
    owners: list[str] = []
    for joint in mechanism.joints:
        for row in (*translation_rows(joint, pose), *rotation_rows(joint, pose)):
            wide = np.zeros((len(pose.time), len(pose.bodies), 3))
            for body, point, part in (
                (joint.body_i, getattr(joint, "point_i", (0.0, 0.0)), row[:, :3]),
                (joint.body_j, getattr(joint, "point_j", (0.0, 0.0)), row[:, 3:]),
            ):
                arm = left(pose.turned(body, point))
                k = pose.bodies.index(body)
                wide[:, k, :2] += part[:, :2]
                wide[:, k, 2] += part[:, 2] + np.einsum("tk,tk->t", part[:, :2], arm)
            found.append(wide)
            owners.append(joint.name)
    for body, what in held_coordinates(mechanism):
        wide = np.zeros((len(pose.time), len(pose.bodies), 3))
        wide[:, pose.bodies.index(body), ("x", "y", "angle").index(what)] = 1.0
        found.append(wide)
        owners.append(f"{body}.{what}")
    rows = np.stack(found, axis=1)[:, :, :-1]  # the ground does not move
    return rows.reshape(*rows.shape[:2], -1), tuple(owners)

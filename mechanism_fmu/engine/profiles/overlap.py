"""Interference of profiles: where they run into each other beside their contact."""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Pose
from ...tables.parts import Contacts
from ..compiler.subset import jit, keep_small
from ..elementary import atan2
from ..scales import length_scale
from .curves import curve, sample
from .touch import look

#: Points of profile i that are looked at.
_SAMPLES = 720
#: Profiles overlap when one reaches into the other by more than this, in scale.
_OVERLAP = 1e-10


@jit
def bridged(block: Array, at: Pose) -> bool:
    """Whether a closed pair has run into itself at a second point, because one profile bridges the other's hollow."""
    keep_small()
    table = Contacts(block)
    deepest = 0.0
    for c in range(table.kind.shape[0]):
        if table.hollow[c] == codes.BRIDGES and table.mode[c] == codes.CLOSED:
            deepest = max(deepest, overlap(block, at, c))
    return deepest > 0.0


@jit
def overlap(block: Array, at: Pose, contact: int) -> float:
    """How far profile i reaches into the other one anywhere, beyond what is allowed for rounding [m]; 0 if nowhere."""
    keep_small()
    table = Contacts(block)
    if table.kind[contact] == codes.POINT_FOLLOWER:
        return 0.0
    alpha = table.alpha[contact]
    kept = at.alpha[alpha]
    deepest = 0.0
    for k in range(_SAMPLES):
        at.alpha[alpha] = sample(block, table.curve_i[contact], k, _SAMPLES)
        deepest = max(deepest, _depth(block, at, contact))
    at.alpha[alpha] = kept
    return deepest if deepest > _OVERLAP * length_scale(block) else 0.0


@jit
def _depth(block: Array, at: Pose, contact: int) -> float:
    """How deep the present point of curve i is inside the other body [m]; in a profile, towards its centre."""
    keep_small()
    table = Contacts(block)
    touch = look(block, at, contact)
    i, j = table.body_i[contact], table.body_j[contact]
    dx = at.x[i] + touch.ax - at.x[j]
    dy = at.y[i] + touch.ay - at.y[j]
    depth: float = touch.tx * (dy - touch.by) - touch.ty * (dx - touch.bx)
    if table.kind[contact] == codes.CAM_FOLLOWER:
        c = at.cosine[j]
        s = at.sine[j]
        x = c * dx + s * dy - table.data[contact, 2]
        y = c * dy - s * dx - table.data[contact, 3]
        rho, _, _, _ = curve(block, table.curve_j[contact], atan2(y, x))
        depth = rho - math.sqrt(x * x + y * y)
    return depth

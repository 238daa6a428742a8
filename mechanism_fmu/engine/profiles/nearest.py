"""Contact coordinates of two profiles: kept where they are nearest to each other, and searched where that is unknown.

A closed pair is followed, and so is an open one of convex profiles, whose nearest points are the only ones. With a
hollow there may be several places; an open pair is then looked at everywhere, each time that its gap is asked for.
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Pose
from ...tables.parts import Contacts, Curves
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_small
from .curves import curve, sample
from .touch import change, look

#: Contact coordinates are settled when one more Newton step would move them by less than this [rad].
_SETTLED = 1e-14
#: Before a step, they may be off by this: the gap is off by no more than its square.
_MOST_DRIFT = 1e-12
_NEWTON_STEPS = 40
_LONGEST_STEP = 0.3
#: The search for the nearest points ends with steps of this length; Newton's method goes on [rad].
_NEAR = 1e-6
#: Points of a profile that are looked at in search of the nearest one; of two profiles, this many of each.
_SAMPLES = 720
_PAIRED_SAMPLES = 72


@jit
def settle_contact_points(block: Array, at: Pose, y: Array) -> None:
    """Bring all contact coordinates to the nearest points at the bodies' pose, and write them to the end of `y`."""
    keep_small()
    count = Sizes(block).alphas
    if count == 0:
        return
    table = Contacts(block)
    for c in range(table.kind.shape[0]):
        if table.alpha[c] != codes.NONE and table.value[c, codes.ENABLED] > 0.5:
            if is_searched(block, c):
                find_nearest(block, at, c)
            else:
                _settle(block, at, c)
    _keep(block, at, y)


@jit
def find_contact_points(block: Array, at: Pose, y: Array) -> None:
    """As `settle_contact_points`, but with a search on the whole of both curves of every pair."""
    keep_small()
    table = Contacts(block)
    for c in range(table.kind.shape[0]):
        if table.alpha[c] != codes.NONE and table.value[c, codes.ENABLED] > 0.5:
            find_nearest(block, at, c)
    _keep(block, at, y)


@jit
def _keep(block: Array, at: Pose, y: Array) -> None:
    first = Sizes(block).y_alpha
    for k in range(Sizes(block).alphas):
        y[first + k] = at.alpha[k]


@jit
def is_searched(block: Array, contact: int) -> bool:
    """Whether a pair's nearest points are sought afresh at each pose: it is open, and one of its profiles is hollow."""
    table = Contacts(block)
    searched: bool = table.mode[contact] == codes.OPEN and table.hollow[contact] != codes.CONVEX
    return searched


@jit
def find_nearest(block: Array, at: Pose, contact: int) -> None:
    """Bring a pair's contact coordinates to the nearest points of all."""
    keep_small()
    alpha = Contacts(block).alpha[contact]
    last = alpha + 1 if Contacts(block).kind[contact] == codes.CAM_FOLLOWER else alpha
    _find(block, at, contact)
    found_i = at.alpha[alpha]
    found_j = at.alpha[last]
    _settle(block, at, contact)
    if not abs(at.alpha[alpha] - found_i) + abs(at.alpha[last] - found_j) < _LONGEST_STEP:
        at.alpha[alpha] = found_i  # where curves hardly bend, Newton's method may lead away
        at.alpha[last] = found_j


@jit
def least_fit(block: Array, at: Pose) -> float:
    """How well the closed pair fits that fits least: the sum of the turnings of both curves; positive if well."""
    keep_small()
    table = Contacts(block)
    least = math.inf
    for c in range(table.kind.shape[0]):
        if table.alpha[c] != codes.NONE and table.mode[c] == codes.CLOSED:
            least = min(least, _fit(block, at, c))
    return least


@jit
def _fit(block: Array, at: Pose, contact: int) -> float:
    """How well a pair fits at its contact point; 0 when that has not been found: Newton's method did not settle."""
    move_i, move_j, _, _, _, fit = _newton_step(block, at, contact)
    if abs(move_i) + abs(move_j) > _NEAR:
        return 0.0
    return fit


@jit
def _settle(block: Array, at: Pose, contact: int) -> None:
    keep_small()
    alpha = Contacts(block).alpha[contact]
    kind = Contacts(block).kind[contact]
    least = _MOST_DRIFT
    for _ in range(_NEWTON_STEPS):
        move_i, move_j, _, _, _, _ = _newton_step(block, at, contact)
        size = abs(move_i) + abs(move_j)
        if not size > least:
            return
        least = _SETTLED
        factor = min(1.0, _LONGEST_STEP / size)
        if kind == codes.POINT_FOLLOWER:
            at.alpha[alpha] += factor * move_j
        else:
            at.alpha[alpha] += factor * move_i
        if kind == codes.CAM_FOLLOWER:
            at.alpha[alpha + 1] += factor * move_j


@jit
def _newton_step(block: Array, at: Pose, contact: int) -> tuple[float, float, float, float, float, float]:
    """Changes of alpha_i and alpha_j towards the nearest points, gap, distance squared, t.g_i/|g_i|, and the fit."""
    keep_small()
    table = Contacts(block)
    touch = look(block, at, contact)
    i, j = table.body_i[contact], table.body_j[contact]
    dx = at.x[i] + touch.ax - at.x[j] - touch.bx
    dy = at.y[i] + touch.ay - at.y[j] - touch.by
    gap = touch.ty * dx - touch.tx * dy
    first = touch.ty * touch.gx - touch.tx * touch.gy
    second = touch.tx * dx + touch.ty * dy
    move_i, move_j, fit = change(table.kind[contact], touch, gap, first, second)
    length = math.sqrt(touch.gx * touch.gx + touch.gy * touch.gy)
    cosine = 0.0
    if length > 0.0:
        cosine = (touch.tx * touch.gx + touch.ty * touch.gy) / length
        fit /= length
    if touch.stretch > 0.0:
        fit /= touch.stretch
    return move_i, move_j, gap, dx * dx + dy * dy, cosine, fit


@jit
def _find(block: Array, at: Pose, contact: int) -> None:
    """Bring a pair's contact coordinates near to the best place of all, by sampling and then by ever smaller steps."""
    keep_small()
    table = Contacts(block)
    alpha = table.alpha[contact]
    first, second = table.curve_i[contact], table.curve_j[contact]
    samples, others = _SAMPLES, 0
    if table.kind[contact] == codes.POINT_FOLLOWER:
        first = second
    elif table.kind[contact] == codes.CAM_FOLLOWER:
        samples = others = _PAIRED_SAMPLES
    least = math.inf
    best_i = 0.0
    best_j = 0.0
    for k in range(samples + 1):
        at.alpha[alpha] = sample(block, first, k, samples)
        for m in range(others + 1):
            if others > 0:
                at.alpha[alpha + 1] = sample(block, second, m, others)
            found = _distance(block, at, contact)
            if found < least:
                least = found
                best_i = at.alpha[alpha]
                if others > 0:
                    best_j = at.alpha[alpha + 1]
    at.alpha[alpha] = best_i
    if others > 0:
        at.alpha[alpha + 1] = best_j
    _descend(block, at, contact, least, Curves(block).range[first, 1] / samples)


@jit
def _descend(block: Array, at: Pose, contact: int, least: float, step: float) -> None:
    """From where the distance is `least`, go on to less in steps of `step` [rad] at first, until Newton's are safe."""
    keep_small()
    first = Contacts(block).alpha[contact]
    last = first + 1 if Contacts(block).kind[contact] == codes.CAM_FOLLOWER else first
    while step > _NEAR:
        moved = False
        for k in range(first, last + 1):
            for way in range(-1, 2, 2):
                kept = at.alpha[k]
                at.alpha[k] = kept + way * step
                found = _distance(block, at, contact)
                if found < least:
                    least = found
                    moved = True
                else:
                    at.alpha[k] = kept
        if not moved:
            step *= 0.5


@jit
def _distance(block: Array, at: Pose, contact: int) -> float:
    """What is least at the best place: the gap to a face, or the squared distance of two points [m2].

    Of two profiles, normals that are not opposite make it larger.
    """
    keep_small()
    kind = Contacts(block).kind[contact]
    _, _, gap, square, cosine, _ = _newton_step(block, at, contact)
    if kind == codes.CAM_FLAT_FOLLOWER:
        return gap
    if kind == codes.CAM_FOLLOWER:
        rho, _, _, _ = curve(block, Contacts(block).curve_i[contact], at.alpha[Contacts(block).alpha[contact]])
        square += (1.0 + cosine) * rho * rho
    return square

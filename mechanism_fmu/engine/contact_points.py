"""Contact coordinates: kept where two profiles are nearest to each other, and found there at the start."""

from __future__ import annotations

import math

from .. import codes
from .curves import curve
from .room import Array
from .subset import jit, keep_small
from .touch import change, look
from .views import contacts, curves, pose, sizes

#: Contact coordinates are settled when one more Newton step would move them by less than this [rad].
_SETTLED = 1e-14
#: Before a step, they may be off by this: the gap is off by no more than its square.
_MOST_DRIFT = 1e-12
_NEWTON_STEPS = 40
_LONGEST_STEP = 0.3
#: Points of a profile that are looked at in search of the nearest one; of two profiles, this many of each.
_SAMPLES = 720
_PAIRED_SAMPLES = 72
#: Profiles overlap when one reaches into the other by more than this [m].
_OVERLAP = 1e-9


@jit
def settle_contact_points(block: Array, y: Array) -> None:
    """Bring all contact coordinates to the nearest points at the bodies' pose, and write them to the end of `y`."""
    keep_small()
    count = sizes(block).alphas
    if count == 0:
        return
    table = contacts(block)
    for c in range(table.kind.shape[0]):
        if table.alpha[c] != codes.NONE:
            _settle(block, c)
    first = y.shape[0] - count
    for k in range(count):
        y[first + k] = pose(block).alpha[k]


@jit
def find_contact_points(block: Array, y: Array) -> None:
    """Look for the nearest points of all pairs of profiles on the whole of both curves."""
    keep_small()
    table = contacts(block)
    for c in range(table.kind.shape[0]):
        if table.alpha[c] == codes.NONE:
            continue
        if table.kind[c] == codes.CAM_FOLLOWER:
            _find_pair(block, c)
        else:
            _find(block, c)
    settle_contact_points(block, y)


@jit
def least_fit(block: Array) -> float:
    """How well the least fitting pair of profiles fits: the sum of the turnings of both curves; positive if well."""
    keep_small()
    table = contacts(block)
    least = math.inf
    for c in range(table.kind.shape[0]):
        if table.alpha[c] != codes.NONE and table.value[c, codes.ENABLED] > 0.5:
            least = min(least, _newton_step(block, c)[5])
    return least


@jit
def overlap(block: Array, contact: int) -> float:
    """How far profile i reaches into the other one anywhere, beyond what is allowed for rounding [m]; 0 if nowhere."""
    keep_small()
    table = contacts(block)
    at = pose(block)
    if table.kind[contact] == codes.POINT_FOLLOWER:
        return 0.0
    alpha = table.alpha[contact]
    kept = at.alpha[alpha]
    deepest = 0.0
    for k in range(_SAMPLES):
        at.alpha[alpha] = _sample(block, table.curve_i[contact], k, _SAMPLES)
        deepest = max(deepest, _depth(block, contact))
    at.alpha[alpha] = kept
    if deepest > _OVERLAP:
        return deepest
    return 0.0


@jit
def _settle(block: Array, contact: int) -> None:
    keep_small()
    at = pose(block)
    alpha = contacts(block).alpha[contact]
    kind = contacts(block).kind[contact]
    least = _MOST_DRIFT
    for _ in range(_NEWTON_STEPS):
        move_i, move_j, _, _, _, _ = _newton_step(block, contact)
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
def _newton_step(block: Array, contact: int) -> tuple[float, float, float, float, float, float]:
    """Changes of alpha_i and alpha_j towards the nearest points, gap, distance squared, t.g_i/|g_i|, and the fit."""
    keep_small()
    table = contacts(block)
    at = pose(block)
    touch = look(block, contact)
    i = table.body_i[contact]
    j = table.body_j[contact]
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
def _sample(block: Array, number: int, k: int, count: int) -> float:
    """The k-th of `count` equidistant values of a profile's coordinate."""
    table = curves(block)
    value: float = table.range[number, 0] + table.range[number, 1] * k / count
    return value


@jit
def _find(block: Array, contact: int) -> None:
    """The point of a profile nearest to a point, or farthest towards a flat face."""
    keep_small()
    table = contacts(block)
    at = pose(block)
    alpha = table.alpha[contact]
    flat = table.kind[contact] == codes.CAM_FLAT_FOLLOWER
    number = table.curve_j[contact]
    if flat:
        number = table.curve_i[contact]
    best = at.alpha[alpha]
    least = math.inf
    for k in range(_SAMPLES + 1):
        at.alpha[alpha] = _sample(block, number, k, _SAMPLES)
        _, _, gap, square, _, _ = _newton_step(block, contact)
        if flat:
            square = gap
        if square < least:
            least = square
            best = at.alpha[alpha]
    at.alpha[alpha] = best


@jit
def _find_pair(block: Array, contact: int) -> None:
    """The points of two profiles that are nearest to each other and whose outward normals are opposite."""
    keep_small()
    table = contacts(block)
    at = pose(block)
    alpha = table.alpha[contact]
    best_i = 0.0
    best_j = 0.0
    least = math.inf
    for k in range(_PAIRED_SAMPLES + 1):
        at.alpha[alpha] = _sample(block, table.curve_i[contact], k, _PAIRED_SAMPLES)
        rho, _, _, _ = curve(block, table.curve_i[contact], at.alpha[alpha])
        for m in range(_PAIRED_SAMPLES + 1):
            at.alpha[alpha + 1] = _sample(block, table.curve_j[contact], m, _PAIRED_SAMPLES)
            _, _, _, square, cosine, _ = _newton_step(block, contact)
            square += (1.0 + cosine) * rho * rho
            if square < least:
                least = square
                best_i = at.alpha[alpha]
                best_j = at.alpha[alpha + 1]
    at.alpha[alpha] = best_i
    at.alpha[alpha + 1] = best_j


@jit
def _depth(block: Array, contact: int) -> float:
    """How deep the present point of curve i is inside the other body [m]; in a profile, towards its centre."""
    keep_small()
    table = contacts(block)
    at = pose(block)
    touch = look(block, contact)
    i = table.body_i[contact]
    j = table.body_j[contact]
    dx = at.x[i] + touch.ax - at.x[j]
    dy = at.y[i] + touch.ay - at.y[j]
    depth: float = touch.tx * (dy - touch.by) - touch.ty * (dx - touch.bx)
    if table.kind[contact] == codes.CAM_FOLLOWER:
        c = at.cosine[j]
        s = at.sine[j]
        x = c * dx + s * dy - table.data[contact, 2]
        y = c * dy - s * dx - table.data[contact, 3]
        rho, _, _, _ = curve(block, table.curve_j[contact], math.atan2(y, x))
        depth = rho - math.sqrt(x * x + y * y)
    return depth

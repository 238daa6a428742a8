"""Where the place of contact of two outlines comes to the end of a feature, and what it goes on with there."""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Pose, Rows
from ...tables.parts import Contacts, Features, Outlines
from ...tolerances import PASSES_BY, RESTS_BELOW, TOUCHES_WITHIN
from ..compiler.subset import jit, keep_apart, keep_small
from ..constraints.outline_row import outline_row, place_feature, turning_of
from ..constraints.point_line import spare_row
from ..outlines.features import (
    beside,
    faces_corner,
    fits,
    inside_range,
    is_copy,
    is_corner,
    is_hollow_corner,
    over_arc,
    over_seam,
    radius_of,
    wrapped,
)
from ..scales import contact_speed, length_scale
from .binding import let_loose


@jit
def left_to_go(block: Array, at: Pose, contact: int) -> tuple[float, int, int]:
    """How far the place of contact is from the nearest end of a feature it is on [m]; of which side, and which way."""
    keep_small()
    way_i, value_i, way_j, value_j = _ends(block, at, contact)
    if value_i < value_j:
        return value_i, 0, way_i
    return value_j, 1, way_j


@jit
def left_on_side(block: Array, at: Pose, contact: int, side: int) -> float:
    """As `left_to_go`, of one side alone: what lies flat is at an end of the other one all the time."""
    keep_small()
    _, value_i, _, value_j = _ends(block, at, contact)
    return value_i if side == 0 else value_j


@jit
def _ends(block: Array, at: Pose, contact: int) -> tuple[int, float, int, float]:
    """The nearer end of the feature of each side: which way it lies, and how far [m]."""
    keep_apart()
    table = Contacts(block)
    i, j = table.body_i[contact], table.body_j[contact]
    f, g = table.feature_i[contact], table.feature_j[contact]
    copy = table.copy[contact]
    ax, ay, tx, ty = place_feature(block, at, i, table.outline_i[contact], 0, f)
    bx, by, vx, vy = place_feature(block, at, j, table.outline_j[contact], copy, g)
    dx = at.x[i] + ax - at.x[j] - bx
    dy = at.y[i] + ay - at.y[j] - by
    kind_i, kind_j = Features(block).kind[f], Features(block).kind[g]
    nx, ny = dx, dy  # out of j, whatever its length
    # as long as what turns with it moves at least: how far a corner may tilt is then no more than its points move
    data = Outlines(block).data
    long = min(
        data[table.outline_i[contact], codes.OUTLINE_RADIUS], data[table.outline_j[contact], codes.OUTLINE_RADIUS]
    )
    if kind_j == codes.SEGMENT:
        nx, ny = long * vy, -long * vx
    elif kind_i == codes.SEGMENT:
        nx, ny = -long * ty, long * tx
    elif radius_of(block, f) < 0.0 or radius_of(block, g) < 0.0:
        nx, ny = -dx, -dy
    way_i, value_i = _end(block, at, table.outline_i[contact], i, 0, f, g, -dx, -dy, -nx, -ny)
    way_j, value_j = _end(block, at, table.outline_j[contact], j, copy, g, f, dx, dy, nx, ny)
    return way_i, value_i, way_j, value_j


@jit
def _end(
    block: Array,
    at: Pose,
    outline: int,
    body: int,
    copy: int,
    feature: int,
    partner: int,
    dx: float,
    dy: float,
    nx: float,
    ny: float,
) -> tuple[int, float]:
    """The nearer end of a feature: which way it lies, and how far [m].

    (dx, dy) leads from the feature's point to that of its partner, (nx, ny) is the normal out of the feature.
    """
    keep_apart()
    data = Features(block).data[feature]
    kind = Features(block).kind[feature]
    c, s = turning_of(block, at, body, outline, copy)
    before = math.inf
    behind = math.inf
    if kind == codes.ARC:
        side = 1.0 if data[codes.FEATURE_RADIUS] > 0.0 else -1.0
        before, behind = over_arc(block, feature, side * (c * nx + s * ny), side * (c * ny - s * nx))
    else:
        if kind == codes.VERTEX:  # by the normal: a hollow arc's centre is on the other side
            dx, dy = nx, ny
        x = data[codes.FEATURE_X] + c * dx + s * dy
        y = data[codes.FEATURE_Y] + c * dy - s * dx
        before, behind = inside_range(block, feature, x, y)
    if kind == codes.VERTEX:
        if not _goes_on(block, outline, feature, -1, partner):
            before = math.inf
        if not _goes_on(block, outline, feature, 1, partner):
            behind = math.inf
    if before < behind:
        return -1, before
    return 1, behind


@jit
def _goes_on(block: Array, outline: int, feature: int, way: int, partner: int) -> bool:
    """Whether what is behind the end of a feature can touch what that touches: an arc, on a side; a side, on an arc.

    A side that comes to lie on a side does not take over: its other end, or that of the other one, strikes. Nor does a
    hollow take over, which a corner goes on to bridge. In a hollow corner what touches goes on to do so.
    """
    keep_small()
    follows = beside(block, outline, feature, way)
    if follows == codes.NONE:
        follows = over_seam(block, outline, feature, way)
    elif Features(block).kind[follows] == codes.VERTEX and not is_corner(block, follows):
        if is_hollow_corner(block, follows):
            return True
        follows = beside(block, outline, follows, way)
        if follows == codes.NONE:
            follows = over_seam(block, outline, feature, way)
    goes_on: bool = follows != codes.NONE and fits(block, follows, partner)
    return goes_on


@jit
def ends_in_hollow(block: Array, at: Pose, contact: int) -> bool:
    """Whether the nearest end of the features that touch is a hollow corner."""
    keep_small()
    table = Contacts(block)
    _, side, way = left_to_go(block, at, contact)
    outline = table.outline_i[contact] if side == 0 else table.outline_j[contact]
    leaves = table.feature_i[contact] if side == 0 else table.feature_j[contact]
    corner = beside(block, outline, leaves, way)
    return corner != codes.NONE and is_hollow_corner(block, corner)


@jit
def hand_over(block: Array, at: Pose, contact: int) -> None:
    """Where the place of contact has come to the end of a feature, go on with the next one, or come off.

    Where the outline goes on smoothly, and where a disc goes around a corner, the normal goes on as well, and nothing
    strikes. A corner that comes to the corner of the other outline has come to its end. In a hollow corner it stays,
    and meets the element behind that besides, which is then for `bind_what_touches`.
    """
    keep_apart()
    table = Contacts(block)
    side, way = _leaves(block, at, contact)
    outline = table.outline_i[contact] if side == 0 else table.outline_j[contact]
    leaves = table.feature_i[contact] if side == 0 else table.feature_j[contact]
    partner = table.feature_j[contact] if side == 0 else table.feature_i[contact]
    follows = beside(block, outline, leaves, way)
    if follows != codes.NONE and is_hollow_corner(block, follows):
        return
    if Features(block).kind[leaves] == codes.VERTEX and Features(block).kind[partner] == codes.VERTEX:
        _come_off_corner(block, contact, side, follows)
        return
    if follows != codes.NONE and Features(block).kind[follows] == codes.VERTEX:
        if not is_corner(block, follows):
            follows = beside(block, outline, follows, way)
        elif Features(block).kind[partner] == codes.VERTEX:
            if _around_corner(block, at, contact, side, way, follows):
                return
            follows = codes.NONE
    if follows == codes.NONE and side == 1 and _cross_seam(block, at, contact, way):
        return
    if follows != codes.NONE and fits(block, follows, partner):
        if side == 0:
            table.feature_i[contact] = follows
        else:
            table.feature_j[contact] = follows
        outline_row(block, at, contact, spare_row(block), False)
        if abs(Rows(block).residual[spare_row(block)]) <= TOUCHES_WITHIN * length_scale(block):
            return
    table.mode[contact] = codes.OPEN
    table.touching[contact] = 0
    let_loose(block, contact)


@jit
def _leaves(block: Array, at: Pose, contact: int) -> tuple[int, int]:
    """Of which side the place of contact leaves its feature, and which way: where both are at an end, what goes on.

    What lies flat is at an end of the other side all the time, but for rounding.
    """
    keep_small()
    table = Contacts(block)
    way_i, value_i, way_j, value_j = _ends(block, at, contact)
    f, g = table.feature_i[contact], table.feature_j[contact]
    is_first = value_i < value_j
    near = PASSES_BY * length_scale(block)
    if max(value_i, value_j) < near and min(value_i, value_j) > -0.5 * near:
        goes_i = _goes_on(block, table.outline_i[contact], f, way_i, g)
        goes_j = _goes_on(block, table.outline_j[contact], g, way_j, f)
        is_first = goes_i if goes_i != goes_j else is_first
    if is_first:
        return 0, way_i
    return 1, way_j


@jit
def _come_off_corner(block: Array, contact: int, side: int, follows: int) -> None:
    """Two corners that touch, and of which one goes on along an element beside the other, come off there.

    They are as far apart as where corners touch, along the normal of that element, and move across it.
    """
    keep_small()
    table = Contacts(block)
    table.mode[contact] = codes.OPEN
    table.touching[contact] = 1
    if follows == codes.NONE:
        table.touching[contact] = 0
        let_loose(block, contact)
    elif side == 0:
        table.feature_i[contact] = follows
    else:
        table.feature_j[contact] = follows


@jit
def _around_corner(block: Array, at: Pose, contact: int, side: int, way: int, corner: int) -> bool:
    """Where a corner has come to a corner at the end of what it touches, what the contact goes on with, if anything.

    That is a side of the one that comes over the other corner, or what is behind that, if the other elements there lie
    on its free side; which comes over which is told by the rates, as places say nothing there. What lay flat goes on
    to touch; the others come off.
    """
    keep_apart()
    table = Contacts(block)
    own, its = table.feature_i[contact], table.feature_j[contact]
    one, other = own, its
    if side == 0:
        one = corner
    else:
        other = corner
    i, j, copy = table.body_i[contact], table.body_j[contact], table.copy[contact]
    outline_i, outline_j = table.outline_i[contact], table.outline_j[contact]
    ax, ay, _, _ = place_feature(block, at, i, outline_i, 0, one)
    bx, by, _, _ = place_feature(block, at, j, outline_j, copy, other)
    # how the corner of i moves as seen from that of j
    ux = at.x_rate[i] - ay * at.phi_rate[i] - at.x_rate[j] + by * at.phi_rate[j]
    uy = at.y_rate[i] + ax * at.phi_rate[i] - at.y_rate[j] - bx * at.phi_rate[j]
    c, s = turning_of(block, at, i, outline_i, 0)
    ci, si = turning_of(block, at, j, outline_j, copy)
    for of in range(2):
        outline, vertex = (outline_i, one) if of == 0 else (outline_j, other)
        for to in range(-1, 2, 2):
            if of == side and to == -way:
                continue  # it comes from there
            element = beside(block, outline, vertex, to)
            if element == codes.NONE:
                continue
            data = Features(block).data[vertex]
            dx, dy = data[codes.FEATURE_DX], data[codes.FEATURE_DY]
            if to > 0:
                dx, dy = data[codes.FEATURE_LEAVES_X], data[codes.FEATURE_LEAVES_Y]
            if of == 0:
                dx, dy = c * dx - s * dy, s * dx + c * dy
                enters = -to * (ux * dx + uy * dy)
                # the normal out of the element, seen from the other outline
                faces = faces_corner(block, other, ci * dy - si * dx, -ci * dx - si * dy)
            else:
                dx, dy = ci * dx - si * dy, si * dx + ci * dy
                enters = to * (ux * dx + uy * dy)
                faces = faces_corner(block, one, c * dy - s * dx, -c * dx - s * dy)
            partner = other if of == 0 else one
            if not (enters > 0.0 and faces and fits(block, element, partner)):
                continue
            table.feature_i[contact] = element if of == 0 else one
            table.feature_j[contact] = element if of == 1 else other
            outline_row(block, at, contact, spare_row(block), False)
            is_free_place = not _is_bound_twice(block, contact)
            if is_free_place and abs(Rows(block).residual[spare_row(block)]) <= TOUCHES_WITHIN * length_scale(block):
                if abs(Rows(block).residual_rate[spare_row(block)]) >= RESTS_BELOW * contact_speed(block, contact):
                    table.mode[contact] = codes.OPEN
                    table.touching[contact] = 1
                return True
            table.feature_i[contact], table.feature_j[contact] = own, its
            if not is_free_place:
                return False
    return False


@jit
def _is_bound_twice(block: Array, contact: int) -> bool:
    """Whether another contact of the group is bound to the same features."""
    table = Contacts(block)
    for k in range(table.group[contact], table.mode.shape[0]):
        if table.group[k] != table.group[contact]:
            break
        same = table.feature_i[k] == table.feature_i[contact] and table.feature_j[k] == table.feature_j[contact]
        if k != contact and same and table.copy[k] == table.copy[contact]:
            return True
    return False


@jit
def _cross_seam(block: Array, at: Pose, contact: int, way: int) -> bool:
    """Go on with the copy of outline j that joins there; whether there is one."""
    keep_apart()
    table = Contacts(block)
    leaves, copy = table.feature_j[contact], table.copy[contact]
    follows = over_seam(block, table.outline_j[contact], leaves, way)
    partner = table.feature_i[contact]
    if follows == codes.NONE or not fits(block, follows, partner):
        return False
    if Features(block).kind[follows] == codes.VERTEX and Features(block).kind[partner] == codes.VERTEX:
        return False
    table.feature_j[contact] = follows
    for step in range(-1, 2, 2):
        if not is_copy(block, table.outline_j[contact], copy + step):
            continue
        table.copy[contact] = wrapped(block, table.outline_j[contact], copy + step)
        outline_row(block, at, contact, spare_row(block), False)
        is_there = left_to_go(block, at, contact)[0] >= -TOUCHES_WITHIN * length_scale(block)
        if is_there and abs(Rows(block).residual[spare_row(block)]) <= TOUCHES_WITHIN * length_scale(block):
            return True
    table.feature_j[contact] = leaves
    table.copy[contact] = copy
    return False

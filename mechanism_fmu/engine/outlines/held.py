"""Whether two outlines touch already where a search has found them near each other."""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.parts import Contacts, Features, Outlines
from ...tolerances import PASSES_BY
from ..compiler.subset import jit, keep_apart, keep_small
from ..scales import length_scale
from .features import (
    AT_A_CORNER,
    beside,
    disc_radius,
    faces_corner,
    fits,
    is_corner,
    is_hollow_corner,
    over_seam,
    radius_of,
)

#: What a contact that is bound has to do with a pair of features: nothing; it is bound to it, or to what goes on there;
#: or to another pair of the same two corners, which may come apart.
FREE_PAIR, HELD_PAIR, SAME_CORNERS = 0, 1, 2


@jit
def is_held(
    block: Array,
    contact: int,
    is_next: bool,
    copy: int,
    side: int,
    one: int,
    other: int,
    disc: int,
    feature: int,
    c: float,
    s: float,
    px: float,
    py: float,
) -> int:
    """Whether a disc about (px, py) touches a feature already, or what it touches goes on there.

    Features that follow upon each other, smoothly or around a corner that sticks out, touch the same feature at one
    place at most: where the one hands over to the other. Where an outline goes over into a hollow arc in which the
    other does not fit, there may be two. What comes off hands over no more: what follows there, where something is
    round or around a corner, may be the next, if that is what is looked for. Two corners at one place touch once, as
    long as that pair of features fits there.
    """
    keep_apart()
    table = Contacts(block)
    group = table.group[contact]
    for k in range(group, table.mode.shape[0]):
        if table.group[k] != group:
            break
        if table.feature_i[k] == codes.NONE:
            continue
        own, its = table.feature_i[k], table.feature_j[k]
        if side == 1:
            own, its = its, own
        comes_off = is_next and table.mode[k] == codes.OPEN
        same_circles = _is_one_circle(block, its, feature) and _is_one_circle(block, own, disc)
        if comes_off and not same_circles and _is_another(block, other, disc, feature, own, its):
            continue
        if table.copy[k] != copy:  # what it is in another copy is another thing
            same = own == disc if side == 0 else its == feature
            goes_on = (same or disc_radius(block, own) >= 0.0) and _goes_on_in_copy(
                block, contact, copy, side, disc, feature, k
            )
            if goes_on:
                return HELD_PAIR
            continue
        same = own == disc or _is_one_circle(block, its, feature) or disc_radius(block, own) >= 0.0
        at_one_place = _is_at(block, disc, its, px, py) and _faces(block, its, own, c, s)
        if not at_one_place and not (fits(block, own, feature) and fits(block, disc, its)):
            continue  # a hollow arc, which something flatter bridges
        if not (same or at_one_place):
            continue
        if is_one_with(block, one, disc, own) and is_one_with(block, other, feature, its):
            return HELD_PAIR if same else SAME_CORNERS
    return FREE_PAIR


@jit
def touches_there(block: Array, contact: int, copy: int, of_i: int, of_j: int) -> bool:
    """Whether elements of two outlines touch, or are beside what touches."""
    keep_small()
    table = Contacts(block)
    group = table.group[contact]
    for k in range(group, table.mode.shape[0]):
        if table.group[k] != group:
            break
        if table.feature_i[k] == codes.NONE:
            continue
        kind = Features(block).kind
        corners = kind[table.feature_i[k]] == codes.VERTEX and kind[table.feature_j[k]] == codes.VERTEX
        if corners and table.mode[k] == codes.OPEN:
            continue  # two that come off each other may come back, and pass
        if table.copy[k] != copy and not _is_over_seam(
            block, table.outline_j[contact], of_j, copy, table.feature_j[k], table.copy[k]
        ):
            continue
        if not is_one_with(block, table.outline_i[contact], of_i, table.feature_i[k]):
            continue
        if table.copy[k] != copy or is_one_with(block, table.outline_j[contact], of_j, table.feature_j[k]):
            return True
    return False


@jit
def _is_another(block: Array, outline: int, disc: int, feature: int, own: int, its: int) -> bool:
    """Whether what comes off may meet a feature that follows: something is round, or there is a corner between."""
    keep_small()
    features = Features(block)
    is_round = radius_of(block, disc) != 0.0 or radius_of(block, own) != 0.0
    if is_round or radius_of(block, feature) != 0.0 or radius_of(block, its) != 0.0:
        return True
    kind = features.kind
    if feature == its or kind[feature] == codes.VERTEX:
        return False
    if kind[its] == codes.VERTEX:
        two_corners: bool = kind[own] == codes.VERTEX
        return two_corners  # and a side of one
    for way in range(-1, 2, 2):
        corner = beside(block, outline, its, way)
        if corner != codes.NONE and is_corner(block, corner) and beside(block, outline, corner, way) == feature:
            return True
    return False


@jit
def _is_at(block: Array, disc: int, held: int, px: float, py: float) -> bool:
    """Whether a corner about (px, py) is where a corner of the other outline is."""
    keep_small()
    features = Features(block)
    if features.kind[disc] != codes.VERTEX or features.kind[held] != codes.VERTEX:
        return False
    dx: float = features.data[held, codes.FEATURE_X] - px
    dy: float = features.data[held, codes.FEATURE_Y] - py
    return max(abs(dx), abs(dy)) <= AT_A_CORNER * length_scale(block)


@jit
def _faces(block: Array, corner: int, element: int, c: float, s: float) -> bool:
    """Whether a corner may touch a segment that ends there; (c, s) turns directions to the corner's frame."""
    keep_small()
    if Features(block).kind[element] != codes.SEGMENT:
        return True
    data = Features(block).data[element]
    nx, ny = data[codes.FEATURE_DY], -data[codes.FEATURE_DX]
    return faces_corner(block, corner, c * nx - s * ny, s * nx + c * ny)


@jit
def _goes_on_in_copy(block: Array, contact: int, copy: int, side: int, disc: int, feature: int, held: int) -> bool:
    """Whether what the contact `held` touches goes on in a copy as one of two features, the other being the same."""
    table = Contacts(block)
    of_i, of_j = disc, feature
    if side == 1:
        of_i, of_j = feature, disc
    over = _is_over_seam(block, table.outline_j[contact], of_j, copy, table.feature_j[held], table.copy[held])
    return over and is_one_with(block, table.outline_i[contact], of_i, table.feature_i[held])


@jit
def _is_over_seam(block: Array, outline: int, feature: int, copy: int, held: int, held_copy: int) -> bool:
    """Whether a feature follows upon one that is touched in the copy before or behind, around no hollow corner."""
    keep_small()
    away = abs(copy - held_copy)
    if away != 1 and away != Outlines(block).copies[outline] - 1:
        return False
    first = Outlines(block).first[outline]
    if is_hollow_corner(block, first):
        return False
    for way in range(-1, 2, 2):
        begins = over_seam(block, outline, held, way)
        if begins != codes.NONE and abs(feature - begins) <= 1:
            return True
    return False


@jit
def _is_one_circle(block: Array, one: int, other: int) -> bool:
    """Whether two features are the same, or arcs of the same circle."""
    keep_small()
    if one == other:
        return True
    features = Features(block)
    if features.kind[one] != codes.ARC or features.kind[other] != codes.ARC:
        return False
    a, b = features.data[one], features.data[other]
    dx: float = a[codes.FEATURE_X] - b[codes.FEATURE_X]
    dy: float = a[codes.FEATURE_Y] - b[codes.FEATURE_Y]
    wider: float = a[codes.FEATURE_RADIUS] - b[codes.FEATURE_RADIUS]
    return max(abs(dx), abs(dy), abs(wider)) <= PASSES_BY * length_scale(block)


@jit
def is_one_with(block: Array, outline: int, feature: int, held: int) -> bool:
    """Whether a feature is the one that is touched, or follows upon it without a hollow corner between."""
    keep_small()
    if feature == held:
        return True
    for way in range(-1, 2, 2):
        corner = held
        if Features(block).kind[held] != codes.VERTEX:
            corner = beside(block, outline, held, way)
            if corner == codes.NONE:
                continue
            if corner == feature:
                return True
            if is_hollow_corner(block, corner):
                continue
        if beside(block, outline, corner, way) == feature:
            return True
    return False

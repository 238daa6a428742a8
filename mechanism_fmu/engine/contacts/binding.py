"""Which contacts of two outlines are bound to which features: those that touch, and the one that strikes next.

Two outlines have a group of contacts, one for each place where they may touch at once. Those that touch are bound; the
first free one stands for the nearest pair of features that touch nothing yet (`engine.outlines.nearest`).
"""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Pose, Strikes
from ...tables.parts import Contacts, Features, Outlines
from ...tolerances import TOUCHES_WITHIN
from .. import status
from ..compiler.subset import jit, keep_apart, keep_small
from ..constraints.outline_row import place_feature, turning_of
from ..outlines.features import AT_A_CORNER, beside, faces_corner, is_corner
from ..outlines.held import is_one_with
from ..outlines.nearest import FREE, MEETS, OVERLAP, look_no_deeper, nearest
from ..scales import length_scale

#: Outlines that reach farther into each other than this do not touch, but overlap, in the scale of lengths.
OVERLAPS = 1e-10


@jit
def is_outline(block: Array, contact: int) -> bool:
    """Whether a contact is one of outlines."""
    found: bool = Contacts(block).kind[contact] == codes.OUTLINE
    return found


@jit
def is_free(block: Array, contact: int) -> bool:
    """Whether a contact of outlines is bound to nothing."""
    free: bool = is_outline(block, contact) and Contacts(block).feature_i[contact] == codes.NONE
    return free


@jit
def free_place(block: Array, group: int) -> int:
    """The first free contact of a group, or `codes.NONE`."""
    table = Contacts(block)
    for k in range(group, table.mode.shape[0]):
        if table.group[k] != group:
            break
        if table.feature_i[k] == codes.NONE:
            return k
    return codes.NONE


@jit
def bind(block: Array, at: Pose, contact: int) -> None:
    """Bind a free contact to the nearest features that touch nothing yet, in place of what comes off beside them."""
    keep_small()
    nearest(block, at, contact, MEETS)
    take_found(block, contact)
    table = Contacts(block)
    f, g = table.feature_i[contact], table.feature_j[contact]
    if f == codes.NONE:
        return
    for k in range(table.group[contact], table.mode.shape[0]):
        if table.group[k] != table.group[contact]:
            break
        opens = table.mode[k] == codes.OPEN and table.feature_i[k] != codes.NONE and k != contact
        if opens and table.copy[k] == table.copy[contact]:
            is_same = is_one_with(block, table.outline_i[k], f, table.feature_i[k])
            if is_same and is_one_with(block, table.outline_j[k], g, table.feature_j[k]):
                table.touching[k] = 0
                let_loose(block, k)


@jit
def take_found(block: Array, contact: int) -> None:
    """Bind a contact to what the last search has found."""
    keep_small()
    from_search = Outlines(block).found
    table = Contacts(block)
    table.feature_i[contact] = from_search[0]
    table.feature_j[contact] = from_search[1]
    table.copy[contact] = from_search[2]


@jit
def let_loose(block: Array, contact: int) -> None:
    """An open contact that has come off is bound to no features any more; one that has no outlines never is."""
    table = Contacts(block)
    if is_outline(block, contact):
        table.apart[table.group[contact]] = 0.0
    table.feature_i[contact] = codes.NONE
    table.feature_j[contact] = codes.NONE
    table.copy[contact] = 0


@jit
def bind_what_touches(block: Array, at: Pose, struck: int) -> int:
    """Bind a contact to every pair of features that touches, and free those that do not but for `struck`; a status.

    Of outlines, one of which takes part in the event (`participation`).
    """
    keep_apart()
    table = Contacts(block)
    near = TOUCHES_WITHIN * length_scale(block)
    island = Strikes(block).island
    look_no_deeper(block, 0.0)
    for c in range(table.mode.shape[0]):
        if not is_outline(block, c):
            continue
        if c == struck:
            table.touching[c] = 1
            table.apart[table.group[c]] = 0.0
        elif table.feature_i[c] != codes.NONE:
            if table.mode[c] == codes.OPEN and table.touching[c] == 0:
                let_loose(block, c)
            elif _has_turned_away(block, at, c):
                table.mode[c] = codes.OPEN
                table.touching[c] = 0
                let_loose(block, c)
    for c in range(table.mode.shape[0]):
        if not is_outline(block, c) or table.group[c] != c or table.value[c, codes.ENABLED] < 0.5:
            continue
        if island[table.body_i[c]] == codes.NONE and island[table.body_j[c]] == codes.NONE:
            continue
        if table.apart[c] > near and not _is_bound(block, c):
            continue  # as far as its outlines are apart, nothing that has happened concerns it
        table.apart[c] = 0.0
        while nearest(block, at, c, FREE) <= near:
            place = free_place(block, c)
            if place == codes.NONE:
                return status.FEW_POINTS
            take_found(block, place)
            table.touching[place] = 1
        if free_place(block, c) == codes.NONE:  # the last one is there to tell
            return status.FEW_POINTS
    return status.OK


@jit
def _has_turned_away(block: Array, at: Pose, contact: int) -> bool:
    """Whether two corners at one place do not touch by this pair of features any more, as a side has turned past it."""
    keep_small()
    table = Contacts(block)
    i, j = table.body_i[contact], table.body_j[contact]
    f, g, copy = table.feature_i[contact], table.feature_j[contact], table.copy[contact]
    one, other = table.outline_i[contact], table.outline_j[contact]
    if Features(block).kind[f] == codes.VERTEX and Features(block).kind[g] == codes.SEGMENT:
        return _is_past(block, at, j, other, copy, g, i, one, 0, f)
    if Features(block).kind[f] == codes.SEGMENT and Features(block).kind[g] == codes.VERTEX:
        return _is_past(block, at, i, one, 0, f, j, other, copy, g)
    return False


@jit
def _is_past(
    block: Array,
    at: Pose,
    j: int,
    outline: int,
    copy: int,
    segment: int,
    i: int,
    of_corner: int,
    copy_of_corner: int,
    corner: int,
) -> bool:
    """Whether a corner of body i stands at an end of a segment of body j, and one of its sides lies deeper."""
    keep_small()
    bx, by, dx, dy = place_feature(block, at, j, outline, copy, segment)
    ax, ay, _, _ = place_feature(block, at, i, of_corner, copy_of_corner, corner)
    along = dx * (at.x[i] + ax - at.x[j] - bx) + dy * (at.y[i] + ay - at.y[j] - by)
    way = -1
    at_a_corner = AT_A_CORNER * length_scale(block)
    if abs(along) >= at_a_corner:
        along = Features(block).data[segment, codes.FEATURE_LENGTH] - along
        way = 1
    end = beside(block, outline, segment, way)
    if abs(along) >= at_a_corner or end == codes.NONE or not is_corner(block, end):
        return False
    c, s = turning_of(block, at, i, of_corner, copy_of_corner)
    return not faces_corner(block, corner, c * dy - s * dx, -c * dx - s * dy)


@jit
def deepest_overlap(block: Array, at: Pose, drift: float) -> tuple[int, float]:
    """The contact of the outlines that reach deepest into each other, and how deep [m]; `codes.NONE` where none does.

    Whatever is bound, held or known to be apart: an independent watch (`outlines.overlap`). Places are known to what
    rows have drifted by, in the scale of lengths.
    """
    keep_apart()
    table = Contacts(block)
    found = codes.NONE
    least = -(OVERLAPS + drift) * length_scale(block)
    for c in range(table.mode.shape[0]):
        if is_outline(block, c) and table.group[c] == c and table.value[c, codes.ENABLED] > 0.5:
            gap = nearest(block, at, c, OVERLAP)
            if gap < least:
                least = gap
                found = c
    return found, -least


@jit
def _is_bound(block: Array, group: int) -> bool:
    """Whether any contact of a group is bound to features."""
    table = Contacts(block)
    for k in range(group, table.mode.shape[0]):
        if table.group[k] != group:
            break
        if table.feature_i[k] != codes.NONE:
            return True
    return False

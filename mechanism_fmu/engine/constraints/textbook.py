"""All constraint rows with the contact coordinates among the coordinates, as the textbook has them (ME451, after Haug).

The motion itself does without contact coordinates; kinematic analysis works with these rows.
"""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, Pose, Rows
from ...tables.parts import Contacts
from ...tables.sizes import Sizes
from ..compiler.subset import entry, jit, keep_small
from ..profiles.curves import curve
from ..vectors import clear
from .entries import begin_row
from .joints.cams import cam_flat_follower, cam_follower, point_follower
from .kinematics import place_bodies, set_instant
from .rows import contact_row, joint_rows


@entry
def textbook_rows(block: Array, time: float) -> None:
    """Write the rows of all joints, then of all contacts that are enabled, open or closed, at `time` [s].

    Positions, rates and contact coordinates are those in y_end, the rates of contact coordinates those in `alpha_rate`.
    Contact c has the rows from `joint_rows + row_first[c]` on (without meaning when it is not enabled); contact
    coordinate k has the column `columns + k`. gamma is without Baumgarte's terms.
    """
    set_instant(block, time)
    at = place_bodies(block, Course(block).y_end)
    joint_rows(block, at)
    table = Contacts(block)
    for c in range(table.kind.shape[0]):
        if table.value[c, codes.ENABLED] > 0.5:
            row = Sizes(block).joint_rows + table.row_first[c]
            if table.kind[c] >= codes.CAM_FOLLOWER:
                _profile_rows(block, at, c, row)
            else:
                contact_row(block, at, c, row)


@jit
def _begin(out: Rows, row: int, i: int, j: int) -> None:
    """Clear a row, its entries of contact coordinates too."""
    clear(out.jacobian[row])
    begin_row(out, row, i, j)


@jit
def _profile_rows(block: Array, at: Pose, contact: int, row: int) -> None:
    """Write the rows of a contact of profiles."""
    keep_small()
    out = Rows(block)
    table = Contacts(block)
    i, j = table.body_i[contact], table.body_j[contact]
    data = table.data[contact]
    first = table.alpha[contact]
    column = Sizes(block).columns + first
    _begin(out, row, i, j)
    _begin(out, row + 1, i, j)
    if table.kind[contact] == codes.CAM_FOLLOWER:
        _begin(out, row + 2, i, j)
        profile_i = curve(block, table.curve_i[contact], at.alpha[first])
        profile_j = curve(block, table.curve_j[contact], at.alpha[first + 1])
        cam_follower(at, out, row, i, j, data, first, column, profile_i, profile_j)
    elif table.kind[contact] == codes.CAM_FLAT_FOLLOWER:
        profile = curve(block, table.curve_i[contact], at.alpha[first])
        cam_flat_follower(at, out, row, i, j, data, first, column, profile)
    else:
        profile = curve(block, table.curve_j[contact], at.alpha[first])
        point_follower(at, out, row, i, j, data, first, column, profile)

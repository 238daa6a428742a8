"""Rows of contacts without curves: a point against a straight line and along it, an angle; and the spare row."""

from __future__ import annotations

from ...tables.declare import Array
from ...tables.motion import Pose, Rows
from ...tables.parts import Contacts
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_small
from ..vectors import turned
from .entries import begin_row

# The relative angle of two bodies against a given one: one row.


@jit
def angle_row(at: Pose, rows: Rows, row: int, i: int, j: int, angle: Array) -> None:
    """Write the row s = phi_i - phi_j - angle[0]: s_q = [.., 1, .., -1], s' = phi_i' - phi_j', gamma = 0."""
    keep_small()
    rows.residual[row] = at.phi[i] - at.phi[j] - angle[0]
    rows.residual_rate[row] = at.phi_rate[i] - at.phi_rate[j]
    rows.gamma[row] = 0.0
    rows.jacobian[row, 3 * i + 2] = 1.0
    rows.jacobian[row, 3 * j + 2] = -1.0


# A point of one body against a line fixed in another: the gap s, one row (Pennestrì et al., Fig. 1).


@jit
def point_line(at: Pose, rows: Rows, row: int, i: int, j: int, point: Array, line: Array) -> None:
    """Write the row s = n.(r_i^P - r_j) - n'.p' of `point` in body i and `line` = (point p', normal n') in body j.

    With n = A_j n', a = A_i s_i, e = r_i + a - r_j and its rate e', u = phi_j':
    s_q = [n, n.Ra, -n, (R n).e], s' = n.e' + u (R n).e, gamma = n.a phi_i'^2 + n.e u^2 - 2 u (R n).e'.
    """
    keep_small()
    ax, ay = turned(at, i, point[0], point[1])
    nx, ny = turned(at, j, line[2], line[3])
    ui, uj = at.phi_rate[i], at.phi_rate[j]
    ex = at.x[i] + ax - at.x[j]
    ey = at.y[i] + ay - at.y[j]
    ex_rate = at.x_rate[i] - ay * ui - at.x_rate[j]
    ey_rate = at.y_rate[i] + ax * ui - at.y_rate[j]
    along = nx * ey - ny * ex
    rows.residual[row] = nx * ex + ny * ey - line[2] * line[0] - line[3] * line[1]
    rows.residual_rate[row] = nx * ex_rate + ny * ey_rate + uj * along
    rows.gamma[row] = (
        (nx * ax + ny * ay) * ui * ui + (nx * ex + ny * ey) * uj * uj - 2.0 * uj * (nx * ey_rate - ny * ex_rate)
    )
    entry = rows.jacobian[row]
    entry[3 * i] = nx
    entry[3 * i + 1] = ny
    entry[3 * i + 2] = ny * ax - nx * ay
    entry[3 * j] = -nx
    entry[3 * j + 1] = -ny
    entry[3 * j + 2] = along


# A row for looking: nothing is solved with it.


@jit
def spare_row(block: Array) -> int:
    """The number of a row that no joint or contact uses."""
    return Sizes(block).rows - 1


@jit
def tangent_line(own: Array, line: Array) -> None:
    """A line with its normal turned by -90 deg, so that it points along, into `line`."""
    line[0] = own[0]
    line[1] = own[1]
    line[2] = own[3]
    line[3] = -own[2]


@jit
def tangent_row(block: Array, at: Pose, contact: int, line: Array) -> None:
    """Write to the spare row how a point slides along its line: distance from the line's point, slip speed, Jacobian.

    `line`, shape (4,), is scratch: the line with its normal turned by -90 deg, so that it points along.
    """
    keep_small()
    table = Contacts(block)
    tangent_line(table.line[contact], line)
    out = Rows(block)
    row = spare_row(block)
    begin_row(out, row, table.body_i[contact], table.body_j[contact])
    point_line(at, out, row, table.body_i[contact], table.body_j[contact], table.data[contact], line)

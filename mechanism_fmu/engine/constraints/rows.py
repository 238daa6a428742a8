"""All constraint rows of the mechanism at one instant: joints, drivers, contacts; a point against a line, an angle."""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.kinds import JOINTS
from ...tables.motion import LinearSystem, Pose, Rows
from ...tables.parts import Contacts, Joints, Options
from ...tables.sizes import Sizes
from ..compiler.by_kind import by_kind
from ..compiler.subset import jit, keep_small
from ..profiles.curves import curve
from ..profiles.nearest import is_searched
from ..vectors import clear, turned
from .joints.drivers import angle_driver, distance_driver, translational_driver, x_driver, y_driver
from .joints.gears import gears, internal_gears, rack_and_pinion
from .joints.pins_and_slides import distance, revolute, revolute_translational, translational
from .profile_row import profile_row

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


# The rows of joints, drivers and contacts, by their kinds.

#: The rows of every joint, by the name of its kind; those of the first two, which are frequent, are compiled for speed.
FREQUENT = {"revolute": revolute, "translational": translational}
OTHERS = {
    "distance": distance,
    "revolute_translational": revolute_translational,
    "gears": gears,
    "internal_gears": internal_gears,
    "rack_and_pinion": rack_and_pinion,
}
#: Of every driver; these take C, C' and C'' besides.
DRIVERS = {
    "x_driver": x_driver,
    "y_driver": y_driver,
    "angle_driver": angle_driver,
    "distance_driver": distance_driver,
    "translational_driver": translational_driver,
}

_ROW = "at, out, row, i, j, data"
_other = by_kind({JOINTS.number(kind): rows for kind, rows in OTHERS.items()}, _ROW, small=True)
_joint = by_kind({JOINTS.number(kind): rows for kind, rows in FREQUENT.items()}, _ROW, rest=_other)
_driver = by_kind(
    {JOINTS.number(kind): rows for kind, rows in DRIVERS.items()}, f"{_ROW}, c, c_rate, c_bend", small=True
)


@jit
def joint_rows(block: Array, at: Pose) -> None:
    """Write the rows of all joints from the bodies' poses and rates (see `place_bodies`), and `pose.instant`."""
    table = Joints(block)
    out = Rows(block)
    for r in range(Sizes(block).joint_rows):
        clear(out.jacobian[r])
    for k in range(table.kind.shape[0]):
        row = table.row[k]
        i, j = table.body_i[k], table.body_j[k]
        if table.curve[k] == codes.NONE:
            _joint(table.kind[k], at, out, row, i, j, table.data[k])
        else:
            _drive(block, at, k)


@jit
def _drive(block: Array, at: Pose, joint: int) -> None:
    """Write the row of a driver, whose motion is a curve over time."""
    keep_small()
    table = Joints(block)
    c, c_rate, c_bend, _ = curve(block, table.curve[joint], at.instant[0])
    i, j = table.body_i[joint], table.body_j[joint]
    _driver(table.kind[joint], at, Rows(block), table.row[joint], i, j, table.data[joint], c, c_rate, c_bend)


@jit
def contact_row(block: Array, at: Pose, contact: int, row: int) -> None:
    """Write the row of one contact: its gap, gap rate, gamma and Jacobian."""
    keep_small()
    table = Contacts(block)
    out = Rows(block)
    clear(out.jacobian[row])
    i, j = table.body_i[contact], table.body_j[contact]
    if table.kind[contact] == codes.POINT_LINE:
        point_line(at, out, row, i, j, table.data[contact], table.line[contact])
    elif table.alpha[contact] != codes.NONE:
        profile_row(block, at, contact, row)
    else:
        angle_row(at, out, row, i, j, table.line[contact])


@jit
def spare_row(block: Array) -> int:
    """The number of a row that no joint or contact uses."""
    return Sizes(block).rows - 1


@jit
def tangent_row(block: Array, at: Pose, contact: int, line: Array) -> None:
    """Write to the spare row how a point slides along its line: distance from the line's point, slip speed, Jacobian.

    `line`, shape (4,), is scratch: the line with its normal turned by -90 deg, so that it points along.
    """
    keep_small()
    table = Contacts(block)
    own = table.line[contact]
    line[0] = own[0]
    line[1] = own[1]
    line[2] = own[3]
    line[3] = -own[2]
    out = Rows(block)
    row = spare_row(block)
    clear(out.jacobian[row])
    point_line(at, out, row, table.body_i[contact], table.body_j[contact], table.data[contact], line)


@jit
def active_rows(block: Array, at: Pose) -> int:
    """Write the rows of all joints and closed contacts; return their number.

    `contacts.row` afterwards holds each closed contact's row, and -1 for an open one.
    """
    keep_small()
    joint_rows(block, at)
    table = Contacts(block)
    count = Sizes(block).joint_rows
    for c in range(table.mode.shape[0]):
        if table.mode[c] == codes.CLOSED:
            contact_row(block, at, c, count)
            table.row[c] = count
            count += 1
        else:
            table.row[c] = -1
    return count


@jit
def follow_open_contacts(block: Array, at: Pose) -> None:
    """Write the rates of the contact coordinates of open contacts; those of closed ones come with their rows.

    Those that are sought afresh each time, or do not count, rest.
    """
    keep_small()
    table = Contacts(block)
    for c in range(table.mode.shape[0]):
        if table.alpha[c] == codes.NONE or table.mode[c] == codes.CLOSED:
            continue
        if table.value[c, codes.ENABLED] > 0.5 and not is_searched(block, c):
            contact_row(block, at, c, spare_row(block))
        else:
            at.alpha_rate[table.alpha[c]] = 0.0
            if table.kind[c] == codes.CAM_FOLLOWER:
                at.alpha_rate[table.alpha[c] + 1] = 0.0


@jit
def driver_power(block: Array) -> float:
    """Power that drivers give, by the multipliers of the last solve: multiplier nu, summed over their rows [W].

    After an impact the multipliers are impulses, and it is their work [J].
    """
    table = Joints(block)
    power = 0.0
    for k in range(table.kind.shape[0]):
        if table.curve[k] != codes.NONE:
            power += LinearSystem(block).multiplier[table.row[k]] * Rows(block).nu[table.row[k]]
    return power


@jit
def row_count(block: Array) -> int:
    """The number of active rows."""
    mode = Contacts(block).mode
    count: int = Sizes(block).joint_rows
    for c in range(mode.shape[0]):
        count += mode[c]
    return count


@jit
def stabilise(block: Array, count: int) -> None:
    """Baumgarte: gamma becomes gamma - 2 alpha Phi' - beta^2 Phi (Pennestrì et al., section 5)."""
    settings = Options(block).settings
    alpha = settings[codes.BAUMGARTE_ALPHA]
    beta = settings[codes.BAUMGARTE_BETA]
    out = Rows(block)
    for r in range(count):
        out.gamma[r] -= 2.0 * alpha * out.residual_rate[r] + beta * beta * out.residual[r]

"""All constraint rows of the mechanism at one instant: joints, drivers, contacts, and what sticks."""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.kinds import JOINTS
from ...tables.motion import Exchange, LinearSystem, Pose, Rows
from ...tables.parts import Bodies, Contacts, Joints, Options
from ...tables.sizes import Sizes
from ..compiler.by_kind import by_kind
from ..compiler.subset import jit, keep_apart, keep_small
from ..profiles.curves import curve
from ..profiles.nearest import is_searched
from .entries import begin_row
from .friction_rows import rubs, stick_rows, stuck_count
from .joints.drivers import angle_driver, distance_driver, translational_driver, x_driver, y_driver
from .joints.gears import gears, internal_gears, rack_and_pinion
from .joints.pins_and_slides import distance, revolute, revolute_translational, translational
from .outline_row import outline_row
from .point_line import angle_row, point_line, spare_row
from .profile_row import profile_row

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
    for k in range(table.kind.shape[0]):
        row = table.row[k]
        i, j = table.body_i[k], table.body_j[k]
        after = Sizes(block).joint_rows if k + 1 == table.kind.shape[0] else table.row[k + 1]
        for r in range(row, after):
            begin_row(out, r, i, j)
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
    if table.kind[contact] == codes.OUTLINE:
        outline_row(block, at, contact, row, False)
        return
    i, j = table.body_i[contact], table.body_j[contact]
    begin_row(out, row, i, j)
    if table.kind[contact] == codes.POINT_LINE:
        point_line(at, out, row, i, j, table.data[contact], table.line[contact])
    elif table.alpha[contact] != codes.NONE:
        profile_row(block, at, contact, row)
    else:
        angle_row(at, out, row, i, j, table.line[contact])


@jit
def active_rows(block: Array, at: Pose) -> int:
    """Write the rows of all joints, closed contacts, and contacts and joints that stick; return their number.

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
    if rubs(block):
        count = stick_rows(block, at, count)
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
def drift_power(block: Array, count: int) -> float:
    """Power of the forces along active rows on what rates are off by, with the multipliers of the last solve [W]."""
    power = 0.0
    for r in range(count):
        power += LinearSystem(block).multiplier[r] * Rows(block).residual_rate[r]
    return power


@jit
def row_count(block: Array) -> int:
    """The number of active rows."""
    mode = Contacts(block).mode
    count: int = Sizes(block).joint_rows
    for c in range(mode.shape[0]):
        count += mode[c]
    if rubs(block):
        count += stuck_count(block)
    return count


@jit
def stabilise(block: Array, y: Array, count: int) -> None:
    """Baumgarte: gamma becomes gamma - 2 alpha Phi' - beta^2 Phi (Pennestrì et al., section 5).

    Gains are those of the settings, 0 by default, because the engine projects its own steps. To what an importer
    integrates, nothing else brings drift back: both gains rise by the rate at which the rows turn.
    """
    settings = Options(block).settings
    alpha = settings[codes.BAUMGARTE_ALPHA]
    beta = settings[codes.BAUMGARTE_BETA]
    if Exchange(block).integrates[0] == 1:
        own = _GAIN * turning_rate(block, y, count)
        alpha += own
        beta += own
    out = Rows(block)
    for r in range(count):  # without gains, too: of a row that is no number, no step comes
        out.gamma[r] -= 2.0 * alpha * out.residual_rate[r] + beta * beta * out.residual[r]


# Gains in the mechanism's own time: drift comes from rows that turn, none from rows that are linear in the coordinates.

#: So many times as fast as rows turn, drift dies away: faster costs an importer's integrator steps.
_GAIN = 2.0


@jit
def turning_rate(block: Array, y: Array, count: int) -> float:
    """How fast the rows turn at y [1/s]: by the accelerations gamma that this takes, over the speeds of the bodies.

    Both in the metric of the masses. For a pendulum it is its angular velocity, and 0 for rows that do not turn. gamma
    of drivers, which holds accelerations of theirs, is left out.
    """
    keep_apart()
    table = Joints(block)
    total = 0.0
    for k in range(table.kind.shape[0]):
        if table.curve[k] == codes.NONE:
            after = Sizes(block).joint_rows if k + 1 == table.kind.shape[0] else table.row[k + 1]
            total += _turning(block, table.row[k], after)
    total += _turning(block, Sizes(block).joint_rows, count)
    if total == 0.0:
        return 0.0
    speed = 0.0
    n = Sizes(block).coordinates
    for k in range(n):
        speed += y[n + k] * y[n + k] / Bodies(block).inverse_mass[k]
    return math.sqrt(total / speed)


@jit
def _turning(block: Array, row: int, after: int) -> float:
    """The sum of gamma^2 / (Phi_q M^-1 Phi_q^T) over rows."""
    keep_small()
    out = Rows(block)
    inverse = Bodies(block).inverse_mass
    total = 0.0
    for r in range(row, after):
        response = 0.0
        for end in range(2):
            first = 3 * out.body[r, end]
            for k in range(first, min(first + 3, Sizes(block).coordinates)):
                response += out.jacobian[r, k] * out.jacobian[r, k] * inverse[k]
        if response > 0.0:
            total += out.gamma[r] * out.gamma[r] / response
    return total

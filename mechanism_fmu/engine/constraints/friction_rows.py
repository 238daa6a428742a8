"""Rows along which contacts and joints with friction slide: they are constraints where these stick.

Contacts come first, in their order, then joints, then force elements, of which only brakes have friction. Slip is that
of the point of body i along its line on body j, of the material of body i along the common tangent of two profiles, of
point j along the axis of a slider on body i, and of the body of a pin or brake against the other.
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.kinds import FORCES, JOINTS
from ...tables.motion import Course, Pose, Rows, Rubs, Strikes
from ...tables.parts import Contacts, Forces, Joints, Options, Ports
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_small
from .entries import begin_row
from .outline_row import outline_row
from .point_line import angle_row, point_line, tangent_line
from .profile_row import slip_row

REVOLUTE = JOINTS.number("revolute")
BRAKE = FORCES.number("brake")


@jit
def coefficient(block: Array, rub: int) -> float:
    """The coefficient of a contact or slider [1], friction radius of a pin [m], torque of a brake [N m]; 0: smooth."""
    contacts = Sizes(block).contacts
    first = contacts + Sizes(block).joints
    if rub >= first:
        element = Forces(block)
        is_brake = element.kind[rub - first] == BRAKE
        of_brake: float = element.data[rub - first, 0]
        return of_brake if is_brake else 0.0
    if rub >= contacts:
        of_joint: float = Joints(block).friction[rub - contacts]
        return of_joint
    of_contact: float = Contacts(block).value[rub, codes.FRICTION]
    return of_contact


@jit
def holding(block: Array, rub: int) -> float:
    """As `coefficient`, while it sticks."""
    contacts = Sizes(block).contacts
    if rub < contacts:
        of_contact: float = Contacts(block).value[rub, codes.FRICTION_STATIC]
        return of_contact
    if rub < contacts + Sizes(block).joints:
        of_joint: float = Joints(block).holding[rub - contacts]
        return of_joint
    return coefficient(block, rub)


@jit
def rubs(block: Array) -> bool:
    """Whether anything has friction, or impacts another law than Newton's."""
    some: bool = Course(block).counters[codes.RUBBING] > 0
    return some


@jit
def rubbing_count(block: Array) -> int:
    """The number of contacts, joints and brakes with friction; one more where impacts have another law than Newton's.

    Coefficients are parameters: it holds as long as the motion.
    """
    keep_small()
    count = 0
    if Options(block).settings[codes.IMPACT_LAW] != codes.NEWTON:
        count = 1
    for k in range(Sizes(block).rubs):
        first = Sizes(block).contacts + Sizes(block).joints
        if k < first:
            if coefficient(block, k) > 0.0:
                count += 1
        elif Forces(block).kind[k - first] == BRAKE:
            count += 1
    return count


@jit
def meets(block: Array, rub: int) -> bool:
    """Whether a contact is closed; joints and brakes always are."""
    return rub >= Sizes(block).contacts or Contacts(block).mode[rub] == codes.CLOSED


@jit
def touches(block: Array, rub: int) -> bool:
    """Whether a contact or joint has friction now: a contact is closed, or has been given an impulse."""
    keep_small()
    if not coefficient(block, rub) > 0.0:
        return _is_rising(block, rub)
    if rub >= Sizes(block).contacts:
        return True
    closed: bool = Contacts(block).mode[rub] == codes.CLOSED
    return closed or Rubs(block).given[rub] > 0.0


@jit
def _is_rising(block: Array, rub: int) -> bool:
    """Whether an input with a slope raises the torque of a brake, which may be zero at this instant alone."""
    keep_small()
    ports = Ports(block)
    rises = False
    if Course(block).counters[codes.RAMPING] != 0:
        element = rub - Sizes(block).contacts - Sizes(block).joints
        for k in range(ports.inputs.shape[0]):
            writes = ports.input_force[k] == element and Forces(block).kind[element] == BRAKE
            rises = rises or (writes and ports.input_factor[k] * ports.held_slopes[k] > 0.0)
    return rises


@jit
def friction_row(block: Array, at: Pose, rub: int, row: int) -> None:
    """Write the row along which a contact or joint slides; its residual counts from where it stuck first."""
    keep_small()
    out = Rows(block)
    line = Strikes(block).tangent_line
    contacts = Sizes(block).contacts
    if rub < contacts:
        table = Contacts(block)
        begin_row(out, row, table.body_i[rub], table.body_j[rub])
        if table.kind[rub] == codes.OUTLINE:
            outline_row(block, at, rub, row, True)
        elif table.alpha[rub] == codes.NONE:
            tangent_line(table.line[rub], line)
            point_line(at, out, row, table.body_i[rub], table.body_j[rub], table.data[rub], line)
        else:
            slip_row(block, at, rub, row)
    elif rub >= contacts + Sizes(block).joints:
        element = Forces(block)
        k = rub - contacts - Sizes(block).joints
        line[0] = 0.0
        begin_row(out, row, element.body[k], element.reaction[k])
        angle_row(at, out, row, element.body[k], element.reaction[k], line)
    else:
        joint = Joints(block)
        k = rub - contacts
        i = joint.body_i[k]
        j = joint.body_j[k]
        begin_row(out, row, i, j)
        data = joint.data[k]
        if joint.kind[k] == REVOLUTE:
            line[0] = 0.0
            angle_row(at, out, row, i, j, line)
        else:
            length = axis_length(block, k)
            line[0] = data[0]
            line[1] = data[1]
            line[2] = data[4] / length
            line[3] = data[5] / length
            point_line(at, out, row, j, i, data[2:], line)
    out.residual[row] -= Rubs(block).anchor[rub]


@jit
def axis_length(block: Array, joint: int) -> float:
    """The length of a slider's axis, as it is given."""
    data = Joints(block).data[joint]
    return math.sqrt(data[4] * data[4] + data[5] * data[5])


@jit
def sticks(block: Array, rub: int) -> bool:
    """Whether a contact or joint touches and sticks."""
    stuck: bool = Rubs(block).slip[rub] == codes.STICKS
    return stuck and touches(block, rub)


@jit
def slips(block: Array, rub: int) -> bool:
    """Whether a contact or joint touches and slips."""
    slip = Rubs(block).slip[rub]
    return (slip == codes.FORWARDS or slip == codes.BACKWARDS) and touches(block, rub)


@jit
def stick_rows(block: Array, at: Pose, count: int) -> int:
    """Write the rows of all that sticks behind the first `count` rows; return the number of rows then."""
    keep_small()
    table = Rubs(block)
    for k in range(table.slip.shape[0]):
        table.row[k] = -1
        if sticks(block, k):
            friction_row(block, at, k, count)
            table.row[k] = count
            count += 1
    return count


@jit
def stuck_count(block: Array) -> int:
    """The number of contacts and joints that stick."""
    keep_small()
    count = 0
    for k in range(Rubs(block).slip.shape[0]):
        if sticks(block, k):
            count += 1
    return count

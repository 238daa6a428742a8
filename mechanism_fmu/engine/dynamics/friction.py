"""Coulomb friction in contacts and joints, with a smooth passage through zero slip.

Friction force = coefficient * |normal force| * tanh(slip speed / reference speed), against the slip. The normal forces
come from the constraint solve, which friction changes in turn: `resist` is one round of that iteration.
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.kinds import JOINTS
from ...tables.motion import LinearSystem, Loads, Pose, Rows, Strikes
from ...tables.parts import Contacts, Joints
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_small
from ..constraints.point_line import spare_row, tangent_row
from ..vectors import turned

#: Slip at which friction reaches 76 % of its full value: along a line [m/s], in a pin [rad/s].
SLIP_SPEED = 1e-4
SLIP_RATE = 1e-3

_REVOLUTE = JOINTS.number("revolute")


@jit
def has_friction(block: Array) -> bool:
    """Whether a joint or a closed contact rubs."""
    keep_small()
    rubs = False
    joint = Joints(block)
    for k in range(joint.kind.shape[0]):
        rubs = rubs or joint.friction[k] > 0.0
    table = Contacts(block)
    for c in range(table.mode.shape[0]):
        rubs = rubs or (table.mode[c] == codes.CLOSED and table.value[c, codes.FRICTION] > 0.0)
    return rubs


@jit
def resist(block: Array, at: Pose) -> float:
    """`loads.force` = `loads.applied` + friction for the multipliers of the last solve; return the power lost [W]."""
    keep_small()
    load = Loads(block)
    for k in range(load.force.shape[0]):
        load.force[k] = load.applied[k]
    lost = 0.0
    joint = Joints(block)
    for k in range(joint.kind.shape[0]):
        if joint.friction[k] > 0.0:
            if joint.kind[k] == _REVOLUTE:
                lost += _pin(block, at, k)
            else:
                lost += _slider(block, at, k)
    table = Contacts(block)
    for c in range(table.mode.shape[0]):
        rubs = table.mode[c] == codes.CLOSED and table.value[c, codes.FRICTION] > 0.0
        if rubs and table.kind[c] == codes.POINT_LINE:
            lost += _contact(block, at, c)
    return lost


@jit
def _contact(block: Array, at: Pose, contact: int) -> float:
    """Friction of a point along its line; returns the power lost."""
    keep_small()
    table = Contacts(block)
    force = Loads(block).force
    tangent_row(block, at, contact, Strikes(block).tangent_line)
    spare = spare_row(block)
    slip = Rows(block).residual_rate[spare]
    normal = abs(LinearSystem(block).multiplier[table.row[contact]])
    friction = -table.value[contact, codes.FRICTION] * normal * math.tanh(slip / SLIP_SPEED)
    for k in range(Sizes(block).coordinates):
        force[k] += friction * Rows(block).jacobian[spare, k]
    lost: float = -friction * slip
    return lost


@jit
def _pin(block: Array, at: Pose, joint: int) -> float:
    """Friction torque of a revolute joint; returns the power lost."""
    keep_small()
    table = Joints(block)
    force = Loads(block).force
    multiplier = LinearSystem(block).multiplier
    row = table.row[joint]
    i, j = table.body_i[joint], table.body_j[joint]
    slip = at.phi_rate[i] - at.phi_rate[j]
    normal = math.sqrt(multiplier[row] * multiplier[row] + multiplier[row + 1] * multiplier[row + 1])
    torque = -table.friction[joint] * normal * math.tanh(slip / SLIP_RATE)
    Loads(block).rubbing[joint] = torque
    force[3 * i + 2] += torque
    force[3 * j + 2] -= torque
    lost: float = -torque * slip
    return lost


@jit
def _slider(block: Array, at: Pose, joint: int) -> float:
    """Friction force of a translational joint along its axis, on body j at its point; returns the power lost."""
    keep_small()
    table = Joints(block)
    force = Loads(block).force
    i, j = table.body_i[joint], table.body_j[joint]
    data = table.data[joint]
    length = math.sqrt(data[4] * data[4] + data[5] * data[5])
    vx, vy = turned(at, i, data[4], data[5])
    vx, vy = vx / length, vy / length
    bx, by = turned(at, j, data[2], data[3])
    # from the centre of mass of body i to the point of body j
    cx = at.x[j] + bx - at.x[i]
    cy = at.y[j] + by - at.y[i]
    slip = vx * (at.x_rate[j] - by * at.phi_rate[j] - at.x_rate[i] + cy * at.phi_rate[i])
    slip += vy * (at.y_rate[j] + bx * at.phi_rate[j] - at.y_rate[i] - cx * at.phi_rate[i])
    normal = abs(LinearSystem(block).multiplier[table.row[joint]]) * length
    friction = -table.friction[joint] * normal * math.tanh(slip / SLIP_SPEED)
    Loads(block).rubbing[joint] = friction
    force[3 * j] += friction * vx
    force[3 * j + 1] += friction * vy
    force[3 * j + 2] += friction * (bx * vy - by * vx)
    force[3 * i] -= friction * vx
    force[3 * i + 1] -= friction * vy
    force[3 * i + 2] -= friction * (cx * vy - cy * vx)
    lost: float = -friction * slip
    return lost

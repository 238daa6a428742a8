"""What loads the structure: the inertia of the rigid motion, and what is applied to the bodies."""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.kinds import JOINTS
from ...tables.members import Couples, Lumps, Nodes, Structure, Ties
from ...tables.motion import Loads, Pose, Stages
from ...tables.parts import Joints
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_small
from ..dynamics.point_forces import weight
from ..vectors import clear

_REVOLUTE = JOINTS.number("revolute")


@jit
def put_loads(block: Array, at: Pose) -> None:
    """P: inertia forces -m a and moments -J alpha of all lumps in the rigid motion, and what else acts on the bodies.

    Forces on a centre of mass are shared among the body's lumps by their masses, which is exact for weight.
    """
    keep_small()
    table = Lumps(block)
    it = Structure(block)
    body = Nodes(block).body
    place = Nodes(block).place
    rate = at.phi_rate
    acceleration = Stages(block).dy_at[Sizes(block).coordinates :]
    clear(it.load)
    for k in range(table.node.shape[0]):
        p = table.node[k]
        i = body[p]
        mass = table.data[k, codes.LUMP_MASS]
        share = table.data[k, codes.LUMP_SHARE]
        turning = acceleration[3 * i + 2]
        square = rate[i] * rate[i]
        x = acceleration[3 * i] - turning * place[p, 1] - square * place[p, 0]
        y = acceleration[3 * i + 1] + turning * place[p, 0] - square * place[p, 1]
        weight_x, weight_y = weight(block, i)
        it.load[3 * p] += share * weight_x - mass * x
        it.load[3 * p + 1] += share * weight_y - mass * y
        it.load[3 * p + 2] -= table.data[k, codes.LUMP_INERTIA] * turning
    couple = Couples(block)
    for k in range(couple.node.shape[0]):
        it.load[3 * couple.node[k] + 2] += couple.sign[k] * Loads(block).torque[couple.force[k]]
    _rub(block, at)


@jit
def _rub(block: Array, at: Pose) -> None:
    """Add the friction of joints to the loads: torques of pins, and forces along the guides of sliders."""
    keep_small()
    table = Joints(block)
    tie = Ties(block)
    place = Nodes(block).place
    load = Structure(block).load
    for k in range(tie.joint.shape[0]):
        joint = tie.joint[k]
        if not table.friction[joint] > 0.0:
            continue
        p = tie.node[k]
        rubbing = Loads(block).rubbing[joint]
        i = table.body_i[joint]
        j = table.body_j[joint]
        if Nodes(block).body[p] == i:
            rubbing = -rubbing  # as of a force on body j; the torque of a pin is given on body i
        if table.kind[joint] == _REVOLUTE:
            load[3 * p + 2] -= rubbing
            continue
        data = table.data[joint]
        length = math.sqrt(data[4] * data[4] + data[5] * data[5])
        x = rubbing * (at.cosine[i] * data[4] - at.sine[i] * data[5]) / length
        y = rubbing * (at.sine[i] * data[4] + at.cosine[i] * data[5]) / length
        # from the node to the point of body j, where it acts
        away_x = at.x[j] + at.cosine[j] * data[2] - at.sine[j] * data[3] - at.x[Nodes(block).body[p]] - place[p, 0]
        away_y = at.y[j] + at.sine[j] * data[2] + at.cosine[j] * data[3] - at.y[Nodes(block).body[p]] - place[p, 1]
        load[3 * p] += x
        load[3 * p + 1] += y
        load[3 * p + 2] += away_x * y - away_y * x

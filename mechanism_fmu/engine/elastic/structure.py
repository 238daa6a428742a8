"""The linkage as a structure at one instant: drives stand still, every joint holds, only members give way.

Unknown are the displacements u = (x, y, rotation) of all nodes: ends of members, and one node a rigid body.
Compatibility d = C u says what they do to the members (three deformations each) and to what cannot give way (rows of
joints, locked coordinates), for which d = 0. C is square: the linkage is statically determinate. With loads P at the
nodes, virtual work gives f = C^-T P, the sections give d = F f, and u = C^-1 d; so B = C^-T and u = B^T F B P, the
flexibility approach of Erdman, Sandor and Oakberg (docs/explanation/elastodynamics.md).
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.kinds import JOINTS
from ...tables.members import Couples, Lumps, Members, Nodes, Structure, Ties
from ...tables.motion import Loads, Pose, Rows, Stages
from ...tables.parts import Joints
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_small
from ..dynamics.point_forces import weight
from ..vectors import clear, turned
from .linear_equations import factorise, solve, solve_transposed

# What loads the structure: the inertia of the rigid motion, and what is applied to the bodies.

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
        i, j = table.body_i[joint], table.body_j[joint]
        if Nodes(block).body[p] == i:
            rubbing = -rubbing  # as of a force on body j; the torque of a pin is given on body i
        if table.kind[joint] == _REVOLUTE:
            load[3 * p + 2] -= rubbing
            continue
        data = table.data[joint]
        length = math.sqrt(data[4] * data[4] + data[5] * data[5])
        x, y = turned(at, i, data[4], data[5])
        x, y = rubbing * x / length, rubbing * y / length
        # from the node to the point of body j, where it acts
        away_x = at.x[j] + at.cosine[j] * data[2] - at.sine[j] * data[3] - at.x[Nodes(block).body[p]] - place[p, 0]
        away_y = at.y[j] + at.sine[j] * data[2] + at.cosine[j] * data[3] - at.y[Nodes(block).body[p]] - place[p, 1]
        load[3 * p] += x
        load[3 * p + 1] += y
        load[3 * p + 2] += away_x * y - away_y * x


@jit
def bend(block: Array, at: Pose) -> None:
    """Write loads, element forces, deformations and displacements to `structure`.

    Positions, accelerations and rows of joints are those that `derivative` has left, of `stages.y_at` and `dy_at`.
    """
    keep_small()
    _place_nodes(block, at)
    it = Structure(block)
    for r in range(it.matrix.shape[0]):
        clear(it.matrix[r])
    _compatibility_of_members(block)
    _compatibility_of_joints(block)
    first = it.matrix.shape[0] - it.locked.shape[0]
    for k in range(it.locked.shape[0]):
        it.matrix[first + k, it.locked[k]] = 1.0
    factorise(it.matrix, it.matrix_order)
    put_loads(block, at)
    solve_transposed(it.matrix, it.matrix_order, it.load, it.element_force)
    _deform(block)
    solve(it.matrix, it.matrix_order, it.deformation, it.displacement)


@jit
def _place_nodes(block: Array, at: Pose) -> None:
    """Write the vectors from the centres of mass of their bodies to the nodes [m], in the global frame."""
    keep_small()
    node = Nodes(block)
    place = node.place
    for k in range(node.body.shape[0]):
        i = node.body[k]
        place[k, 0], place[k, 1] = turned(at, i, node.point[k, 0], node.point[k, 1])


@jit
def _compatibility_of_members(block: Array) -> None:
    """Rows of a member from a to b, of length l along t, n = R t: t.(u_b - u_a), and by what its ends turn off t.

    The latter are rotation_a - n.(u_b - u_a)/l and rotation_b - n.(u_b - u_a)/l.
    """
    keep_small()
    table = Members(block)
    it = Structure(block)
    place = Nodes(block).place
    for m in range(table.start.shape[0]):
        a = table.start[m]
        b = table.end[m]
        along_x = place[b, 0] - place[a, 0]
        along_y = place[b, 1] - place[a, 1]
        length = math.sqrt(along_x * along_x + along_y * along_y)
        along_x /= length
        along_y /= length
        for end in range(2):
            node = a
            sign = -1.0
            if end == 1:
                node = b
                sign = 1.0
            it.matrix[3 * m, 3 * node] = sign * along_x
            it.matrix[3 * m, 3 * node + 1] = sign * along_y
            for row in range(3 * m + 1, 3 * m + 3):
                it.matrix[row, 3 * node] = sign * along_y / length
                it.matrix[row, 3 * node + 1] = -sign * along_x / length
        it.matrix[3 * m + 1, 3 * a + 2] = 1.0
        it.matrix[3 * m + 2, 3 * b + 2] = 1.0


@jit
def _compatibility_of_joints(block: Array) -> None:
    """Rows of the joints: what acts on a body at its centre of mass as (J_x, J_y, J_phi) acts on the node it stands at.

    With a from the centre of mass to the node, its moment there is J_phi - (a_x J_y - a_y J_x).
    """
    keep_small()
    table = Ties(block)
    it = Structure(block)
    jacobian = Rows(block).jacobian
    body = Nodes(block).body
    place = Nodes(block).place
    first = 3 * Members(block).start.shape[0]
    for k in range(table.joint.shape[0]):
        row = Joints(block).row[table.joint[k]]
        after = Sizes(block).joint_rows
        if table.joint[k] + 1 < Sizes(block).joints:
            after = Joints(block).row[table.joint[k] + 1]
        node = table.node[k]
        i = 3 * body[node]
        for r in range(row, after):
            x = jacobian[r, i]
            y = jacobian[r, i + 1]
            it.matrix[first + r, 3 * node] += x
            it.matrix[first + r, 3 * node + 1] += y
            it.matrix[first + r, 3 * node + 2] += jacobian[r, i + 2] - place[node, 0] * y + place[node, 1] * x


@jit
def _deform(block: Array) -> None:
    """The deformations d = F f of each member: l/EA along it; l/3EI and -l/6EI of the moments on its two ends."""
    keep_small()
    table = Members(block)
    it = Structure(block)
    clear(it.deformation)
    for m in range(table.start.shape[0]):
        first = it.element_force[3 * m + 1]
        second = it.element_force[3 * m + 2]
        bending = table.data[m, codes.MEMBER_BENDING]
        it.deformation[3 * m] = it.element_force[3 * m] * table.data[m, codes.MEMBER_STRETCH]
        it.deformation[3 * m + 1] = bending * (first / 3.0 - second / 6.0)
        it.deformation[3 * m + 2] = bending * (second / 3.0 - first / 6.0)

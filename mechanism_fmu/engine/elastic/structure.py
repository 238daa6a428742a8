"""The linkage as a structure at one instant: drives stand still, every joint holds, only members give way.

Unknown are the displacements u = (x, y, rotation) of all nodes: ends of members, and one node a rigid body.
Compatibility d = C u says what they do to the members (three deformations each) and to what cannot give way (rows of
joints, locked coordinates), for which d = 0. C is square: the linkage is statically determinate. With loads P at the
nodes, virtual work gives f = C^-T P, the sections give d = F f, and u = C^-1 d; so B = C^-T and u = B^T F B P, the
flexibility approach of Erdman, Sandor and Oakberg (docs/elastodynamics.md).
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.members import Members, Nodes, Structure, Ties
from ...tables.motion import Pose, Rows
from ...tables.parts import Joints
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_small
from ..vectors import clear
from .applied import put_loads
from .linear_equations import factorise, solve, solve_transposed


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
        place[k, 0] = at.cosine[i] * node.point[k, 0] - at.sine[i] * node.point[k, 1]
        place[k, 1] = at.sine[i] * node.point[k, 0] + at.cosine[i] * node.point[k, 1]


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

"""What can be read of elastic members, after `structure.bend`."""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.members import Members, Nodes, Structure
from ...tables.motion import Pose
from ..compiler.subset import jit, keep_small


@jit
def elastic_reading(block: Array, at: Pose, kind: int, index: int) -> float:
    """The value of an output of members or their ends; `index` as in `ports.output_index`."""
    keep_small()
    it = Structure(block)
    value = 0.0
    if kind == codes.NODE_PLACE or kind == codes.NODE_BENT:
        value = _place(block, at, index // 2, index % 2)
        if kind == codes.NODE_BENT:
            value += it.displacement[3 * (index // 2) + index % 2]
    elif kind == codes.NODE_DEFLECTION:
        value = it.displacement[index]
    elif kind == codes.NODE_DEVIATION:
        x = it.displacement[3 * index]
        y = it.displacement[3 * index + 1]
        value = math.sqrt(x * x + y * y)
    else:
        value = _stress(block, index)
    return value


@jit
def _place(block: Array, at: Pose, node: int, axis: int) -> float:
    """Where a node stands in the rigid motion [m]."""
    i = Nodes(block).body[node]
    place: float = Nodes(block).place[node, axis]
    if axis == 0:
        place += at.x[i]
    else:
        place += at.y[i]
    return place


@jit
def _stress(block: Array, member: int) -> float:
    """Largest magnitude of the normal stress in a member [Pa]: |N| / A + |M| / W at the end with the larger moment.

    Between the ends the moment runs straight, because all mass stands at nodes.
    """
    force = Structure(block).element_force
    data = Members(block).data[member]
    moment = max(abs(force[3 * member + 1]), abs(force[3 * member + 2]))
    stress: float = abs(force[3 * member]) / data[codes.MEMBER_AREA] + moment / data[codes.MEMBER_MODULUS]
    return stress

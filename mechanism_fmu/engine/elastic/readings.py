"""Outputs of elastic members, after `structure.bend`."""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.members import Beams, Members, Nodes, Structure
from ...tables.motion import LinearSystem, Pose, Stages
from ...tables.parts import Bodies
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_small
from ..dynamics.point_forces import weight
from ..vectors import turned

# A hinged bar that bends under the forces on its tip and its own inertia (docs/explanation/elastodynamics.md).
#
# The bar is uniform with point masses at its ends, so that mass m, centre of mass (x_G from the hinge) and inertia J
# are those of its body: its mass per length is mu = 6 (m x_G (l - x_G) - J) / l^3. The motion and the force Q of the
# hinge across the bar are those of the solve; what acts on the tip need not be known, because moments about it give the
# couple at the hinge, M_0 = J alpha - m (l - x_G) a_G + l Q. With a(x) = a_0 + alpha x the acceleration across the bar,
# m_0 the mass at the hinge and Q' = Q - m_0 a_0,
#
#     M(x) = -M_0 + Q' x - mu (a_0 x^2 / 2 + alpha x^3 / 6) = E I v''(x),    M(l) = 0.


@jit
def beam_reading(block: Array, at: Pose, kind: int, beam: int) -> float:
    """Deflection of the tip from the tangent at the hinge [m], or the largest bending stress of a bar [Pa].

    Accelerations and multipliers are those that `derivative` has left. The deflection counts along R t, where t points
    from the hinge to the tip.
    """
    keep_small()
    data = Beams(block).data[beam]
    length = data[codes.BEAM_SPAN]
    zeroth, first, second, third = _moment(block, at, beam)
    if kind == codes.BEAM_DEFLECTION:
        # the integral of M (l - x) / EI
        square = length * length
        sag = zeroth / 2.0 + length * (first / 6.0 + length * (second / 12.0 + length * third / 20.0))
        deflection: float = square * sag / data[codes.BEAM_STIFFNESS]
        return deflection
    largest = abs(zeroth)
    # M' = first + 2 second x + 3 third x^2 = 0; where second or third vanish, so does a root or the numbers end
    root = math.sqrt(max(second * second - 3.0 * third * first, 0.0))
    for side in range(2):
        bottom = -second + root if side == 1 else -second - root
        if bottom != 0.0:
            x = first / bottom
            if 0.0 < x < length:
                largest = max(largest, abs(zeroth + x * (first + x * (second + x * third))))
    stress: float = largest / data[codes.BEAM_MODULUS]
    return stress


@jit
def _moment(block: Array, at: Pose, beam: int) -> tuple[float, float, float, float]:
    """The bending moment M(x) as a polynomial: its coefficients of x^0 to x^3."""
    keep_small()
    table = Beams(block)
    data = table.data[beam]
    i = table.body[beam]
    row = table.row[beam]
    tx, ty = turned(at, i, data[codes.BEAM_ALONG_X], data[codes.BEAM_ALONG_Y])
    multiplier = LinearSystem(block).multiplier
    hinge = data[codes.BEAM_SIDE] * (tx * multiplier[row + 1] - ty * multiplier[row])
    length = data[codes.BEAM_SPAN]
    centre = data[codes.BEAM_CENTRE]
    mass = 1.0 / Bodies(block).inverse_mass[3 * i]
    inertia = 1.0 / Bodies(block).inverse_mass[3 * i + 2]
    acceleration = Stages(block).dy_at[Sizes(block).coordinates :]
    weight_x, weight_y = weight(block, i)
    at_centre = tx * (acceleration[3 * i + 1] - weight_y / mass) - ty * (acceleration[3 * i] - weight_x / mass)
    turning = acceleration[3 * i + 2]
    at_hinge = at_centre - turning * centre
    density = 6.0 * (mass * centre * (length - centre) - inertia) / (length * length * length)
    at_tip = mass * centre / length - density * length / 2.0
    concentrated = mass - density * length - at_tip
    couple = inertia * turning - mass * (length - centre) * at_centre + length * hinge
    return -couple, hinge - concentrated * at_hinge, -density * at_hinge / 2.0, -density * turning / 6.0


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

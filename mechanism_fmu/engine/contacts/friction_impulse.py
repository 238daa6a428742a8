"""Coulomb friction in an impact: the tangential impulse that the normal one allows."""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, LinearSystem, Rows, Strikes
from ...tables.parts import Bodies, Contacts
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_small
from ..constraints.kinematics import place_bodies
from ..constraints.rows import active_rows, spare_row, tangent_row
from ..dynamics.acceleration import scale_rows
from ..dynamics.minimum_norm import minimum_norm


@jit
def rub(block: Array) -> None:
    """Slow down the slip of every contact that has just had a normal impulse p (`strikes.impulse`), at y_end.

    The tangential impulse is what ends the slip while all closed rows keep their rates, or coefficient * p when that is
    less, or less still when more would add energy. It follows the normal impulses, contact by contact.
    """
    keep_small()
    n = Sizes(block).coordinates
    table = Contacts(block)
    system = LinearSystem(block)
    y = Course(block).y_end
    for c in range(table.mode.shape[0]):
        most = table.value[c, codes.FRICTION] * abs(Strikes(block).impulse[c])
        if not most > 0.0 or table.kind[c] != codes.POINT_LINE:
            continue
        at = place_bodies(block, y)
        count = active_rows(block, at)
        tangent_row(block, at, c, Strikes(block).tangent_line)
        row = Rows(block)
        spare = spare_row(block)
        for k in range(n):
            row.jacobian[count, k] = row.jacobian[spare, k]
        for r in range(count):
            system.right_side[r] = 0.0
        system.right_side[count] = -row.residual_rate[spare]
        scale_rows(block, count + 1)
        minimum_norm(block, count + 1, n)
        share = min(_dissipative_share(block), most / max(most, abs(system.multiplier[count])))
        for k in range(n):
            y[n + k] += share * Bodies(block).inverse_root_mass[k] * system.solution[k]


@jit
def _dissipative_share(block: Array) -> float:
    """The part, 0..1, of the change of rates in `solution` that takes the most energy from the rates at y_end.

    It is 1 unless closed rows separate after a bounce, or fix the slip themselves.
    """
    keep_small()
    n = Sizes(block).coordinates
    solution = LinearSystem(block).solution
    along = 0.0
    square = 0.0
    for k in range(n):
        along -= Course(block).y_end[n + k] / Bodies(block).inverse_root_mass[k] * solution[k]
        square += solution[k] * solution[k]
    if not along > 0.0:
        return 0.0
    return min(1.0, along / square)

"""Normal forces that rows share at will, where friction turns their shares into motion.

Rows that depend on each other determine multipliers up to a null space. A change in it changes friction, friction the
multipliers again, and with them, or not, the accelerations. Contacts press or come off, so that not all of the null
space is admissible: those without force may only gain some (docs/explanation/friction.md).
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, LinearSystem, Loads, Pose, Rubs, Strikes
from ...tables.parts import Bodies, Contacts, Joints
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_apart, keep_small
from ..constraints.friction_rows import REVOLUTE, axis_length, coefficient, slips
from ..constraints.point_line import spare_row
from ..constraints.rows import contact_row, row_count
from ..dynamics.acceleration import derivative
from ..dynamics.dependent_rows import take_out_range
from ..dynamics.sliding import eliminate, has_two_sides, normal_force
from ..vectors import clear
from .complementarity import push_ratio, push_tolerance
from .trial import COUNT, excess

#: A row of whose squared length less than this is outside the range of all rows is determined: rounding of the
#: projection leaves some 1e-15.
_DETERMINED = 1e-12
#: Accelerations by changes of friction cancel when less than this share of their terms is left.
_CANCELS = 1e-9
#: Sweeps that look for shares by which a contact presses; what they still lack then, of 1, is lacking for good.
_SWEEPS, _LACKS = 200, 1e-9

# Of `strikes.closed`: what has force; closed without force; open, but with no acceleration of its gap. What is added
# where no admissible shares press it.
_HAS_FORCE, _WITHOUT_FORCE, _GRAZES, _NEVER = 0, 1, 2, 2


@jit
def undetermined(block: Array, at: Pose) -> int:
    """Return what slips by a friction that the rows share out at will, so that accelerations depend on the shares.

    `codes.NONE` if there is none. To be called right behind a trial; accelerations, modes and rows are as before.
    """
    keep_apart()
    if not _may_share(block):
        return codes.NONE
    grazing = _mark_forceless(block, at)
    count = row_count(block)
    if LinearSystem(block).rank[0] >= count and grazing == 0:
        return codes.NONE
    mark = Strikes(block).closed
    mode = Contacts(block).mode
    if grazing > 0:
        for c in range(mode.shape[0]):
            if mark[c] == _GRAZES:
                mode[c] = codes.CLOSED
        derivative(block, Course(block).y_end, Course(block).dy_end)
        count = row_count(block)
    what = codes.NONE
    opened = 0
    if LinearSystem(block).rank[0] < count:
        opened = _mark_never(block, count)
        if opened > 0:
            for c in range(mode.shape[0]):
                if mark[c] > _GRAZES:
                    mode[c] = codes.OPEN
            derivative(block, Course(block).y_end, Course(block).dy_end)
            count = row_count(block)
        what = _first_that_moves(block, count)
    if grazing + opened > 0:
        for c in range(mode.shape[0]):
            if mark[c] != _HAS_FORCE:
                mode[c] = codes.CLOSED if mark[c] % 2 == _WITHOUT_FORCE else codes.OPEN
        derivative(block, Course(block).y_end, Course(block).dy_end)
    return what


@jit
def _may_share(block: Array) -> bool:
    """Whether a contact or joint slips."""
    keep_small()
    some = False
    for k in range(Sizes(block).contacts + Sizes(block).joints):
        some = some or slips(block, k)
    return some


@jit
def _mark_forceless(block: Array, at: Pose) -> int:
    """Mark the candidates without force in `strikes.closed`; return how many of them are open."""
    keep_small()
    mark = Strikes(block).closed
    mode = Contacts(block).mode
    for c in range(mode.shape[0]):
        mark[c] = _HAS_FORCE
    tolerance = push_tolerance(block, row_count(block))
    grazing = 0
    for k in range(Strikes(block).problem[COUNT]):
        c = Strikes(block).candidates[k]
        if mode[c] == codes.CLOSED:
            if push_ratio(block, c, tolerance) < 1.0:
                mark[c] = _WITHOUT_FORCE
        elif Rubs(block).free[c] == codes.BOUND:
            contact_row(block, at, c, spare_row(block))
            left, rounding = excess(block, c)
            if abs(left) <= rounding:
                mark[c] = _GRAZES
                grazing += 1
    return grazing


@jit
def _mark_never(block: Array, count: int) -> int:
    """Mark contacts without force that no admissible shares press, and return how many there are.

    Admissible changes v of the multipliers are combinations of `_change_shares` of all rows, with v >= 0 where there is
    no force. The least one with v = 1 for a contact is a combination of these contacts' own rows with factors f >= 0:
    a linear complementarity problem, solved by projected Gauss-Seidel. Where there is none, the factors grow for ever.
    """
    keep_apart()
    mark = Strikes(block).closed
    place = Contacts(block).row
    contacts = mark.shape[0]
    some = False
    for c in range(contacts):
        some = some or mark[c] != _HAS_FORCE
    if not some:
        return 0
    product = LinearSystem(block).column_triangle
    change = Loads(block).last_multiplier
    for r in range(count):
        clear(product[r])
    for r in range(count):
        if _change_shares(block, r, count, change):
            for c in range(contacts):
                if mark[c] != _HAS_FORCE:
                    for d in range(contacts):
                        if mark[d] != _HAS_FORCE:
                            product[place[c], place[d]] += change[place[c]] * change[place[d]]
    opened = 0
    for c in range(contacts):  # marks change what is opened, but not what is without force
        if mark[c] != _HAS_FORCE and not _can_press(block, c):
            mark[c] += _NEVER
            opened += 1
    return opened


@jit
def _can_press(block: Array, contact: int) -> bool:
    """Whether there are admissible shares by which a contact without force presses."""
    keep_small()
    mark = Strikes(block).closed
    place = Contacts(block).row
    product = LinearSystem(block).column_triangle
    factor = LinearSystem(block).dual
    clear(factor)
    for _ in range(_SWEEPS):
        lacks = 0.0
        for c in range(mark.shape[0]):
            if mark[c] == _HAS_FORCE:
                continue
            value = -1.0 if c == contact else 0.0
            for d in range(mark.shape[0]):
                if mark[d] != _HAS_FORCE:
                    value += product[place[c], place[d]] * factor[place[d]]
            lacks = max(lacks, -value)
            if product[place[c], place[c]] > _DETERMINED:
                factor[place[c]] = max(0.0, factor[place[c]] - value / product[place[c], place[c]])
        if lacks <= _LACKS:
            return True
    return False


@jit
def _first_that_moves(block: Array, count: int) -> int:
    """The first contact or joint that slips whose share of a normal force changes accelerations; `codes.NONE`."""
    keep_apart()
    for k in range(Sizes(block).contacts + Sizes(block).joints):
        if slips(block, k):
            row = _normal_row(block, k)
            if _moves(block, row, count) or (_is_pin(block, k) and _moves(block, row + 1, count)):
                return k
    return codes.NONE


@jit
def _moves(block: Array, row: int, count: int) -> bool:
    """Whether the share of the multiplier of a row that is free changes accelerations, by friction."""
    keep_apart()
    if not _change_shares(block, row, count, Loads(block).last_multiplier):
        return False
    table = Rubs(block)
    root = Bodies(block).inverse_root_mass
    number = _sliding_count(block)
    largest = 0.0
    terms = 0.0
    for i in range(Sizes(block).coordinates):
        total = 0.0
        size = 0.0
        for a in range(number):
            k = table.sliding[a]
            friction = table.matrix[a, number]
            total += friction * table.solution[k, i]
            size += abs(friction) * (abs(table.solution[k, i]) + abs(root[i] * table.direction[k, i]))
        largest = max(largest, abs(total))
        terms = max(terms, size)
    return largest > _CANCELS * terms


@jit
def _change_shares(block: Array, row: int, count: int, change: Array) -> bool:
    """Write the change of all multipliers, shape (count,), by the free share of one; False where it has none.

    What it does to friction, with what that does to all normal forces again, is in the last column of `rubs.matrix`.
    """
    keep_apart()
    take_out_range(block, row, count, change)
    if not change[row] > _DETERMINED:
        return False
    table = Rubs(block)
    number = _sliding_count(block)
    for a in range(number):
        k = table.sliding[a]
        factor = float(table.slip[k]) * coefficient(block, k)
        normal_force(block, k, number, a)
        for b in range(number):
            table.matrix[a, b] *= factor
        table.matrix[a, a] += 1.0
        table.matrix[a, number] = -factor * _normal_change(block, k, change)
    if eliminate(table.matrix, number) == 0.0:
        return False
    for a in range(number):
        for r in range(count):
            change[r] += table.matrix[a, number] * table.multiplier[table.sliding[a], r]
    return True


@jit
def _sliding_count(block: Array) -> int:
    """The number of contacts, joints and brakes that slip: as many are in `rubs.sliding`."""
    keep_small()
    number = 0
    for k in range(Sizes(block).rubs):
        if slips(block, k):
            number += 1
    return number


@jit
def _normal_row(block: Array, rub: int) -> int:
    """The row of the normal force of a contact or joint; the first of two of a pin."""
    contacts = Sizes(block).contacts
    row: int = Contacts(block).row[rub] if rub < contacts else Joints(block).row[rub - contacts]
    return row


@jit
def _is_pin(block: Array, rub: int) -> bool:
    contacts = Sizes(block).contacts
    is_pin: bool = rub >= contacts and Joints(block).kind[rub - contacts] == REVOLUTE
    return is_pin


@jit
def _normal_change(block: Array, rub: int, change: Array) -> float:
    """The change of the normal force of a contact or joint by that of the multipliers."""
    keep_small()
    multiplier = LinearSystem(block).multiplier
    contacts = Sizes(block).contacts
    if rub >= contacts + Sizes(block).joints:
        return 0.0
    row = _normal_row(block, rub)
    value: float = change[row]
    if rub < contacts:
        return -value if multiplier[row] < 0.0 and has_two_sides(block, rub) else value
    if _is_pin(block, rub):
        force = math.sqrt(multiplier[row] * multiplier[row] + multiplier[row + 1] * multiplier[row + 1])
        both: float = multiplier[row] * value + multiplier[row + 1] * change[row + 1]
        return both / force if force > 0.0 else 0.0
    along: float = axis_length(block, rub - contacts) * value
    return -along if multiplier[row] < 0.0 else along

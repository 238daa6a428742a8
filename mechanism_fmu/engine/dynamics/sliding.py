"""Dry friction of what slips: forces, or impulses, that agree with the normal ones, by one factorisation.

With f along the directions of slip, the multipliers are those without friction and R f more, R the response to unit
forces, by the same factors as the solve without friction. So f = -sigma mu |N(f)|, sigma the direction of slip, is a
system as large as the number of contacts and joints that slip. It is linear in contacts, and solved by Newton's method
where pins slip, whose normal force is the root of a sum of squares.
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import LinearSystem, Loads, Pose, Rows, Rubs
from ...tables.parts import Bodies, Contacts, Joints
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_small
from ..constraints.friction_rows import REVOLUTE, axis_length, coefficient, friction_row, holding, slips, sticks
from ..constraints.point_line import spare_row
from .linear_solve import solve_again

#: Newton's method ends when no friction changes by more than this part of the largest.
_AGREE = 1e-14
#: Close to where no forces agree, rounding leaves more than that: it ends, too, when less than this shrinks no more.
_NEARLY = 1e-8
_ROUNDS = 40
#: Coefficients do not grow by less than this part: there the answer ends.
_LEAST_GROWTH = 1e-4
#: What moves along its friction by less than this share of what it would without rows is held by them: rows that
#: depend on each other leave 1e-15, and are told from others from 1e-10 on (`minimum_norm.RANK_TOLERANCE`), squared.
_HELD = 1e-12


@jit
def slide(block: Array, at: Pose, count: int) -> float:
    """Add what friction does to the last solve, of `count` rows: solution and multipliers; the power lost [W].

    Friction is left in `rubs.force`, of what sticks too, and in `loads.rubbing` of joints. Not a number: no normal
    forces agree with their friction.
    """
    keep_small()
    number = _respond(block, at, count)
    Rubs(block).sense[0] = 1
    if number > 0 and not _agree(block, number):
        return math.nan
    n = Sizes(block).coordinates
    table = Rubs(block)
    system = LinearSystem(block)
    lost = 0.0
    for a in range(number):
        k = table.sliding[a]
        force = table.force[k]
        lost -= force * table.speed[k]
        for i in range(n):
            system.solution[i] += force * table.solution[k, i]
        for r in range(count):
            system.multiplier[r] += force * table.multiplier[k, r]
    contacts = Sizes(block).contacts
    joints = Sizes(block).joints
    for k in range(table.slip.shape[0]):
        if sticks(block, k):
            table.force[k] = system.multiplier[table.row[k]]
        if k >= contacts + joints:
            if coefficient(block, k) > 0.0:
                Loads(block).torque[k - contacts - joints] = table.force[k]
        elif k >= contacts:
            Loads(block).rubbing[k - contacts] = table.force[k]
    return lost


@jit
def _respond(block: Array, at: Pose, count: int) -> int:
    """Find what slips, and what unit forces along their slip do; how many there are. Solution and multipliers stay."""
    keep_small()
    n = Sizes(block).coordinates
    table = Rubs(block)
    system = LinearSystem(block)
    row = Rows(block)
    spare = spare_row(block)
    number = 0
    for k in range(table.slip.shape[0]):
        table.force[k] = 0.0
        if not slips(block, k):
            continue
        if number == 0:
            for i in range(n):
                table.bare_solution[i] = system.solution[i]
            for r in range(count):
                table.bare_multiplier[r] = system.multiplier[r]
        friction_row(block, at, k, spare)
        table.speed[k] = row.residual_rate[spare]
        for i in range(n):
            table.direction[k, i] = row.jacobian[spare, i]
        respond(block, count, table.direction[k], table.solution[k])
        for r in range(count):
            table.multiplier[k, r] = system.multiplier[r]
        table.sliding[number] = k
        number += 1
    if number > 0:
        for i in range(n):
            system.solution[i] = table.bare_solution[i]
        for r in range(count):
            system.multiplier[r] = table.bare_multiplier[r]
    return number


@jit
def respond(block: Array, count: int, direction: Array, solution: Array) -> None:
    """What a unit force along `direction` does to rates, into `solution` (as that of the linear system).

    With the factors of the last solve, of `count` rows; the system's own solution and multipliers are lost.
    """
    keep_small()
    n = Sizes(block).coordinates
    system = LinearSystem(block)
    row = Rows(block)
    for r in range(count):
        right = 0.0
        for end in range(2):
            first = 3 * row.body[r, end]
            for i in range(first, min(first + 3, n)):
                right -= row.jacobian[r, i] * Bodies(block).inverse_mass[i] * direction[i]
        system.right_side[r] = right
    solve_again(block, count, n)
    for i in range(n):
        solution[i] = system.solution[i] + Bodies(block).inverse_root_mass[i] * direction[i]


@jit
def _agree(block: Array, number: int) -> bool:
    """Find `rubs.force` of what slips; whether there is an answer.

    By Newton's method at once; where that fails, the coefficients grow from zero in steps, and the answer follows them.
    """
    keep_small()
    if _newton(block, number, 1.0):
        return True
    table = Rubs(block)
    for a in range(number):
        table.force[table.sliding[a]] = 0.0
    reached = 0.0
    growth = 0.5
    while reached < 1.0:
        for a in range(number):
            k = table.sliding[a]
            table.kept[k] = table.force[k]
        if _newton(block, number, min(1.0, reached + growth)):
            reached = min(1.0, reached + growth)
            growth *= 2.0
            continue
        for a in range(number):
            k = table.sliding[a]
            table.force[k] = table.kept[k]
        growth *= 0.5
        if growth < _LEAST_GROWTH:
            return False
    return True


@jit
def _newton(block: Array, number: int, part: float) -> bool:
    """Newton's method for `rubs.force`, from what it holds, with this part of the coefficients; whether it ends."""
    keep_small()
    table = Rubs(block)
    before = math.inf
    for _ in range(_ROUNDS):
        for a in range(number):
            k = table.sliding[a]
            share = part * float(table.slip[k]) * coefficient(block, k)
            table.matrix[a, number] = -table.force[k] - share * normal_force(block, k, number, a)
            for b in range(number):
                table.matrix[a, b] *= share
            table.matrix[a, a] += 1.0
            table.criterion[k] = table.matrix[a, a]
        determinant = eliminate(table.matrix, number)
        if determinant == 0.0:
            return False
        table.sense[0] = 1 if determinant > 0.0 else 0
        change = 0.0
        largest = 0.0
        for a in range(number):
            k = table.sliding[a]
            table.force[k] += table.matrix[a, number]
            change = max(change, abs(table.matrix[a, number]))
            largest = max(largest, abs(table.force[k]))
        if change <= _AGREE * largest or 0.5 * before < change <= _NEARLY * largest:
            return True
        if not change < math.inf:
            return False
        before = change
    return False


@jit
def normal_force(block: Array, rub: int, number: int, line: int) -> float:
    """The normal force of a contact or joint with the friction found so far [N]; its derivatives to `matrix[line]`."""
    keep_small()
    table = Rubs(block)
    slope = table.matrix[line]
    contacts = Sizes(block).contacts
    for b in range(number):
        slope[b] = 0.0
    if rub < contacts:
        normal: float = table.given[rub]
        if Contacts(block).mode[rub] == codes.CLOSED:
            row = Contacts(block).row[rub]
            normal += _multiplier(block, row, number)
            side = 1.0
            if normal < 0.0 and has_two_sides(block, rub):
                side = -1.0  # it holds, and is pushed from its other side
            for b in range(number):
                slope[b] = side * table.multiplier[table.sliding[b], row]
            normal *= side
        return normal
    if rub >= contacts + Sizes(block).joints:
        return 1.0  # the coefficient of a brake is its torque
    joint = rub - contacts
    row = Joints(block).row[joint]
    first = _multiplier(block, row, number)
    second = 0.0
    length = 1.0
    if Joints(block).kind[joint] == REVOLUTE:
        second = _multiplier(block, row + 1, number)
    else:
        length = axis_length(block, joint)
    force = math.sqrt(first * first + second * second)
    for b in range(number):
        if force > 0.0:
            k = table.sliding[b]
            slope[b] = first * table.multiplier[k, row]
            if second != 0.0:
                slope[b] += second * table.multiplier[k, row + 1]
            slope[b] *= length / force
    return force * length


@jit
def has_two_sides(block: Array, contact: int) -> bool:
    """Whether a contact holds from both sides: it is guided, or switched by a function."""
    table = Contacts(block)
    both: bool = table.value[contact, codes.GUIDED] > 0.5 or table.function[contact] != codes.NONE
    return both


@jit
def _multiplier(block: Array, row: int, number: int) -> float:
    """The multiplier of a row with the friction found so far."""
    table = Rubs(block)
    value: float = table.bare_multiplier[row]
    for b in range(number):
        k = table.sliding[b]
        value += table.force[k] * table.multiplier[k, row]
    return value


@jit
def eliminate(matrix: Array, number: int) -> float:
    """Solve the first `number` equations; the right side, in column `number`, becomes the solution. The determinant."""
    keep_small()
    determinant = 1.0
    for c in range(number):
        best = c
        for r in range(c + 1, number):
            if abs(matrix[r, c]) > abs(matrix[best, c]):
                best = r
        if not abs(matrix[best, c]) > 0.0:
            return 0.0
        if best != c:
            determinant = -determinant
            for k in range(c, number + 1):
                matrix[c, k], matrix[best, k] = matrix[best, k], matrix[c, k]
        for r in range(number):
            if r != c and matrix[r, c] != 0.0:  # most do nothing to each other
                share = matrix[r, c] / matrix[c, c]
                for k in range(c, number + 1):
                    matrix[r, k] -= share * matrix[c, k]
    for c in range(number):
        determinant *= matrix[c, c]
        matrix[c, number] /= matrix[c, c]
    return determinant


@jit
def can_move(block: Array, rub: int) -> bool:
    """Whether what slips can move along its friction, after the last solve: not where other rows hold it."""
    keep_small()
    table = Rubs(block)
    root = Bodies(block).inverse_root_mass
    with_rows = 0.0
    without = 0.0
    for i in range(Sizes(block).coordinates):
        along = table.direction[rub, i] * root[i]
        with_rows += along * table.solution[rub, i]
        without += along * along
    return with_rows > _HELD * without


@jit
def hold(block: Array, rub: int) -> float:
    """How much more than it does now friction of a contact or joint that sticks could hold [N, N m]; impulses alike."""
    keep_small()
    system = LinearSystem(block)
    contacts = Sizes(block).contacts
    bound = holding(block, rub)
    if rub < contacts:
        normal: float = Rubs(block).given[rub]
        if Contacts(block).mode[rub] == codes.CLOSED:
            normal += system.multiplier[Contacts(block).row[rub]]
            if has_two_sides(block, rub):
                normal = abs(normal)
    elif rub >= contacts + Sizes(block).joints:
        normal = 1.0
    else:
        row = Joints(block).row[rub - contacts]
        normal = abs(system.multiplier[row])
        if Joints(block).kind[rub - contacts] == REVOLUTE:
            normal = math.sqrt(normal * normal + system.multiplier[row + 1] * system.multiplier[row + 1])
        else:
            normal *= axis_length(block, rub - contacts)
    held: float = bound * normal - abs(system.multiplier[Rubs(block).row[rub]])
    return held

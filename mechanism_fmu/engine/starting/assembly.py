"""Assembly of the start position: the guess, the copies of patterns, and Newton's method."""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, LinearSystem, Loads, Rows, Stages
from ...tables.parts import Bodies, Contacts, Functions, Options, Patterns
from ...tables.sizes import Sizes
from ...tolerances import CLOSED_WITHIN, TOUCHES_WITHIN
from .. import status
from ..compiler.subset import jit, keep_apart, keep_small
from ..constraints.kinematics import place_bodies
from ..constraints.rows import active_rows
from ..contacts.binding import let_loose
from ..contacts.guards import function_value, gap, guard_value, place_contact, place_pattern
from ..contacts.rubbing import part_all
from ..contacts.transition import switch_contacts
from ..dynamics.linear_solve import solve, write_matrix
from ..profiles.nearest import find_contact_points, settle_contact_points
from ..scales import contact_unit, largest_off, length_scale
from ..vectors import copy

# Assembly: the position nearest to the start guess at which no row is off, by Newton's method.

_NEWTON_STEPS = 50
_HALVINGS = 30


@jit
def assemble(block: Array) -> int:
    """Close the position rows from the bodies' start guess by Newton's method with minimum-norm steps.

    Held coordinates do not move. The result, or the closest position found, stands in y_end; `rows.residual` holds
    what is left of Phi, for the joints and the contacts that are closed at the start.
    """
    keep_apart()
    n = Sizes(block).coordinates
    now = Course(block)
    s = Stages(block)
    for i in range(Bodies(block).start.shape[0]):
        for k in range(3):
            now.y_end[3 * i + k] = Bodies(block).start[i, k]
    at = place_bodies(block, now.y_end)
    find_contact_points(block, at, now.y_end)
    count = active_rows(block, at)
    worst = largest_off(block, Rows(block).residual, count)
    for _ in range(_NEWTON_STEPS):
        if worst == 0.0:
            return status.OK
        newton_direction(block, count, Rows(block).residual)
        step = 1.0
        improved = False
        for _ in range(_HALVINGS):
            copy(now.y_end, s.y_new)
            for k in range(n):
                s.y_new[k] += step * Loads(block).weight[k] * LinearSystem(block).solution[k]
            at = place_bodies(block, s.y_new)
            settle_contact_points(block, at, s.y_new)
            active_rows(block, at)
            after = largest_off(block, Rows(block).residual, count)
            if after < worst:
                improved = True
                break
            step *= 0.5
        if not improved:
            break
        copy(s.y_new, now.y_end)
        worst = after
    at = place_bodies(block, now.y_end)
    active_rows(block, at)
    return status.OK if worst <= CLOSED_WITHIN else status.NOT_ASSEMBLED


@jit
def newton_direction(block: Array, count: int, left: Array) -> None:
    """Minimum-norm solution of Phi_q dq = -left over the coordinates that are not held; left is Phi, or Phi'."""
    keep_small()
    n = Sizes(block).coordinates
    system = LinearSystem(block)
    for r in range(count):
        system.right_side[r] = -left[r]
    write_matrix(block, count, Loads(block).weight)
    solve(block, count, n)


# The start guess: where bodies and patterns begin, before assembly.

#: Copies of a pattern that are passed in search of the one where the point is.
_MOST_COPIES = 4000


@jit
def start_guess(block: Array, offset: int) -> None:
    """The bodies' start guess, the contacts that are closed there, and patterns `offset` copies beside where it is."""
    keep_small()
    body = Bodies(block)
    now = Course(block)
    table = Contacts(block)
    weight = Loads(block).weight
    start_rates(block)
    for i in range(body.start.shape[0]):
        for k in range(3):
            now.y_end[3 * i + k] = body.start[i, k]
            weight[3 * i + k] = 1.0 if k == 2 else length_scale(block)
    part_all(block)
    held = Options(block).held
    for k in range(held.shape[0]):
        weight[held[k]] = 0.0
    at = place_bodies(block, now.y_end)
    for p in range(Patterns(block).copy.shape[0]):
        Patterns(block).copy[p] = 0
        place_pattern(block, at, p)
    for c in range(table.mode.shape[0]):
        table.clicks[c] = 0
        table.mode[c] = codes.OPEN
        if table.value[c, codes.STARTS_CLOSED] > 0.5 and table.value[c, codes.ENABLED] > 0.5:
            table.mode[c] = codes.CLOSED
        place_contact(block, at, c)
        let_loose(block, c)
    find_copies(block)
    for p in range(Patterns(block).copy.shape[0]):
        if Patterns(block).enabled[p] > 0.5:
            Patterns(block).copy[p] += offset
            place_pattern(block, at, p)
    for f in range(Functions(block).true.shape[0]):
        Functions(block).true[f] = 0
        if function_value(block, at, f)[0] < 0.0:
            Functions(block).true[f] = 1
    switch_contacts(block, at)


@jit
def start_rates(block: Array) -> None:
    """The bodies' start rates, with no coordinate held: others are as far from them as their energy says."""
    keep_apart()
    n = Sizes(block).coordinates
    rate = Bodies(block).start_rate
    for i in range(rate.shape[0]):
        for k in range(3):
            Course(block).y_end[n + 3 * i + k] = rate[i, k]
            Loads(block).weight[3 * i + k] = Bodies(block).inverse_root_mass[3 * i + k]


@jit
def find_copies(block: Array) -> bool:
    """Go to the copy of each pattern where its point is at y_end; whether any was another than before."""
    keep_apart()
    table = Patterns(block)
    first_next = 2 * Sizes(block).contacts
    count = table.copy.shape[0]
    at = place_bodies(block, Course(block).y_end)
    moved = False
    for p in range(count):
        for _ in range(_MOST_COPIES):
            if table.enabled[p] < 0.5:
                break
            if guard_value(block, at, first_next + p)[0] <= 0.0:
                table.copy[p] += 1
            elif guard_value(block, at, first_next + count + p)[0] <= 0.0:
                table.copy[p] -= 1
            else:
                break
            place_pattern(block, at, p)
            moved = True
    return moved


@jit
def is_inside(block: Array) -> bool:
    """Whether a point of a pattern is behind one of the other lines there, which logical functions do not switch."""
    keep_small()
    table = Contacts(block)
    at = place_bodies(block, Course(block).y_end)
    inside = False
    for c in range(table.mode.shape[0]):
        pattern = table.pattern[c]
        if pattern == codes.NONE or table.mode[c] == codes.CLOSED or table.value[c, codes.ENABLED] < 0.5:
            continue
        if table.function[c] == codes.NONE and Patterns(block).enabled[pattern] > 0.5:
            inside = inside or gap(block, at, c)[0] < -TOUCHES_WITHIN * contact_unit(block, c)
    return inside

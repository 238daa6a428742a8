"""The minimum-norm solution z = D^T multiplier with S multiplier = b, S = D D^T, for rows that are all independent.

A row has entries of two bodies only, and S those of rows with a body in common. L of S = L diag(d) L^T has few more,
where rows come in a good order (`body_rank`: minimum degree). So costs grow as the number of bodies, as long as they
make chains, trees and loops. S has the square of the condition of D: where b - D z is not rounding alone,
corrections with it bring the accuracy back to that of D itself (corrected semi-normal equations: Björck, Linear Algebra
Appl. 88/89, 1987).
"""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.motion import LinearSystem, Rows
from ...tables.parts import Bodies
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_apart, keep_small

#: A row of which less than this part of its squared length is left behind those before it is not independent enough.
_DEPENDS_BELOW = 1e-8
#: The solution is corrected when b - D z exceeds this part of its terms; when it has been, this much is enough.
_CORRECT_ABOVE = 1e-14
_ENOUGH = 1e-13
_MOST_CORRECTIONS = 3

# The order of the rows and the places of L's entries: they change when rows do, at events.


@jit
def _has_changed(block: Array, count: int) -> bool:
    """Whether the rows are of other bodies than those that the order was made for."""
    system = LinearSystem(block)
    body = Rows(block).body
    changed: bool = system.planned[0] != count
    for r in range(count):
        changed = changed or system.plan_body[r, 0] != body[r, 0] or system.plan_body[r, 1] != body[r, 1]
    return changed


@jit
def _plan(block: Array, count: int) -> None:
    """Order the rows, and note for each the earlier ones with which it has an entry of L."""
    keep_apart()
    system = LinearSystem(block)
    body = Rows(block).body
    system.planned[0] = count
    for r in range(count):
        system.plan_body[r, 0] = body[r, 0]
        system.plan_body[r, 1] = body[r, 1]
        system.parent[r] = _rank_of(block, r)  # scratch, until places are known
    for r in range(count):
        place = r
        while place > 0 and system.parent[system.place[place - 1]] > system.parent[r]:
            system.place[place] = system.place[place - 1]
            place -= 1
        system.place[place] = r
    ground = Sizes(block).bodies
    for b in range(ground + 1):
        system.last_of_body[b] = codes.NONE
    start = 0
    for i in range(count):
        system.parent[i] = codes.NONE
        system.seen[i] = i
        system.fill_start[i] = start
        system.fill_count[i] = 0
        for end in range(2):
            b = body[system.place[i], end]
            if b == ground:
                continue
            earlier = system.last_of_body[b]
            while earlier != codes.NONE:
                _climb(block, i, earlier // 2)
                earlier = system.chain[earlier // 2, earlier % 2]
            system.chain[i, end] = system.last_of_body[b]
            system.last_of_body[b] = 2 * i + end
        _sort(system.fill[start:], system.fill_count[i])
        start += system.fill_count[i]


@jit
def _rank_of(block: Array, row: int) -> int:
    """Where a row comes in the order: with the first of its bodies, then with the other."""
    keep_small()
    ground = Sizes(block).bodies
    first, second = ground, ground
    for end in range(2):
        b = Rows(block).body[row, end]
        if b != ground:
            second = max(first, Bodies(block).rank[b]) if first != ground else ground
            first = min(first, Bodies(block).rank[b])
    return first * (ground + 1) + second


@jit
def _climb(block: Array, i: int, k: int) -> None:
    """Note that row `i` has an entry with the earlier row `k`, and with all that follow from it up the tree."""
    keep_small()
    system = LinearSystem(block)
    while system.seen[k] != i:
        system.seen[k] = i
        system.fill[system.fill_start[i] + system.fill_count[i]] = k
        system.fill_count[i] += 1
        if system.parent[k] == codes.NONE:
            system.parent[k] = i
        k = system.parent[k]


@jit
def _sort(values: Array, count: int) -> None:
    """In ascending order, by insertion."""
    keep_small()
    for k in range(1, count):
        value = values[k]
        place = k
        while place > 0 and values[place - 1] > value:
            values[place] = values[place - 1]
            place -= 1
        values[place] = value


# Factors, and solutions by them.


@jit
def factorise_sparse(block: Array, count: int) -> bool:
    """S = L diag(d) L^T, with L in `lower` and 1/d in `pivot`; False where a row is not independent enough.

    `independence` is the least part of a row's squared length that is left behind the rows before it.
    """
    if _has_changed(block, count):
        _plan(block, count)
    system = LinearSystem(block)
    ground = Sizes(block).bodies
    w = system.spread
    least = 1.0
    depends_below = max(_DEPENDS_BELOW, system.least_independence[0])
    for i in range(count):
        w[i] = 0.0
    for i in range(count):
        r = system.place[i]
        square = _square(block, r)
        left = square
        mine = system.fill_start[i]
        for q in range(mine, mine + system.fill_count[i]):
            k = system.fill[q]
            value = _product(block, r, system.place[k], ground)
            theirs = system.fill_start[k]
            for t in range(theirs, theirs + system.fill_count[k]):
                value -= system.lower[t] * w[system.fill[t]]
            w[k] = value
            share = value * system.pivot[k]
            system.lower[q] = share
            left -= value * share
        for q in range(mine, mine + system.fill_count[i]):
            w[system.fill[q]] = 0.0
        if not left > depends_below * square:
            return False
        system.pivot[i] = 1.0 / left
        least = min(least, left / square)
    system.independence[0] = least
    system.rank[0] = count
    return True


@jit
def _square(block: Array, r: int) -> float:
    """Squared length of a row of D."""
    entry = LinearSystem(block).scaled[r]
    first: float = entry[0] * entry[0] + entry[1] * entry[1] + entry[2] * entry[2]
    second: float = entry[3] * entry[3] + entry[4] * entry[4] + entry[5] * entry[5]
    return first + second


@jit
def _product(block: Array, r: int, s: int, ground: int) -> float:
    """Scalar product of two rows of D, over the bodies that both have."""
    scaled = LinearSystem(block).scaled
    body = Rows(block).body
    total = 0.0
    for end in range(2):
        b = body[r, end]
        if b != ground and (b == body[s, 0] or b == body[s, 1]):
            k = 3 * end
            m = 0 if b == body[s, 0] else 3
            total += scaled[r, k] * scaled[s, m] + scaled[r, k + 1] * scaled[s, m + 1]
            total += scaled[r, k + 2] * scaled[s, m + 2]
    return total


@jit
def solve_sparse(block: Array, count: int, width: int) -> bool:
    """Write `solution` and `multiplier` of the linear system, by the factors of `factorise_sparse`.

    False where corrections do not bring the residual down to rounding: no pivot tells how badly D is conditioned.
    """
    system = LinearSystem(block)
    x = system.coefficient
    change = system.dual
    for k in range(width + 3):  # the ground's, too: its entries of D are 0, by which a NaN would remain one
        system.solution[k] = 0.0
    for i in range(count):
        x[i] = 0.0
        change[i] = system.right_side[system.place[i]]
    for correction in range(_MOST_CORRECTIONS + 1):
        _substitute(system, change, count)
        _combine(block, change, count)
        for i in range(count):
            x[i] += change[i]
        if _residual_is_rounding(block, count, _CORRECT_ABOVE if correction == 0 else _ENOUGH):
            for i in range(count):
                system.multiplier[system.place[i]] = x[i]
            return True
    return False


@jit
def _residual_is_rounding(block: Array, count: int, part: float) -> bool:
    """Write b - D z to `dual`; whether each row of it is at most this `part` of what it is the difference of.

    Each by its own terms: a heavily loaded part of a mechanism says nothing of the accuracy of a lightly loaded one.
    """
    system = LinearSystem(block)
    body = Rows(block).body
    z = system.solution
    all_are = True
    for i in range(count):
        r = system.place[i]
        entry = system.scaled[r]
        left = system.right_side[r]
        terms = abs(left)
        for end in range(2):
            c = 3 * body[r, end]
            k = 3 * end
            left -= entry[k] * z[c] + entry[k + 1] * z[c + 1] + entry[k + 2] * z[c + 2]
            terms += abs(entry[k] * z[c]) + abs(entry[k + 1] * z[c + 1]) + abs(entry[k + 2] * z[c + 2])
        system.dual[i] = left
        all_are = all_are and abs(left) <= part * terms  # not so where it is NaN
    return all_are


@jit
def _substitute(system: LinearSystem, x: Array, count: int) -> None:
    """Solve L diag(d) L^T x = x in its place."""
    for i in range(count):
        value = x[i]
        mine = system.fill_start[i]
        for q in range(mine, mine + system.fill_count[i]):
            value -= system.lower[q] * x[system.fill[q]]
        x[i] = value
    for back in range(count):
        i = count - 1 - back
        x[i] *= system.pivot[i]
    for back in range(count):
        i = count - 1 - back
        value = x[i]
        mine = system.fill_start[i]
        for q in range(mine, mine + system.fill_count[i]):
            x[system.fill[q]] -= system.lower[q] * value


@jit
def _combine(block: Array, x: Array, count: int) -> None:
    """Add D^T x to the solution."""
    system = LinearSystem(block)
    z = system.solution
    body = Rows(block).body
    for i in range(count):
        r = system.place[i]
        entry = system.scaled[r]
        for end in range(2):
            c = 3 * body[r, end]
            k = 3 * end
            z[c] += entry[k] * x[i]
            z[c + 1] += entry[k + 1] * x[i]
            z[c + 2] += entry[k + 2] * x[i]

"""Modes of all candidates at once, by one linear complementarity problem, in two forms.

With G the accelerations by unit forces and c those without them, first, with lambda_R = mu lambda_N + lambda_T,
lambda_L = mu lambda_N - lambda_T and v_T' = xi_R - xi_L for what may slip either way (Glocker, Pfeiffer 1995),

    g''      =  (G_NN - G_NT mu) lambda_N + G_NT lambda_R          + c_N
    xi_R     =  (G_TN - G_TT mu) lambda_N + G_TT lambda_R +  xi_L  + c_T
    lambda_L =               2 mu lambda_N -      lambda_R

each beside lambda_N, lambda_R, xi_L. Its answers have no more forces inside their cones than rows determine, but
Lemke's algorithm may end in a ray. Then, with lambda_T = f+ - f- and xi = |v_T'| (Stewart, Trinkle 1996),

    g''                =  G_NN lambda_N + G_NT (f+ - f-)      + c_N
     v_T' + xi         =  G_TN lambda_N + G_TT (f+ - f-) + xi + c_T
    -v_T' + xi         = -G_TN lambda_N - G_TT (f+ - f-) + xi - c_T
    mu lambda_N - |f|  =    mu lambda_N -       f+ - f-

each beside lambda_N, f+, f-, xi. That matrix is copositive: where everything may slip either way, as in an impact and
at rest, there is no ray.

What slips one way has g'' and lambda_N alone, with its friction -sigma mu lambda_N. In an impact the same with impulses
and changes of rates. Joints and what else sticks or slips stay as they are: it proposes modes, which the engine's own
solve then examines (`complementarity`).
"""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Pose, Problem, Rows, Rubs, Strikes
from ...tables.parts import Bodies, Contacts
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_apart, keep_small
from ..constraints.friction_rows import coefficient, friction_row, holding
from ..constraints.point_line import spare_row
from ..constraints.rows import contact_row
from ..dynamics.sliding import respond
from .lemke import lemke
from .trial import COUNT, excess, slip_change, try_modes

#: Unknowns of what may slip either way, in the first form and in the second.
CONES = 3
SPLIT = 4


@jit
def propose(block: Array, at: Pose, form: int) -> bool:
    """Set the modes of the candidates as the complementarity problem has them; whether a solution was found.

    `form` is `CONES` or `SPLIT`.
    """
    keep_apart()
    strike = Strikes(block)
    rub = Rubs(block)
    mode = Contacts(block).mode
    count = strike.problem[COUNT]
    for k in range(count):
        c = strike.candidates[k]
        mode[c] = codes.OPEN
        if rub.free[c] == codes.FREE:
            rub.slip[c] = codes.APART
    active = try_modes(block, at)
    _take_directions(block, at, count)
    for d in range(2 * count):
        respond(block, active, Problem(block).direction[d], Problem(block).response[d])
    unknowns = _write(block, count, form)
    if not lemke(Problem(block).tableau, Problem(block).basis, unknowns):
        return False
    _read(block, count, unknowns, form)
    return True


@jit
def _take_directions(block: Array, at: Pose, count: int) -> None:
    """Directions of the normal and of the slip of each candidate, and what they do without its forces."""
    keep_small()
    problem = Problem(block)
    spare = spare_row(block)
    for k in range(count):
        c = Strikes(block).candidates[k]
        contact_row(block, at, c, spare)
        problem.offset[2 * k] = excess(block, c)[0]
        _keep_direction(block, 2 * k, spare)
        problem.offset[2 * k + 1] = 0.0
        for i in range(Sizes(block).coordinates):
            problem.direction[2 * k + 1, i] = 0.0
        if coefficient(block, c) > 0.0:
            friction_row(block, at, c, spare)
            problem.offset[2 * k + 1] = slip_change(block, spare)[0]
            _keep_direction(block, 2 * k + 1, spare)


@jit
def _keep_direction(block: Array, place: int, row: int) -> None:
    for i in range(Sizes(block).coordinates):
        Problem(block).direction[place, i] = Rows(block).jacobian[row, i]


@jit
def _is_free(block: Array, contact: int) -> bool:
    """Whether its friction may stick, or slip either way."""
    free: bool = Rubs(block).free[contact] == codes.FREE and coefficient(block, contact) > 0.0
    return free


@jit
def _between(block: Array, a: int, b: int) -> float:
    """The acceleration along direction `a` by a unit force along direction `b`."""
    keep_apart()
    problem = Problem(block)
    root = Bodies(block).inverse_root_mass
    total = 0.0
    for i in range(Sizes(block).coordinates):
        total += problem.direction[a, i] * root[i] * problem.response[b, i]
    return total


@jit
def _write(block: Array, count: int, form: int) -> int:
    """Write the tableau, in units in which the largest acceleration of a normal by its own force is 1; its unknowns."""
    keep_apart()
    problem = Problem(block)
    rub = Rubs(block)
    unit = 0.0
    unknowns = 0
    for k in range(count):
        unit = max(unit, _between(block, 2 * k, 2 * k))
        problem.first[k] = unknowns
        unknowns += form if _is_free(block, Strikes(block).candidates[k]) else 1
    if not unit > 0.0:
        unit = 1.0
    if count > 0:  # there may be no contact at all, but pins that rub
        problem.unit[0] = unit
    table = problem.tableau
    for i in range(unknowns):
        for j in range(2 * unknowns + 2):
            table[i, j] = 0.0
        table[i, i] = 1.0
        table[i, 2 * unknowns] = -1.0
    for k in range(count):
        row = problem.first[k]
        c = Strikes(block).candidates[k]
        column = unknowns + row
        _write_row(block, count, unknowns, form, row, 2 * k, 1.0)
        if not _is_free(block, c):
            continue
        mu = holding(block, c)
        given = mu * rub.given[c] * unit
        _write_row(block, count, unknowns, form, row + 1, 2 * k + 1, 1.0)
        if form == CONES:
            table[row + 1, column + 2] = -1.0
            table[row + 2, column] = -2.0 * mu
            table[row + 2, column + 1] = 1.0
            table[row + 2, 2 * unknowns + 1] = 2.0 * given
        else:
            _write_row(block, count, unknowns, form, row + 2, 2 * k + 1, -1.0)
            table[row + 1, column + 3] = -1.0
            table[row + 2, column + 3] = -1.0
            table[row + 3, column] = -mu
            table[row + 3, column + 1] = 1.0
            table[row + 3, column + 2] = 1.0
            table[row + 3, 2 * unknowns + 1] = given
    return unknowns


@jit
def _write_row(block: Array, count: int, unknowns: int, form: int, row: int, direction: int, side: float) -> None:
    """Write `side` times the acceleration along a direction as row `row` of the tableau."""
    keep_apart()
    problem = Problem(block)
    table = problem.tableau
    unit = problem.unit[0]
    offset = problem.offset[direction]
    for m in range(count):
        other = Strikes(block).candidates[m]
        column = unknowns + problem.first[m]
        normal = _between(block, direction, 2 * m) / unit
        along = 0.0
        if coefficient(block, other) > 0.0:
            along = _between(block, direction, 2 * m + 1) / unit
        if not _is_free(block, other):
            normal -= float(Rubs(block).slip[other]) * coefficient(block, other) * along
        else:
            table[row, column + 1] = -side * along
            if form == CONES:
                normal -= holding(block, other) * along
                offset -= holding(block, other) * Rubs(block).given[other] * along * unit
            else:
                table[row, column + 2] = side * along
        table[row, column] = -side * normal
    table[row, 2 * unknowns + 1] = side * offset


@jit
def _read(block: Array, count: int, unknowns: int, form: int) -> None:
    """Set modes by which unknowns are in the basis."""
    keep_small()
    problem = Problem(block)
    rub = Rubs(block)
    for k in range(count):
        c = Strikes(block).candidates[k]
        row = problem.first[k]
        if _in_basis(block, unknowns, unknowns + row):
            Contacts(block).mode[c] = codes.CLOSED
        if not _is_free(block, c):
            continue
        right = _in_basis(block, unknowns, unknowns + row + 1)  # lambda_R, f+
        if form == CONES:
            left = _in_basis(block, unknowns, row + 2)  # lambda_L
        else:
            left = _in_basis(block, unknowns, unknowns + row + 2)  # f-
            if right == left or not _in_basis(block, unknowns, unknowns + row + 3):
                right = left = True
        rub.slip[c] = codes.STICKS
        if not (right and left):
            rub.slip[c] = codes.FORWARDS if left else codes.BACKWARDS


@jit
def _in_basis(block: Array, unknowns: int, variable: int) -> bool:
    keep_small()
    problem = Problem(block)
    for i in range(unknowns):
        if problem.basis[i] == variable:
            return bool(problem.tableau[i, 2 * unknowns + 1] > 0.0)
    return False

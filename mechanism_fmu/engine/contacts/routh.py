"""Stronge's law for one contact: Routh's path of the impulses, with the normal impulse as the clock.

While the contact slips with the sign sigma, dv_N/dP_N = G_NN - sigma mu G_NT and dv_T/dP_N = G_NT - sigma mu G_TT.
Where the slip ends it sticks if |G_NT| <= mu G_TT, and else slips on with the sign of G_NT. Compression ends at v_N = 0
with the work W_c < 0, the impact where the work since then is -e^2 W_c (Stronge, Impact Mechanics, 2000).
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, Loads, Pose, Rows, Rubs, Strikes
from ...tables.parts import Bodies, Contacts
from ...tables.sizes import Sizes
from .. import status
from ..compiler.subset import jit, keep_small
from ..constraints.entries import along_row
from ..constraints.friction_rows import coefficient, friction_row, holding
from ..constraints.point_line import spare_row
from ..constraints.rows import active_rows, contact_row, driver_power
from ..dynamics.acceleration import scale_rows
from ..dynamics.linear_solve import factorise
from ..dynamics.sliding import respond
from .participation import island_of

#: The path of one impact has at most two changes of slip, and the end of compression.
_PARTS = 6


@jit
def along_routh(block: Array, at: Pose) -> int:
    """Impulses of the one contact that strikes, by the work that it does; `status.NO_CHOICE`: it is not alone.

    A joint with friction, another contact that touches, or one that is struck from both sides is none of its business.
    """
    keep_small()
    contact = _alone(block)
    if contact == codes.NONE:
        return status.NO_CHOICE
    n = Sizes(block).coordinates
    strike = Strikes(block)
    y = Course(block).y_end
    rub = Rubs(block)
    mu = coefficient(block, contact)
    Contacts(block).mode[contact] = codes.OPEN
    count = active_rows(block, at)
    spare = spare_row(block)
    contact_row(block, at, contact, spare)
    v_n = Rows(block).residual_rate[spare]
    work = _respond(block, count, 0)
    g_nn = _along(block, 0)
    v_t, g_nt, g_tt, work_t = 0.0, 0.0, 0.0, 0.0
    if mu > 0.0:
        friction_row(block, at, contact, spare)
        v_t = Rows(block).residual_rate[spare]
        g_nt = _along(block, 0)
        work_t = _respond(block, count, 1)
        g_tt = _along(block, 1)
    restitution = strike.target[contact] / strike.closing[contact] - 1.0
    normal, tangential = _path(v_n, v_t, g_nn, g_nt, g_tt, mu, holding(block, contact), restitution)
    if not normal < math.inf:
        return status.NO_CHOICE
    for k in range(n):
        y[n + k] += normal * rub.solution[0, k]
        if mu > 0.0:
            y[n + k] += tangential * rub.solution[1, k]
    y[Sizes(block).y_work] += normal * work + tangential * work_t
    for c in range(strike.impulse.shape[0]):
        strike.impulse[c] = 0.0
    strike.impulse[contact] = normal
    Contacts(block).mode[contact] = codes.CLOSED
    return status.OK


@jit
def _alone(block: Array) -> int:
    """The one contact that strikes, where no other friction takes part in the event; else `codes.NONE`."""
    keep_small()
    table = Contacts(block)
    strike = Strikes(block)
    found = codes.NONE
    for c in range(table.mode.shape[0]):
        if table.mode[c] != codes.CLOSED or island_of(block, c) == codes.NONE:
            continue
        if not strike.closing[c] > 0.0 or found != codes.NONE or not strike.target[c] >= strike.closing[c]:
            return codes.NONE
        found = c
    for k in range(table.mode.shape[0], Sizes(block).rubs):
        if coefficient(block, k) > 0.0 and island_of(block, k) != codes.NONE:
            return codes.NONE
    return found


@jit
def _respond(block: Array, count: int, place: int) -> float:
    """Change of rates by a unit impulse along the spare row, to `rubs.solution[place]`; the work of drivers by it."""
    keep_small()
    n = Sizes(block).coordinates
    spare = spare_row(block)
    impulse = Loads(block).applied
    for k in range(n):
        impulse[k] = Rows(block).jacobian[spare, k]
    scale_rows(block, count)
    factorise(block, count, n)
    respond(block, count, impulse, Rubs(block).solution[place])
    for k in range(n):
        Rubs(block).solution[place, k] *= Bodies(block).inverse_root_mass[k]
    return driver_power(block)


@jit
def _along(block: Array, place: int) -> float:
    """Change of the spare row's rate by `rubs.solution[place]`."""
    return along_row(Rows(block), spare_row(block), Rubs(block).solution[place], Sizes(block).bodies, 0.0)


@jit
def _path(
    v_n: float, v_t: float, g_nn: float, g_nt: float, g_tt: float, mu: float, holds: float, restitution: float
) -> tuple[float, float]:
    """Normal and tangential impulse at the end of the path; infinite where it has none.

    `mu` is the coefficient while it slips, `holds` that while it sticks.
    """
    keep_small()
    normal = 0.0
    tangential = 0.0
    work = 0.0  # of the present phase
    target = math.inf  # in expansion, the work that it does
    for _ in range(_PARTS):
        sigma = 0.0
        if v_t > 0.0 or (v_t == 0.0 and g_nt > holds * g_tt):
            sigma = 1.0
        elif v_t < 0.0 or (v_t == 0.0 and -g_nt > holds * g_tt):
            sigma = -1.0
        ratio = -sigma * mu  # dP_T / dP_N
        if sigma == 0.0 and g_tt > 0.0:
            ratio = -g_nt / g_tt
        slope_n = g_nn + ratio * g_nt
        slope_t = g_nt + ratio * g_tt
        part = math.inf
        ends_slip = sigma * slope_t < 0.0
        if ends_slip:
            part = -v_t / slope_t
        compresses = target == math.inf
        ends_phase = False
        if compresses:
            # Where slip has ended at the same impulse, as with one degree of freedom, rounding may have left v_n > 0.
            if slope_n > 0.0 and max(0.0, -v_n) / slope_n <= part:
                part = max(0.0, -v_n) / slope_n
                ends_phase = True
        elif slope_n > 0.0:
            needed = (math.sqrt(max(0.0, v_n * v_n + 2.0 * slope_n * (target - work))) - v_n) / slope_n
            if needed <= part:
                part = needed
                ends_phase = True
        if not part < math.inf:
            return math.inf, 0.0
        work += part * (v_n + 0.5 * slope_n * part)
        normal += part
        tangential += ratio * part
        v_n += slope_n * part
        v_t += slope_t * part
        if (ends_slip and not ends_phase) or sigma == 0.0:
            v_t = 0.0
        if ends_phase and not compresses:
            return normal, tangential
        if ends_phase:
            v_n = 0.0
            target = -restitution * restitution * work
            work = 0.0
            if target == 0.0:
                return normal, tangential
    return math.inf, 0.0

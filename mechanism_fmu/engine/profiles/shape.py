"""The shape of a profile as a whole: distances along it, and whether it has hollows."""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, Pose, Rows
from ...tables.parts import Contacts, Curves
from ...tables.sizes import Sizes
from ...tolerances import MARGIN
from .. import status
from ..compiler.subset import jit, keep_small
from .curves import curve, piece_at, quarter_wave, sample

# A row that several joints share: the distance of two points along a vector fixed in a body.


@jit
def along(
    at: Pose,
    rows: Rows,
    row: int,
    i: int,
    j: int,
    si_x: float,
    si_y: float,
    sj_x: float,
    sj_y: float,
    axis_x: float,
    axis_y: float,
) -> None:
    """Write w.d, with w = A_i axis and d = r_j + b - r_i - a from point s_i of body i to point s_j of body j.

    With a = A_i s_i, b = A_j s_j, u = phi_i': Phi_q = [-w, (R w).d - w.R a, w, w.R b],
    Phi' = w.d' + u (R w).d, gamma = w.d u^2 - 2 u (R w).d' - w.(a u^2 - b phi_j'^2).
    """
    keep_small()
    ci, si, cj, sj = at.cosine[i], at.sine[i], at.cosine[j], at.sine[j]
    ax, ay = ci * si_x - si * si_y, si * si_x + ci * si_y
    bx, by = cj * sj_x - sj * sj_y, sj * sj_x + cj * sj_y
    wx, wy = ci * axis_x - si * axis_y, si * axis_x + ci * axis_y
    ui, uj = at.phi_rate[i], at.phi_rate[j]
    dx = at.x[j] + bx - at.x[i] - ax
    dy = at.y[j] + by - at.y[i] - ay
    dx_rate = at.x_rate[j] - by * uj - at.x_rate[i] + ay * ui
    dy_rate = at.y_rate[j] + bx * uj - at.y_rate[i] - ax * ui
    distance = wx * dx + wy * dy
    across = wx * dy - wy * dx
    rows.residual[row] = distance
    rows.residual_rate[row] = wx * dx_rate + wy * dy_rate + across * ui
    rows.gamma[row] = (
        distance * ui * ui
        - 2.0 * (wx * dy_rate - wy * dx_rate) * ui
        - (wx * ax + wy * ay) * ui * ui
        + (wx * bx + wy * by) * uj * uj
    )
    line = rows.jacobian[row]
    line[3 * i] = -wx
    line[3 * i + 1] = -wy
    line[3 * i + 2] = across - (wy * ax - wx * ay)
    line[3 * j] = wx
    line[3 * j + 1] = wy
    line[3 * j + 2] = wy * bx - wx * by


# What profiles are like, looked at once before the motion begins: their parameters may have changed.

_SAMPLES = 720
#: A profile that bends less than this part of a circle of its radius counts as one with a hollow.
_STRAIGHT = 1e-9
#: Narrower pieces are none: a move without width.
_NARROWEST = 1e-9


@jit
def examine_profiles(block: Array) -> int:
    """Note of every pair whether it has hollows, and how far contact coordinates may go in a step; return a status.

    When a profile reaches its centre, PENDING_SUBJECT holds the contact.
    """
    keep_small()
    table = Contacts(block)
    for k in range(table.alpha_haste.shape[0]):
        table.alpha_haste[k] = 0.0
    for c in range(table.kind.shape[0]):
        table.hollow[c] = codes.CONVEX
        if table.alpha[c] == codes.NONE or table.value[c, codes.ENABLED] < 0.5:
            continue
        least_i = least_j = math.inf
        alpha = table.alpha[c]
        if table.curve_i[c] != codes.NONE:
            rho, least_i = _least(block, table.curve_i[c])
            table.alpha_haste[alpha] = 1.0 / _shortest(block, table.curve_i[c])
            alpha += 1
        else:
            rho = math.inf
        if table.curve_j[c] != codes.NONE:
            rho_j, least_j = _least(block, table.curve_j[c])
            rho = min(rho, rho_j)
            table.alpha_haste[alpha] = 1.0 / _shortest(block, table.curve_j[c])
        if not rho > 0.0:
            Course(block).counters[codes.PENDING_SUBJECT] = c
            return status.AT_CENTRE
        if not min(least_i, least_j) > _STRAIGHT / rho:
            table.hollow[c] = codes.HOLLOW
            total = least_i + least_j if table.kind[c] == codes.CAM_FOLLOWER else least_i
            if not total > 0.0:
                table.hollow[c] = codes.BRIDGES
    return status.OK


@jit
def passes_join(block: Array, before: Array, after: Array) -> bool:
    """Whether a closed pair comes from one piece of a profile to another between two states y, or within MARGIN."""
    keep_small()
    table = Contacts(block)
    for c in range(table.kind.shape[0]):
        if table.alpha[c] == codes.NONE or table.mode[c] != codes.CLOSED:
            continue
        k = Sizes(block).y_alpha + table.alpha[c]
        for number in (table.curve_i[c], table.curve_j[c]):
            if number == codes.NONE:
                continue
            low = min(before[k], after[k]) - MARGIN
            if _turned_piece(block, number, low) != _turned_piece(block, number, max(before[k], after[k]) + MARGIN):
                return True
            k += 1
    return False


@jit
def _turned_piece(block: Array, number: int, x: float) -> int:
    """The piece of a profile at x, in whichever turn."""
    keep_small()
    if Curves(block).periodic[number] == 1:
        start, span = Curves(block).range[number, 0], Curves(block).range[number, 1]
        x -= math.floor((x - start) / span) * span
    return piece_at(block, number, x)


@jit
def _least(block: Array, number: int) -> tuple[float, float]:
    """The least radius [m] and the least curvature [1/m] of a profile; the latter is below zero in a hollow."""
    keep_small()
    least = least_rho = math.inf
    for k in range(_SAMPLES):
        rho, rate, bend, _ = curve(block, number, sample(block, number, k, _SAMPLES))
        square = rho * rho + rate * rate
        least_rho = min(least_rho, rho)
        least = min(least, (square + rate * rate - rho * bend) / (square * math.sqrt(square)))
    return least_rho, least


@jit
def _shortest(block: Array, number: int) -> float:
    """How far one may go along a curve without passing over something: a piece, or a quarter of a wave."""
    keep_small()
    table = Curves(block)
    first = table.piece[number]
    after = first + table.pieces[number]
    shortest = math.inf
    for p in range(first, after):
        if p + 1 < after:
            width = table.piece_start[p + 1] - table.piece_start[p]
            if width > _NARROWEST:
                shortest = min(shortest, width)
        shortest = min(shortest, quarter_wave(block, p))
    return shortest

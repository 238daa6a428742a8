"""What profiles are like, looked at once before the motion begins: their parameters may have changed."""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course
from ...tables.parts import Contacts, Curves
from .. import status
from ..compiler.subset import jit, keep_small
from .curves import curve, quarter_wave, sample

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
        least_i = math.inf
        least_j = math.inf
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
            total = least_i
            if table.kind[c] == codes.CAM_FOLLOWER:
                total = least_i + least_j
            if not total > 0.0:
                table.hollow[c] = codes.BRIDGES
    return status.OK


@jit
def _least(block: Array, number: int) -> tuple[float, float]:
    """The least radius [m] and the least curvature [1/m] of a profile; the latter is below zero in a hollow."""
    keep_small()
    least = math.inf
    least_rho = math.inf
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

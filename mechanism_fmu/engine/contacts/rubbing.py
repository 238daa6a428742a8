"""Which contacts and joints may stick or slip either way at an instant, and what is known of the others."""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, Pose, Rows, Rubs
from ...tables.sizes import Sizes
from ...tolerances import PILED, SLIPS_ABOVE, SLIPS_WHERE_PILED, STUCK_BELOW
from ..compiler.subset import jit, keep_small
from ..constraints.friction_rows import coefficient, friction_row, sticks, touches
from ..constraints.kinematics import place_bodies
from ..constraints.point_line import spare_row


@jit
def part_all(block: Array) -> None:
    """Nothing touches with friction yet."""
    keep_small()
    table = Rubs(block)
    for k in range(table.slip.shape[0]):
        table.slip[k] = codes.APART
        table.anchor[k] = 0.0
        table.given[k] = 0.0


@jit
def look_at_slip(block: Array, at: Pose, only_touching: bool, stopped: int) -> None:
    """At rest friction is free to stick, or to slip either way; in motion its direction is known.

    At rest is what slips no faster than `SLIPS_ABOVE`, or, where it sticks, than its row may drift; and `stopped`,
    whose slip has just been found to end, whatever speed the instant's rounding leaves. It is taken to stick, unless it
    has just let go: then its row may have drifted, too, and the sign of that speed says nothing of where it will slip.
    Where it has not stuck before, it does so here. All that has friction is looked at where not `only_touching`.
    """
    keep_small()
    table = Rubs(block)
    spare = spare_row(block)
    slips_above = SLIPS_ABOVE
    if Course(block).counters[codes.PILE] >= PILED:
        slips_above = SLIPS_WHERE_PILED
    for k in range(table.slip.shape[0]):
        let_go = table.free[k] == codes.LET_GO
        table.free[k] = codes.BOUND
        if not (touches(block, k) or (coefficient(block, k) > 0.0 and not only_touching)):
            continue
        begins = table.slip[k] != codes.STICKS
        if begins:
            table.anchor[k] = 0.0
        friction_row(block, at, k, spare)
        if begins:  # also where it slips: an impact may end that
            table.anchor[k] = Rows(block).residual[spare]
        speed = Rows(block).residual_rate[spare]
        drifts = not begins or let_go
        if abs(speed) > (max(slips_above, STUCK_BELOW) if drifts else slips_above) and k != stopped:
            table.slip[k] = codes.FORWARDS if speed > 0.0 else codes.BACKWARDS
            continue
        table.free[k] = codes.LET_GO if let_go else codes.FREE
        if not let_go:
            table.slip[k] = codes.STICKS


@jit
def free_all(block: Array) -> None:
    """In an impact all friction may end in stick or slip.

    A brake, whose torque is bounded, has no impulse.
    """
    keep_small()
    table = Rubs(block)
    at = place_bodies(block, Course(block).y_end)
    look_at_slip(block, at, False, codes.NONE)
    for k in range(table.slip.shape[0]):
        if k >= Sizes(block).contacts + Sizes(block).joints:
            table.free[k] = codes.BOUND
            table.slip[k] = codes.APART
        elif coefficient(block, k) > 0.0:
            table.free[k] = codes.FREE


@jit
def note_sticks(block: Array) -> None:
    """Note what sticks."""
    keep_small()
    table = Rubs(block)
    for k in range(table.slip.shape[0]):
        table.stuck[k] = 1 if sticks(block, k) else 0


@jit
def set_noted(block: Array, slip: int) -> None:
    """What stuck when it was noted has this mode for now, `codes.APART` or `codes.STICKS`."""
    keep_small()
    table = Rubs(block)
    for k in range(table.slip.shape[0]):
        if table.stuck[k] == 1:
            table.slip[k] = slip


@jit
def part(block: Array) -> None:
    """The instant is over: what does not touch any more does not stick there, and what has let go may stick again."""
    keep_small()
    table = Rubs(block)
    for k in range(table.slip.shape[0]):
        table.free[k] = codes.BOUND
        if not touches(block, k):
            table.slip[k] = codes.APART


@jit
def let_slip(block: Array, rub: int) -> None:
    """Friction of what sticks has reached its bound: it slips to where it is pushed."""
    keep_small()
    table = Rubs(block)
    table.slip[rub] = codes.BACKWARDS if table.force[rub] > 0.0 else codes.FORWARDS
    table.free[rub] = codes.LET_GO

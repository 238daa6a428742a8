"""Impulses of one round of impacts, by Newton's, Poisson's or Stronge's law (docs/explanation/friction.md).

Newton: every contact that approaches separates with e times its closing speed; with friction in one complementarity
problem (Moreau, Glocker), which may have no answer, or add energy: then Poisson's law holds. Poisson: compression is
the same with e = 0, and in the expansion each contact gives back at least e times the impulse of its compression, with
a friction of its own. Stronge: the work of a contact in expansion is e^2 times that of its compression, along Routh's
path of the impulses.
"""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, LinearSystem, Pose, Rows, Rubs, Strikes
from ...tables.parts import Bodies, Contacts, Options
from ...tables.sizes import Sizes
from .. import status
from ..compiler.subset import jit, keep_small
from ..constraints.friction_rows import rubs
from ..constraints.kinematics import place_bodies
from ..constraints.point_line import spare_row
from ..constraints.rows import contact_row, driver_power
from ..vectors import largest
from .complementarity import push_impulses
from .participation import participants_energy
from .routh import along_routh
from .rubbing import free_all
from .trial import ABSENT, COUNT, SHOCK

#: An impact may seem to add this share of the kinetic energy, by rounding.
_ROUNDING = 1e-13


@jit
def exchange(block: Array, at: Pose) -> int:
    """Give the contacts that `strikes` names their impulses, and y_end the rates behind them; return a status."""
    keep_small()
    strike = Strikes(block)
    mode = Contacts(block).mode
    n = Sizes(block).coordinates
    rate = Course(block).y_end[n:]
    for k in range(n):
        strike.rates_of_round[k] = rate[k]
    if not rubs(block):
        outcome = push_impulses(block, at)
        if outcome == status.OK:
            _apply(block)
        return outcome
    settings = Options(block).settings
    for c in range(mode.shape[0]):
        strike.closed[c] = mode[c]
    law = settings[codes.IMPACT_LAW]
    if law == codes.POISSON:
        return _poisson(block, at)
    if law == codes.STRONGE:
        outcome = along_routh(block, at)
        if outcome != status.NO_CHOICE:
            return outcome
        return _by_poisson(block)
    energy = participants_energy(block)
    work = Course(block).y_end[Sizes(block).y_work]
    free_all(block)
    if push_impulses(block, at) != status.OK:  # with e > 0 it may have no answer; Poisson's always has one
        return _by_poisson(block)
    _apply(block)
    gain = participants_energy(block) - energy
    gain -= Course(block).y_end[Sizes(block).y_work] - work
    if settings[codes.ENERGY_GUARD] > 0.5 and gain > _ROUNDING * energy:
        Course(block).y_end[Sizes(block).y_work] = work
        return _by_poisson(block)
    return status.OK


@jit
def shock(block: Array, at: Pose) -> int:
    """An impact of the candidates without approach, that ends slip with which no finite forces agree; return a status.

    The same law with e = 0. Zero is a solution, too, from which no motion follows; it is not taken.
    """
    keep_small()
    strike = Strikes(block)
    table = Contacts(block)
    rub = Rubs(block)
    for c in range(table.mode.shape[0]):
        strike.closing[c] = 0.0
        strike.target[c] = 0.0
    for k in range(strike.problem[COUNT]):
        c = strike.candidates[k]
        contact_row(block, at, c, spare_row(block))
        strike.target[c] = -Rows(block).residual_rate[spare_row(block)]
        table.mode[c] = codes.CLOSED
    free_all(block)
    for k in range(rub.slip.shape[0]):
        if rub.free[k] == codes.FREE:
            rub.slip[k] = codes.STICKS
    strike.problem[SHOCK] = 1
    outcome = push_impulses(block, at)
    strike.problem[SHOCK] = 0
    if outcome != status.OK:
        return outcome
    _apply(block)
    change = largest(LinearSystem(block).solution, Sizes(block).coordinates)
    return status.OK if change > 0.0 else status.NO_CHOICE


@jit
def _by_poisson(block: Array) -> int:
    """Begin the round anew, by Poisson's law in place of another."""
    keep_small()
    n = Sizes(block).coordinates
    y = Course(block).y_end
    strike = Strikes(block)
    for k in range(n):
        y[n + k] = strike.rates_of_round[k]
    for c in range(strike.closed.shape[0]):
        Contacts(block).mode[c] = strike.closed[c]
    Course(block).counters[codes.COUNT_BY_POISSON] += 1
    return _poisson(block, place_bodies(block, y))


@jit
def _apply(block: Array) -> None:
    """Change the rates at y_end by the impulses of the last problem, which become `strikes.impulse`."""
    keep_small()
    n = Sizes(block).coordinates
    y = Course(block).y_end
    table = Contacts(block)
    strike = Strikes(block)
    for k in range(n):
        y[n + k] += Bodies(block).inverse_root_mass[k] * LinearSystem(block).solution[k]
    for c in range(table.mode.shape[0]):
        strike.impulse[c] = 0.0
        if table.mode[c] == codes.CLOSED:
            strike.impulse[c] = LinearSystem(block).multiplier[table.row[c]]
    y[Sizes(block).y_work] += driver_power(block)  # of impulses: drivers do work at once


@jit
def _poisson(block: Array, at: Pose) -> int:
    """Compression, and expansion with at least e times its impulses."""
    keep_small()
    table = Contacts(block)
    strike = Strikes(block)
    rub = Rubs(block)
    contacts = table.mode.shape[0]
    for c in range(contacts):
        strike.restitution[c] = 0.0
        if strike.closing[c] > 0.0:
            strike.restitution[c] = max(0.0, strike.target[c] / strike.closing[c] - 1.0)
            strike.target[c] = min(strike.target[c], strike.closing[c])
    free_all(block)
    outcome = push_impulses(block, at)
    if outcome != status.OK:
        return outcome
    _apply(block)
    gives = False
    for c in range(contacts):
        strike.compression[c] = strike.impulse[c]
        rub.given[c] = max(0.0, strike.restitution[c] * strike.impulse[c])
        gives = gives or rub.given[c] > 0.0
    if not gives:
        return status.OK
    at = place_bodies(block, Course(block).y_end)
    for c in range(contacts):
        if strike.role[c] != ABSENT:  # those that are open, too
            contact_row(block, at, c, spare_row(block))
            strike.target[c] = -Rows(block).residual_rate[spare_row(block)]
    free_all(block)
    outcome = push_impulses(block, at)
    if outcome == status.OK:
        _apply(block)
        for c in range(contacts):
            strike.impulse[c] += strike.compression[c] + rub.given[c]
    for c in range(contacts):
        rub.given[c] = 0.0
    return outcome

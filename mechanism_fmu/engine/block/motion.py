"""Views of an instance's block: how far the motion has come, the instant that is looked at, and scratch."""

from __future__ import annotations

from typing import NamedTuple

from .layout import Array
from .room import room


class Course(NamedTuple):
    """How far the motion has come.

    Clock, counters and ledger (columns in `codes`); y = (q, qd, work, loss, alpha, own) and its derivative at the end
    of the engine's own step, and the step's dense output; how independent the active rows are there (see `singular`);
    the last impact, and impacts and events of the last communication step.
    """

    clock: Array
    counters: Array
    ledger: Array
    y_end: Array
    dy_end: Array
    dense: Array
    independence_end: Array
    last_impact: Array
    impacts: Array
    events: Array


course = room(Course)


class Pose(NamedTuple):
    """Positions and rates of all bodies at the instant that is looked at; the last entry is the ground.

    `alpha` are the contact coordinates and `alpha_rate` what goes with the rates of the bodies; `instant` is the time
    [s], on which drivers depend.
    """

    x: Array
    y: Array
    phi: Array
    cosine: Array
    sine: Array
    x_rate: Array
    y_rate: Array
    phi_rate: Array
    alpha: Array
    alpha_rate: Array
    instant: Array


pose = room(Pose)


class Rows(NamedTuple):
    """The constraint rows at the instant that is looked at: Phi, Phi', gamma (with Baumgarte's terms), nu, Phi_q.

    The entries of `nu` count for drivers only. Columns of contact coordinates, behind those of the ground, are written
    only where these count as coordinates (see `textbook`).
    """

    residual: Array
    residual_rate: Array
    gamma: Array
    nu: Array
    jacobian: Array


rows = room(Rows)


class LinearSystem(NamedTuple):
    """The minimum-norm problem D z = b, with D^T multiplier = z, and the scratch of its solution.

    `rank` is that of D, and `independence` says how far its least independent row is from depending on the others: the
    share of its squared length that is left after projection.
    """

    scaled: Array
    right_side: Array
    solution: Array
    multiplier: Array
    basis: Array
    triangle: Array
    column_basis: Array
    column_triangle: Array
    order: Array
    row_norm: Array
    coefficient: Array
    dual: Array
    rank: Array
    independence: Array


linear_system = room(LinearSystem)


class Loads(NamedTuple):
    """Generalised forces [N, N m].

    `force` acts; `applied` is its part without friction; `torque` is that of each force element on its body, `rubbing`
    that of the friction in each joint (a force in sliders); the accelerations that the forces alone would give;
    assembly weights; the multipliers of the last round of the friction iteration.
    """

    force: Array
    applied: Array
    torque: Array
    rubbing: Array
    last_multiplier: Array
    free_acceleration: Array
    weight: Array


loads = room(Loads)


class Stages(NamedTuple):
    """Scratch of one Runge-Kutta step.

    `tried`: start and size of the one last tried [s]; `independence` of the rows at each of its stages, of which
    `stage` is the one computed last; `stiffest` is the unknown that limited the steps, once that was asked.
    """

    derivatives: Array
    tried: Array
    y_start: Array
    y_stage: Array
    y_new: Array
    y_at: Array
    dy_at: Array
    new_dense: Array
    stage: Array
    independence: Array
    stiffest: Array


stages = room(Stages, "stage_")


class Strikes(NamedTuple):
    """Scratch of an impact.

    What each contact is in it (`impact.ABSENT` ...), by how much its gap rate must rise at least (v of eq (6)), its
    closing speed and impulse; the contacts that a complementarity problem decides about, and which problem it is
    (columns in `complementarity`); all rates before the impact; the line along which a point slides.
    """

    role: Array
    target: Array
    closing: Array
    impulse: Array
    candidates: Array
    problem: Array
    rates_before: Array
    tangent_line: Array


strikes = room(Strikes, "contact_")


class Watch(NamedTuple):
    """Scratch of the search for events.

    Which guards are looked at, whether each is armed and what it must come down to; its rate at the last look; value
    and rate at the next.
    """

    watched: Array
    armed: Array
    floor: Array
    rate: Array
    next: Array


watch = room(Watch, "guard_")

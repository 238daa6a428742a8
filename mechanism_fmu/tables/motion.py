"""Tables of the motion: time reached, state, the instant that is looked at, and scratch."""

from __future__ import annotations

import math

from .. import codes
from .declare import ANY, COUNT, FINITE, FLAG, MOST, NOT_NEGATIVE, WHOLE, Table, index_of, integer, real, whole
from .implicit_method import RODAS5P
from .method import METHOD

#: Subject of a guard: a contact, pattern or logical function, or the status of a failure; the guard says which.
_SUBJECT = whole(codes.NONE, int(MOST))

#: So many points of the motion lead through a singular configuration.
BEHIND = 4

#: Columns of the clock and of the counters, in the order of `codes`.
_CLOCK = {
    "TIME": FINITE,
    "STEP_START": FINITE,
    "STEP_END": FINITE,
    "STEP_SIZE": NOT_NEGATIVE,
    "NEXT_STEP": NOT_NEGATIVE._replace(high=math.inf, nan=True),
    "RAMP_START": FINITE,
    "RAMP_END": FINITE,
    "STEP_BEGUN": FINITE,
    "PASSED_AT": FINITE,
    "COMPLETED": FINITE,
}
_COUNTERS = {
    "COUNT_IMPACTS": COUNT,
    "COUNT_IN_STEP": whole(0, 0, "buffer"),
    "COUNT_LOST": COUNT,
    "COUNT_STEPS": COUNT,
    "PENDING_GUARD": whole(codes.GUARD_NONE, codes.GUARD_HANDOVER),
    "PENDING_SUBJECT": _SUBJECT,
    "COUNT_PULLS": WHOLE,
    "COUNT_EVENTS": COUNT,
    "EVENTS_IN_STEP": whole(0, 0, "event_buffer"),
    "PILE": COUNT,
    "RAMPING": FLAG,
    "RANK": whole(0, 0, "rows"),
    "FALLING": FLAG,
    "COUNT_INSTANTS": COUNT,
    "STEPS_IN_STEP": COUNT,
    "COUNT_REJECTED": COUNT,
    "COUNT_TRIES": COUNT,
    "COUNT_BY_POISSON": COUNT,
    "RUBBING": whole(0, 1, "rubs"),
    "SENSE": FLAG,
    "IMPLICIT": whole(0, 0, "may_be_implicit"),
    "STIFF": COUNT,
    "COUNT_IMPLICIT": COUNT,
    "COUNT_BACK": COUNT,
    "COUNT_PASSED": COUNT,
    "IMPLICIT_STEP": whole(0, 0, "may_be_implicit"),
    "FIRST_IMPACT": whole(0, -1, "buffer"),
    "FIRST_EVENT": whole(0, -1, "event_buffer"),
    "UNDETERMINED": whole(0, 0, "rubs"),
    "SEVERAL": whole(0, 0, "rubs"),
}
#: Columns of an impact record and of an event record, the last one for all behind it.
_RECORD = {
    "RECORD_TIME": FINITE,
    "RECORD_CONTACT": index_of("contacts"),
    "RECORD_TOOTH": WHOLE,
    "RECORD_CLOSING_SPEED": FINITE,
    "RECORD_IMPULSE": FINITE,
    "RECORD_VELOCITY": FINITE,
    "RECORD_INSTANT": COUNT,
    "RECORD_ENERGY": FINITE,
    "RECORD_CONTACT_IMPULSES": FINITE,
}
_EVENT = {
    "EVENT_TIME": FINITE,
    "EVENT_GUARD": whole(codes.GUARD_NONE, codes.GUARD_HANDOVER),
    "EVENT_SUBJECT": _SUBJECT,
    "EVENT_IMPULSE": FINITE,
    "EVENT_OLD_MODE": COUNT,
    "EVENT_NEW_MODE": COUNT,
}


class Course(Table):
    """How far the motion has come.

    Clock, counters, ledger, scales, and those of each body (columns in `codes`); when its run of events without
    progress began, and how many there were; y = (q, qd, work, loss, alpha, own) and its derivative at the end of the
    engine's own step, and the step's dense output; how independent the active rows are there (see `singular`); the last
    impact, and impacts and events of the last communication step, in buffers that go round.
    """

    clock = real(codes.CLOCK_LENGTH, holds=_CLOCK)
    counters = integer(codes.COUNTERS_LENGTH, holds=_COUNTERS)
    ledger = real(codes.LEDGER_LENGTH, holds=FINITE)
    scales = real(codes.SCALES, holds=NOT_NEGATIVE)
    accumulation = real("bodies", 2, holds=FINITE)
    body_scales = real("bodies", codes.BODY_SCALES, holds=NOT_NEGATIVE)
    y_end = real("unknowns", holds=FINITE)
    dy_end = real("unknowns", holds=ANY)
    dense = real(METHOD.dense_rows, "unknowns", holds=FINITE)
    independence_end = real(1, holds=ANY)
    last_impact = real("record", holds=_RECORD)
    impacts = real("buffer", "record", holds=_RECORD)
    events = real("event_buffer", "event", holds=_EVENT)


class Pose(Table):
    """Positions and rates of all bodies at the instant that is looked at; the last entry is the ground.

    `alpha` are the contact coordinates and `alpha_rate` what goes with the rates of the bodies; `instant` is the time
    [s], on which drivers depend.
    """

    x = real("frames", work=True)
    y = real("frames", work=True)
    phi = real("frames", work=True)
    cosine = real("frames", work=True)
    sine = real("frames", work=True)
    x_rate = real("frames", work=True)
    y_rate = real("frames", work=True)
    phi_rate = real("frames", work=True)
    alpha = real("alphas", work=True)
    alpha_rate = real("alphas", work=True)
    instant = real(1, work=True)


class Rows(Table):
    """The constraint rows at the instant that is looked at: Phi, Phi', gamma (with Baumgarte's terms), nu, Phi_q.

    `body` are the two bodies of which a row has entries. The entries of `nu` count for drivers only. Columns of contact
    coordinates, behind those of the ground, are written only where these count as coordinates (see `textbook`).
    """

    residual = real("rows", work=True)
    residual_rate = real("rows", work=True)
    gamma = real("rows", work=True)
    nu = real("rows", work=True)
    jacobian = real("rows", "wide", work=True)
    body = integer("rows", 2, name="row_body", work=True)


class LinearSystem(Table):
    """The minimum-norm problem D z = b, with D^T multiplier = z, and the scratch of its solution.

    `level` is the rounding of the multipliers (`engine.dynamics.rounding`).

    `rank` is that of D, and `independence` says how far its least independent row is from depending on the others: the
    share of its squared length that is left after projection. What has less than `least_independence` counts as
    dependent; 0 for what is so but for rounding. A row of `scaled` has three entries of each of the
    bodies in `scaled_body`.

    `kept` is 1 where the next factorisation is to be kept, 2 once it stands: while nothing but forces changes.

    The sparse solution has an order of the rows, `place`, made for the first `planned` rows with bodies `plan_body`;
    `fill` are the earlier places with which a row has entries, `fill_count` many from `fill_start` on, and `lower`
    these entries: what is behind the last one is never touched, and costs no memory.

    The dense one, `by_pivots`, has a basis of orthonormal rows, of which `singleton` says in which column their only
    entry is, if there is one only. It goes island by island: the rows of one are `island_row` in `island_range`, and
    `island_spot` says where there a row is; its basis rows are the first `island_rank` of `order` there, of which those
    before `island_singletons` have one entry only; its bodies have the columns `island_column`, `island_width` in all.
    """

    scaled = real("rows", 6, work=True)
    scaled_body = integer("rows", 2, work=True)
    planned = integer(1, work=True)
    plan_body = integer("rows", 2, work=True)
    place = integer("rows", work=True)
    parent = integer("rows", work=True)
    seen = integer("rows", work=True)
    chain = integer("rows", 2, work=True)
    last_of_body = integer("frames", work=True)
    fill = integer("squared_rows", work=True)
    fill_start = integer("rows", work=True)
    fill_count = integer("rows", work=True)
    lower = real("squared_rows", work=True)
    pivot = real("rows", work=True)
    spread = real("rows", work=True)
    by_pivots = integer(1, work=True)
    kept = integer(1, name="factors_kept", work=True)
    right_side = real("rows", work=True)
    solution = real("columns", work=True)
    multiplier = real("rows", work=True)
    basis = real("rows", "columns", work=True)
    triangle = real("rows", "rows", work=True)
    column_basis = real("rows", "rows", work=True)
    column_triangle = real("rows", "rows", work=True)
    order = integer("rows", work=True)
    singleton = integer("rows", work=True)
    islands = integer(1, work=True)
    island_range = integer("rows", 2, work=True)
    island_width = integer("rows", work=True)
    island_rank = integer("rows", work=True)
    island_singletons = integer("rows", work=True)
    island_row = integer("rows", work=True)
    island_spot = integer("rows", work=True)
    island_column = integer("frames", work=True)
    island_of = integer("frames", work=True)
    island_solution = real("columns", work=True)
    leader = integer("frames", work=True)
    gathered = real("rows", work=True)
    row_norm = real("rows", 3, work=True)
    coefficient = real("rows", work=True)
    dual = real("rows", work=True)
    level = real(1, work=True)
    rank = integer(1, work=True)
    independence = real(1, work=True)
    least_independence = real(1, work=True)


class Loads(Table):
    """Generalised forces [N, N m].

    `force` acts, and `size` is the sum of its terms' magnitudes; `applied` is its part without friction; `torque` is
    that of each force element on its body, `rubbing` that of the friction in each joint (a force in sliders); the
    accelerations that the forces alone would give; assembly weights; the multipliers of the last round of the friction
    iteration; rate and length of each body at an event, or of those that it is joined to, in scale (see `scaling`).
    """

    force = real("columns", work=True)
    size = real("columns", work=True)
    applied = real("columns", work=True)
    torque = real("forces", work=True)
    rubbing = real("joints", work=True)
    last_multiplier = real("rows", work=True)
    free_acceleration = real("columns", work=True)
    weight = real("columns", work=True)
    body_rate = real("bodies", work=True)
    body_length = real("bodies", work=True)


class Stages(Table, prefix="stage_"):
    """Scratch of one Runge-Kutta step.

    `tried`: start and size of the one last tried [s]; the `scale` of each unknown; `drift`: the most that an active row
    is off at its end, and a rate, in scale, and as they are; `independence` of the rows at each of its stages, of which
    `stage` is the one computed last; `looks_stiff` says how stiff an explicit one found the motion; `jams` is 1 where
    forces and friction did not agree at a stage; `stiffest` is the unknown that limited the steps, once that was asked;
    `behind` are points of the motion before y_start, with their derivatives (see `passing`).
    """

    derivatives = real(METHOD.stages, "unknowns", name="derivatives", work=True)
    tried = real(2, name="tried", work=True)
    scale = real("unknowns", work=True)
    drift = real(4, work=True)
    y_start = real("unknowns", name="y_start", work=True)
    y_stage = real("unknowns", name="y_stage", work=True)
    y_new = real("unknowns", name="y_new", work=True)
    y_at = real("unknowns", name="y_at", work=True)
    dy_at = real("unknowns", name="dy_at", work=True)
    new_dense = real(METHOD.dense_rows, "unknowns", name="new_dense", work=True)
    stage = integer(1, name="stage", work=True)
    independence = real(METHOD.stages, work=True)
    looks_stiff = real(1, work=True)
    jams = integer(1, work=True)
    behind = real(BEHIND, "unknowns", name="behind", work=True)
    behind_rates = real(BEHIND, "unknowns", name="behind_rates", work=True)
    stiffest = integer(1, work=True)


class Implicit(Table, prefix="implicit_"):
    """Scratch of a linearly implicit step; none in mechanisms that are too large for it.

    The Jacobian of the derivative at y_start and the change of that with time, and whether they are of this y_start;
    L and U of the linear system, and its pivots; the increments of the stages; a right side, and one without q; the
    powers of all forces together, without their signs, at the end of the step [W].
    """

    jacobian = real("implicit", "implicit", work=True)
    by_time = real("implicit", work=True)
    fresh = integer(1, work=True)
    matrix = real("implicit_rates", "implicit_rates", work=True)
    pivot = integer("implicit_rates", work=True)
    increment = real(RODAS5P.stages, "implicit", work=True)
    right = real("implicit", work=True)
    rest = real("implicit_rates", work=True)
    turnover = real(1, name="implicit_turnover", work=True)


class Strikes(Table, rows="contacts", prefix="contact_"):
    """Scratch of an impact.

    What each contact is in it (`impact.ABSENT` ...), by how much its gap rate must rise at least (v of eq (6)), its
    closing speed and impulse; the contacts that a complementarity problem decides about, and which problem it is
    (columns in `complementarity`); all rates before the impact, and before its present round; whether each contact is
    closed for that; its coefficient of restitution and impulse of compression; the line along which a point slides; its
    mode before the event, and before what happens within it. Of each body the island in which it takes part in the
    event (see `contacts.participation`); of each island one more than the last round in which a contact approached, or
    0.
    """

    role = integer(work=True)
    target = real(work=True)
    closing = real(work=True)
    impulse = real(work=True)
    candidates = integer(name="candidates", work=True)
    problem = integer(4, alone=True, name="problem", work=True)
    rates_before = real("coordinates", alone=True, name="rates_before", work=True)
    rates_of_round = real("coordinates", alone=True, name="rates_of_round", work=True)
    closed = integer(work=True)
    restitution = real(work=True)
    compression = real(work=True)
    tangent_line = real(4, alone=True, name="tangent_line", work=True)
    earlier = integer(2, work=True)
    island = integer("frames", alone=True, name="event_island", work=True)
    approached = integer("frames", alone=True, name="event_approached", work=True)


class Watch(Table, rows="guards", prefix="guard_"):
    """Scratch of the search for events.

    Which guards are looked at, whether each is armed and what it must come down to; its rate at the last look; value
    and rate at the next; of the distance of two outlines, up to which part of the step it has been looked at, and a
    bound of how fast it changes [m per step].
    """

    watched = integer(work=True)
    armed = integer(work=True)
    floor = real(work=True)
    rate = real(work=True)
    next = real(2, work=True)
    reached = real(work=True)
    most = real(work=True)


class Exchange(Table, rows="guards", prefix="exchange_"):
    """Model Exchange: what the events of an importer's own integrator need (see `engine.exchange`).

    State: whether an open contact is still leaving, so that its rate is looked at and not its gap; by how much each
    indicator is lifted; gap and gap rate of each contact, unknowns and their derivatives at COMPLETED.

    Scratch: the indicators, the last of which is of the turns of bodies; how far the next piece of a driver's motion
    is [s]; 1 where a completed step is to be followed by event mode; 1 while derivatives are an importer's.
    """

    leaves = integer("contacts", alone=True, name="exchange_leaves", holds=FLAG)
    lift = real(holds=NOT_NEGATIVE)
    seen = real("contacts", 2, alone=True, name="exchange_seen", holds=FINITE)
    seen_y = real("unknowns", alone=True, name="exchange_seen_y", holds=FINITE)
    seen_rates = real("unknowns", alone=True, name="exchange_seen_rates", holds=ANY)
    indicator = real("indicators", alone=True, name="exchange_indicator", work=True)
    next_piece = real(1, alone=True, name="exchange_next_piece", work=True)
    wants_events = integer(1, alone=True, name="exchange_wants_events", work=True)
    integrates = integer(1, alone=True, name="exchange_integrates", work=True)


#: So many steps of difference quotients are tried (`engine.exchange.sensitivities`).
LEVELS = 8


class Sensitivity(Table, rows="responses", prefix="response_"):
    """Scratch of directional derivatives.

    Along which change of inputs and states they are; what these and the derivatives are before; the result, outputs
    first, then derivatives of the states, an estimate of its error, and whether it is asked for; difference quotients,
    and what is extrapolated.
    """

    input_seed = real("inputs", alone=True, name="input_seed", work=True)
    state_seed = real("unknowns", alone=True, name="state_seed", work=True)
    inputs = real("inputs", alone=True, name="response_inputs", work=True)
    states = real("unknowns", alone=True, name="response_states", work=True)
    rates = real("unknowns", alone=True, name="response_rates", work=True)
    asked = integer(name="asked", work=True)
    response = real(name="response", work=True)
    error = real(work=True)
    quotient = real(work=True)
    tableau = real(LEVELS, "responses", alone=True, name="response_tableau", work=True)


class Rubs(Table, rows="rubs", prefix="rub_"):
    """Friction of contacts, in their order, of joints, and of brakes among the force elements.

    State: how each slips (`codes.STICKS` ...), and where along its line, or at which angle, one that sticks began to.

    Scratch: the row of one that sticks; of one that slips, its direction in the coordinates, and what a unit of
    friction does to rates (as `linear_system.solution`) and to multipliers; friction [N, N m], or its impulse; the slip
    speed; a part of the normal impulse that is given; what holds it least (`complementarity.hold_ratio`); whether it is
    free to stick or to slip either way; whether it stuck before. Those that slip, by number; friction
    that smaller coefficients would have; of one that slips, what a unit of normal force does to its gap beside what it
    would without friction; 1 where the system for their friction has a positive determinant, as it has for little
    friction, else 0; that system; solution and multipliers without it.
    """

    slip = integer(holds=whole(codes.BACKWARDS, codes.STICKS))
    anchor = real(holds=FINITE)
    row = integer(work=True)
    direction = real("columns", work=True)
    solution = real("rub_columns", "columns", alone=True, work=True)
    multiplier = real("rows", work=True)
    force = real(work=True)
    speed = real(work=True)
    given = real(work=True)
    least_hold = real(work=True)
    free = integer(work=True)
    stuck = integer(work=True)
    sliding = integer(work=True)
    kept = real(work=True)
    criterion = real(work=True)
    sense = integer(1, alone=True, work=True)
    matrix = real("rub_columns", work=True)
    bare_solution = real("columns", alone=True, work=True)
    bare_multiplier = real("rows", alone=True, work=True)


class Problem(Table, rows="problem", prefix="problem_"):
    """Scratch of the complementarity problem of contacts with friction: see `contacts.proposal` and `contacts.lemke`.

    Directions of the normal and of the slip of each candidate in the coordinates, what a unit of force along them does
    to rates (as `linear_system.solution`), and accelerations along them without the candidates' forces; the first
    unknown of each candidate; the acceleration along a normal by which the tableau is scaled; tableau and basis.
    """

    direction = real("columns", work=True)
    response = real("columns", work=True)
    offset = real(work=True)
    first = integer(work=True)
    unit = real(work=True)
    tableau = real("problem_columns", work=True)
    basis = integer(work=True)

"""Views of an instance's block by subject: what engine functions read and write by name."""

from __future__ import annotations

from typing import NamedTuple

from .room import Array, room, sizes_room


class Sizes(NamedTuple):
    """How many of each there are (see `layout.SIZES`)."""

    bodies: int
    coordinates: int
    columns: int
    wide: int
    frames: int
    joints: int
    forces: int
    contacts: int
    patterns: int
    functions: int
    curves: int
    pieces: int
    terms: int
    alphas: int
    held: int
    inputs: int
    outputs: int
    joint_rows: int
    contact_rows: int
    rows: int
    unknowns: int
    guards: int
    record: int
    buffer: int


sizes = sizes_room(Sizes)


class Bodies(NamedTuple):
    """The bodies: inverse masses, 3 a body and zeros for the ground [1/kg, 1/(kg m2)], and where they start."""

    inverse_mass: Array
    inverse_root_mass: Array
    start: Array
    start_rate: Array


bodies = room(Bodies, "inverse_mass", "inverse_root_mass", "body_start", "body_start_rate")


class Joints(NamedTuple):
    """The joints' specifications; `curve` is the motion of a driver."""

    kind: Array
    body_i: Array
    body_j: Array
    row: Array
    data: Array
    friction: Array
    curve: Array


joints = room(
    Joints, "joint_kind", "joint_body_i", "joint_body_j", "joint_row", "joint_data", "joint_friction", "joint_curve"
)


class Curves(NamedTuple):
    """Functions of one variable, in pieces that are sums of terms (columns in `codes`), with their ranges."""

    piece: Array
    pieces: Array
    periodic: Array
    range: Array
    piece_term: Array
    piece_terms: Array
    piece_start: Array
    term: Array


curves = room(
    Curves,
    "curve_piece",
    "curve_pieces",
    "curve_periodic",
    "curve_range",
    "piece_term",
    "piece_terms",
    "piece_start",
    "term_data",
)


class Forces(NamedTuple):
    """The force elements; `data` holds what inputs write."""

    kind: Array
    body: Array
    reaction: Array
    data: Array


forces = room(Forces, "force_kind", "force_body", "force_reaction", "force_data")


class Contacts(NamedTuple):
    """The contacts' specifications and state.

    `value` holds numbers by column (`codes.RESTITUTION` ...). State is the mode (`codes.OPEN` or `CLOSED`), whether the
    gap was zero when the step began, the clicks of a stop with memory, the line of the present copy (of stops and
    locks: the present angle), whether profiles have hollows (`codes.CONVEX` ...), one over how far their contact
    coordinates may go in a step [1/rad], and the first time at which a guided contact pulled [s] (infinity: never).
    `row` is the constraint row of a closed contact; `least_push` the least contact force of the step last tried, over
    its tolerance.
    Contacts of profiles have contact coordinates, the first of which is `alpha`, and curves; `row_first` counts the
    rows that contacts have when contact coordinates are coordinates.
    """

    kind: Array
    body_i: Array
    body_j: Array
    pattern: Array
    function: Array
    closes_when: Array
    data: Array
    row_first: Array
    alpha: Array
    curve_i: Array
    curve_j: Array
    value: Array
    mode: Array
    touching: Array
    clicks: Array
    line: Array
    hollow: Array
    alpha_haste: Array
    pull_time: Array
    row: Array
    least_push: Array


contacts = room(
    Contacts,
    "contact_kind",
    "contact_body_i",
    "contact_body_j",
    "contact_pattern",
    "contact_function",
    "contact_closes_when",
    "contact_data",
    "contact_row_first",
    "contact_alpha",
    "contact_curve_i",
    "contact_curve_j",
    "contact_value",
    "contact_mode",
    "contact_touching",
    "contact_clicks",
    "contact_line",
    "contact_hollow",
    "alpha_haste",
    "pull_time",
    "contact_row",
    "least_push",
)


class Patterns(NamedTuple):
    """The circular patterns; state: the index of the present copy, and its two boundaries as lines (4 numbers each)."""

    body_i: Array
    body_j: Array
    data: Array
    pitch: Array
    enabled: Array
    copy: Array
    line: Array


patterns = room(
    Patterns,
    "pattern_body_i",
    "pattern_body_j",
    "pattern_data",
    "pattern_pitch",
    "pattern_enabled",
    "pattern_index",
    "pattern_line",
)


class Functions(NamedTuple):
    """The logical functions that switch contacts; state: their values."""

    kind: Array
    subject: Array
    limit: Array
    true: Array


functions = room(Functions, "function_kind", "function_index", "function_limit", "function_true")


class Strikes(NamedTuple):
    """Scratch of an impact.

    What each contact is in it (`impact.ABSENT` ...), the separation speed it must reach, its closing speed and impulse;
    the contacts that a complementarity problem decides about, and which problem it is (columns in `complementarity`);
    all rates before the impact; a line.
    """

    role: Array
    target: Array
    closing: Array
    impulse: Array
    candidates: Array
    problem: Array
    rates_before: Array
    line: Array


strikes = room(
    Strikes,
    "contact_role",
    "contact_target",
    "contact_closing",
    "contact_impulse",
    "candidates",
    "problem",
    "rates_before",
    "line",
)


class Watch(NamedTuple):
    """Scratch of the search for events: which guards are looked at, and their values and rates at two looks."""

    watched: Array
    armed: Array
    floor: Array
    now: Array
    next: Array


watch = room(Watch, "guard_watched", "guard_armed", "guard_floor", "guard_now", "guard_next")


class Ports(NamedTuple):
    """Inputs and outputs: which table entries they write and read, and their values.

    `inputs` and `input_slopes` (unit of the input per second) are what the outside sets. When a communication step
    begins, the motion takes them as `held_inputs` and `held_slopes`, and `input_slopes` become zero; where it stops,
    `inputs` become the values reached.
    """

    input_force: Array
    input_column: Array
    input_start: Array
    inputs: Array
    held_inputs: Array
    input_slopes: Array
    held_slopes: Array
    output_kind: Array
    output_index: Array
    output_slot: Array
    output_value: Array
    outputs: Array
    output_rates: Array


ports = room(
    Ports,
    "input_force",
    "input_column",
    "input_start",
    "inputs",
    "held_inputs",
    "input_slopes",
    "held_slopes",
    "output_kind",
    "output_index",
    "output_slot",
    "output_value",
    "outputs",
    "output_rates",
)


class Course(NamedTuple):
    """How far the motion has come.

    Clock, counters and ledger (columns in `codes`); y = (q, qd, work, loss) and its derivative at the end of the
    engine's own step, and the step's dense output; the last impact, and impacts and events of the last communication
    step.
    """

    clock: Array
    counters: Array
    ledger: Array
    y_end: Array
    dy_end: Array
    dense: Array
    last_impact: Array
    impacts: Array
    events: Array


course = room(Course, "clock", "counters", "ledger", "y_end", "dy_end", "dense", "last_impact", "impacts", "events")


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


pose = room(Pose, "x", "y", "phi", "cosine", "sine", "x_rate", "y_rate", "phi_rate", "alpha", "alpha_rate", "instant")


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


rows = room(Rows, "residual", "residual_rate", "gamma", "nu", "jacobian")


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


linear_system = room(
    LinearSystem,
    "scaled",
    "right_side",
    "solution",
    "multiplier",
    "basis",
    "triangle",
    "column_basis",
    "column_triangle",
    "order",
    "row_norm",
    "coefficient",
    "dual",
    "rank",
    "independence",
)


class Loads(NamedTuple):
    """Generalised forces [N, N m].

    `force` acts; `applied` is its part without friction; the accelerations that it alone would give; assembly weights;
    the multipliers of the last round of the friction iteration.
    """

    force: Array
    applied: Array
    last_multiplier: Array
    free_acceleration: Array
    weight: Array


loads = room(Loads, "force", "applied", "last_multiplier", "free_acceleration", "weight")


class Stages(NamedTuple):
    """Scratch of one Runge-Kutta step.

    `tried`: start and size of the one last tried [s]; `independence` of the rows at each of its stages, of which
    `stage` is the one computed last.
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


stages = room(
    Stages,
    "stages",
    "tried",
    "y_start",
    "y_stage",
    "y_new",
    "y_at",
    "dy_at",
    "new_dense",
    "stage",
    "stage_independence",
)


class Options(NamedTuple):
    """Engine settings (columns in `codes`), and the coordinates that assembly must not move."""

    settings: Array
    held: Array


options = room(Options, "settings", "held")

"""Views of an instance's block by subject: what engine functions read and write by name."""

from __future__ import annotations

from typing import NamedTuple

from .room import Array, room, sizes_room


class Sizes(NamedTuple):
    """How many of each there are (see `layout.SIZES`)."""

    bodies: int
    coordinates: int
    columns: int
    frames: int
    joints: int
    forces: int
    contacts: int
    held: int
    inputs: int
    outputs: int
    joint_rows: int
    rows: int
    unknowns: int
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
    """The joints' specifications."""

    kind: Array
    body_i: Array
    body_j: Array
    row: Array
    data: Array


joints = room(Joints, "joint_kind", "joint_body_i", "joint_body_j", "joint_row", "joint_data")


class Forces(NamedTuple):
    """The force elements; `data` holds what inputs write."""

    kind: Array
    body: Array
    reaction: Array
    data: Array


forces = room(Forces, "force_kind", "force_body", "force_reaction", "force_data")


class Contacts(NamedTuple):
    """The contacts' specifications and state.

    State is the mode (`codes.OPEN` or `CLOSED`), whether the gap was zero when the step began, and the first time at
    which a closed contact pulled [s] (infinity: never).
    """

    body_i: Array
    body_j: Array
    start_mode: Array
    tooth: Array
    data: Array
    restitution: Array
    beam_length: Array
    mode: Array
    touching: Array
    pull_time: Array
    row: Array


contacts = room(
    Contacts,
    "contact_body_i",
    "contact_body_j",
    "contact_start_mode",
    "contact_tooth",
    "contact_data",
    "contact_restitution",
    "contact_beam_length",
    "contact_mode",
    "contact_touching",
    "pull_time",
    "contact_row",
)


class Ports(NamedTuple):
    """Inputs and outputs: which table entries they write and read, and their values."""

    input_force: Array
    input_column: Array
    input_start: Array
    inputs: Array
    held_inputs: Array
    output_kind: Array
    output_index: Array
    output_slot: Array
    output_value: Array
    outputs: Array


ports = room(
    Ports,
    "input_force",
    "input_column",
    "input_start",
    "inputs",
    "held_inputs",
    "output_kind",
    "output_index",
    "output_slot",
    "output_value",
    "outputs",
)


class Course(NamedTuple):
    """How far the motion has come.

    Clock, counters and ledger (columns in `codes`); y = (q, qd, work) and its derivative at the end of the engine's own
    step, and the step's dense output; the last impact, and those of the last communication step.
    """

    clock: Array
    counters: Array
    ledger: Array
    y_end: Array
    dy_end: Array
    dense: Array
    last_impact: Array
    impacts: Array


course = room(Course, "clock", "counters", "ledger", "y_end", "dy_end", "dense", "last_impact", "impacts")


class Pose(NamedTuple):
    """Positions and rates of all bodies at the instant that is looked at; the last entry is the ground."""

    x: Array
    y: Array
    cosine: Array
    sine: Array
    x_rate: Array
    y_rate: Array
    phi_rate: Array


pose = room(Pose, "x", "y", "cosine", "sine", "x_rate", "y_rate", "phi_rate")


class Rows(NamedTuple):
    """The constraint rows at the instant that is looked at: Phi, Phi', gamma (with Baumgarte's terms), Phi_q."""

    residual: Array
    residual_rate: Array
    gamma: Array
    jacobian: Array


rows = room(Rows, "residual", "residual_rate", "gamma", "jacobian")


class LinearSystem(NamedTuple):
    """The minimum-norm problem D z = b, with D^T multiplier = z, and the scratch of its solution."""

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
)


class Loads(NamedTuple):
    """Applied generalised forces [N, N m], the accelerations that they alone would give, and assembly weights."""

    force: Array
    free_acceleration: Array
    weight: Array


loads = room(Loads, "force", "free_acceleration", "weight")


class Stages(NamedTuple):
    """Scratch of one Runge-Kutta step."""

    derivatives: Array
    y_start: Array
    y_stage: Array
    y_new: Array
    y_at: Array
    dy_at: Array
    new_dense: Array


stages = room(Stages, "stages", "y_start", "y_stage", "y_new", "y_at", "dy_at", "new_dense")


class Options(NamedTuple):
    """Engine settings (columns in `codes`), and the coordinates that assembly must not move."""

    settings: Array
    held: Array


options = room(Options, "settings", "held")

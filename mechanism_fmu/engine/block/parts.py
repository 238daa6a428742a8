"""Views of an instance's block: the parts of the mechanism, its ports and its settings."""

from __future__ import annotations

from typing import NamedTuple

from .layout import Array
from .room import room, sizes_room


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
    own: int
    held: int
    inputs: int
    outputs: int
    members: int
    nodes: int
    ties: int
    lumps: int
    couples: int
    locked: int
    beams: int
    joint_rows: int
    contact_rows: int
    rows: int
    unknowns: int
    guards: int
    record: int
    buffer: int
    displacements: int


sizes = sizes_room(Sizes)


class Bodies(NamedTuple):
    """The bodies: inverse masses, 3 a body and zeros for the ground [1/kg, 1/(kg m2)], and where they start."""

    inverse_mass: Array
    inverse_root_mass: Array
    start: Array
    start_rate: Array
    tooth_length: Array


bodies = room(Bodies, "body_")


class Joints(NamedTuple):
    """The joints' specifications; `curve` is the motion of a driver."""

    kind: Array
    body_i: Array
    body_j: Array
    row: Array
    data: Array
    friction: Array
    curve: Array


joints = room(Joints, "joint_")


class Curves(NamedTuple):
    """Functions of one variable, in pieces that are sums of terms (columns in `codes`), with their ranges."""

    piece: Array
    pieces: Array
    periodic: Array
    range: Array
    piece_term: Array
    piece_terms: Array
    piece_start: Array
    term_data: Array


curves = room(Curves, "curve_")


class Forces(NamedTuple):
    """The force elements; `data` holds what inputs write, `own` says which of the own states is an element's first."""

    kind: Array
    body: Array
    reaction: Array
    own: Array
    data: Array


forces = room(Forces, "force_")


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


contacts = room(Contacts, "contact_")


class Patterns(NamedTuple):
    """The circular patterns; state: the index of the present copy, and its two boundaries as lines (4 numbers each)."""

    body_i: Array
    body_j: Array
    data: Array
    pitch: Array
    enabled: Array
    copy: Array
    line: Array


patterns = room(Patterns, "pattern_")


class Functions(NamedTuple):
    """The logical functions that switch contacts; state: their values."""

    kind: Array
    subject: Array
    limit: Array
    true: Array


functions = room(Functions, "function_")


class Ports(NamedTuple):
    """Inputs and outputs: which table entries they write and read, and their values.

    `inputs` and `input_slopes` (unit of the input per second) are what the outside sets. When a communication step
    begins, the motion takes them as `held_inputs` and `held_slopes`, and `input_slopes` become zero; where it stops,
    `inputs` become the values reached. All of them are as the outside has them; `input_factor` and `input_offset` make
    of them what a table entry gets. `left_outputs` are kept by who
    stops before an event (FMI 3.0's event mode).
    """

    input_force: Array
    input_column: Array
    input_start: Array
    input_factor: Array
    input_offset: Array
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
    left_outputs: Array


ports = room(Ports)


class Options(NamedTuple):
    """Engine settings (columns in `codes`), and the coordinates that assembly must not move."""

    settings: Array
    held: Array


options = room(Options)

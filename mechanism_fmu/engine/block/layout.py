"""What stands where in an instance's block: header, tables, state, work.

`FIELDS` is the only place where a field is declared. The tables describe the mechanism and change only with its
parameters (an input's value is written into `force_data`); the state is everything that a saved state must restore,
in one piece; work is scratch that no result depends on.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from ... import codes
from .contents import ANY, COUNT, FINITE, FLAG, MOST, NOT_NAN, NOT_NEGATIVE, WHOLE, Holds, index_of, whole

Array = np.ndarray[Any, np.dtype[Any]]

#: Names of the sizes, in header order.
SIZES = (
    "bodies",
    "coordinates",  # 3 a body
    "columns",  # coordinates, and 3 more for the ground
    "wide",  # columns, and one a contact coordinate
    "frames",  # bodies, and the ground
    "joints",
    "forces",
    "contacts",
    "patterns",
    "functions",
    "curves",
    "pieces",
    "terms",
    "alphas",  # contact coordinates
    "own",  # states of force elements' own
    "held",
    "inputs",
    "outputs",
    "members",  # elastic ones; these seven are zero when no output asks for them
    "nodes",
    "ties",
    "lumps",
    "couples",
    "locked",
    "beams",
    "joint_rows",
    "contact_rows",  # of all contacts, when contact coordinates count as coordinates
    "rows",  # joint rows, contact rows, and a spare one
    "unknowns",  # positions, rates, work done, energy lost in motion, contact coordinates, own states
    "guards",  # two a contact, two a pattern, one a logical function
    "record",  # columns of an impact record
    "buffer",  # impacts that are kept of one communication step
    "displacements",  # 3 a node
)


#: Those that `allocate` is given; the others follow.
GIVEN_SIZES = (
    "bodies",
    "joints",
    "forces",
    "contacts",
    "patterns",
    "functions",
    "curves",
    "pieces",
    "terms",
    "alphas",
    "own",
    "held",
    "inputs",
    "outputs",
    "members",
    "nodes",
    "ties",
    "lumps",
    "couples",
    "locked",
    "beams",
    "joint_rows",
    "contact_rows",
)


class Field(NamedTuple):
    """A field: its room ("tables", "state" or "work"), name, shape (names of sizes, or numbers), type, and contents.

    `holds` is what may stand in it: declared for every field of the state (None elsewhere), column by column where the
    columns differ; the last declaration is that of all columns behind it, too.
    """

    room: str
    name: str
    shape: tuple[str | int, ...]
    integer: bool = False
    holds: tuple[Holds, ...] | None = None


#: Subject of a guard: a contact, pattern or logical function, or the status of a failure; the guard says which.
_SUBJECT = whole(codes.NONE, int(MOST))

#: Columns of the clock and of the counters, in the order of `codes`.
_CLOCK = {
    "TIME": FINITE,
    "STEP_START": FINITE,
    "STEP_END": FINITE,
    "STEP_SIZE": NOT_NEGATIVE,
    "NEXT_STEP": NOT_NEGATIVE._replace(high=math.inf, nan=True),
    "LAST_EVENT": FINITE,
    "RAMP_START": FINITE,
    "RAMP_END": FINITE,
    "STEP_BEGUN": FINITE,
}
_COUNTERS = {
    "COUNT_IMPACTS": COUNT,
    "COUNT_IN_STEP": whole(0, codes.IMPACT_BUFFER_LENGTH),
    "COUNT_LOST": COUNT,
    "COUNT_STEPS": COUNT,
    "PENDING_GUARD": whole(codes.GUARD_NONE, codes.GUARD_FAILED),
    "PENDING_SUBJECT": _SUBJECT,
    "COUNT_PULLS": WHOLE,
    "COUNT_EVENTS": COUNT,
    "EVENTS_IN_STEP": whole(0, codes.EVENT_BUFFER_LENGTH),
    "PILE": COUNT,
    "RAMPING": FLAG,
    "RANK": whole(0, 0, "rows"),
    "FALLING": FLAG,
    "COUNT_INSTANTS": COUNT,
    "STEPS_IN_STEP": COUNT,
}
#: Columns of an impact record, the last one for all behind it, and of an event record.
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
    "EVENT_GUARD": whole(codes.GUARD_NONE, codes.GUARD_FAILED),
    "EVENT_SUBJECT": _SUBJECT,
    "EVENT_OLD_MODE": COUNT,
    "EVENT_NEW_MODE": COUNT,
    "EVENT_IMPULSE": FINITE,
}

#: Names of the columns of fields whose columns differ, as in `codes`.
COLUMNS = {
    "clock": tuple(_CLOCK),
    "counters": tuple(_COUNTERS),
    "last_impact": tuple(_RECORD),
    "impacts": tuple(_RECORD),
    "events": tuple(_EVENT),
}

FIELDS = (
    Field("tables", "inverse_mass", ("columns",)),
    Field("tables", "inverse_root_mass", ("columns",)),
    Field("tables", "body_start", ("bodies", 3)),
    Field("tables", "body_start_rate", ("bodies", 3)),
    Field("tables", "body_tooth_length", ("bodies",)),
    Field("tables", "joint_kind", ("joints",), True),
    Field("tables", "joint_body_i", ("joints",), True),
    Field("tables", "joint_body_j", ("joints",), True),
    Field("tables", "joint_row", ("joints",), True),
    Field("tables", "joint_data", ("joints", 9)),
    Field("tables", "joint_friction", ("joints",)),
    Field("tables", "joint_curve", ("joints",), True),
    Field("tables", "force_kind", ("forces",), True),
    Field("tables", "force_body", ("forces",), True),
    Field("tables", "force_reaction", ("forces",), True),
    Field("tables", "force_own", ("forces",), True),
    Field("tables", "force_data", ("forces", 8)),
    Field("tables", "contact_kind", ("contacts",), True),
    Field("tables", "contact_body_i", ("contacts",), True),
    Field("tables", "contact_body_j", ("contacts",), True),
    Field("tables", "contact_pattern", ("contacts",), True),
    Field("tables", "contact_function", ("contacts",), True),
    Field("tables", "contact_closes_when", ("contacts",), True),
    Field("tables", "contact_data", ("contacts", 6)),
    Field("tables", "contact_row_first", ("contacts",), True),
    Field("tables", "contact_alpha", ("contacts",), True),
    Field("tables", "contact_curve_i", ("contacts",), True),
    Field("tables", "contact_curve_j", ("contacts",), True),
    Field("tables", "contact_value", ("contacts", codes.CONTACT_VALUES)),
    Field("tables", "pattern_body_i", ("patterns",), True),
    Field("tables", "pattern_body_j", ("patterns",), True),
    Field("tables", "pattern_data", ("patterns", 6)),
    Field("tables", "pattern_pitch", ("patterns",)),
    Field("tables", "pattern_enabled", ("patterns",)),
    Field("tables", "function_kind", ("functions",), True),
    Field("tables", "function_subject", ("functions",), True),
    Field("tables", "function_limit", ("functions",)),
    Field("tables", "curve_piece", ("curves",), True),
    Field("tables", "curve_pieces", ("curves",), True),
    Field("tables", "curve_periodic", ("curves",), True),
    Field("tables", "curve_range", ("curves", 2)),
    Field("tables", "piece_term", ("pieces",), True),
    Field("tables", "piece_terms", ("pieces",), True),
    Field("tables", "piece_start", ("pieces",)),
    Field("tables", "term_data", ("terms", codes.TERM_COLUMNS)),
    Field("tables", "held", ("held",), True),
    Field("tables", "input_force", ("inputs",), True),
    Field("tables", "input_column", ("inputs",), True),
    Field("tables", "input_start", ("inputs",)),
    Field("tables", "input_factor", ("inputs",)),
    Field("tables", "input_offset", ("inputs",)),
    Field("tables", "output_kind", ("outputs",), True),
    Field("tables", "output_index", ("outputs",), True),
    Field("tables", "output_slot", ("outputs",), True),
    Field("tables", "output_value", ("outputs",)),
    Field("tables", "settings", (codes.SETTINGS,)),
    Field("tables", "node_body", ("nodes",), True),
    Field("tables", "node_point", ("nodes", 2)),
    Field("tables", "member_start", ("members",), True),
    Field("tables", "member_end", ("members",), True),
    Field("tables", "member_data", ("members", codes.MEMBER_COLUMNS)),
    Field("tables", "tie_joint", ("ties",), True),
    Field("tables", "tie_node", ("ties",), True),
    Field("tables", "lump_node", ("lumps",), True),
    Field("tables", "lump_data", ("lumps", codes.LUMP_COLUMNS)),
    Field("tables", "couple_force", ("couples",), True),
    Field("tables", "couple_node", ("couples",), True),
    Field("tables", "couple_sign", ("couples",), True),
    Field("tables", "locked", ("locked",), True),
    Field("tables", "beam_body", ("beams",), True),
    Field("tables", "beam_row", ("beams",), True),
    Field("tables", "beam_data", ("beams", codes.BEAM_COLUMNS)),
    Field("state", "clock", (codes.CLOCK_LENGTH,), holds=tuple(_CLOCK.values())),
    Field("state", "counters", (codes.COUNTERS_LENGTH,), True, tuple(_COUNTERS.values())),
    Field("state", "ledger", (codes.LEDGER_LENGTH,), holds=(FINITE,)),
    Field("state", "inputs", ("inputs",), holds=(FINITE,)),
    Field("state", "held_inputs", ("inputs",), holds=(FINITE,)),
    Field("state", "input_slopes", ("inputs",), holds=(FINITE,)),
    Field("state", "held_slopes", ("inputs",), holds=(FINITE,)),
    Field("state", "y_end", ("unknowns",), holds=(FINITE,)),
    Field("state", "dy_end", ("unknowns",), holds=(ANY,)),
    Field("state", "dense", (5, "unknowns"), holds=(FINITE,)),
    Field("state", "independence_end", (1,), holds=(ANY,)),
    Field("state", "contact_mode", ("contacts",), True, (whole(codes.OPEN, codes.CLOSED),)),
    Field("state", "contact_touching", ("contacts",), True, (FLAG,)),
    Field("state", "contact_clicks", ("contacts",), True, (COUNT,)),
    Field("state", "contact_line", ("contacts", 4), holds=(FINITE,)),
    Field("state", "contact_hollow", ("contacts",), True, (whole(codes.CONVEX, codes.BRIDGES),)),
    Field("state", "alpha_haste", ("alphas",), holds=(NOT_NAN,)),
    Field("state", "pattern_copy", ("patterns",), True, (WHOLE,)),
    Field("state", "pattern_line", ("patterns", 8), holds=(FINITE,)),
    Field("state", "function_true", ("functions",), True, (FLAG,)),
    Field("state", "pull_time", ("contacts",), holds=(NOT_NAN,)),
    Field("state", "last_impact", ("record",), holds=tuple(_RECORD.values())),
    Field("state", "impacts", ("buffer", "record"), holds=tuple(_RECORD.values())),
    Field("state", "left_outputs", ("outputs",), holds=(ANY,)),  # kept by FMI 3.0's event mode, else 0
    Field("state", "events", (codes.EVENT_BUFFER_LENGTH, codes.EVENT_COLUMNS), holds=tuple(_EVENT.values())),
    Field("work", "x", ("frames",)),
    Field("work", "y", ("frames",)),
    Field("work", "phi", ("frames",)),
    Field("work", "cosine", ("frames",)),
    Field("work", "sine", ("frames",)),
    Field("work", "x_rate", ("frames",)),
    Field("work", "y_rate", ("frames",)),
    Field("work", "phi_rate", ("frames",)),
    Field("work", "alpha", ("alphas",)),
    Field("work", "alpha_rate", ("alphas",)),
    Field("work", "instant", (1,)),
    Field("work", "contact_row", ("contacts",), True),
    Field("work", "contact_role", ("contacts",), True),
    Field("work", "contact_target", ("contacts",)),
    Field("work", "contact_closing", ("contacts",)),
    Field("work", "contact_impulse", ("contacts",)),
    Field("work", "least_push", ("contacts",)),
    Field("work", "candidates", ("contacts",), True),
    Field("work", "problem", (2,), True),
    Field("work", "guard_watched", ("guards",), True),
    Field("work", "guard_armed", ("guards",), True),
    Field("work", "guard_floor", ("guards",)),
    Field("work", "guard_rate", ("guards",)),
    Field("work", "guard_next", ("guards", 2)),
    Field("work", "tangent_line", (4,)),
    Field("work", "residual", ("rows",)),
    Field("work", "residual_rate", ("rows",)),
    Field("work", "gamma", ("rows",)),
    Field("work", "nu", ("rows",)),
    Field("work", "jacobian", ("rows", "wide")),
    Field("work", "scaled", ("rows", "columns")),
    Field("work", "right_side", ("rows",)),
    Field("work", "solution", ("columns",)),
    Field("work", "multiplier", ("rows",)),
    Field("work", "basis", ("rows", "columns")),
    Field("work", "triangle", ("rows", "rows")),
    Field("work", "column_basis", ("rows", "rows")),
    Field("work", "column_triangle", ("rows", "rows")),
    Field("work", "order", ("rows",), True),
    Field("work", "row_norm", ("rows", 2)),
    Field("work", "coefficient", ("rows",)),
    Field("work", "rank", (1,), True),
    Field("work", "independence", (1,)),
    Field("work", "stage", (1,), True),
    Field("work", "stage_independence", (7,)),
    Field("work", "stage_stiffest", (1,), True),
    Field("work", "dual", ("rows",)),
    Field("work", "force", ("columns",)),
    Field("work", "applied", ("columns",)),
    Field("work", "torque", ("forces",)),
    Field("work", "rubbing", ("joints",)),
    Field("work", "last_multiplier", ("rows",)),
    Field("work", "weight", ("columns",)),
    Field("work", "free_acceleration", ("columns",)),
    Field("work", "derivatives", (7, "unknowns")),
    Field("work", "tried", (2,)),
    Field("work", "y_start", ("unknowns",)),
    Field("work", "y_stage", ("unknowns",)),
    Field("work", "y_new", ("unknowns",)),
    Field("work", "y_at", ("unknowns",)),
    Field("work", "dy_at", ("unknowns",)),
    Field("work", "new_dense", (5, "unknowns")),
    Field("work", "rates_before", ("coordinates",)),
    Field("work", "outputs", ("outputs",)),
    Field("work", "output_rates", ("outputs",)),
    Field("work", "node_place", ("nodes", 2)),
    Field("work", "matrix", ("displacements", "displacements")),
    Field("work", "matrix_order", ("displacements",), True),
    Field("work", "load", ("displacements",)),
    Field("work", "element_force", ("displacements",)),
    Field("work", "deformation", ("displacements",)),
    Field("work", "displacement", ("displacements",)),
)

_FIRST_OFFSET = len(SIZES)
_HEADER = _FIRST_OFFSET + len(FIELDS)
FIELDS_BY_NAME = {field.name: field for field in FIELDS}
_SLOTS = {field.name: _FIRST_OFFSET + i for i, field in enumerate(FIELDS)}


def size_slot(name: str) -> int:
    """The header word that holds the size `name`."""
    return SIZES.index(name)


def slot(name: str) -> int:
    """The header word that holds the offset of the field `name`."""
    return _SLOTS[name]


def allocate(sizes: dict[str, int]) -> Array:
    """A zeroed block with its header filled in.

    Args:
        sizes: those of `GIVEN_SIZES`, by name.

    Returns:
        The block, float64 of shape (words,).

    """
    complete = _complete(sizes)
    offsets = [_HEADER]
    for field in FIELDS:
        offsets.append(offsets[-1] + int(np.prod(shape_of(field, complete))))
    block = np.zeros(offsets[-1])
    block[:_HEADER].view(np.int64)[:] = [*(complete[name] for name in SIZES), *offsets[:-1]]
    return block


def sizes_of(block: Array) -> dict[str, int]:
    """The sizes in a block's header, by name, in the order of `SIZES`."""
    return dict(zip(SIZES, block[:_FIRST_OFFSET].view(np.int64).tolist(), strict=True))


def field_of(block: Array, name: str) -> Array:
    """A view of the field `name`, in its own shape and type."""
    field = FIELDS_BY_NAME[name]
    shape = shape_of(field, sizes_of(block))
    start = int(block[:_HEADER].view(np.int64)[_SLOTS[name]])
    flat = block[start : start + int(np.prod(shape))]
    return (flat.view(np.int64) if field.integer else flat).reshape(shape)


def state_of(block: Array) -> Array:
    """A view of the whole state, shape (words,): copy it to save, write it to restore."""
    header = block[:_HEADER].view(np.int64)
    first = next(f.name for f in FIELDS if f.room == "state")
    after = next(f.name for f in FIELDS if f.room == "work")
    return block[int(header[_SLOTS[first]]) : int(header[_SLOTS[after]])]


def shape_of(field: Field, sizes: dict[str, int]) -> tuple[int, ...]:
    """The shape of a field for given sizes."""
    return tuple(sizes[n] if isinstance(n, str) else n for n in field.shape)


def _complete(sizes: dict[str, int]) -> dict[str, int]:
    coordinates = 3 * sizes["bodies"]
    return sizes | {
        "coordinates": coordinates,
        "columns": coordinates + 3,
        "wide": coordinates + 3 + sizes["alphas"],
        "frames": sizes["bodies"] + 1,
        "rows": sizes["joint_rows"] + sizes["contact_rows"] + 1,
        "unknowns": 2 * coordinates + 2 + sizes["alphas"] + sizes["own"],
        "guards": 2 * sizes["contacts"] + 2 * sizes["patterns"] + sizes["functions"],
        "record": codes.RECORD_CONTACT_IMPULSES + sizes["contacts"] + 2 * coordinates,
        "buffer": codes.IMPACT_BUFFER_LENGTH,
        "displacements": 3 * sizes["nodes"],
    }

"""Tables of the mechanism: its parts, their present state, its ports and settings."""

from __future__ import annotations

from .. import codes
from .declare import ANY, COUNT, FINITE, FLAG, NOT_NAN, NOT_NEGATIVE, WHOLE, Table, index_of, integer, real, whole
from .kinds import FORCES, JOINTS


class Bodies(Table, prefix="body_"):
    """The bodies: inverse masses, 3 a body and zeros for the ground [1/kg, 1/(kg m2)], and where they start.

    Rows are eliminated in the order of their bodies' `rank`.
    """

    inverse_mass = real("columns", name="inverse_mass")
    inverse_root_mass = real("columns", name="inverse_root_mass")
    start = real("bodies", 3)
    start_rate = real("bodies", 3)
    tooth_length = real("bodies")
    rank = integer("bodies")


class Joints(Table, rows="joints", prefix="joint_"):
    """The joints' specifications; `holding` is friction while it sticks, `curve` the motion of a driver."""

    kind = integer()
    body_i = integer()
    body_j = integer()
    row = integer()
    data = real(JOINTS.width)
    friction = real()
    holding = real()
    curve = integer()


class Curves(Table, prefix="curve_"):
    """Functions of one variable, in pieces that are sums of terms (columns in `codes`), with their ranges."""

    piece = integer("curves")
    pieces = integer("curves")
    periodic = integer("curves")
    range = real("curves", 2)
    piece_term = integer("pieces", name="piece_term")
    piece_terms = integer("pieces", name="piece_terms")
    piece_start = real("pieces", name="piece_start")
    term_data = real("terms", codes.TERM_COLUMNS, name="term_data")


class Forces(Table, rows="forces", prefix="force_"):
    """The force elements; `data` holds what inputs write, `own` says which of the own states is an element's first.

    A nonlinear one has a law: the operations from `law` up to `law_end`, or the curve of its energy. `threshold` is the
    first of its thresholds, or none.
    """

    kind = integer()
    body = integer()
    reaction = integer()
    own = integer()
    law = integer()
    law_end = integer()
    curve = integer()
    threshold = integer()
    data = real(FORCES.width)


class Operations(Table, rows="operations", prefix="operation_"):
    """Operations of laws of the user's own: `tables.kinds.OPERATIONS`; value of a constant, threshold of a choice."""

    kind = integer()
    operands = integer(3)
    value = real()
    threshold = integer()
    result = real(work=True)


class Thresholds(Table, rows="thresholds", prefix="threshold_"):
    """Thresholds of force elements, where a force begins, ends or goes over to another formula: a step ends there.

    `subject` is the operation, or the piece behind the threshold. State: its side (`codes.ABOVE` ...), the number of
    crossings since a time [s] without progress. Scratch: the part of its value that is rounding, whether it has been on
    its side in this step, its values at the last three looks.
    """

    kind = integer()
    force = integer()
    subject = integer()
    side = integer(holds=whole(-codes.CROSSES, codes.CROSSES))
    crossings = integer(holds=COUNT)
    since = real(holds=FINITE)
    rounding = real(work=True)
    armed = integer(work=True)
    looks = real(3, work=True)


#: Columns of what is known of an oscillation, in the order of `codes`.
_SWING = {
    "SWING_SEEN": FINITE,
    "SWING_SIDE": whole(-1, 1),
    "SWING_SENSE": whole(-1, 1),
    "SWING_REACH": NOT_NEGATIVE,
    "SWING_ABOVE": NOT_NEGATIVE,
    "SWING_BELOW": NOT_NEGATIVE,
    "SWING_PASSAGES": COUNT,
    "SWING_TIME": FINITE,
    "SWING_WORK": FINITE,
    "SWING_PERIOD": NOT_NEGATIVE,
    "SWING_POWER": FINITE,
}


class Oscillations(Table, rows="oscillations", prefix="oscillation_"):
    """What is known of the oscillations (columns in `codes`): state, and as it is at the instant that is looked at."""

    swing = real(codes.SWING_COLUMNS, holds=_SWING)
    shown = real(codes.SWING_COLUMNS, work=True)


class Contacts(Table, rows="contacts", prefix="contact_"):
    """The contacts' specifications and state.

    `value` holds numbers by column (`codes.RESTITUTION` ...). State is the mode (`codes.OPEN` or `CLOSED`), whether the
    gap was zero when the step began, the clicks of a stop with memory, the line of the present copy (of stops and
    locks: the present angle), whether profiles have hollows (`codes.CONVEX` ...), one over how far their contact
    coordinates may go in a step [1/rad], and the first time at which a guided contact pulled [s] (infinity: never).
    `row` is the constraint row of a closed contact; `least_push` and `most_push` are the least and the largest contact
    force at the stages of the step last tried, over its tolerance.
    Contacts of profiles have contact coordinates, the first of which is `alpha`, and curves; `row_first` counts the
    rows that contacts have when contact coordinates are coordinates.
    Two outlines share a group of contacts, of which `group` is the first, one for each place where they touch at once;
    each is bound to the two features that touch there, and to the copy of outline j (state; none: it is free). `apart`
    of the first is how far all that touches nothing is from each other at least [m], as far as looks have shown.
    `wear` is the place of a contact among those whose work of sliding is added up.
    """

    kind = integer()
    body_i = integer()
    body_j = integer()
    pattern = integer()
    function = integer()
    closes_when = integer()
    data = real(6)
    row_first = integer()
    alpha = integer()
    curve_i = integer()
    curve_j = integer()
    value = real(codes.CONTACT_VALUES)
    outline_i = integer()
    outline_j = integer()
    group = integer()
    wear = integer()
    mode = integer(holds=whole(codes.OPEN, codes.CLOSED))
    touching = integer(holds=whole(0, codes.LEFT_INSIDE))
    clicks = integer(holds=COUNT)
    line = real(4, holds=FINITE)
    hollow = integer(holds=whole(codes.CONVEX, codes.BRIDGES))
    alpha_haste = real("alphas", alone=True, name="alpha_haste", holds=NOT_NAN)
    pull_time = real(name="pull_time", holds=NOT_NAN)
    feature_i = integer(holds=index_of("features"))
    feature_j = integer(holds=index_of("features"))
    copy = integer(holds=WHOLE)
    apart = real(holds=NOT_NEGATIVE)
    row = integer(work=True)
    least_push = real(name="least_push", work=True)
    most_push = real(name="most_push", work=True)


class Features(Table, rows="features", prefix="feature_"):
    """Vertices, segments and arcs of outlines, in the order of each chain (columns in `codes`)."""

    kind = integer()
    data = real(codes.FEATURE_COLUMNS)


class Outlines(Table, rows="outlines", prefix="outline_"):
    """The outlines: their features, whether the last one is followed by the first, and their copies (0: it alone).

    Work: how deep behind a feature a point may be for it to count there [m], and whether crossing elements do; what a
    search has found; angle, sine and cosine of the last copies that were looked at, one with an even number and one
    with an odd one.
    """

    first = integer()
    count = integer()
    closed = integer()
    copies = integer()
    data = real(codes.OUTLINE_COLUMNS)
    turning = real(6, work=True)
    depth = real(2, name="outlines_depth", alone=True, work=True)
    found = integer(3, name="outlines_found", alone=True, work=True)


class Patterns(Table, rows="patterns", prefix="pattern_"):
    """The circular patterns; state: the index of the present copy, and its two boundaries as lines (4 numbers each)."""

    body_i = integer()
    body_j = integer()
    data = real(6)
    pitch = real()
    enabled = real()
    copy = integer(holds=WHOLE)
    line = real(8, holds=FINITE)


class Functions(Table, rows="functions", prefix="function_"):
    """The logical functions that switch contacts; state: their values."""

    kind = integer()
    subject = integer()
    limit = real()
    true = integer(holds=FLAG)


class Ports(Table):
    """Inputs and outputs: which table entries they write and read, and their values.

    `inputs` and `input_slopes` (unit of the input per second) are what the outside sets. When a communication step
    begins, the motion takes them as `held_inputs` and `held_slopes`, and `input_slopes` become zero; where it stops,
    `inputs` become the values reached. All of them are as the outside has them; `input_factor` and `input_offset` make
    of them what a table entry gets. `left_outputs` are kept by who stops before an event (FMI 3.0's event mode), and
    else 0.
    """

    input_force = integer("inputs")
    input_column = integer("inputs")
    input_start = real("inputs")
    input_factor = real("inputs")
    input_offset = real("inputs")
    inputs = real("inputs", holds=FINITE)
    held_inputs = real("inputs", holds=FINITE)
    input_slopes = real("inputs", holds=FINITE)
    held_slopes = real("inputs", holds=FINITE)
    output_kind = integer("outputs")
    output_index = integer("outputs")
    output_slot = integer("outputs")
    output_value = real("outputs")
    outputs = real("outputs", work=True)
    output_rates = real("outputs", work=True)
    left_outputs = real("outputs", holds=ANY)


class Options(Table):
    """Engine settings (columns in `codes`), and the coordinates that assembly must not move."""

    settings = real(codes.SETTINGS)
    held = integer("held")

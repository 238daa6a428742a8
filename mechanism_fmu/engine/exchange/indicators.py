"""Event indicators: numbers that are positive until something happens, one for each guard, whatever the mode.

- A contact: its gap while it is open, its force while it is closed.
- A contact that has just come off, by an impact or because it would pull, is *leaving*: its gap is zero within
  rounding, and would fire again at once. Until its gap is clearly positive, its indicator is

      gap rate + STICK_SPEED + gap / RETURN_TIME, in the scales of the mechanism,

  which is positive as long as it leaves, and comes to zero on the way back, just beyond the top of the hop, before the
  gap does. That event changes nothing but what is looked at: from then on it is the gap. A hop that is no higher
  than what touches has ended there: the contact closes.
- Two outlines: an importer's step must not lead through a corner, and there is no rate that would tell of a dip. What
  is known is their distance s at the last completed step, and by how much it can have changed since: the circle around
  one outline has been displaced by `travel` at most in the frame of the other one's body. So the indicator is
  s - travel, which takes no search at all; at its zero, which is no more than a look, s is measured anew. Where s is
  less than what a corner may be grazed by unseen, `_GRAZE` of the radius, it is the distance itself, or
  2 _GRAZE R - travel if that is less.
- All bodies, where anything depends on their places: 1 - turn / MOST_TURN since the last completed step, so that no
  step turns over what happens twice within it.
- A stop with memory, the end of a feature, a pattern's boundaries, a logical function: how far each is from its change.
- Thresholds of forces: how far each is on its side; below zero also where it has been at zero since the last completed
  step, by the cubic through states and rates at both ends of it.
- Friction: the slip speed of what slips; what friction of what sticks could hold more.

Each is scaled to order 1, and lifted above zero where an event has left it below (`events`). What cannot happen in
the present mode is 1.
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, Exchange, LinearSystem, Pose, Rubs
from ...tables.parts import Contacts, Outlines, Ports
from ...tables.sizes import Sizes
from ...tolerances import PASSES_BY, SLIPS_ABOVE, STICK_SPEED
from .. import status
from ..compiler.subset import jit, keep_apart, keep_small
from ..constraints.friction_rows import rubs, slips, sticks
from ..constraints.rows import row_count
from ..contacts.binding import is_free
from ..contacts.guards import can_open, gap, guard_of, guard_value, is_watched
from ..dynamics.acceleration import derivative
from ..dynamics.forces import feed, set_time
from ..dynamics.rounding import force_rounding, note_level
from ..dynamics.sliding import hold
from ..elementary import sine_cosine
from ..outlines.nearest import look_no_deeper
from ..scales import contact_speed, contact_unit, force_scale, friction_unit, guard_unit, length_scale, slip_scale
from ..stepping.singular import SINGULAR_BELOW, independence
from ..stepping.step_size import MOST_TURN
from .thresholds import write_threshold_indicators

#: By how much a leaving contact's indicator rises with its gap: so fast must it come back from a gap for that to be
#: seen before the gap is zero, in the time of the mechanism.
RETURN_TIME = 0.1
#: Poses between which a step runs: its start, two control points, and now.
_SEEN, _LEAVES, _ARRIVES, _NOW = range(4)
#: The order of lengths in a mechanism whose scale is 1 [m], and of angles [rad].
EXTENT = 0.14
#: Outlines may graze each other unseen by half of this part of the smaller one's radius.
_GRAZE = 1e-3
#: An indicator below this is due, and behind events none is below twice as much.
DUE = 1e-12
#: A closed contact opens, and what sticks slips, when its force lacks so many times its tolerance.
LETS_GO = 2.0


@jit
def evaluate(block: Array) -> Pose:
    """Forces and accelerations at y_end and TIME with the present inputs, which may move between events."""
    keep_apart()
    now = Course(block)
    feed(block, Ports(block).inputs)
    set_time(block, now.clock[codes.TIME])
    return derivative(block, now.y_end, now.dy_end)


@jit
def what_forbids(block: Array) -> int:
    """Why the accelerations last computed are none, or `status.OK`."""
    keep_small()
    dy = Course(block).dy_end
    for k in range(dy.shape[0]):
        if not abs(dy[k]) < 1e300:
            return status.JAMMED if rubs(block) else status.STEP_TOO_SMALL
    if LinearSystem(block).rank[0] != Course(block).counters[codes.RANK] or independence(block) < SINGULAR_BELOW:
        return status.SINGULAR
    return status.OK


@jit
def happens(block: Array, number: int) -> tuple[int, int]:
    """What it is that happens when this indicator comes to zero in the present mode, as `guards.guard_of`."""
    keep_small()
    guard, subject = guard_of(block, number)
    if guard == codes.GUARD_GAP and Contacts(block).mode[subject] == codes.CLOSED:
        guard = codes.GUARD_PUSH
    elif guard == codes.GUARD_STICK and sticks(block, subject):
        guard = codes.GUARD_SLIP
    return guard, subject


@jit
def can_happen(block: Array, number: int) -> bool:
    """Whether this indicator can come to zero in the present mode."""
    keep_small()
    guard, subject = happens(block, number)
    if guard == codes.GUARD_PUSH:
        pushes: bool = Contacts(block).value[subject, codes.ENABLED] > 0.5 and can_open(block, subject)
        return pushes
    if guard == codes.GUARD_SLIP:
        return True
    if guard == codes.GUARD_STICK:
        return rubs(block) and slips(block, subject)
    return is_watched(block, number)


@jit
def is_leaving(block: Array, number: int) -> bool:
    """Whether this is the indicator of an open contact whose rate is looked at."""
    keep_small()
    guard, subject = guard_of(block, number)
    if guard != codes.GUARD_GAP or Contacts(block).mode[subject] == codes.CLOSED or is_free(block, subject):
        return False
    leaves: bool = Exchange(block).leaves[subject] == 1
    return leaves


@jit
def indicator(block: Array, at: Pose, number: int) -> float:
    """One indicator at the pose, forces and accelerations of `evaluate`, without its lift."""
    keep_apart()
    if not can_happen(block, number):
        return 1.0
    guard, subject = happens(block, number)
    if guard == codes.GUARD_PUSH:
        row = Contacts(block).row[subject]
        note_level(block, row_count(block))
        force: float = LinearSystem(block).multiplier[row] + LETS_GO * force_rounding(block, row)
        return force / order(block, guard, subject)
    if guard == codes.GUARD_SLIP:
        note_level(block, row_count(block))
        return (hold(block, subject) + LETS_GO * force_rounding(block, Rubs(block).row[subject])) / order(
            block, guard, subject
        )
    if is_leaving(block, number):
        distance, rate = gap(block, at, subject)
        unit = contact_unit(block, subject)
        leaves = (rate / contact_speed(block, subject) + STICK_SPEED) * unit + distance / RETURN_TIME
        return leaves / order(block, guard, subject)
    if guard == codes.GUARD_GAP and is_free(block, subject):
        return _before_meeting(block, at, number, subject) / order(block, guard, subject)
    value = guard_value(block, at, number)[0]
    if guard == codes.GUARD_STICK:
        value = (value / slip_scale(block, subject) + 0.5 * SLIPS_ABOVE) * friction_unit(block, subject)  # 0: at rest
    return value / order(block, guard, subject)


@jit
def _before_meeting(block: Array, at: Pose, number: int, contact: int) -> float:
    """How far two outlines are from touching, or from the next look at that [m]."""
    keep_small()
    table = Contacts(block)
    known = table.apart[table.group[contact]]
    one, other = table.outline_i[contact], table.outline_j[contact]
    graze = unseen(block, contact)
    i, j = table.body_i[contact], table.body_j[contact]
    travel = _travel(block, i, j, one)
    if Outlines(block).copies[other] == 0:
        travel = min(travel, _travel(block, j, i, other))
    if known >= graze:
        return float(known - travel)
    look_no_deeper(block, 2.0 * graze)  # what has come in since is to be seen, that far at least
    distance = guard_value(block, at, number)[0]
    look_no_deeper(block, 0.0)
    return float(min(distance, 2.0 * graze - travel))


@jit
def unseen(block: Array, contact: int) -> float:
    """How far two outlines may reach into each other before that is passed over unseen [m]."""
    keep_small()
    data = Outlines(block).data
    one: float = data[Contacts(block).outline_i[contact], codes.OUTLINE_RADIUS]
    other: float = data[Contacts(block).outline_j[contact], codes.OUTLINE_RADIUS]
    return _GRAZE * min(one, other)


@jit
def _travel(block: Array, i: int, j: int, outline: int) -> float:
    """A bound of how far points of the circle around an outline of body i have gone in the frame of body j [m].

    Since the last completed step, at any instant since then: that of the poses between which the cubic through places
    and velocities at both ends runs (the control points of its Bezier form).
    """
    keep_small()
    data = Outlines(block).data[outline]
    x, y = data[codes.OUTLINE_X], data[codes.OUTLINE_Y]
    radius: float = data[codes.OUTLINE_RADIUS]
    xi, yi, phi_i = _pose(block, i, _SEEN)
    xj, yj, phi_j = _pose(block, j, _SEEN)
    seen_x, seen_y = _from(xj, yj, phi_j, xi, yi, phi_i, x, y)
    most = 0.0
    for which in range(_LEAVES, _NOW + 1):
        now_xi, now_yi, now_i = _pose(block, i, which)
        now_xj, now_yj, now_j = _pose(block, j, which)
        now_x, now_y = _from(now_xj, now_yj, now_j, now_xi, now_yi, now_i, x, y)
        turned = abs(now_i - phi_i - now_j + phi_j)
        most = max(most, math.sqrt((now_x - seen_x) ** 2 + (now_y - seen_y) ** 2) + radius * turned)
    return most


@jit
def _from(
    xj: float, yj: float, phi_j: float, xi: float, yi: float, phi_i: float, x: float, y: float
) -> tuple[float, float]:
    """The point (x, y) of body i in the frame of body j [m]."""
    keep_small()
    s, c = sine_cosine(phi_i)
    dx = xi + c * x - s * y - xj
    dy = yi + s * x + c * y - yj
    s, c = sine_cosine(phi_j)
    return c * dx + s * dy, c * dy - s * dx


@jit
def _pose(block: Array, body: int, which: int) -> tuple[float, float, float]:
    """Place and angle of a body at the last completed step, now, or at a control point of the cubic in between."""
    keep_small()
    if body == Sizes(block).bodies:
        return 0.0, 0.0, 0.0
    return (
        _coordinate(block, 3 * body, which),
        _coordinate(block, 3 * body + 1, which),
        _coordinate(block, 3 * body + 2, which),
    )


@jit
def _coordinate(block: Array, k: int, which: int) -> float:
    clock = Course(block).clock
    third = (clock[codes.TIME] - clock[codes.COMPLETED]) / 3.0
    n = Sizes(block).coordinates
    seen = Exchange(block).seen_y
    now = Course(block).y_end
    value: float = seen[k]
    if which == _LEAVES:
        value += third * seen[n + k]
    elif which == _ARRIVES:
        value = now[k] - third * now[n + k]
    elif which == _NOW:
        value = now[k]
    return value


@jit
def _before_turned(block: Array) -> float:
    """How much further the body that has turned most may turn, in parts of what it may."""
    keep_small()
    if Sizes(block).indicators == Sizes(block).rubs + 1:
        return 1.0
    most = 0.0
    for k in range(2, Sizes(block).coordinates, 3):
        for which in range(_LEAVES, _NOW + 1):
            most = max(most, abs(_coordinate(block, k, which) - _coordinate(block, k, _SEEN)))
    return 1.0 - most / MOST_TURN


@jit
def write_indicators(block: Array) -> None:
    """All indicators at y_end and TIME."""
    keep_small()
    at = evaluate(block)
    table = Exchange(block)
    for g in range(Sizes(block).guards):
        table.indicator[g] = indicator(block, at, g) + table.lift[g]
    if Sizes(block).thresholds > 0:
        write_threshold_indicators(block)
    table.indicator[table.indicator.shape[0] - 1] = _before_turned(block)


@jit
def measure(block: Array, at: Pose) -> None:
    """Measure how far all outlines are apart from which nothing is bound, for the indicators of what follows."""
    keep_small()
    table = Contacts(block)
    for g in range(table.mode.shape[0]):
        if is_free(block, g) and can_happen(block, g):
            table.apart[table.group[g]] = 0.0
            table.apart[table.group[g]] = max(guard_value(block, at, g)[0], 0.0)


@jit
def due_below(block: Array, number: int) -> float:
    """Below which value an indicator is due: of forces, where they lack more than half of what they may."""
    keep_small()
    guard, subject = happens(block, number)
    if guard != codes.GUARD_PUSH and guard != codes.GUARD_SLIP:
        return DUE
    note_level(block, row_count(block))
    row = Contacts(block).row[subject] if guard == codes.GUARD_PUSH else Rubs(block).row[subject]
    return max(DUE, 0.25 * LETS_GO * force_rounding(block, row) / order(block, guard, subject))


@jit
def lift(block: Array, at: Pose, number: int, least: float) -> None:
    """Lift an indicator that is less than `least` to that, or take back its lift.

    What has come to the end of a feature in a hollow corner has nowhere to go on; it counts again `PASSES_BY` farther.
    """
    keep_small()
    value = indicator(block, at, number)
    table = Exchange(block)
    table.lift[number] = 0.0
    if value < least:
        table.lift[number] = least - value
        guard, subject = guard_of(block, number)
        if guard == codes.GUARD_HANDOVER:
            table.lift[number] += PASSES_BY * length_scale(block) / order(block, guard, subject)


@jit
def order(block: Array, guard: int, subject: int) -> float:
    """Order of what an indicator is of: a length or angle of the mechanism, or a force or torque."""
    keep_small()
    if guard == codes.GUARD_PUSH:
        return force_scale(block) * length_scale(block) / contact_unit(block, subject)
    if guard == codes.GUARD_SLIP:
        return force_scale(block) * length_scale(block) / friction_unit(block, subject)
    return EXTENT * guard_unit(block, guard, subject)
